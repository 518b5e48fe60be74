/* SPDX-License-Identifier: MIT */
/* The parts of an instance, and the creation of its object. */
#include "instance.h"

#include "plugin/param.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Whether a call with this status returned values. FF_NOCONV and FF_STOPPED are positive, but they
   are failures. */
static bool is_good(ff_status status)
{
    return status == FF_OK || status == FF_DOMAIN;
}

/* Stores the model's reason for a failure or a warning. */
static void explain(ff_instance *i)
{
    const fe_tables *tables = &i->object.tables;
    const ff_message *message = ff_report_first(i->report);
    if (!message && ff_report_count(i->report))
        message = ff_report_at(i->report, 0);
    if (!message)
        return;
    fe_engine_set_message(i->engine, i->report);
    if (tables->errors)
        fe_tables_print(tables, i->reason, sizeof i->reason);
    else
        snprintf(i->reason, sizeof i->reason, "%s",
                 i->object.text[0] &&
                         (message->severity == FF_WARNING || !is_good(i->object.status))
                     ? i->object.text
                     : message->text);
    if (!i->item[0])
        snprintf(i->item, sizeof i->item, "%s", tables->errors ? tables->item : i->object.item);
}

static void work(void *of)
{
    fe_request *request = of;
    ff_instance *i = request->instance;
    if (!i->report || ff_report_count(i->report)) {
        ff_report_free(i->report);
        i->report = ff_report_new();
    }
    fe_tables_forget(&i->object.tables);
    bool good = request->work(request);
    ff_status status = i->object.status;
    explain(i);
    if (good)
        request->status = status > 0 ? status : FF_OK;
    else if (is_good(status) || fe_report_lacked_memory(i->report) ||
             ff_report_fault(i->report) == FF_FAULT_PLUGIN)
        request->status = fe_status_of(i->report);
    else
        request->status = status;
}

ff_status fe_handle(fe_request *request)
{
    ff_instance *i = request->instance;
    i->item[0] = i->reason[0] = i->object.item[0] = i->object.text[0] = 0;
    i->object.status = FF_OK;
    if (i->broken)
        return fe_engine_lack(i->engine);
    i->broken = fe_engine_call(i->engine, &i->heap, work, request) != FF_OK;
    return i->broken ? FF_NOMEM : request->status;
}

bool fe_refuse(ff_instance *i, const char *item, const char *format, ...)
{
    char text[700];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    snprintf(i->item, sizeof i->item, "%s", item);
    return ff_error(i->report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "%s: %s", i->stage.use, text);
}

static bool refuse_absent(fe_request *q)
{
    return fe_refuse(q->instance, "", "an argument is NULL: %s", q->text);
}

ff_status fe_absent(const ff_instance *i, const char *argument)
{
    fe_request request = {
        .instance = (ff_instance *)(uintptr_t)i, .work = refuse_absent, .text = argument};
    return i ? fe_handle(&request) : FF_INVALID;
}

