/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Calls of ff_run_* that end the program if memory is short. */
#include "run.h"

#include "../memory/memory.h"

ff_run *run_read(ff_engine *engine, const char *file)
{
    ff_run *run;
    ff_run_read(engine, file, &run);
    return memory_require(run);
}

ff_run *run_copy(const ff_run *run)
{
    ff_run *copy;
    ff_run_copy(run, &copy);
    return memory_require(copy);
}

/* Ends the program if the run ran out of memory: such a run has no messages. */
static void require(ff_run *run)
{
    memory_require(ff_run_report(run));
}

void run_set(ff_run *run, const char *assignment, const ff_place *path, const ff_place *value)
{
    ff_run_set_at(run, assignment, path, value);
    require(run);
}

void run_set_all(ff_run *run, const char *const *assignments, size_t count)
{
    for (size_t i = 0; i < count; i++)
        run_set(run, assignments[i], NULL, NULL);
}

void run_put(ff_run *run, const char *key, const ff_node *node)
{
    ff_run_put(run, key, node);
    require(run);
}

ff_pipeline *run_build(ff_run *run, bool everything)
{
    ff_run_build(run, everything);
    require(run);
    return ff_run_pipeline(run);
}

bool run_has_errors(ff_run *run)
{
    return ff_report_errors(ff_run_report(run)) > 0;
}

bool run_start(ff_run *run, const ff_observer *watch)
{
    bool good = ff_run_start(run, watch) == FF_OK;
    require(run);
    return good;
}

ff_result *run_output(const ff_pipeline *pipeline, const char *path, const ff_stage **stage)
{
    const char *name;
    *stage = ff_stage_of(pipeline, path, &name);
    bool known = *stage && (*stage)->loaded && (*stage)->results;
    int output = known ? ff_model_find_output((*stage)->loaded->model, name) : -1;
    return output < 0 ? NULL : &(*stage)->results[output];
}

ff_stage *run_together(const ff_pipeline *pipeline, const ff_stage *stage, size_t i)
{
    if (stage->loop && i < stage->loop->count)
        return &pipeline->stages[pipeline->order[stage->loop->first + i]];
    return !stage->loop && i == 0 ? &pipeline->stages[stage - pipeline->stages] : NULL;
}
