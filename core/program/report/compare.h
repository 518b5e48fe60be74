/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares two or more designs: their results, the differences from the first, and whether these
 * are larger than the errors. */
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

/* Adds the table of the requested outputs (scalars and extremes of series), and figures of the
 * series that all designs have along the path of contact. Returns false after an error, which the
 * view has reported. */
bool report_compare(study_answer *answer, const report_design *designs, size_t count);

#endif
