/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Two or more designs side by side: what each gave, how it differs from the first, and whether the
 * difference is larger than what the numbers are known to.
 */
#ifndef REPORT_COMPARE_H
#define REPORT_COMPARE_H

#include "../results/view.h"
#include "../study/kinds/answer/answer.h"

/* A run, or a case of a study. */
typedef struct report_design {
    const results_view *view;
    size_t index;
    const char *name; /* "results/a", "results/study:3" */
} report_design;

/* Adds the table of the outputs that the designs' files ask for, of the scalars and the extremes
   of series, and the drawings of the series that all of them have along the path of contact. False
   after an error, which the view has reported. */
bool report_compare(study_answer *answer, const report_design *designs, size_t count);

#endif
