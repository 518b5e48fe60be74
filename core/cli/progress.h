/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Looks after a run: the progress line, the interrupt key, what models tell. */
#ifndef FF_PROGRESS_H
#define FF_PROGRESS_H

#include "json.h"

typedef struct ff_progress {
    ff_watch watch; /* to give to ff_pipeline_run */
    ff_report *report;
    json_t *log; /* [{stage, level, text}]; the caller frees it */
    bool terminal;
    const ff_stage
        *stage; /* that is at work, since `started`; its line was drawn last at `drawn` */
    double started, drawn; /* s; 0: no line stands on the terminal */
} ff_progress;

/* Takes over SIGINT: the first one asks the stages to stop, the second ends the program. */
void ff_progress_begin(ff_progress *progress, ff_report *report);
void ff_progress_end(ff_progress *progress); /* clears the line; SIGINT is as it was before */

bool ff_interrupted(void);

#endif
