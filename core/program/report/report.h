/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the report, a single page that needs no other files and no network. */
#ifndef REPORT_REPORT_H
#define REPORT_REPORT_H

#include "../results/view.h"

#include <flankfilm/engine.h>
#include <stdio.h>

#define REPORT_BEGINS "<!DOCTYPE html>" /* the first bytes of a page */

/* Files from which pages are made: layout, styles and scripts. */
typedef struct report_template report_template;

/* Opens the program's files. If `folder` is not NULL, its files named layout.html, figure.css,
 * page.css, figure.js, answers.js, choose.js and script.js are used instead. NULL after an error.
 */
report_template *report_template_open(const char *folder, ff_report *report);
void report_template_close(report_template *of); /* NULL is allowed */

/* Writes the page to a file. `best` has texts such as "OUTPUT=least" or "OUTPUT=largest": outputs
 * of a sweep whose best values the page names. Returns false after an error, which is in `report`;
 * the view must have the same report. */
bool report_write(const results_view *view, const report_template *with, const char *const *best,
                  size_t best_count, const char *path, ff_report *report);

/* Writes a page with figures only; `json` is a list of their descriptions. */
void report_write_figures(FILE *out, const report_template *with, const char *title,
                          const char *json);

#endif
