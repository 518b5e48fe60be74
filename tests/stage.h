/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Short names for instances of one model in tests: from the build tree, and misuse or a fault of
 * the plugin ends the test program with the engine's sentence.
 *
 *   stage *gear = stage_open("gear/involute-spur");
 *   stage_set_text(gear, "module", "3 mm");
 *   stage_run(gear);
 *   double ratio = stage_scalar(gear, "contact_ratio");
 */
#ifndef TEST_STAGE_H
#define TEST_STAGE_H

#include <flankfilm/engine.h>

typedef ff_instance stage;

stage *stage_open(const char *id);
void stage_close(stage *s);

/* Parameters: in SI, as a list in SI, or as a user writes them. */
void stage_set(stage *s, const char *param, double si);
void stage_set_reals(stage *s, const char *param, size_t count, const double *si);
void stage_set_text(stage *s, const char *param, const char *text);
/* The same for a value that is to be refused. */
ff_status stage_try_text(stage *s, const char *param, const char *text);

void stage_link(stage *s, const char *wire, stage *from);
void stage_give(stage *s, const char *row, uint32_t rank, const size_t *shape, const double *data);
void stage_give_scalar(stage *s, const char *row, double value);
void stage_give_series(stage *s, const char *row, size_t count, const double *data);

/* The status of the model; a fault of the plugin ends the program. */
ff_status stage_ready(stage *s);
ff_status stage_run(stage *s); /* for all outputs that it does not refuse */
ff_status stage_run_wanted(stage *s, const char *outputs);

/* Hands the state of the last run of `from` to the next run of `to`. 0: there is none. */
int stage_carry(stage *to, stage *from);

/* Results; the program ends when there is no such output, or it was not given or is empty: a loop
   over it would check nothing. */
const double *stage_get(const stage *s, const char *output, size_t *count);
size_t stage_count(const stage *s, const char *output); /* of its numbers; it may be empty */
const size_t *stage_shape(const stage *s, const char *output, uint32_t *rank);
double stage_scalar(const stage *s, const char *output);
int stage_has(const stage *s, const char *output); /* 1: the model gave it */

const void *stage_service(stage *s, const char *id);

const char *stage_why(const stage *s);      /* the reason of the last status; "" without */
const char *stage_why_item(const stage *s); /* its parameter or port, "" without */
int stage_has_quality(const stage *s, const char *name); /* 1: there is such a line */
double stage_quality(const stage *s, const char *name);
double stage_quality_limit(const stage *s, const char *name);
int stage_verdict(const stage *s); /* the worst verdict of the last run */

/* The n-th call of progress in a run answers "stop" (0: never); of one stage at a time. */
void stage_stop_at(stage *s, int call);

#endif
