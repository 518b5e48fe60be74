/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Building a pipeline from a file, step by step. */
#include "build.h"

#include "../plugin/param.h"

#include <stdlib.h>

static void warn_of_accuracy(const fe_build *b)
{
    bool chooses = !b->accuracy || fe_report_errors(b->report) > 0;
    for (size_t i = 0; i < b->pipeline->count && !chooses; i++)
        chooses = b->pipeline->stages[i].needed && b->pipeline->stages[i].choice;
    if (!chooses)
        fe_warn(b->report, b->accuracy->place,
                "accuracy: no stage that runs chooses its model, so that it changes nothing; "
                "write use: KIND/auto there");
}

static void bind(fe_build *b, fe_stage *stage)
{
    fe_bind_stage(b, stage);
    if (stage->choice)
        fe_bind_candidates(b, stage);
}

fe_pipeline *fe_pipeline_build(const fe_tree *tree, fe_library *library, bool everything,
                               fe_report *report)
{
    const fe_node *root = fe_tree_root(tree);
    if (!root)
        return NULL;
    fe_pipeline *pipeline = fe_alloc(sizeof *pipeline);
    pipeline->memory = fe_alloc(sizeof *pipeline->memory);
    pipeline->memory->library = library;
    fe_build b = {.pipeline = pipeline,
                  .library = library,
                  .report = report,
                  .everything = everything,
                  .accuracy = fe_node_get(root, "accuracy")};
    if (!fe_read_stages(&b, root)) {
        fe_pipeline_free(pipeline);
        return NULL;
    }
    for (size_t i = 0; everything && i < pipeline->count; i++)
        fe_link_from(&b, &pipeline->stages[i]);
    fe_request_outputs(&b, fe_node_get(root, "outputs"));
    fe_mark_needed(pipeline);
    fe_sort_stages(&b);
    for (size_t i = 0; i < pipeline->count; i++)
        if (pipeline->stages[i].loaded && (pipeline->stages[i].needed || everything))
            bind(&b, &pipeline->stages[i]);
    for (size_t i = 0; i < pipeline->count; i++) {
        fe_stage *stage = &pipeline->stages[pipeline->order[i]];
        if (stage->params && !stage->instance->broken && stage->choice)
            fe_open_candidates(&b, stage);
        else if (stage->params && !stage->instance->broken)
            fe_open_instance(&b, stage);
    }
    warn_of_accuracy(&b);
    return pipeline;
}

void fe_pipeline_free(fe_pipeline *pipeline)
{
    if (!pipeline)
        return;
    for (size_t i = pipeline->count; i-- > 0;)
        fe_close_instance(&pipeline->stages[pipeline->order[i]]);
    for (size_t i = 0; i < pipeline->count; i++) {
        fe_stage *stage = &pipeline->stages[i];
        fe_free_candidates(stage);
        for (size_t k = 0; stage->params && k < stage->loaded->model->param_count; k++)
            fe_value_clear(&stage->params[k].value);
        fe_forget_results(stage);
        fe_free(stage->state);
    }
    fe_arena_free(&pipeline->memory->arena);
    fe_free(pipeline->memory);
    fe_free(pipeline);
}

const char *fe_verdict_name(int verdict)
{
    return verdict == FF_GOOD ? "good" : verdict == FF_DOUBTFUL ? "doubtful" : "bad";
}
