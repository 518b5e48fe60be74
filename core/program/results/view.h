/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads what a run or a study has left in its directory, for those who write it in another form. */
#ifndef RESULTS_VIEW_H
#define RESULTS_VIEW_H

#include <flankfilm/engine.h>
#include <flankfilm/writer.h>

/* Returns NULL after an error in the report, which also takes the errors of the view's functions.
   Report and directory outlive the view. */
const ff_view *results_view_open(const char *directory, ff_report *report);
void results_view_close(const ff_view *view); /* NULL is allowed */

#endif
