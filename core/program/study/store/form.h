/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What records have in common is said once. The form of a record is the record without its numbers
 * and without the texts of its own; null stands in their places. A line of the journal names the
 * form and lists the values that fill those places, in their order; the first line of each worker
 * with a form, and every 256th after it, says it, too:
 *   {"case":1,"key":"...","status":"ok","form":"HASH","is":{...},"values":[...],"sum":"..."}
 * "log" and "parameters" stand beside the form.
 */
#ifndef STUDY_FORM_H
#define STUDY_FORM_H

#include <jansson.h>
#include <stddef.h>
#include <stdio.h>

enum { STUDY_FORM_NAME = 17 }; /* bytes of the hash that names a form, with its end */

/* Writes the record as a line without its last brace. `said` has how many lines ago
   the process has said each form, and gets this one. */
void study_form_write(json_t *record, json_t *said, FILE *out);

/* Returns the record of a line with a form; NULL when the values do not fill it. */
json_t *study_form_fill(const json_t *form, const json_t *line);

#endif
