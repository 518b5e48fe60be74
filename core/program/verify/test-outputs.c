/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tests of models that compute arrays. */
#include "private.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { PATIENCE = 2 }; /* s, after which a stage is asked to stop */

static bool check_lengths(verify_context *c, const verify_instance *instance, size_t output)
{
    const ff_dims *dims = &c->loaded->output_dims[output];
    for (size_t other = 0; other < output; other++) {
        const ff_dims *theirs = &c->loaded->output_dims[other];
        uint32_t left = dims->rank - instance->ranks[output];
        uint32_t left_theirs = theirs->rank - instance->ranks[other];
        for (uint32_t i = left; i < dims->rank && instance->outputs[other].data; i++)
            for (uint32_t k = left_theirs; k < theirs->rank; k++)
                if (!strcmp(dims->name[i], theirs->name[k]) &&
                    instance->shapes[output][i - left] != instance->shapes[other][k - left_theirs])
                    return verify_fail(c, "\"%s\" has %zu points along %s, but \"%s\" has %zu",
                                       ff_model_output(c->model, output)->name,
                                       instance->shapes[output][i - left], dims->name[i],
                                       ff_model_output(c->model, other)->name,
                                       instance->shapes[other][k - left_theirs]);
    }
    return true;
}

static bool check_outputs(verify_context *c, const verify_instance *instance)
{
    const ff_model *model = c->model;
    for (size_t i = 0; i < model->output_count; i++) {
        const verify_guarded *output = &instance->outputs[i];
        const char *name = ff_model_output(model, i)->name;
        if (!output->data && verify_is_wanted(instance, i))
            return verify_fail(c, "the output \"%s\" was wanted, but not given", name);
        if (!output->data)
            continue;
        if (!verify_is_intact(output->data, output->count))
            return verify_fail(c, "evaluate wrote outside the array \"%s\" of %zu numbers", name,
                               output->count);
        for (size_t k = 0; k < output->count; k++)
            if (!isfinite(output->data[k]))
                return verify_fail(c, "the output \"%s\" is %g at point %zu of %zu", name,
                                   output->data[k], k, output->count);
        if (!check_lengths(c, instance, i))
            return false;
    }
    return true;
}

/* Evaluates and checks what any evaluation owes; *status tells whether there are outputs. */
static bool evaluate(verify_context *c, verify_instance *instance, uint64_t wanted,
                     const verify_setup *setup, ff_status *status)
{
    double **before = verify_copy_inputs(setup);
    *status = verify_instance_evaluate(instance, wanted, setup);
    if (!verify_inputs_are_unchanged(setup, before, "evaluate"))
        return false;
    if (instance->breach[0])
        return verify_fail(c, "it %s", instance->breach);
    if (*status < FF_BUG || *status > FF_STOPPED || *status == FF_BUG)
        return verify_fail(c, "evaluate gave the status %d: %s", *status, instance->text);
    if (*status == FF_OK || *status == FF_DOMAIN)
        return check_outputs(c, instance);
    return *status == FF_NOMEM || *status == FF_STOPPED || instance->text[0] ||
           verify_fail(c, "evaluate gave the status %d and no reason", *status);
}

bool verify_test_inputs(verify_context *c)
{
    enum { DRAWS = 60 };
    uint64_t all = verify_data_outputs(c->model);
    bool good = true;
    double end = verify_now() + 1;
    for (int i = 0; i < DRAWS && good && verify_now() < end; i++) {
        verify_instance instance;
        ff_status status;
        verify_setup *setup = verify_open_accepted(c, &instance, false);
        if (!setup)
            return false;
        if (!c->given || i > 0)
            verify_setup_draw_inputs(setup, &c->random);
        verify_step(c, "evaluate with random inputs, draw %d", i);
        instance.stop_at = verify_now() + PATIENCE;
        if (verify_setup_is_complete(setup))
            good = evaluate(c, &instance, all, setup, &status);
        verify_instance_close(&instance);
    }
    return good;
}

