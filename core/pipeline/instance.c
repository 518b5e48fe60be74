/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The life of a model's object: create, set, wire, ready; destroy. */
#include "build.h"

#include <stdio.h>

static bool create(ff_stage *stage, ff_report *report)
{
    ff_instance *instance = stage->instance;
    ff_host_init(instance);
    ff_call call = ff_call_begin(stage, "create");
    ff_status status = stage->loaded->model->create(&instance->host, &instance->self);
    instance->created = ff_call_end(&call, status, report);
    return instance->created;
}

static bool set(ff_stage *stage, ff_report *report)
{
    const ff_model *model = stage->loaded->model;
    ff_instance *instance = stage->instance;
    bool good = true;
    for (size_t i = 0; i < model->param_count; i++) {
        const ff_bound *param = &stage->params[i];
        if (!param->present)
            continue;
        ff_call call = ff_call_begin(stage, "set");
        ff_status status = model->set(instance->self, (uint32_t)i, &param->value);
        if (!instance->item[0])
            snprintf(instance->item, sizeof instance->item, "%s", param->row->name);
        good = ff_call_end(&call, status, report) && good;
    }
    return good;
}

/* The table behind a service; NULL when there is none, with its cause in the report. */
static const void *service_of(ff_stage *from, const ff_port *input, ff_report *report)
{
    if (!from->instance->alive)
        return NULL;
    uint32_t output = (uint32_t)ff_find_offer(from->loaded, input);
    ff_call call = ff_call_begin(from, "service");
    const void *table = from->loaded->model->service(from->instance->self, output);
    if (!ff_call_end(&call, FF_OK, report) || table)
        return table;
    ff_error(report, FF_EXIT_PLUGIN, from->use_place, NULL,
             "%s: the plugin %s gave no table for its service \"%s\"", from->name,
             from->loaded->path, from->results[output].row->name);
    return NULL;
}

static bool wire(ff_build *b, ff_stage *stage)
{
    const ff_pipeline *pipeline = b->pipeline;
    const ff_model *model = stage->loaded->model;
    bool good = true;
    for (size_t i = 0; i < model->input_count && good; i++) {
        const ff_port *row = ff_model_input(model, i);
        const ff_wire *wire = ff_input_wire(stage, i);
        ff_stage *from = wire->stage < 0 ? NULL : ff_serving(&pipeline->stages[wire->stage]);
        int output = from ? ff_find_offer(from->loaded, row) : -1;
        const void *service = NULL;
        if (output < 0)
            continue;
        if (row->service && !(service = service_of(from, row, b->report)))
            return false;
        if (row->service && b->paranoid)
            service = ff_paranoia_watch(b, stage, from, row->service, service);
        if (!model->wire)
            continue;
        ff_call call = ff_call_begin(stage, "wire");
        good =
            ff_call_end(&call, model->wire(stage->instance->self, (uint32_t)i, service), b->report);
    }
    return good;
}

static bool ready(ff_stage *stage, ff_report *report)
{
    if (!stage->loaded->model->ready)
        return true;
    ff_call call = ff_call_begin(stage, "ready");
    return ff_call_end(&call, stage->loaded->model->ready(stage->instance->self), report);
}

void ff_open_instance(ff_build *b, ff_stage *stage)
{
    if (stage->choice && !stage->choice->chosen) {
        ff_open_contenders(b, stage);
        return;
    }
    if (b->paranoid)
        ff_paranoia_begin(stage->instance);
    stage->instance->alive = create(stage, b->report) && set(stage, b->report) && wire(b, stage) &&
                             ready(stage, b->report);
}

void ff_close_instance(ff_stage *stage)
{
    ff_instance *instance = stage->instance;
    for (size_t i = 0; stage->choice && i < stage->choice->count; i++)
        ff_close_instance(stage->choice->candidates[i].stage);
    if (instance->created && stage->loaded->model->destroy) {
        ff_guard_mark mark = ff_guard_enter(stage->loaded->path, stage->name, "destroy");
        stage->loaded->model->destroy(instance->self);
        ff_guard_leave(mark);
    }
    ff_paranoia_end(instance);
    ff_tables_free(&instance->tables);
    instance->created = instance->alive = false;
}
