/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a call into a model comes to: messages with the user's places. */
#include "build.h"

#include <stdio.h>

ff_call ff_call_begin(const ff_stage *stage, const char *action)
{
    ff_instance *instance = stage->instance;
    ff_call call = {.stage = stage, .action = action};
    instance->item[0] = instance->text[0] = instance->fault[0] = 0;
    ff_tables_forget(&instance->tables);
    ff_environment_keep(&call.environment);
    ff_paranoia_enter(instance);
    call.mark = ff_guard_enter(stage->loaded->path, stage->name, action);
    return call;
}

/* The place of a parameter, input or output of the stage; else that of the stage, and no name. */
static ff_place place_of(const ff_stage *stage, const char *item, bool *known)
{
    const ff_model *model = stage->loaded->model;
    int param = ff_model_find_param(model, item);
    *known = true;
    if (param >= 0 && stage->params[param].place.source)
        return stage->params[param].place;
    for (size_t i = 0; i < stage->wire_count; i++)
        if (ff_is_on_wire(item, stage->wires[i].name))
            return stage->wires[i].place;
    *known = param >= 0 || ff_model_find_output(model, item) >= 0;
    return stage->place;
}

/* What a status asks for, and its reason when the model gives none. */
typedef struct meaning {
    ff_status status;
    int exit_code;
    const char *reason;
} meaning;

static meaning meaning_of(ff_status status)
{
    static const meaning meanings[] = {
        {FF_DOMAIN, FF_EXIT_OK, "values were computed outside the range of the model"},
        {FF_NOCONV, FF_EXIT_FAILED, "it found no solution, and gave no reason"},
        {FF_STOPPED, FF_EXIT_FAILED, "it was stopped"},
        {FF_NOMEM, FF_EXIT_FAILED, "it ran out of memory"},
        {FF_INVALID, FF_EXIT_INPUT, "it cannot use a parameter or an input, and gave no reason"},
        {FF_UNSUPPORTED, FF_EXIT_INPUT, "it does not serve this request, and gave no reason"},
    };
    for (size_t i = 0; i < sizeof meanings / sizeof meanings[0]; i++)
        if (meanings[i].status == status)
            return meanings[i];
    return (meaning){status, FF_EXIT_PLUGIN, "and gave no reason"};
}

bool ff_blame(const ff_stage *stage, ff_report *report, const char *what)
{
    return ff_error(report, FF_EXIT_PLUGIN, stage->use_place, NULL, "%s: the plugin %s %s",
                    stage->name, stage->loaded->path, what);
}

/* What is wrong with a table that the model read. */
static bool tell_table(const ff_stage *stage, ff_report *report)
{
    const ff_tables *tables = &stage->instance->tables;
    char what[700];
    for (size_t i = 0; i < ff_report_count(tables->said); i++) {
        const ff_message *m = ff_report_at(tables->said, i);
        snprintf(what, sizeof what, "asked for a table in vain: %s", m->text);
        if (m->exit_code == FF_EXIT_PLUGIN)
            ff_blame(stage, report, what);
        else
            ff_error(report, m->exit_code, m->place, m->hint, "%s.%s (%s): %s", stage->name,
                     tables->item, stage->use, m->text);
    }
    return false;
}

static bool judge(const ff_call *call, ff_status status, ff_report *report)
{
    const ff_stage *stage = call->stage;
    const ff_instance *instance = stage->instance;
    meaning means = meaning_of(status);
    const char *text = instance->text[0] ? instance->text : means.reason;
    char what[700];
    bool known = false;
    if (instance->fault[0])
        return ff_blame(stage, report, instance->fault);
    if (status == FF_OK)
        return true;
    if (instance->tables.said)
        return tell_table(stage, report);
    if (means.exit_code == FF_EXIT_PLUGIN) {
        if (status == FF_BUG)
            snprintf(what, sizeof what, "found a fault of its own during %s: %s", call->action,
                     text);
        else
            snprintf(what, sizeof what, "gave the unknown status %d during %s: %s", status,
                     call->action, text);
        return ff_blame(stage, report, what);
    }
    ff_place place = instance->item[0] ? place_of(stage, instance->item, &known) : stage->place;
    if (status != FF_DOMAIN)
        return ff_error(report, means.exit_code, place, NULL, "%s%s%s (%s): %s", stage->name,
                        known ? "." : "", known ? instance->item : "", stage->use, text);
    ff_warn(report, place, "%s: %s", stage->name, text);
    return true;
}

bool ff_call_end(const ff_call *call, ff_status status, ff_report *report)
{
    const ff_stage *stage = call->stage;
    ff_guard_leave(call->mark);
    const char *changed = ff_environment_restore(&call->environment);
    if (!ff_paranoia_leave(stage, changed, call->action, report))
        return false;
    if (changed && !stage->instance->paranoia)
        ff_warn(report, stage->use_place, "%s: the plugin %s %s during %s; this was set back",
                stage->name, stage->loaded->path, changed, call->action);
    return judge(call, status, report);
}
