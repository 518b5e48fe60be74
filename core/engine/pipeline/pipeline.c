/* SPDX-License-Identifier: MIT */
/* Builds a pipeline from a file, step by step. */
#include "pipeline.h"
#include "build.h"

#include <stdlib.h>
#include <string.h>

static void warn_of_feedback(const fe_build *b, const ff_node *feedback)
{
    bool loops = !feedback || ff_report_errors(b->report) > 0;
    for (size_t i = 0; i < b->pipeline->count && !loops; i++)
        loops = b->pipeline->stages[i].needed && b->pipeline->stages[i].loop;
    if (!loops)
        ff_warn(b->report, feedback->place,
                "feedback: this changes nothing, since no stage that runs is in a loop");
}

ff_pipeline *fe_pipeline_build(const fe_tree *tree, ff_engine *engine, bool everything,
                               ff_report *report)
{
    const ff_node *root = fe_tree_root(tree);
    if (!root)
        return NULL;
    ff_pipeline *pipeline = fe_alloc(sizeof *pipeline);
    pipeline->memory = fe_alloc(sizeof *pipeline->memory);
    pipeline->memory->engine = engine;
    fe_folder_keep(&pipeline->memory->folder);
    fe_build b = {.pipeline = pipeline,
                  .engine = engine,
                  .report = report,
                  .everything = everything,
                  .file_rank = root->rank};
    if (!fe_read_stages(&b, root)) {
        fe_pipeline_free(pipeline);
        return NULL;
    }
    for (size_t i = 0; everything && i < pipeline->count; i++)
        fe_link_from(&b, &pipeline->stages[i]);
    fe_read_feedback(&b, ff_node_get(root, "feedback"));
    fe_request_outputs(&b, ff_node_get(root, "outputs"));
    fe_request_limits(&b, ff_node_get(root, "limits"));
    fe_read_accept(&b, ff_node_get(root, "accept"));
    fe_mark_needed(pipeline);
    fe_sort_stages(&b);
    fe_check_dims(&b);
    for (size_t i = 0; i < pipeline->count; i++)
        if (pipeline->stages[i].loaded && (pipeline->stages[i].needed || everything))
            fe_bind_stage(&b, &pipeline->stages[i]);
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[pipeline->order[i]];
        if (stage->params && !stage->instance->broken)
            fe_open_instance(&b, stage);
        if (stage->instance->created)
            fe_check_folder(pipeline, stage, "create, set, wire or ready", report);
    }
    fe_check_needs(&b);
    warn_of_feedback(&b, ff_node_get(root, "feedback"));
    fe_check_unread(&b, ff_node_get(root, "outputs"));
    return pipeline;
}

void fe_pipeline_free(ff_pipeline *pipeline)
{
    if (!pipeline)
        return;
    for (size_t i = pipeline->count; i-- > 0;)
        fe_close_instance(&pipeline->stages[pipeline->order[i]]);
    fe_folder_restore(&pipeline->memory->folder);
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[i];
        for (size_t k = 0; stage->params && k < stage->loaded->model->param_count; k++) {
            ff_value_clear(&stage->params[k].value);
        }
        fe_forget_results(stage);
        fe_free(stage->state);
    }
    fe_arena_free(&pipeline->memory->arena);
    fe_free(pipeline->memory);
    fe_free(pipeline);
}

const char *ff_verdict_name(int verdict)
{
    return verdict == FF_GOOD ? "good" : verdict == FF_DOUBTFUL ? "doubtful" : "bad";
}
