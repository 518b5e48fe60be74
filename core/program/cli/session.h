/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A file that was read, with what the commands need of it. */
#ifndef CLI_SESSION_H
#define CLI_SESSION_H

#include "../study/kinds/kinds.h"
#include "options.h"

/* So many rows of a table of cases are tried by a check, and the last one. */
enum { CLI_MOST_ROWS = 1000 };
/* A check looks at each case of a study of so many, and at so many of a study that makes its cases
   itself, from the first to the last. */
enum { CLI_MOST_CASES = 256, CLI_MOST_SPREAD = 32 };

typedef struct cli_session {
    ff_report *report;
    ff_engine *engine;
    ff_run *run;
    ff_pipeline *pipeline;   /* of the run; may be NULL after errors; of a study: a case that it can
                                run */
    study_definition *study; /* NULL: a single case */
    size_t first;            /* that case */
    size_t tried;            /* cases that a check has looked at as a whole; 0: not whole ones */
} cli_session;

/* With the directories of the options. */
ff_engine *cli_engine_new(const cli_options *options);

/* Loads the file, applies --set and builds the pipeline. False with errors in the report. */
bool cli_session_open(cli_session *session, const cli_options *options, bool everything);
void cli_session_close(cli_session *session);
/* Builds a case of the study, and `runs` the stages of it that are quick. What is wrong with it is
   in the messages of the run that is returned and is the caller's. */
ff_run *cli_session_try(const cli_session *session, const cli_options *options, size_t index,
                        bool runs);

/* Where the results of a run are: -o, or results/<name of the file without its ending>, with what
   --set says behind it, so that a variant stands beside what it varies. Freed by the caller. */
char *cli_run_directory(const cli_options *options);
/* Where those of a study are, whose directory keeps the cases of all variants. Freed by the caller.
 */
char *cli_study_directory(const cli_options *options);

/* Whether --strict is given and fails what was run: numbers are in doubt, a limit is not surely
   met, or there is a warning that is not of the range of a model. `tell` says which. */
bool cli_is_strict_about(const cli_options *options, bool doubtful, bool unsure,
                         const ff_report *report, bool tell);

/* Prints the errors, as JSON or with `ending` below them, and returns their exit code. */
int cli_refuse(const ff_report *report, const cli_options *options, const char *ending);

#endif
