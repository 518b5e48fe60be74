/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Watches a run: draws the progress line, handles the interrupt key, keeps the log of the
 * models. */
#ifndef CLI_PROGRESS_H
#define CLI_PROGRESS_H

#include "../accuracy/measure.h"
#include "../results/json.h"

typedef struct cli_progress {
    ff_observer watch; /* to give to ff_run_start */
    ff_report *report;
    json_t *log; /* [{stage, level, text}]; the caller frees it */
    bool terminal;
    char text[ACCURACY_PROGRESS]; /* what is being run, if there are several runs; otherwise "" */
    /* the stage that is running: since `started`; its line was last drawn at `drawn` */
    const ff_stage *stage;
    double started, drawn; /* s; 0: no line is shown */
} cli_progress;

/* Handles SIGINT: the first one asks the stages to stop, the second ends the program. */
void cli_progress_begin(cli_progress *progress, ff_report *report);
/* clears the line, and restores the handling of SIGINT */
void cli_progress_end(cli_progress *progress);

bool cli_interrupted(void);

#endif
