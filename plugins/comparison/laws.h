/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fitted laws, as the files of this folder share them. */
#ifndef FIT_LAWS_H
#define FIT_LAWS_H

#include <flankfilm/author.h>
#include <flankfilm/comparison.h>

#include <stdbool.h>

/* What a fitter said of a law. */
typedef struct fitted {
    const ff_fit_law *law;
    bool told;
    ff_fit_found found;   /* but for what it points to: */
    ff_fit_value *values; /* one for each parameter */
    double *correlation;
    char *why, *note;
} fitted;

typedef struct comparison {
    ff_comparison service;
    fitted *laws;
    size_t count;
} comparison;

/* The best law, or NULL: none was fitted. */
const fitted *fit_best(const comparison *c);
/* Row of a column that the fitter reads. */
const ff_param *fit_column(const ff_comparison_request *r, size_t column);
/* Smallest and largest number of a column that is there. */
void fit_range(const ff_comparison_request *r, size_t column, double *low, double *high);

/* facts.c: the members of the answer, to be freed; NULL: no memory. */
char *fit_facts(const comparison *c, const ff_comparison_request *r);
/* text.c */
void fit_print(const comparison *c, const ff_comparison_request *r);

#endif