/* The outputs that the model serves with these inputs, found one by one until the time is up. */
static bool find_served(verify_context *c, verify_instance *instance, const verify_setup *setup,
                        uint64_t *served, double end)
{
    uint64_t all = verify_data_outputs(c->model);
    *served = 0;
    for (size_t i = 0; i < c->model->output_count && i < 64 && verify_now() < end; i++) {
        const char *name = ff_model_output(c->model, i)->name;
        ff_status status = FF_UNSUPPORTED;
        verify_step(c, "evaluate with \"%s\" alone wanted", name);
        if (all >> i & 1 && !evaluate(c, instance, UINT64_C(1) << i, setup, &status))
            return false;
        if (status == FF_OK || status == FF_DOMAIN)
            *served |= UINT64_C(1) << i;
        else if (status != FF_UNSUPPORTED && status != FF_STOPPED) /* stopped: too slow to tell */
            return verify_fail(c, "\"%s\" cannot be had alone: %s", name, instance->text);
    }
    return true;
}

/* Opens an instance and finds inputs that it can work with, and what it then serves; NULL when
   there are none. */
static verify_setup *find_work(verify_context *c, verify_instance *instance, uint64_t *served)
{
    enum { TRIES = 40 };
    double end = verify_now() + 5;
    for (int i = 0; i < (c->given ? 1 : TRIES) && verify_now() < end; i++) {
        ff_status status = FF_INVALID;
        verify_setup *setup = verify_open_accepted(c, instance, false);
        if (!setup)
            return NULL;
        if (!c->given)
            verify_setup_draw_inputs(setup, &c->random);
        if (!c->given)
            instance->stop_at = verify_now() + PATIENCE;
        *served = verify_data_outputs(c->model);
        verify_step(c, "evaluate");
        if (verify_setup_is_complete(setup) && !evaluate(c, instance, *served, setup, &status))
            return NULL;
        if (status == FF_UNSUPPORTED && !find_served(c, instance, setup, served, INFINITY))
            return NULL;
        if (status == FF_OK || status == FF_DOMAIN || (status == FF_UNSUPPORTED && *served))
            return setup;
        if (c->given)
            verify_fail(c, "evaluate gave the status %d: %s", status, instance->text);
        verify_instance_close(instance);
    }
    verify_skip(c, "no random inputs suit it; --pipeline FILE gives real ones");
    return NULL;
}

bool verify_test_wanted(verify_context *c)
{
    uint64_t served;
    verify_instance instance;
    verify_setup *setup = find_work(c, &instance, &served);
    if (!setup)
        return false;
    bool good = find_served(c, &instance, setup, &served, verify_now() + 2);
    verify_instance_close(&instance);
    return good;
}

typedef struct shift {
    const verify_setup *setup;
    uint64_t wanted;
    verify_instance instance;
    ff_status status;
} shift;

static void *work(void *argument)
{
    shift *mine = argument;
    mine->status = verify_instance_open(&mine->instance, mine->setup);
    if (mine->status == FF_OK)
        mine->status = verify_instance_evaluate(&mine->instance, mine->wanted, mine->setup);
    return NULL;
}

bool verify_test_repeat(verify_context *c)
{
    uint64_t served;
    verify_instance instance;
    pthread_t thread;
    verify_setup *setup = find_work(c, &instance, &served);
    if (!setup)
        return false;
    shift here = {.setup = setup, .wanted = served}, there = {.setup = setup, .wanted = served};
    bool good = true,
         serial = c->model->flags & FF_SERIAL || pthread_create(&thread, NULL, work, &there) != 0;
    if (serial)
        work(&there);
    work(&here);
    if (!serial)
        pthread_join(thread, NULL);
    ff_status again = verify_instance_evaluate(&instance, served, setup);
    if (here.status == FF_STOPPED || there.status == FF_STOPPED || again == FF_STOPPED)
        verify_skip(c, "too slow for the random inputs found; --pipeline FILE gives real ones");
    else
        good = verify_outputs_agree(c, &here.instance, &there.instance, "in a second thread") &&
               verify_outputs_agree(c, &here.instance, &instance,
                                    "when the same instance works again");
    verify_instance_close(&here.instance);
    verify_instance_close(&there.instance);
    verify_instance_close(&instance);
    return good;
}
