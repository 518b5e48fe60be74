/* SPDX-License-Identifier: MIT */
/* The bracket around a call into a model: turns its outcome into messages with places in the user's
   file. */
#include "build.h"

#include <assert.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

const ff_guard_mark **fe_end_of_services(const ff_guard_mark *mark)
{
    const ff_guard_mark **end = mark->services;
    while (*end)
        end++;
    return end;
}

ff_guard_mark fe_enter_model(const ff_stage *stage, const char *action)
{
    ff_guard_mark *mark = &stage->instance->mark;
    *mark = (ff_guard_mark){.path = stage->loaded->path,
                            .stage = stage->name,
                            .action = action,
                            .code = (const void *)(uintptr_t)stage->loaded->model->create,
                            .services = mark->services,
                            .loaded = stage->loaded};
    return fe_guard_enter(*mark);
}

static fe_instance *instance_of(const ff_guard_mark *mark)
{
    return (fe_instance *)((char *)(uintptr_t)mark - offsetof(fe_instance, mark));
}

/* Returns the locks that a call needs: those of the stage's object and of the services that the
   stage may call. */
static fe_serial locks_of(const ff_guard_mark *mark)
{
    fe_serial locks = instance_of(mark)->alone;
    for (const ff_guard_mark *const *service = mark->services; service && *service; service++)
        locks |= locks_of(*service);
    return locks;
}

fe_call fe_call_begin(const ff_stage *stage, const char *action)
{
    assert(stage->loaded && stage->instance);
    fe_instance *instance = stage->instance;
    fe_call call = {.stage = stage, .action = action};
    instance->item[0] = instance->text[0] = instance->fault[0] = 0;
    for (const ff_guard_mark **s = instance->mark.services; s && *s; s++)
        instance_of(*s)->text[0] = 0;
    instance->no_room = false;
    fe_tables_forget(&instance->tables);
    call.alone = locks_of(&instance->mark);
    fe_serial_enter(call.alone);
    fe_environment_keep(&call.environment);
    call.previous = fe_enter_model(stage, action);
    return call;
}

/* Returns the place of a parameter, an input or an output of the stage; if `item` has no place,
   that of the stage. */
static ff_place place_of(const ff_stage *stage, const char *item, bool *known)
{
    const ff_model *model = stage->loaded->model;
    int param = ff_model_find_param(model, item);
    *known = true;
    if (param >= 0 && stage->params[param].place.source)
        return stage->params[param].place;
    for (size_t i = 0; i < stage->wire_count; i++)
        if (fe_is_on_wire(item, stage->wires[i].name))
            return stage->wires[i].place;
    *known = param >= 0 || ff_model_find_output(model, item) >= 0;
    return stage->place;
}

/* The exit code of a status, and its text if the model gives no reason. */
typedef struct meaning {
    ff_status status;
    int fault;
    const char *reason;
} meaning;

static meaning meaning_of(ff_status status)
{
    static const meaning meanings[] = {
        {FF_DOMAIN, FF_FAULT_NONE, "values were computed outside the range of the model"},
        {FF_NOCONV, FF_FAULT_RUN, "it found no solution, and gave no reason"},
        {FF_STOPPED, FF_FAULT_RUN, "it was stopped"},
        {FF_NOMEM, FF_FAULT_RUN, "it ran out of memory"},
        {FF_INVALID, FF_FAULT_INPUT, "it cannot use a parameter or an input, and gave no reason"},
        {FF_UNSUPPORTED, FF_FAULT_INPUT, "it does not support this request, and gave no reason"},
    };
    for (size_t i = 0; i < sizeof meanings / sizeof meanings[0]; i++)
        if (meanings[i].status == status)
            return meanings[i];
    return (meaning){status, FF_FAULT_PLUGIN, "and gave no reason"};
}

bool fe_plugin_fault(const ff_stage *stage, ff_report *report, const char *what)
{
    return ff_error(report, FF_FAULT_PLUGIN, stage->use_place, NULL, "%s: the plugin %s %s",
                    stage->name, stage->loaded->path, what);
}

bool fe_shared_fault(const ff_stage *stage, ff_report *report, const char *what)
{
    char who[1500];
    fe_guard_name(&stage->instance->mark, who, sizeof who);
    return ff_error(report, FF_FAULT_PLUGIN, stage->use_place, NULL, "%s %s", who, what);
}

/* False, with an error, if the model has written outside an output array. */
static bool check_outputs(const fe_call *call, ff_report *report)
{
    const ff_stage *stage = call->stage;
    char what[256];
    for (size_t i = 0; stage->results && i < stage->loaded->model->output_count; i++) {
        const ff_result *result = &stage->results[i];
        const char *where = result->data ? ff_guarded_breach(result->data, result->count) : NULL;
        if (!where)
            continue;
        snprintf(what, sizeof what, "wrote %s the array of its output \"%s\" during %s", where,
                 result->row->name, call->action);
        return fe_shared_fault(stage, report, what);
    }
    return true;
}

/* Reports the errors of a table that the model read. */
static bool report_table_errors(const ff_stage *stage, ff_report *report)
{
    const fe_tables *tables = &stage->instance->tables;
    char what[700];
    for (size_t i = 0; i < ff_report_count(tables->errors); i++) {
        const ff_message *m = ff_report_at(tables->errors, i);
        snprintf(what, sizeof what, "asked for a table that cannot be read: %s", m->text);
        if (m->fault == FF_FAULT_PLUGIN)
            fe_plugin_fault(stage, report, what);
        else
            ff_error(report, m->fault, m->place, m->hint, "%s.%s (%s): %s", stage->name,
                     tables->item, stage->use, m->text);
    }
    return false;
}

