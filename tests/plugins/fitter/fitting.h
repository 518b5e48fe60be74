/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs the fitter on numbers of a test, with the laws as they are built. */
#ifndef TEST_FITTING_H
#define TEST_FITTING_H

#include <flankfilm/fitter.h>
#include <flankfilm/viscosity.h>
#include <host.h>

enum { FITTING_MOST_PARAMS = 24 };

typedef struct fitting {
    const char *id;                        /* of the law */
    const char *hold[FITTING_MOST_PARAMS]; /* "V_occ", "0.6132", ..., NULL */
    stage *fitter, *law;
    ff_fit_param params[FITTING_MOST_PARAMS];
    const ff_fit_param *rows[FITTING_MOST_PARAMS];
    size_t count;
    /* what was found */
    int told;
    char why[400], note[2000], refusal[400];
    ff_fit_found found;
    ff_fit_value values[FITTING_MOST_PARAMS];
} fitting;

/* Columns in SI; T, uncertainty and weight may be NULL. */
typedef struct points {
    size_t n;
    const double *p, *eta, *T, *uncertainty, *weight;
} points;

void fitting_open(fitting *f);
void fitting_close(fitting *f);
ff_status fitting_run(fitting *f, const points *data);
const ff_fit_value *fitting_value(const fitting *f, const char *param);

/* ln eta of the law with these parameters, "eta0", "5 mPa s", ..., NULL. */
void fitting_truth(const char *id, const char *const *params, size_t n, const double *p,
                   double *ln_eta);

/* Numbers of the normal distribution, the same everywhere. */
double fitting_normal(uint64_t *state);

#endif
