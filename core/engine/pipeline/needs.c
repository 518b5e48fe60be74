/* SPDX-License-Identifier: MIT */
/* Leaves out outputs for which the model lacks a parameter or an input (flankfilm.needs/1). Another
   stage may then lack this output as its input, so stages are visited in the order of the run. */
#include "build.h"

#include "../plugin/param.h"

#include <string.h>

/* Whether the input or wire with that name has a value. */
static bool is_fed(const ff_pipeline *pipeline, const ff_stage *stage, const char *item)
{
    for (size_t i = 0; stage->wire_count && i < stage->loaded->model->input_count; i++) {
        const ff_port *row = ff_model_input(stage->loaded->model, i);
        const ff_result *result = ff_feeding_result(pipeline, stage, i);
        bool served = row->service && fe_input_wire(stage, i)->stage >= 0;
        if (fe_is_on_wire(row->name, item) && (served || (result && result->wanted)))
            return true;
    }
    return false;
}

/* Whether one of the items is given. */
static bool is_met(const ff_pipeline *pipeline, const ff_stage *stage, const char *items)
{
    for (const char *at = items; *at; at += *at == '|') {
        char item[96];
        size_t length = strcspn(at, "|");
        snprintf(item, sizeof item, "%.*s", (int)length, at);
        int param = ff_model_find_param(stage->loaded->model, item);
        if (param >= 0 ? stage->params[param].present || stage->params[param].wire
                       : is_fed(pipeline, stage, item))
            return true;
        at += length;
    }
    return false;
}

/* Returns the stages that require the output: "film, losses"; "": none does. */
static const char *readers_of(const fe_build *b, const ff_result *result)
{
    const char *names = "";
    for (size_t k = 0; k < b->pipeline->count; k++) {
        const ff_stage *stage = &b->pipeline->stages[k];
        bool reads = false;
        for (size_t i = 0; stage->needed && stage->loaded && i < stage->loaded->model->input_count;
             i++)
            reads = reads || (ff_feeding_result(b->pipeline, stage, i) == result &&
                              !(ff_model_input(stage->loaded->model, i)->flags & FF_OPTIONAL));
        if (reads)
            names = fe_join(b->pipeline, names, stage->name);
    }
    return names;
}

static void leave_out(fe_build *b, ff_stage *stage, size_t output, const char *text)
{
    ff_result *result = &stage->results[output];
    if (result->required) {
        const char *readers = readers_of(b, result);
        ff_error(b->report, FF_FAULT_INPUT, stage->place,
                 fe_pipeline_print(b->pipeline, "%s.%s is %s%s", stage->name, result->row->name,
                                   *readers ? "needed by " : "requested by name", readers),
                 "%s.%s (%s): %s", stage->name, result->row->name, stage->use, text);
    }
    result->wanted = false;
    result->requested = 0;
    result->refused = true;
}

void fe_check_needs(fe_build *b)
{
    for (size_t k = 0; k < b->pipeline->count; k++) {
        ff_stage *stage = &b->pipeline->stages[b->pipeline->order[k]];
        const fe_instance *instance = stage->instance;
        for (size_t n = 0; stage->needed && stage->loaded && n < instance->need_count; n++) {
            const fe_need *need = &instance->needs[n];
            if (is_met(b->pipeline, stage, need->items))
                continue;
            for (size_t i = 0; i < stage->loaded->model->output_count; i++)
                if (stage->results[i].wanted &&
                    fe_word_find(need->outputs, stage->results[i].row->name) >= 0)
                    leave_out(b, stage, i, need->text);
        }
    }
}
