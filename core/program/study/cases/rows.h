/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Cases that a table lists, in a file or as they come from standard input. The first line names a
 * path in each column, as --set takes it, with a unit in brackets for numbers without one:
 *
 *     duty.torque [N m], oil.grade, x-operator
 *     250, 68, Ada
 *
 * Each further line is a case. An empty field leaves the value of the file. Fields are parted by
 * semicolons, commas or tabs and quoted as in RFC 4180, within one line. Blank lines, lines that
 * begin with # and columns whose name begins with x- are passed over.
 */
#ifndef STUDY_ROWS_H
#define STUDY_ROWS_H

#include "study.h"

/* Reads what stands under `cases:` into an axis of the study; "-" opens standard input, of which
   nothing is read yet. False after an error. */
bool study_rows_read(study_definition *study, const ff_node *node, ff_report *report);
void study_rows_free(study_rows *rows); /* accepts NULL */

/* Of standard input. Reads the line that names the columns; waits for it. False after an error. */
bool study_rows_begin(study_rows *rows, ff_report *report);
enum { STUDY_ROWS_FD = 0 };
/* Adds the next row to the cases of the study: 1; 0 when none has come yet, -1 when none will. */
int study_rows_next(study_rows *rows);
void study_rows_wait(void); /* until something comes or a signal does */
bool study_rows_ended(const study_rows *rows);
/* Returns the text of a row, for study_rows_put in another process. */
const char *study_rows_text(const study_rows *rows, size_t index);
void study_rows_put(study_rows *rows, size_t index, const char *text);
/* Reports what is wrong with a row whose fields are no case; report may be NULL. */
bool study_rows_check(study_rows *rows, size_t index, ff_report *report);
/* Whether the rows ended with a line that was too long. */
bool study_rows_are_cut(const study_rows *rows);

#endif
