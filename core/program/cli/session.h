/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The file of a command, and what the command needs to know of it. */
#ifndef CLI_SESSION_H
#define CLI_SESSION_H

#include "../study/kinds/kinds.h"
#include "options.h"

/* A check tries the first rows of a table of cases, at most this many, and the last one. */
enum { CLI_MOST_ROWS = 1000 };
/* A check looks at each case of a study with at most CLI_MOST_CASES cases; of a study that chooses
 * its cases itself, only at CLI_MOST_SPREAD cases, spread from the first to the last. */
enum { CLI_MOST_CASES = 256, CLI_MOST_SPREAD = 32 };

typedef struct cli_session {
    ff_report *report;
    ff_engine *engine;
    ff_run *run;
    ff_pipeline *pipeline;   /* the pipeline of the run; for a study, the pipeline of its example
                                case; may be NULL after errors */
    study_definition *study; /* NULL: a single case */
    size_t first;            /* the number of the example case */
    size_t tried; /* number of complete cases that a check has tried; 0: only single values were
                   * tried */
} cli_session;

/* Returns an engine that searches the directories given as options. */
ff_engine *cli_engine_new(const cli_options *options);

/* Loads the file, applies --set and builds the pipeline. False if the report has errors. */
bool cli_session_open(cli_session *session, const cli_options *options, bool everything);
void cli_session_close(cli_session *session);
/* Builds a case of the study; if `runs`, also runs its quick stages. The messages of the
 * returned run, which the caller closes, say what is wrong with the case. */
ff_run *cli_session_try(const cli_session *session, const cli_options *options, size_t index,
                        bool runs);

/* Returns the directory for the results of a run: -o, or results/<name of the file without its
 * ending>, extended by the assignments of --set, so that variants do not replace each other. Freed
 * by the caller. */
char *cli_run_directory(const cli_options *options);
/* Returns the directory for a study, which keeps the cases of all variants. Freed by the caller. */
char *cli_study_directory(const cli_options *options);

/* Whether --strict is given and fails the result: numbers are in doubt, a limit is not surely met,
 * or there is a warning that is not about the range of a model. `print`: prints the reason. */
bool cli_is_strict_about(const cli_options *options, bool doubtful, bool unsure,
                         const ff_report *report, bool print);

/* Prints the errors, as JSON or followed by `ending`, and returns their exit code. */
int cli_refuse(const ff_report *report, const cli_options *options, const char *ending);

#endif
