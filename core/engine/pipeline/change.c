/* SPDX-License-Identifier: MIT */
/* Changes parameter values of a built pipeline. Its stages and wires stay the same. */
#include "build.h"
#include "pipeline.h"

#include "../value/tree.h"

#include <string.h>

/* Returns the stage whose parameter the assignment sets; NULL: it sets something else. */
static ff_stage *find_target(const ff_pipeline *pipeline, const char *assignment)
{
    static const char top[] = "pipeline.";
    const char *name, *equals = strchr(assignment, '=');
    if (!equals)
        return NULL;
    if (!strncmp(assignment, top, sizeof top - 1))
        assignment += sizeof top - 1;
    char *path = fe_copy_text(assignment, (size_t)(equals - assignment));
    ff_stage *stage = ff_stage_of(pipeline, path, &name);
    bool fits = stage && stage->needed && stage->loaded &&
                ff_model_find_param(stage->loaded->model, name) >= 0;
    fe_free(path);
    return fits ? stage : NULL;
}

/* False if a run has marked outputs as refused. */
static bool is_as_built(const ff_pipeline *pipeline)
{
    bool good = true;
    for (size_t i = 0; i < pipeline->count && good; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        for (size_t k = 0; good && stage->needed && k < stage->loaded->model->output_count; k++)
            good = !stage->results[k].refused;
    }
    return good;
}

static void bind_anew(fe_build *b, ff_stage *stage)
{
    for (size_t i = 0; i < stage->loaded->model->param_count; i++) {
        ff_value_clear(&stage->params[i].value);
    }
    fe_bind_stage(b, stage);
}

/* Whether an object can be reused for the next case. If its values are unchanged, its results
   depend on its inputs only. An object with a service wire is not reused, since the service table
   may belong to a destroyed object. An object with a chain state is not reused, since the new case
   would start from the previous one. */
static bool stays(const ff_stage *stage, bool changed)
{
    bool kept = !changed && stage->loaded && stage->instance->alive && !ff_stage_has_state(stage);
    for (size_t i = 0; kept && i < stage->loaded->model->input_count; i++)
        kept = !ff_model_input(stage->loaded->model, i)->service;
    return kept;
}

static void close_objects(ff_pipeline *pipeline, const bool *changed, bool objects)
{
    for (size_t i = pipeline->count; i-- > 0;) {
        size_t k = pipeline->order[i];
        if (!objects || !stays(&pipeline->stages[k], changed[k]))
            fe_close_object(&pipeline->stages[k]);
    }
}

static void open_objects(fe_build *b)
{
    ff_pipeline *pipeline = b->pipeline;
    for (size_t i = 0; i < pipeline->count && ff_report_errors(b->report) == 0; i++) {
        ff_stage *stage = &pipeline->stages[pipeline->order[i]];
        if (stage->params && !stage->instance->alive)
            fe_open_instance(b, stage);
    }
}

bool fe_pipeline_change(ff_pipeline *pipeline, fe_tree *tree, const char *const *assignments,
                        size_t count, bool objects)
{
    const ff_node *root = fe_tree_root(tree);
    bool *changed = fe_alloc((pipeline->count + 1) * sizeof *changed);
    bool good = is_as_built(pipeline), moved = false;
    for (size_t i = 0; i < count && good; i++) {
        const ff_stage *stage = find_target(pipeline, assignments[i]);
        good = stage && fe_tree_change(tree, assignments[i]);
        if (good)
            changed[stage - pipeline->stages] = true;
    }
    if (good) {
        fe_build b = {.pipeline = pipeline,
                      .engine = pipeline->memory->engine,
                      .report = ff_report_new(),
                      .file_rank = root->rank};
        close_objects(pipeline, changed, objects);
        for (size_t i = 0; i < pipeline->count; i++)
            if (changed[i])
                bind_anew(&b, &pipeline->stages[i]);
        if (objects) {
            fe_folder_keep(&pipeline->memory->folder);
            open_objects(&b);
            fe_check_needs(&b);
            fe_check_unread(&b, ff_node_get(root, "outputs"));
            moved = fe_folder_restore(&pipeline->memory->folder);
        }
        good = ff_report_count(b.report) == 0 && !moved;
        ff_report_free(b.report);
    }
    fe_free(changed);
    return good;
}
