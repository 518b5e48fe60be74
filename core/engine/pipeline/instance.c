/* SPDX-License-Identifier: MIT */
/* The calls in the life of a model's object: create, set, wire, ready, destroy. */
#include "build.h"

#include "../plugin/param.h"

#include <assert.h>
#include <stdio.h>

static void destroy(void *of)
{
    fe_instance *instance = of;
    const ff_stage *stage = instance->stage;
    /* a stage that is not needed has no model */
    const ff_model *model = instance->created ? stage->loaded->model : NULL;
    if (model && model->destroy) {
        fe_serial_enter(instance->alone);
        ff_guard_mark previous = fe_enter_model(stage, "destroy");
        model->destroy(instance->self);
        fe_guard_leave(previous);
        fe_serial_leave(instance->alone);
    }
    instance->created = instance->alive = false;
}

void fe_place_params(const ff_stage *stage)
{
    for (size_t i = 0; i < stage->loaded->model->param_count; i++) {
        const ff_bound *param = &stage->params[i];
        if (param->row->place)
            fe_param_place(param->row, stage->instance->self,
                           param->present ? &param->value : NULL);
    }
}

/* Finds the parameters that cannot be placed, and stores the reason. */
static void inspect(fe_instance *instance)
{
    const ff_hooks *hooks = instance->hooks;
    const char *fault = NULL;
    if (instance->fault[0])
        return;
    if (instance->stage->loaded->model->self_size && !instance->self)
        fault = "gave no instance to take its parameters";
    else if (hooks)
        fault = hooks->created(hooks->ctx, instance->self);
    if (fault)
        snprintf(instance->fault, sizeof instance->fault, "%s", fault);
}

bool fe_create_object(ff_stage *stage, ff_report *report)
{
    fe_instance *instance = stage->instance;
    fe_host_init(instance);
    instance->alone = fe_serial_of(stage->loaded->model);
    fe_call call = fe_call_begin(stage, "create");
    ff_status status = stage->loaded->model->create(&instance->host, &instance->self);
    instance->created = status == FF_OK || status == FF_DOMAIN;
    fe_resource_add(&instance->open, destroy, instance);
    if (instance->created)
        inspect(instance);
    return fe_call_end(&call, status, report);
}

bool fe_set_param(ff_stage *stage, size_t param, ff_report *report)
{
    assert(param < stage->loaded->model->param_count);
    const ff_bound *bound = &stage->params[param];
    fe_instance *instance = stage->instance;
    if (!bound->present || bound->row->place)
        return true;
    fe_call call = fe_call_begin(stage, "set");
    ff_status status = stage->loaded->model->set(instance->self, (uint32_t)param, &bound->value);
    if (status != FF_OK && !instance->item[0])
        snprintf(instance->item, sizeof instance->item, "%s", bound->row->name);
    return fe_call_end(&call, status, report);
}

static bool set(ff_stage *stage, ff_report *report)
{
    bool good = true;
    fe_place_params(stage);
    for (size_t i = 0; i < stage->loaded->model->param_count; i++)
        good = fe_set_param(stage, i, report) && good;
    return good;
}

/* Writes what is wrong with a service table, which completes 'the plugin gave ...'; "" if nothing
   is. A table of flankfilm's own interfaces begins with its size and `self`, followed by functions
   and positive numbers. */
static void look_at_table(const void *table, const char *id, char *wrong, size_t wrong_size)
{
    enum { LARGEST = 4096 };
    const size_t head = sizeof(size_t) + sizeof(void *);
    size_t size = 0;
    uintptr_t word;
    wrong[0] = '\0';
    if (strncmp(id, "flankfilm.", strlen("flankfilm.")) != 0)
        return;
    memcpy(&size, table, sizeof size);
    if (size < head + sizeof word || size > LARGEST)
        snprintf(wrong, wrong_size, "a table that claims to have %zu bytes", size);
    for (size_t at = head; !wrong[0] && at + sizeof word <= size; at += sizeof word) {
        memcpy(&word, (const char *)table + at, sizeof word);
        if (!word)
            snprintf(wrong, wrong_size, "a table without its function %zu",
                     (at - head) / sizeof word + 1);
    }
}

const void *fe_fetch_service(ff_stage *stage, uint32_t output, bool wired, ff_report *report)
{
    assert(output < stage->loaded->model->output_count);
    const ff_port *row = ff_model_output(stage->loaded->model, output);
    char what[200], wrong[80] = "no table";
    fe_call call = fe_call_begin(stage, "service");
    const void *table = stage->loaded->model->service(stage->instance->self, output);
    if (table && wired) /* Reads the table here, so that an invalid pointer crashes in the call that
                           names the plugin. */
        look_at_table(table, row->service, wrong, sizeof wrong);
    if (!fe_call_end(&call, FF_OK, report) || (table && (!wired || !wrong[0])))
        return table;
    snprintf(what, sizeof what, "gave %s for its service \"%s\"", wrong, row->name);
    fe_plugin_fault(stage, report, what);
    return NULL;
}

static const void *service_of(ff_stage *from, const ff_port *input, ff_report *report)
{
    uint32_t output = (uint32_t)fe_find_offer(from->loaded, input);
    return from->instance->alive ? fe_fetch_service(from, output, true, report) : NULL;
}

bool fe_wire_object(ff_stage *stage, size_t input, const void *service, ff_report *report)
{
    assert(input < stage->loaded->model->input_count);
    const ff_model *model = stage->loaded->model;
    if (!model->wire)
        return true;
    fe_call call = fe_call_begin(stage, "wire");
    return fe_call_end(&call, model->wire(stage->instance->self, (uint32_t)input, service), report);
}

static bool wire(fe_build *b, ff_stage *stage)
{
    const ff_pipeline *pipeline = b->pipeline;
    const ff_model *model = stage->loaded->model;
    ff_guard_mark *mark = &stage->instance->mark;
    bool good = true;
    if (model->input_count == 0)
        return true;
    mark->services = fe_arena_alloc(&b->pipeline->memory->arena,
                                    (model->input_count + 2) * sizeof *mark->services);
    for (size_t i = 0; i < model->input_count && good; i++) {
        const ff_port *row = ff_model_input(model, i);
        const ff_wire *wire = fe_input_wire(stage, i);
        ff_stage *from = wire->stage < 0 ? NULL : &pipeline->stages[wire->stage];
        int output = from ? fe_find_offer(from->loaded, row) : -1;
        const void *service = NULL;
        if (output < 0)
            continue;
        if (row->service && !(service = service_of(from, row, b->report)))
            return false;
        if (service)
            *fe_end_of_services(mark) = &from->instance->mark;
        good = fe_wire_object(stage, i, service, b->report);
    }
    return good;
}

bool fe_ready_object(ff_stage *stage, ff_report *report)
{
    if (!stage->loaded->model->ready)
        return true;
    fe_call call = fe_call_begin(stage, "ready");
    return fe_call_end(&call, stage->loaded->model->ready(stage->instance->self), report);
}

void fe_open_instance(fe_build *b, ff_stage *stage)
{
    stage->instance->alive = fe_create_object(stage, b->report) && set(stage, b->report) &&
                             wire(b, stage) && fe_ready_object(stage, b->report);
}

void fe_close_object(ff_stage *stage)
{
    fe_instance *instance = stage->instance;
    fe_resource_remove(&instance->open);
    destroy(instance);
    fe_tables_release(&instance->tables);
    fe_forget_servings(instance);
    instance->mark.services = NULL;
    instance->self = NULL;
}

void fe_close_instance(ff_stage *stage)
{
    fe_close_object(stage);
    fe_tables_free(&stage->instance->tables);
}
