/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Takes parameters and inputs for a test from a pipeline of the user. */
#include "private.h"

#include "../accuracy/models.h"
#include "../memory/memory.h"
#include "../run/run.h"

#include <flankfilm/laws.h>

#include <stdlib.h>
#include <string.h>

/* Returns the name of the stage that uses the model, or NULL after an error. */
static const char *find_stage(ff_run *user, const char *id)
{
    const ff_node *stages = ff_node_get(ff_run_root(user), "pipeline");
    for (size_t i = 0; stages && stages->kind == FF_MAP && i < stages->count; i++) {
        const ff_node *use = ff_node_get(stages->items[i], "use");
        if (use && use->kind == FF_SCALAR && !strcmp(use->text, id))
            return stages->keys[i];
    }
    ff_error(ff_run_report(user), FF_FAULT_INPUT, FF_NOWHERE, NULL, "no stage of the file uses %s",
             id);
    return NULL;
}

/* Returns whether the wire of that name is connected. */
static bool is_connected(const ff_stage *stage, const char *wire)
{
    for (size_t i = 0; i < stage->wire_count; i++)
        if (!strcmp(stage->wires[i].name, wire))
            return stage->wires[i].stage >= 0;
    return false;
}

/* Returns whether the result depends on the oil. The tests replace the laws of the file, and a
   result that depends on the oil would contradict the replaced laws. */
static bool is_of_oil(const ff_pipeline *pipeline, const ff_result *result)
{
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        const ff_model *model = stage->loaded ? stage->loaded->model : NULL;
        for (size_t k = 0; model && k < model->output_count; k++)
            if (&stage->results[k] == result)
                return ff_model_find_service(model, FF_LIQUID_ID) >= 0;
    }
    return false;
}

/* Takes the parameters of the stage and its inputs. Simple laws replace the stages that provide
   services. */
static bool take_stage(verify_context *context, const ff_pipeline *pipeline, const char *name)
{
    const ff_model *model = context->model;
    const ff_stage *stage = pipeline->stages, *end = stage + pipeline->count;
    while (stage < end && strcmp(stage->name, name) != 0)
        stage++;
    if (stage == end)
        return false;
    context->given = verify_setup_new(context);
    for (size_t i = 0; i < model->param_count; i++)
        if (stage->params[i].present && stage->params[i].value.given) {
            context->given->values[i] = stage->params[i].value;
            context->given->values[i].size = sizeof(ff_value);
        }
    for (size_t i = 0; i < model->input_count; i++) {
        const ff_result *result = ff_feeding_result(pipeline, stage, i);
        bool optional = ff_model_input(model, i)->flags & FF_OPTIONAL;
        if (!is_connected(stage, ff_model_input(model, i)->name))
            context->given->services[i] = NULL;
        if (result && result->data && !(optional && is_of_oil(pipeline, result)))
            verify_setup_give(context->given, i, result->data, result->rank, result->shape);
    }
    return true;
}

bool verify_take_user_run(verify_context *context, const verify_request *request, ff_engine *engine,
                          bool runs)
{
    const ff_model *model = context->model;
    ff_run *user = context->user = run_read(engine, request->pipeline);
    if (!run_has_errors(user))
        run_set_all(user, request->sets, request->set_count);
    const char *name = run_has_errors(user) ? NULL : find_stage(user, model->id);
    if (!name)
        return false;
    bool data = verify_data_outputs(model); /* a law has no data outputs that could be requested */
    char *outputs = memory_print_text("outputs=[%s.*]", name);
    if (data)
        run_set(user, outputs, NULL, NULL);
    free(outputs);
    const ff_pipeline *pipeline = accuracy_build_alone(user, engine, !data);
    return pipeline && !run_has_errors(user) && (!runs || !data || run_start(user, NULL)) &&
           take_stage(context, pipeline, name);
}