/* Returns the stage that gives the service input `item`; NULL: there is none, or `item` is no
   service input. */
static const ff_stage *server_of(const ff_stage *stage, const char *item)
{
    const ff_model *model = stage->loaded->model;
    const ff_guard_mark **services = stage->instance->mark.services;
    for (size_t i = 0; i < model->input_count; i++) {
        const ff_port *row = ff_model_input(model, i);
        for (size_t k = 0; row->service && !strcmp(row->name, item) && services && services[k]; k++)
            if (fe_find_offer(instance_of(services[k])->stage->loaded, row) >= 0)
                return instance_of(services[k])->stage;
    }
    return NULL;
}

/* Writes the reasons that failing services gave during the call: " (mine: the reason)". */
static void print_words_of_services(const ff_stage *stage, char *out, size_t size)
{
    const ff_guard_mark **services = stage->instance->mark.services;
    size_t at = 0;
    out[0] = 0;
    for (size_t k = 0; services && services[k] && at < size; k++) {
        const fe_instance *server = instance_of(services[k]);
        if (server->text[0])
            at += (size_t)snprintf(out + at, size - at, " (%s: %s)", server->stage->name,
                                   server->text);
    }
}

/* Reports a fault of a plugin: the stage's own plugin, or that of the service which the stage
   reports as faulty. */
static bool report_fault(const fe_call *call, ff_status status, const char *text, ff_report *report)
{
    const ff_stage *stage = call->stage, *server = server_of(stage, stage->instance->item);
    char what[1400];
    if (status == FF_BUG && server) {
        snprintf(what, sizeof what, "failed in the service that it gives to %s (%s) as \"%s\": %s",
                 stage->name, stage->use, stage->instance->item, text);
        return fe_plugin_fault(server, report, what);
    }
    if (status == FF_BUG) {
        snprintf(what, sizeof what, "reported an internal error during %s: %s", call->action, text);
        return fe_plugin_fault(stage, report, what);
    }
    snprintf(what, sizeof what, "gave the unknown status %d during %s: %s", status, call->action,
             text);
    return fe_shared_fault(stage, report, what);
}

static bool judge(const fe_call *call, ff_status status, ff_report *report)
{
    const ff_stage *stage = call->stage, *server = NULL;
    const fe_instance *instance = stage->instance;
    meaning means = meaning_of(status);
    const char *text = instance->text[0] ? instance->text : means.reason;
    char words[800];
    bool known = false;
    if (instance->fault[0])
        return fe_plugin_fault(stage, report, instance->fault);
    if (status == FF_OK)
        return true;
    if (status == FF_STOPPED && instance->left)
        return false;
    if (status == FF_NOMEM)
        fe_report_note_no_memory(report);
    if (instance->tables.errors)
        return report_table_errors(stage, report);
    if (means.fault == FF_FAULT_PLUGIN)
        return report_fault(call, status, text, report);
    ff_place place = instance->item[0] ? place_of(stage, instance->item, &known) : stage->place;
    print_words_of_services(stage, words, sizeof words);
    if (means.fault == FF_FAULT_RUN && instance->item[0])
        server = server_of(stage, instance->item);
    if (status != FF_DOMAIN)
        return ff_error(report, means.fault, place, NULL, "%s%s%s (%s): %s%s%s%s%s%s", stage->name,
                        known ? "." : "", known ? instance->item : "", stage->use, text, words,
                        server ? "; that service is given by " : "", server ? server->name : "",
                        server ? ": the plugin " : "", server ? server->loaded->path : "");
    ff_warn(report, place, "%s: %s", stage->name, text);
    return true;
}

/* Warns that the call changed something that it must not change. A service that the stage calls may
   have made the change, since the engine does not see these calls. */
static void warn_of_change(const ff_stage *stage, const char *changed, const char *action,
                           ff_report *report)
{
    char who[1500];
    fe_guard_name(&stage->instance->mark, who, sizeof who);
    ff_warn(report, stage->use_place, "%s %s during %s; this was undone", who, changed, action);
}

void fe_check_folder(const ff_pipeline *pipeline, const ff_stage *stage, const char *action,
                     ff_report *report)
{
    if (fe_folder_restore(&pipeline->memory->folder))
        warn_of_change(stage, "changed the working directory", action, report);
}

bool fe_call_end(const fe_call *call, ff_status status, ff_report *report)
{
    const ff_stage *stage = call->stage;
    fe_guard_leave(call->previous);
    if (stage->instance->no_room)
        status = FF_NOMEM;
    if (status != FF_OK || stage->instance->status != FF_DOMAIN)
        stage->instance->status = status;
    const ff_hooks *hooks = stage->instance->hooks;
    if (hooks)
        hooks->returned(hooks->ctx, call->action, status,
                        stage->instance->text[0] || stage->instance->tables.errors);
    const char *changed = ff_environment_restore(&call->environment);
    fe_serial_leave(call->alone);
    if (stage->instance->no_memory)
        fe_out_of_memory();
    if (changed)
        warn_of_change(stage, changed, call->action, report);
    bool intact = check_outputs(call, report);
    return judge(call, status, report) && intact;
}
