/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ends a study whose plugin is written over: its code is the file, as long as it runs. */
#include "run.h"

#include <stdio.h>

const char *study_written_over(const study_run *run, char *text, size_t size)
{
    for (size_t i = 0; run->pipeline && i < run->pipeline->count; i++) {
        const ff_stage *stage = &run->pipeline->stages[i];
        const ff_guard_mark mark = {.loaded = stage->loaded};
        if (!ff_guard_written_over(&mark))
            continue;
        snprintf(text, size,
                 "%s: the plugin %s was written over while the study ran; what it did before is "
                 "kept, and the same command goes on with the plugin as it is now",
                 stage->name, stage->loaded->path);
        return text;
    }
    return NULL;
}