bool fe_refuse_name(ff_instance *i, const char *what, const char *name, const char *const *names,
                    size_t count)
{
    const char *near = ff_nearest(name, names, count);
    return fe_refuse(i, name, "it has no %s \"%.80s\"%s%s%s", what, name,
                     near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
}

bool fe_pass_on(ff_instance *i, const ff_instance *from, ff_status status)
{
    if (from->broken)
        fe_out_of_memory();
    ff_report_append(i->report, from->report);
    if (is_good(status))
        return true;
    i->object.status = status;
    return false;
}

static void read_presets(ff_instance *i)
{
    const ff_loaded *loaded = i->stage.loaded;
    for (size_t k = 0; k < loaded->model->param_count; k++) {
        const ff_param *row = ff_model_param(loaded->model, k);
        i->stage.params[k].row = row;
        if (row->preset && !ff_param_read_preset(row, &loaded->param_units[k], row->name,
                                                 &i->presets[k], i->report))
            i->presets[k].size = 0;
    }
}

static bool load(fe_request *q)
{
    ff_instance *i = q->instance;
    fe_arena *arena = &i->memory.arena;
    ff_stage *stage = &i->stage;
    const char *name = strchr(q->name, '/');
    name = name ? name + 1 : q->name;
    stage->use = fe_arena_text(arena, q->name, strlen(q->name));
    stage->name = fe_arena_text(arena, name, strlen(name));
    const ff_loaded *loaded = ff_engine_model(i->engine, q->name, FF_NOWHERE, i->report);
    if (!loaded)
        return false;
    fe_warn_displaced(loaded, i->report);
    const ff_model *model = loaded->model;
    i->given = fe_arena_alloc(arena, model->param_count * sizeof *i->given);
    i->presets = fe_arena_alloc(arena, model->param_count * sizeof *i->presets);
    i->names = fe_arena_alloc(arena, model->param_count * sizeof *i->names);
    i->feeds = fe_arena_alloc(arena, model->input_count * sizeof *i->feeds);
    i->serving = fe_arena_alloc(arena, (model->input_count + 1) * sizeof *i->serving);
    stage->params = fe_arena_alloc(arena, model->param_count * sizeof *stage->params);
    stage->results = fe_arena_alloc(arena, model->output_count * sizeof *stage->results);
    for (size_t k = 0; k < model->output_count; k++)
        stage->results[k].row = ff_model_output(model, k);
    stage->loaded = loaded;
    read_presets(i);
    return true;
}

static void allocate(void *of)
{
    fe_request *request = of;
    request->instance = fe_alloc(sizeof *request->instance);
}

ff_status ff_instance_new(ff_engine *engine, const char *id, ff_instance **instance)
{
    fe_request request = {.work = load, .name = id};
    if (!instance)
        return FF_INVALID;
    *instance = NULL;
    if (!engine || !id)
        return FF_INVALID;
    if (fe_engine_call(engine, &engine->heap, allocate, &request) != FF_OK)
        return FF_NOMEM;
    ff_instance *i = request.instance;
    i->engine = engine;
    i->pipeline = (ff_pipeline){.stages = &i->stage, .count = 1, .memory = &i->memory};
    i->memory.engine = engine;
    i->stage.needed = true;
    i->stage.instance = &i->object;
    i->object.stage = &i->stage;
    ff_status status = fe_handle(&request);
    if (status == FF_OK)
        *instance = i;
    else
        ff_instance_close(i);
    return status;
}

void ff_instance_close(ff_instance *instance)
{
    if (!instance)
        return;
    fe_heap_close(&instance->heap);
    fe_free(instance);
}

void fe_drop_object(ff_instance *i)
{
    fe_close_instance(&i->stage);
    i->object.self = NULL;
    i->stage.ran = i->evaluated = false;
}

bool fe_is_fed(const fe_feed *feed)
{
    return feed->from || feed->array.data || feed->table;
}

/* Whether the wire that replaces the parameter is connected. */
static bool is_replaced(const ff_instance *i, const ff_param *row)
{
    const ff_model *model = i->stage.loaded->model;
    for (size_t k = 0; row->instead && k < model->input_count; k++)
        if (fe_is_on_wire(ff_model_input(model, k)->name, row->instead) && fe_is_fed(&i->feeds[k]))
            return true;
    return false;
}

/* Whether the parameter, or another one of its group, is given. *required: one of them must be
   given. */
static bool is_settled(const ff_instance *i, size_t param, bool *required)
{
    const ff_model *model = i->stage.loaded->model;
    const ff_param *row = ff_model_param(model, param);
    bool given = false, preset = false;
    *required = false;
    for (size_t k = row->group ? 0 : param; k < (row->group ? model->param_count : param + 1);
         k++) {
        const ff_param *member = ff_model_param(model, k);
        if (k != param && (!member->group || strcmp(row->group, member->group)))
            continue;
        given = given || i->given[k].size;
        preset = preset || member->preset;
        *required = *required || (member->flags & FF_REQUIRED && !is_replaced(i, member));
    }
    *required = *required && !preset;
    return given;
}

/* Finds the value of each parameter: given, preset or absent. */
static bool settle(ff_instance *i)
{
    const ff_model *model = i->stage.loaded->model;
    for (size_t k = 0; k < model->param_count; k++) {
        const ff_param *row = ff_model_param(model, k);
        ff_bound *bound = &i->stage.params[k];
        bool required, given = is_settled(i, k, &required), replaced = is_replaced(i, row);
        if (replaced && i->given[k].size)
            return fe_refuse(i, row->name, "\"%s\" is given, and the wire \"%s\" gives it, too",
                             row->name, row->instead);
        if (!given && required)
            return fe_refuse(i, row->name, "\"%s\"%s is missing: %s", row->name,
                             row->group ? ", or another of its group," : "", row->doc);
        bound->value = given ? i->given[k] : replaced ? (ff_value){.size = 0} : i->presets[k];
        bound->present = bound->value.size != 0;
    }
    for (size_t k = 0; k < model->input_count; k++) {
        const ff_port *row = ff_model_input(model, k);
        if (!fe_is_fed(&i->feeds[k]) && !(row->flags & FF_OPTIONAL))
            return fe_refuse(i, row->name, "nothing feeds its input \"%s\"", row->name);
    }
    return true;
}

/* Creates the objects of the instances whose services this one uses. A new object has a new service
   table. */
static bool make_feeding(ff_instance *i)
{
    for (size_t k = 0; k < i->stage.loaded->model->input_count; k++) {
        fe_feed *feed = &i->feeds[k];
        if (!feed->from || !ff_model_input(i->stage.loaded->model, k)->service)
            continue;
        if (!fe_pass_on(i, feed->from, ff_instance_ready(feed->from)))
            return false;
        if (feed->version != feed->from->version)
            fe_drop_object(i);
    }
    return true;
}

/* Passes the service tables of the wired instances to the model. Their objects exist. */
static bool wire(ff_instance *i)
{
    const ff_model *model = i->stage.loaded->model;
    bool good = true;
    memset(i->serving, 0, (model->input_count + 1) * sizeof *i->serving);
    i->object.mark.services = i->serving;
    for (size_t k = 0; k < model->input_count && good; k++) {
        const ff_port *row = ff_model_input(model, k);
        fe_feed *feed = &i->feeds[k];
        const void *table = feed->table;
        if (!fe_is_fed(&i->feeds[k]))
            continue;
        if (row->service && feed->from) {
            feed->version = feed->from->version;
            table = fe_fetch_service(&feed->from->stage, (uint32_t)feed->output, true, i->report);
            if (!table)
                return false;
            *fe_end_of_services(&i->object.mark) = &feed->from->object.mark;
        }
        good = fe_wire_object(&i->stage, k, table, i->report);
    }
    return good;
}

/* Sets the parameters in order. Stops at the first parameter that the model refuses; the message
   names it. */
static bool set_all(ff_instance *i)
{
    fe_place_params(&i->stage);
    for (size_t k = 0; k < i->stage.loaded->model->param_count; k++)
        if (!fe_set_param(&i->stage, k, i->report))
            return false;
    return true;
}

bool fe_make_object(ff_instance *i)
{
    if (!make_feeding(i))
        return false;
    if (i->object.alive)
        return true;
    fe_drop_object(i);
    i->version++;
    fe_folder_keep(&i->memory.folder);
    i->object.watch = &i->observer;
    i->object.alive = fe_create_object(&i->stage, i->report) && settle(i) && set_all(i) &&
                      wire(i) && fe_ready_object(&i->stage, i->report);
    i->object.watch = NULL;
    fe_check_folder(&i->pipeline, &i->stage, "create, set, wire or ready", i->report);
    return i->object.alive;
}

static bool make(fe_request *q)
{
    return fe_make_object(q->instance);
}

ff_status ff_instance_ready(ff_instance *instance)
{
    if (!instance)
        return FF_INVALID;
    return fe_handle(&(fe_request){.instance = instance, .work = make});
}
