/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stores the common parts of records only once. The form of a record is the record with null in
   place of its numbers, and of texts that differ from case to case. A line of the journal names the
   form and lists the values in their order. The first line of each worker with a form, and every
   256th after it, also contains the form itself:
     {"case":1,"key":"...","status":"ok","form":"HASH","is":{...},"values":[...],"sum":"..."}
   The members "log" and "parameters" are stored next to the form. */
#ifndef STUDY_RECORD_SCHEMA_H
#define STUDY_RECORD_SCHEMA_H

#include <jansson.h>
#include <stddef.h>
#include <stdio.h>

enum { STUDY_FORM_NAME = 17 }; /* size of a form's name, a hash, with its terminating zero, bytes */

/* Writes the record as a line without its closing brace. `written_forms` counts, for each form, the
   lines since the form was last written. The form of the record is added. */
void study_form_write(json_t *record, json_t *written_forms, FILE *out);

/* Returns the record of a line with a form, or NULL if the values do not fit the form. */
json_t *study_form_fill(const json_t *form, const json_t *line);

#endif
