/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Results as JSON. All values are SI; a number that is not finite is written as null. */
#ifndef FF_JSON_H
#define FF_JSON_H

#include "../pipeline/pipeline.h"

#include <jansson.h>

/* Digits of every number: 17 would mostly show rounding errors. */
enum { FF_JSON_DIGITS = 12 };

json_t *ff_json_text(const char *text); /* null for NULL; what is not UTF-8 is replaced */
json_t *ff_json_real(double value);

/* Messages of one severity: [{file, line, column, message, hint}]. */
json_t *ff_json_messages(const ff_report *report, ff_severity severity);

/* {"flankfilm": version, "status": status, "exit": code}, the start of every answer. */
json_t *ff_json_answer(const char *status, int code);

/* Adds "errors" and "warnings". */
void ff_json_add_messages(json_t *answer, const ff_report *report);

/* Prints the object, frees it. */
void ff_json_print(json_t *object, FILE *stream);

/* The answer of a command that could not do its work; returns the exit code of the report. */
int ff_json_refuse(const ff_report *report);

/* Parts of a stage. */
json_t *ff_json_params(const ff_stage *stage); /* {name: {value, text, origin}} */
json_t *ff_json_wires(const ff_pipeline *pipeline, const ff_stage *stage);
json_t *ff_json_quality(const ff_stage *stage);

/* How a stage ended, in a word or two. */
const char *ff_status_name(const ff_stage *stage);

#endif
