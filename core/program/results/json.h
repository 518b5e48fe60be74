/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes answers in JSON. All values are in SI; a number that is not finite is written as null. */
#ifndef RESULTS_JSON_H
#define RESULTS_JSON_H

#include <flankfilm/engine.h>

#include <jansson.h>

enum { RESULTS_FORMAT = 1 /* format number of result.json */ };

/* Digits of every number; with 17, most would only show rounding errors. */
enum { RESULTS_JSON_DIGITS = 12 };

json_t *results_json_key(uint64_t key);      /* 16 hexadecimal digits */
json_t *results_json_text(const char *text); /* null for NULL; what is not UTF-8 is replaced */

/* {"flankfilm": version, "status": status, "exit": code}, the first members of every answer, and
 * the "errors" and "warnings" of the report, unless it is NULL. */
json_t *results_json_answer(const char *status, int code, const ff_report *report);

/* Adds the doubtful quality lines of a pipeline to the "warnings" of an answer, with the places of
 * their stages. */
void results_json_add_doubts(json_t *answer, const ff_pipeline *pipeline);

/* Prints the object as the answer and frees it. */
void results_json_print(json_t *object);

/* These describe parts of a stage. */
json_t *results_json_params(const ff_stage *stage); /* {name: {value, text, origin}} */
json_t *results_json_wires(const ff_pipeline *pipeline, const ff_stage *stage);
/* Returns {version, path, build, reference, bibtex} of a model: path and hash of its plugin, and
 * its literature. */
json_t *results_json_model(const ff_loaded *loaded);
/* Returns the members of results_json_model for a loaded stage, and {parameters, wires}. */
json_t *results_json_origin(const ff_pipeline *pipeline, const ff_stage *stage);

/* Returns {name: text} of the circumstances: version, file, date, machine. */
json_t *results_json_facts(const char *file);

#endif
