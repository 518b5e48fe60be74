/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Turns the outcome of a call into a model into messages with places in the user's file. */
#include "build.h"

#include "../plugin/serial.h"

#include <stdio.h>

fe_call fe_call_begin(const fe_stage *stage, const char *action)
{
    fe_instance *instance = stage->instance;
    fe_call call = {.stage = stage, .action = action};
    instance->item[0] = instance->text[0] = instance->fault[0] = 0;
    fe_tables_forget(&instance->tables);
    fe_serial_enter(stage->loaded->model);
    fe_environment_keep(&call.environment);
    call.mark = fe_guard_enter(stage->loaded->path, stage->name, action);
    return call;
}

/* The place of a parameter, input or output of the stage; when it is not known, of the stage. */
static fe_place place_of(const fe_stage *stage, const char *item, bool *known)
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

/* The exit code of a status, and its reason when the model gives none. */
typedef struct meaning {
    ff_status status;
    int exit_code;
    const char *reason;
} meaning;

static meaning meaning_of(ff_status status)
{
    static const meaning meanings[] = {
        {FF_DOMAIN, FE_EXIT_OK, "values were computed outside the range of the model"},
        {FF_NOCONV, FE_EXIT_FAILED, "it found no solution, and gave no reason"},
        {FF_STOPPED, FE_EXIT_FAILED, "it was stopped"},
        {FF_NOMEM, FE_EXIT_FAILED, "it ran out of memory"},
        {FF_INVALID, FE_EXIT_INPUT, "it cannot use a parameter or an input, and gave no reason"},
        {FF_UNSUPPORTED, FE_EXIT_INPUT, "it does not serve this request, and gave no reason"},
    };
    for (size_t i = 0; i < sizeof meanings / sizeof meanings[0]; i++)
        if (meanings[i].status == status)
            return meanings[i];
    return (meaning){status, FE_EXIT_PLUGIN, "and gave no reason"};
}

bool fe_plugin_fault(const fe_stage *stage, fe_report *report, const char *what)
{
    return fe_error(report, FE_EXIT_PLUGIN, stage->use_place, NULL, "%s: the plugin %s %s",
                    stage->name, stage->loaded->path, what);
}

/* Reports the errors of a table that the model read. */
static bool tell_table(const fe_stage *stage, fe_report *report)
{
    const fe_tables *tables = &stage->instance->tables;
    char what[700];
    for (size_t i = 0; i < fe_report_count(tables->errors); i++) {
        const fe_message *m = fe_report_at(tables->errors, i);
        snprintf(what, sizeof what, "asked for a table that cannot be read: %s", m->text);
        if (m->exit_code == FE_EXIT_PLUGIN)
            fe_plugin_fault(stage, report, what);
        else
            fe_error(report, m->exit_code, m->place, m->hint, "%s.%s (%s): %s", stage->name,
                     tables->item, stage->use, m->text);
    }
    return false;
}

static bool judge(const fe_call *call, ff_status status, fe_report *report)
{
    const fe_stage *stage = call->stage;
    const fe_instance *instance = stage->instance;
    meaning means = meaning_of(status);
    const char *text = instance->text[0] ? instance->text : means.reason;
    char what[700];
    bool known = false;
    if (instance->fault[0])
        return fe_plugin_fault(stage, report, instance->fault);
    if (status == FF_OK)
        return true;
    if (instance->tables.errors)
        return tell_table(stage, report);
    if (means.exit_code == FE_EXIT_PLUGIN) {
        if (status == FF_BUG)
            snprintf(what, sizeof what, "found a fault of its own during %s: %s", call->action,
                     text);
        else
            snprintf(what, sizeof what, "gave the unknown status %d during %s: %s", status,
                     call->action, text);
        return fe_plugin_fault(stage, report, what);
    }
    fe_place place = instance->item[0] ? place_of(stage, instance->item, &known) : stage->place;
    if (status != FF_DOMAIN)
        return fe_error(report, means.exit_code, place, NULL, "%s%s%s (%s): %s", stage->name,
                        known ? "." : "", known ? instance->item : "", stage->use, text);
    fe_warn(report, place, "%s: %s", stage->name, text);
    return true;
}

bool fe_call_end(const fe_call *call, ff_status status, fe_report *report)
{
    const fe_stage *stage = call->stage;
    fe_guard_leave(call->mark);
    const char *changed = fe_environment_restore(&call->environment);
    fe_serial_leave(stage->loaded->model);
    if (stage->instance->no_memory)
        fe_out_of_memory();
    if (changed)
        fe_warn(report, stage->use_place, "%s: the plugin %s %s during %s; this was set back",
                stage->name, stage->loaded->path, changed, call->action);
    return judge(call, status, report);
}
