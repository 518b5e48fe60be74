/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A fit as the command holds it, for fit.c and fit-print.c. */
#ifndef FF_FIT_COMMAND_H
#define FF_FIT_COMMAND_H

#include "command.h"

#include "../pipeline/candidate.h"
#include "../pipeline/tool.h"
#include "../value/columns.h"

#include <flankfilm/fitter.h>

typedef struct ff_fitted_law {
    ff_candidate *candidate;
    char *id;
    ff_fit_law view;
    ff_fit_param *params;
    const ff_fit_param **param_rows;
    /* what was found, copies */
    bool told;
    ff_fit_found found;
    ff_fit_value *values; /* one per parameter */
    double *correlation;
    char *why, *note;
} ff_fitted_law;

typedef struct ff_fit_text {
    char *name, *text;
} ff_fit_text;

typedef struct ff_fitting {
    const ff_options *options;
    ff_report *report;
    ff_library *library;
    ff_tool tool;
    const ff_fitter *fitter;
    ff_columns columns;
    double *at; /* of each column; NaN: not asked */
    ff_tree *settings;
    ff_fitted_law *laws;
    size_t law_count;
    ff_fit_text *texts;
    size_t text_count;
    char *why; /* of the last refusal of a law */
} ff_fitting;

/* The best law, or NULL: none was fitted. */
const ff_fitted_law *ff_fit_best(const ff_fitting *fitting);
/* Smallest and largest number of a column that is there. */
void ff_fit_range(const ff_fitting *fitting, size_t column, double *low, double *high);

void ff_fit_print(const ff_fitting *fitting);
json_t *ff_fit_json(const ff_fitting *fitting); /* the whole answer */

#endif
