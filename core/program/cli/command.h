/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands of the program, and functions that several of them use. */
#ifndef CLI_COMMAND_H
#define CLI_COMMAND_H

#include "session.h"

#include <jansson.h>

/* An exit code is EXIT_SUCCESS, the FF_FAULT_... of an error, or this one. */
enum { CLI_EXIT_CASES = 4 }; /* a study finished with failed cases */

/* Each command returns the exit code of the program. */
int cli_run(const cli_options *options);
int cli_plan_study(const cli_options *options);
int cli_check(const cli_options *options);
int cli_explain(const cli_options *options);
int cli_cite(const cli_options *options);
int cli_models(const cli_options *options);
int cli_verify_command(const cli_options *options);
int cli_new(const cli_options *options);
int cli_compare(const cli_options *options);
int cli_export(const cli_options *options);
int cli_write_report(const cli_options *options);
int cli_schema(const cli_options *options);
int cli_fit_command(const cli_options *options);

/* Prints how much the cases of a study saved by reusing results; nothing without cases. */
void cli_print_savings(const study_reuse_counts *savings);
json_t *cli_json_savings(const study_reuse_counts *savings);

/* Prints the answer to a row of standard input; false if nobody reads it. */
bool cli_answer_row(size_t index, const json_t *set, const json_t *record, bool known);

/* Prints how many cases a study has, and what they vary. */
void cli_print_cases(const study_definition *study);
/* Runs the study of the session. */
int cli_run_study(cli_session *session, const cli_options *options);
/* Returns the model that --executor names, with the parameters that --with gives. NULL after an
 * error. */
ff_instance *cli_executor_open(ff_engine *engine, const cli_options *options, ff_report *report);
/* Finds the part of the cases that Slurm assigns to this process, from its array index and, unless
 * array_only, its task number. False after an error. */
bool cli_shard_find(study_run *run, bool array_only, ff_report *report);

#endif
