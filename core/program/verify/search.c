/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Searches for parameters and inputs with which the model works. */
#include "private.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PATIENCE = 2 }; /* time in s after which a stage is asked to stop */

verify_setup *verify_open_accepted(verify_context *context, verify_instance *instance, bool quietly)
{
    enum { TRIES = 400 };
    for (int i = 0; i < (context->given ? 1 : TRIES); i++) {
        verify_setup *setup = context->given ? context->given : verify_setup_new(context);
        if (!context->given)
            verify_setup_draw_params(setup, &context->random, VERIFY_CALIBRATED);
        if (!context->given ||
            !verify_setup_is_complete(setup)) /* the user's pipeline may not have run */
            verify_setup_draw_inputs(setup, &context->random);
        if (!verify_setup_can_be_used(setup, quietly))
            return NULL;
        verify_step(context, "create, set and ready");
        if (verify_is_good(verify_instance_open(instance, setup)))
            return setup;
        verify_instance_close(instance);
    }
    if (!quietly)
        verify_skip(context,
                    "no parameters were found that it accepts%s%s; --pipeline FILE gives some",
                    instance->text[0] ? ": " : "", instance->text);
    return NULL;
}

bool verify_find_served(verify_context *c, verify_instance *instance, const verify_setup *setup,
                        char **served, double end)
{
    const ff_result *result;
    *served = memory_copy_text("", 0);
    for (size_t i = 0; i < c->model->output_count && study_seconds_now() < end; i++) {
        const ff_port *row = ff_model_output(c->model, i);
        if (row->service)
            continue;
        verify_step(c, "evaluate with \"%s\" alone wanted", row->name);
        ff_status status = verify_instance_run(instance, row->name, setup);
        if (!verify_instance_is_sound(instance, status))
            return false;
        if (ff_instance_result(instance->made, row->name, &result) == FF_OK)
            memory_add_text(served, " %s", row->name);
        else if (status != FF_UNSUPPORTED &&
                 status != FF_STOPPED) /* FF_STOPPED: too slow to decide */
            return verify_fail(c, "\"%s\" cannot be computed alone: %s", row->name, instance->text);
    }
    return true;
}

/* Returns the names of the outputs that the last run gave. */
static char *list_given(const verify_instance *instance)
{
    const ff_result *result;
    char *given = memory_copy_text("", 0);
    for (size_t i = 0; i < instance->model->output_count; i++) {
        const char *name = ff_model_output(instance->model, i)->name;
        if (ff_instance_result(instance->made, name, &result) == FF_OK)
            memory_add_text(&given, " %s", name);
    }
    return given;
}

verify_setup *verify_find_work(verify_context *c, verify_instance *instance, char **served)
{
    enum { TRIES = 40 };
    double end = study_seconds_now() + 5;
    for (int i = 0; i < (c->given ? 1 : TRIES) && study_seconds_now() < end; i++) {
        verify_setup *setup = verify_open_accepted(c, instance, false);
        if (!setup)
            return NULL;
        if (!c->given)
            instance->stop_at = study_seconds_now() + PATIENCE;
        verify_step(c, "evaluate");
        ff_status status = verify_instance_run(instance, NULL, setup);
        if (!verify_instance_is_sound(instance, status))
            return NULL;
        *served = list_given(instance);
        if (status == FF_UNSUPPORTED && !verify_find_served(c, instance, setup, served, INFINITY))
            return NULL;
        if (**served)
            return setup;
        if (c->given)
            verify_fail(c, "evaluate gave the status %d: %s", status, instance->text);
        verify_instance_close(instance);
    }
    verify_skip(c, "no suitable random inputs were found; --pipeline FILE gives real ones");
    return NULL;
}

bool verify_outputs_agree(verify_context *c, const verify_instance *a, const verify_instance *b,
                          const char *when)
{
    for (size_t i = 0; i < c->model->output_count; i++) {
        const char *name = ff_model_output(c->model, i)->name;
        const ff_result *x, *y;
        ff_instance_result(a->made, name, &x);
        ff_instance_result(b->made, name, &y);
        bool alike =
            !x == !y &&
            (!x || (x->count == y->count && !memcmp(x->data, y->data, x->count * sizeof *x->data)));
        if (!alike)
            return verify_fail(c, "the output \"%s\" differs %s", name, when);
    }
    return true;
}
