/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stores what records have in common only once. The form of a record is the record with null in
 * place of its numbers and of texts that differ from case to case. A line of the journal names
 * the form and lists the values in their order. The first line of each worker with a form, and
 * every 256th after it, also has the form itself:
 * {"case":1,"key":"...","status":"ok","form":"HASH","is":{...},"values":[...],"sum":"..."}
 * "log" and "parameters" stand beside the form. */
#ifndef STUDY_FORM_H
#define STUDY_FORM_H

#include <jansson.h>
#include <stddef.h>
#include <stdio.h>

enum { STUDY_FORM_NAME = 17 }; /* bytes of a form's name, a hash, with its end */

/* Writes the record as a line without its closing brace. `said` counts for each form the lines
 * since it was last written; this form is added. */
void study_form_write(json_t *record, json_t *said, FILE *out);

/* Returns the record of a line with a form; NULL if the values do not fit the form. */
json_t *study_form_fill(const json_t *form, const json_t *line);

#endif
