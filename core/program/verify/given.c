/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters and inputs of a real run: those of a stage in a user's file. */
#include "private.h"

#include "../../engine/value/memory.h"

#include <stdlib.h>
#include <string.h>

/* The name of the stage that uses the model; NULL after an error. */
static const char *find_stage(const fe_node *root, const char *id, fe_report *report)
{
    const fe_node *stages = fe_node_get(root, "pipeline");
    for (size_t i = 0; stages && stages->kind == FE_MAP && i < stages->count; i++) {
        const fe_node *use = fe_node_get(stages->items[i], "use");
        if (use && use->kind == FE_SCALAR && !strcmp(use->text, id))
            return stages->keys[i];
    }
    fe_error(report, FE_EXIT_INPUT, FE_NOWHERE, NULL, "no stage of the file uses %s", id);
    return NULL;
}

static bool take(ff_exam *exam, const fe_pipeline *pipeline, const char *name)
{
    const fe_stage *stage = pipeline->stages, *end = stage + pipeline->count;
    while (stage < end && strcmp(stage->name, name) != 0)
        stage++;
    if (stage == end)
        return false;
    ff_value *values = fe_alloc(exam->model->param_count * sizeof *values);
    ff_array *inputs = fe_alloc(exam->model->input_count * sizeof *inputs);
    for (size_t i = 0; i < exam->model->param_count; i++)
        if (stage->params[i].present) {
            values[i] = stage->params[i].value;
            values[i].size = sizeof *values;
        }
    for (size_t i = 0; i < exam->model->input_count; i++) {
        const fe_result *result = fe_feeding_result(pipeline, stage, i);
        if (result)
            inputs[i] =
                (ff_array){.data = result->data, .shape = result->shape, .rank = result->rank};
    }
    exam->values = values;
    exam->inputs = inputs;
    return true;
}

static bool has_data(const ff_model *model)
{
    for (size_t i = 0; i < model->output_count; i++)
        if (!ff_model_output(model, i)->service)
            return true;
    return false;
}

bool verify_exam_give(verify_examined *subject, const verify_request *request, fe_library *library,
                      bool run, fe_report *report)
{
    const ff_model *model = subject->loaded->model;
    fe_tree *tree = fe_tree_load(request->pipeline, report);
    bool good = fe_tree_root(tree) && fe_report_errors(report) == 0;
    for (size_t i = 0; i < request->set_count && good; i++)
        good = fe_tree_set(tree, request->sets[i], "pipeline", fe_pipeline_top_keys, report);
    const char *name = good ? find_stage(fe_tree_root(tree), model->id, report) : NULL;
    if (!name)
        return false;
    bool data = has_data(model); /* or a law, which nothing asks for */
    char *outputs = fe_print_text("outputs=[%s.*]", name);
    if (data)
        fe_tree_set(tree, outputs, "pipeline", fe_pipeline_top_keys, report);
    free(outputs);
    fe_pipeline *pipeline = fe_pipeline_build(tree, library, !data, report);
    return pipeline && fe_report_errors(report) == 0 &&
           (!run || !data || fe_pipeline_run(pipeline, NULL, report)) &&
           take(&subject->exam, pipeline, name);
}
