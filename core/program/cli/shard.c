/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds which part of a study this process runs, from the environment that Slurm sets. */
#include "command.h"

#include <stdlib.h>

static long environment(const char *name, long otherwise)
{
    const char *text = getenv(name);
    return text && *text ? strtol(text, NULL, 10) : otherwise;
}

bool cli_shard_find(study_run *run, bool array_only, ff_report *report)
{
    long arrays = environment("SLURM_ARRAY_TASK_COUNT", 1);
    long first = environment("SLURM_ARRAY_TASK_MIN", 0);
    long step = environment("SLURM_ARRAY_TASK_STEP", 1);
    long last = environment("SLURM_ARRAY_TASK_MAX", first + (arrays - 1) * step);
    long array = environment("SLURM_ARRAY_TASK_ID", first) - first;
    if (arrays < 2) {
        arrays = 1;
        array = 0;
    } else if (step < 1 || last - first != (arrays - 1) * step || array < 0 || array % step != 0 ||
               array / step >= arrays) {
        return ff_error(
            report, FF_FAULT_INPUT, FF_NOWHERE, "give the part: --shard I/N",
            "the numbers of Slurm's array are not a range: %ld of %ld tasks from %ld to "
            "%ld",
            array + first, arrays, first, last);
    }
    long tasks = array_only ? 1 : environment("SLURM_STEP_NUM_TASKS", 1);
    long task = environment("SLURM_PROCID", 0);
    if (tasks < 2 || task < 0 || task >= tasks) {
        tasks = 1;
        task = 0;
    }
    run->shard = (size_t)(array / step * tasks + task) + 1;
    run->shards = (size_t)(arrays * tasks);
    return true;
}
