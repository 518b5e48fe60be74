/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The life of a model's object: create, set, wire, ready; destroy. */
#include "build.h"

#include "../plugin/environment.h"
#include "../plugin/guard.h"

#include <stdio.h>

/* A call into the model of a stage, from before to after. */
static ff_guard_mark enter(const ff_stage *stage, const char *action)
{
    ff_instance_hush(stage->instance);
    return ff_guard_enter(stage->loaded->path, stage->name, action);
}

static bool create(ff_build *b, ff_stage *stage)
{
    ff_instance *instance = stage->instance;
    ff_host_init(instance);
    ff_guard_mark mark = enter(stage, "create");
    ff_status status = stage->loaded->model->create(&instance->host, &instance->self);
    ff_guard_leave(mark);
    instance->created = ff_judge(stage, "create", status, b->report);
    return instance->created;
}

static bool set(ff_build *b, ff_stage *stage)
{
    const ff_model *model = stage->loaded->model;
    bool good = true;
    for (size_t i = 0; i < model->param_count; i++) {
        if (!stage->params[i].present)
            continue;
        ff_guard_mark mark = enter(stage, "set");
        ff_status status = model->set(stage->instance->self, (uint32_t)i, &stage->params[i].value);
        ff_guard_leave(mark);
        if (!stage->instance->item[0])
            snprintf(stage->instance->item, sizeof stage->instance->item, "%s",
                     stage->params[i].row->name);
        good = ff_judge(stage, "set", status, b->report) && good;
    }
    return good;
}

/* The table behind a service; NULL when there is none, with its cause in the report. */
static const void *service_of(ff_build *b, ff_stage *from, const char *id)
{
    int output = ff_find_service(from->loaded, id);
    if (!from->instance->alive || output < 0)
        return NULL;
    ff_guard_mark mark = enter(from, "service");
    const void *table = from->loaded->model->service(from->instance->self, (uint32_t)output);
    ff_guard_leave(mark);
    if (!table)
        ff_error(b->report, FF_EXIT_PLUGIN, from->use_place, NULL,
                 "%s: the plugin %s gave no table for its service \"%s\"", from->name,
                 from->loaded->path, from->results[output].row->name);
    return table;
}

static bool wire(ff_build *b, ff_stage *stage)
{
    const ff_model *model = stage->loaded->model;
    bool good = true;
    for (size_t i = 0; i < model->input_count; i++) {
        const ff_port *row = ff_model_input(model, i);
        const ff_wire *wire = ff_input_wire(stage, i);
        const void *service = NULL;
        if (wire->stage < 0)
            continue;
        if (row->service) {
            service = service_of(b, &b->pipeline->stages[wire->stage], row->service);
            good = good && service;
        } else if (!ff_feeding_result(b->pipeline, stage, i))
            continue;
        if (!good || !model->wire)
            continue;
        ff_guard_mark mark = enter(stage, "wire");
        ff_status status = model->wire(stage->instance->self, (uint32_t)i, service);
        ff_guard_leave(mark);
        good = ff_judge(stage, "wire", status, b->report);
    }
    return good;
}

static bool ready(ff_build *b, ff_stage *stage)
{
    const ff_model *model = stage->loaded->model;
    if (!model->ready)
        return true;
    ff_guard_mark mark = enter(stage, "ready");
    ff_status status = model->ready(stage->instance->self);
    ff_guard_leave(mark);
    return ff_judge(stage, "ready", status, b->report);
}

void ff_open_instance(ff_build *b, ff_stage *stage)
{
    ff_environment environment;
    ff_environment_keep(&environment);
    stage->instance->alive = create(b, stage) && set(b, stage) && wire(b, stage) && ready(b, stage);
    stage->instance->broken = !stage->instance->alive;
    const char *changed = ff_environment_restore(&environment);
    if (changed)
        ff_warn(b->report, stage->use_place, "%s: the plugin %s %s; this was set back", stage->name,
                stage->loaded->path, changed);
}

void ff_close_instance(ff_stage *stage)
{
    ff_instance *instance = stage->instance;
    if (instance->created && stage->loaded->model->destroy) {
        ff_guard_mark mark = enter(stage, "destroy");
        stage->loaded->model->destroy(instance->self);
        ff_guard_leave(mark);
    }
    instance->created = instance->alive = false;
}
