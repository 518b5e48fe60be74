/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One instance of the model under test. The engine makes and runs it, and the test watches the
   process meanwhile. */
#include "private.h"

#include "../memory/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

__attribute__((format(printf, 2, 3))) static void breach(verify_instance *instance,
                                                         const char *format, ...)
{
    va_list args;
    va_start(args, format);
    if (!instance->breach[0])
        vsnprintf(instance->breach, sizeof instance->breach, format, args);
    va_end(args);
}

static const char *created(void *ctx, void *self)
{
    verify_instance *instance = ctx;
    size_t needed = instance->model->self_size;
    instance->created = true;
    instance->self = self;
    instance->room = verify_allocation_room(self);
    if (instance->room && instance->room < needed)
        breach(instance, "gives an instance of %zu bytes, but its self_size is %zu", instance->room,
               needed);
    if (instance->breach[0])
        return instance->breach;
    return instance->create_only ? "is not needed any further" : NULL;
}

/* Returns whether a model must give a reason for this status. FF_NOMEM needs none; from evaluate,
 * FF_STOPPED and FF_DOMAIN need none, either. */
static bool owes_reason(const char *action, ff_status status)
{
    bool evaluates = !strcmp(action, "evaluate");
    if (status == FF_STOPPED)
        return !evaluates;
    return status == FF_DOMAIN ? !evaluates : status != FF_OK && status != FF_NOMEM;
}

static void returned(void *ctx, const char *action, ff_status status, bool explained)
{
    verify_instance *instance = ctx;
    if (!explained && owes_reason(action, status))
        breach(instance, "gave the status %d and no reason during %s", status, action);
    verify_check_process(instance->context);
}

static int32_t progress(void *ctx, const ff_stage *stage, double fraction)
{
    verify_instance *instance = ctx;
    (void)stage, (void)fraction;
    if (instance->stop_at > 0 && study_seconds_now() > instance->stop_at)
        instance->asked_to_stop = true;
    return instance->asked_to_stop;
}

static void log_line(void *ctx, const ff_stage *stage, int32_t level, const char *text)
{
    (void)stage, (void)level;
    if (!text[0])
        breach(ctx, "logged no text");
}

/* Stores why the last call failed, for use after the instance is closed; for a fault of the plugin,
 * the whole sentence. */
static ff_status note(verify_instance *instance, ff_status status)
{
    const ff_message *first = ff_report_first(ff_instance_report(instance->made));
    const char *text = status == FF_BUG && first ? first->text : ff_instance_reason(instance->made);
    snprintf(instance->text, sizeof instance->text, "%s", status == FF_OK ? "" : text);
    return status;
}

static ff_status set(const verify_instance *instance, const ff_param *row, const ff_value *value)
{
    double number = row->type == FF_REAL ? value->real : (double)value->integer;
    if (value->text)
        return ff_instance_set(instance->made, row->name, value->text);
    if (row->type == FF_REALS)
        return ff_instance_set_reals(instance->made, row->name, value->reals, value->count);
    return ff_instance_set_reals(instance->made, row->name, &number, 1);
}

/* Passes the arrays of the setup to the instance. */
static ff_status feed(const verify_instance *instance, const verify_setup *setup)
{
    ff_status status = FF_OK;
    for (size_t i = 0; i < instance->model->input_count && status == FF_OK; i++) {
        const ff_port *row = ff_model_input(instance->model, i);
        if (!row->service)
            status = ff_instance_give(instance->made, row->name, &setup->inputs[i]);
    }
    return status;
}

ff_status verify_instance_new(verify_instance *instance, const verify_setup *setup)
{
    verify_context *context = setup->context;
    *instance = (verify_instance){
        .context = context,
        .hooks = {sizeof instance->hooks, instance, created, returned},
    };
    const ff_observer observer = {
        .size = sizeof observer, .ctx = instance, .progress = progress, .log = log_line};
    ff_status status = ff_instance_new(context->engine, context->model->id, &instance->made);
    memory_require(instance->made); /* cannot fail, since the model is loaded */
    const ff_model *model = instance->model = ff_instance_stage(instance->made)->loaded->model;
    ff_instance_watch(instance->made, &instance->hooks);
    ff_instance_observe(instance->made, &observer);
    for (size_t i = 0; i < model->param_count && status == FF_OK; i++)
        if (setup->values[i].size)
            status = set(instance, ff_model_param(model, i), &setup->values[i]);
    for (size_t i = 0; i < model->input_count && status == FF_OK; i++)
        if (setup->services[i])
            status = ff_instance_serve(instance->made, ff_model_input(model, i)->name,
                                       setup->services[i]);
    return note(instance, status == FF_OK ? feed(instance, setup) : status);
}

bool verify_instance_create(verify_instance *instance, verify_context *context)
{
    verify_instance_new(instance, verify_setup_new(context));
    instance->create_only = true;
    ff_status status = note(instance, ff_instance_ready(instance->made));
    if (instance->breach[0])
        return verify_fail(context, "it %s", instance->breach);
    return status != FF_BUG || instance->created || verify_fail(context, "%s", instance->text);
}

ff_status verify_instance_open(verify_instance *instance, const verify_setup *setup)
{
    ff_status status = verify_instance_new(instance, setup);
    return status == FF_OK ? note(instance, ff_instance_ready(instance->made)) : status;
}

ff_status verify_instance_run(verify_instance *instance, const char *outputs,
                              const verify_setup *setup)
{
    ff_status status = feed(instance, setup);
    return note(instance, status == FF_OK ? ff_instance_run(instance->made, outputs) : status);
}

ff_status verify_instance_call(verify_instance *instance, const char *function,
                               ff_status (*work)(void *ctx), void *ctx)
{
    return note(instance, ff_instance_call(instance->made, function, work, ctx));
}

bool verify_instance_is_sound(const verify_instance *instance, ff_status status)
{
    verify_context *c = instance->context;
    if (instance->breach[0])
        return verify_fail(c, "it %s", instance->breach);
    return status != FF_BUG || verify_fail(c, "%s", instance->text);
}

void verify_instance_close(verify_instance *instance)
{
    ff_instance_close(instance->made);
    instance->made = NULL;
}
