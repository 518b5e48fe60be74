/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cases listed in a table, from a file or from standard input as they come. The first line names
 * a path for each column, as --set takes it, with a unit in brackets for numbers without one:
 *     duty.torque [N m], oil.grade, x-operator
 *     250, 68, Ada
 * Each further line is a case. An empty field keeps the value of the file. Fields are separated
 * by semicolons, commas or tabs and quoted as in RFC 4180, within one line. Blank lines, lines
 * that begin with # and columns whose name begins with x- are ignored. */
#ifndef STUDY_ROWS_H
#define STUDY_ROWS_H

#include "study.h"

/* Reads the table that `cases:` names into an axis of the study. "-" opens standard input, from
 * which nothing is read yet. False after an error. */
bool study_rows_read(study_definition *study, const ff_node *node, ff_report *report);
void study_rows_free(study_rows *rows); /* accepts NULL */

/* For standard input: waits for the line that names the columns, and reads it. False after an
 * error. */
bool study_rows_begin(study_rows *rows, ff_report *report);
enum { STUDY_ROWS_FD = 0 };
/* Adds the next row to the cases of the study. 1: added; 0: none has come yet; -1: none will
 * come. */
int study_rows_next(study_rows *rows);
void study_rows_wait(void); /* until something comes or a signal does */
bool study_rows_ended(const study_rows *rows);
/* Returns the text of a row, to be passed to study_rows_put in another process. */
const char *study_rows_text(const study_rows *rows, size_t index);
void study_rows_put(study_rows *rows, size_t index, const char *text);
/* Reports why the fields of a row are no case; report may be NULL. */
bool study_rows_check(study_rows *rows, size_t index, ff_report *report);
/* Whether the rows ended with a line that was too long. */
bool study_rows_are_cut(const study_rows *rows);

#endif
