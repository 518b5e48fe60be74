/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The context of a test, which also checks the state of the process. */
#include "private.h"

#include "../memory/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

ff_engine *verify_open_engine(const char *root)
{
    const char *const roots[] = {root};
    ff_engine_options options = {
        .size = sizeof options, .plugin_paths = roots, .plugin_path_count = 1};
    ff_engine *engine;
    ff_engine_new(&options, &engine);
    return memory_require(engine);
}

void verify_outcome_set(verify_outcome *outcome, verify_finding finding, const char *why)
{
    if (outcome->finding == VERIFY_PASSED) {
        outcome->finding = finding;
        ff_clean_text(outcome->why, sizeof outcome->why, why);
    }
}

void verify_context_begin(verify_context *context, ff_engine *engine)
{
    context->engine = engine;
    context->model = context->loaded->model;
    context->laws = verify_plain_laws(engine, context->loaded);
    context->random = (verify_random){42};
    context->redirected = verify_allocations_redirect(context->model);
}

void verify_watch(verify_context *context)
{
    context->watching = true;
    context->pid = getpid();
    verify_process_look(&context->process);
    ff_free(context->environment);
    context->environment = ff_environment_keep();
}

void verify_check_process(verify_context *context)
{
    size_t breached = verify_allocation_breached();
    if (breached)
        verify_fail(context, "wrote past the end of its own memory, %zu bytes, while %s", breached,
                    context->outcome->step);
    if (!context->watching)
        return;
    if (getpid() != context->pid)
        _exit(0); /* this process is a copy of the test, forked by the model */
    const char *change = ff_environment_restore(context->environment);
    change = change ? change : verify_process_changed(&context->process);
    if (change)
        verify_fail(context, "%s while %s", change, context->outcome->step);
}

void verify_step(verify_context *context, const char *format, ...)
{
    va_list args;
    verify_check_process(context);
    va_start(args, format);
    vsnprintf(context->outcome->step, sizeof context->outcome->step, format, args);
    va_end(args);
}

static void set_outcome(verify_context *context, verify_finding finding, const char *format,
                        va_list args)
{
    char text[512];
    vsnprintf(text, sizeof text, format, args);
    verify_outcome_set(context->outcome, finding, text);
}

bool verify_fail(verify_context *context, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    set_outcome(context, VERIFY_FAILED, format, args);
    va_end(args);
    return false;
}

bool verify_skip(verify_context *context, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    set_outcome(context, VERIFY_SKIPPED, format, args);
    va_end(args);
    return false;
}

bool verify_read_param(verify_context *context, size_t param, const char *text, ff_value *value,
                       const char **message)
{
    ff_param row = *ff_model_param(context->model, param);
    row.preset = text ? text : row.preset;
    ff_report_free(context->messages);
    context->messages = ff_report_new();
    bool good = ff_param_read_preset(&row, &context->loaded->param_units[param], row.name, value,
                                     context->messages);
    *message = ff_report_count(context->messages) ? ff_report_at(context->messages, 0)->text : NULL;
    return good;
}

uint64_t verify_data_outputs(const ff_model *model)
{
    uint64_t bits = 0;
    for (size_t i = 0; i < model->output_count && i < 64; i++)
        if (!ff_model_output(model, i)->service)
            bits |= UINT64_C(1) << i;
    return bits;
}
