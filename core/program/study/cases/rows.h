/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Cases listed in a table, from a file or from standard input while it is being written. The first
 * line gives a path for each column, as in --set, with a unit in brackets for numbers without one:
 *     duty.torque [N m], oil.grade, x-operator
 *     250, 68, Ada
 *
 * Each further line is a case. An empty field keeps the value of the file. Fields are separated by
 * semicolons, commas or tabs and quoted as in RFC 4180, within one line. Blank lines, lines that
 * begin with # and columns whose name begins with x- are ignored.
 */
#ifndef STUDY_ROWS_H
#define STUDY_ROWS_H

#include "study.h"

/* Reads the table that `cases:` names into an axis of the study. "-" opens standard input without
   reading it. Returns false after an error. */
bool study_rows_read(study_definition *study, const ff_node *node, ff_report *report);
void study_rows_free(study_rows *rows); /* accepts NULL */

/* For standard input: waits for the line that names the columns, and reads it. Returns false after
   an error. */
bool study_rows_begin(study_rows *rows, ff_report *report);
enum { STUDY_ROWS_FD = 0 };
/* Adds the next row to the cases of the study. Returns 1 if a row was added, 0 if none has arrived
   yet, -1 if there will be none. */
int study_rows_next(study_rows *rows);
void study_rows_wait(void); /* waits until data or a signal arrives */
bool study_rows_ended(const study_rows *rows);
/* Returns the text of a row, to be passed to study_rows_put in another process. */
const char *study_rows_text(const study_rows *rows, size_t index);
void study_rows_put(study_rows *rows, size_t index, const char *text);
/* Reports why the fields of a row are not a case. `report` may be NULL. */
bool study_rows_check(study_rows *rows, size_t index, ff_report *report);
/* Returns whether the rows ended with a line that was too long. */
bool study_rows_are_cut(const study_rows *rows);

#endif
