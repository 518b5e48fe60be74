/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs a fit on numbers of a test, with the laws as they are built. */
#ifndef TEST_FITTING_H
#define TEST_FITTING_H

#include "../../../../core/program/fit/fit.h"

typedef struct fitting {
    const char *id;      /* of the law */
    const char *hold[4]; /* "V_occ=0.6132", ..., NULL */
    ff_engine *engine;
    ff_report *report; /* of the last run */
    fit fit;
    const fit_law *law; /* its only one */
} fitting;

/* Columns in SI; T, uncertainty and weight may be NULL. */
typedef struct points {
    size_t n;
    const double *p, *eta, *T, *uncertainty, *weight;
} points;

/* Makes the checks as the program makes its fits; the answer is main's. */
int fitting_test(void (*checks)(void));

/* Whether the law could be fitted. */
bool fitting_run(fitting *f, const points *data);
void fitting_close(fitting *f);
const fit_param *fitting_param(const fitting *f, const char *name);
/* Whether a message of the last run has this part. */
bool fitting_says(const fitting *f, const char *part);

/* ln eta of the law with these parameters, "eta0", "5 mPa s", ..., NULL. */
void fitting_truth(const char *id, const char *const *params, size_t n, const double *p,
                   double *ln_eta);

/* Numbers of the normal distribution, the same everywhere. */
double fitting_normal(uint64_t *state);

#endif
