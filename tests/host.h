/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A small host of its own for tests of models: loads one plugin at a time straight from the build
 * tree, without the core's loader and pipeline. Misuse and broken plugins end the test program
 * with a sentence.
 *
 *   stage *gear = stage_open("gear/involute-spur");
 *   stage_set_text(gear, "module", "3 mm");
 *   stage_run(gear);
 *   double ratio = stage_scalar(gear, "contact_ratio");
 */
#ifndef TEST_HOST_H
#define TEST_HOST_H

#include <flankfilm/plugin.h>

typedef struct stage stage;

stage *stage_open(const char *id);
void stage_close(stage *s); /* closes nothing that it is linked to */

/* Parameters: in SI, as a list in SI, or as a user writes them ("3 mm", "auto", "[1, 2]"). */
void stage_set(stage *s, const char *param, double si);
void stage_set_reals(stage *s, const char *param, size_t count, const double *si);
void stage_set_text(stage *s, const char *param, const char *text);

/* Connects the rows "wire.*" or the service "wire" to another stage. */
void stage_link(stage *s, const char *wire, stage *from);
/* Feeds one input row, "contact.time", with the caller's data, which must outlive the run. */
void stage_give(stage *s, const char *row, uint32_t rank, const size_t *shape, const double *data);
void stage_give_scalar(stage *s, const char *row, double value);
void stage_give_series(stage *s, const char *row, size_t count, const double *data);

/* Sets, wires and readies the stage, and what it is linked to; at once done by the calls below. */
ff_status stage_ready(stage *s);
/* Runs the linked stages that have not run, then this one, with all outputs wanted, but for those
   that the model refuses for its inputs, or those named ("h_min p_max"). */
ff_status stage_run(stage *s);
ff_status stage_run_wanted(stage *s, const char *outputs);

/* Hands the state that the run of `from` left to the next run of `to`, as in a chain of cases. 0:
   there is none. */
int stage_carry(stage *to, const stage *from);

/* Results; the program ends when there is no such output, or it was not given or is empty: a loop
   over it would check nothing. */
const double *stage_get(const stage *s, const char *output, size_t *count);
size_t stage_count(const stage *s, const char *output); /* of its numbers; it may be empty */
const size_t *stage_shape(const stage *s, const char *output, uint32_t *rank);
double stage_scalar(const stage *s, const char *output);
int stage_has(const stage *s, const char *output); /* 1: the model gave it */

/* The service table behind the output of that interface id; readies the stage. */
const void *stage_service(stage *s, const char *id);

/* Last text given to host->fail, or "data.csv:3:7: what is wrong with a table"; "" without. */
const char *stage_why(const stage *s);
const char *stage_why_item(const stage *s); /* its parameter or port, "" without */
double stage_quality(const stage *s, const char *name);
double stage_quality_limit(const stage *s, const char *name);
int stage_verdict(const stage *s); /* the worst verdict of the last run */

/* The n-th progress call answers "stop" (0: never). */
void stage_stop_at(stage *s, int call);

/* Checks that count their failures and go on. Return check_done() from main. */
int check_near(const char *what, double value, double expected, double relative);
int check_below(const char *what, double value, double limit);
int check_true(const char *what, int condition);
int check_done(void); /* prints the figures; 0 when there were checks and all held */

#endif
