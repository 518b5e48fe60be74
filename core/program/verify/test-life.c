/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tests for all models: their texts, life cycle and parameters. */
#include "private.h"

#include <malloc.h>
#include <math.h>
#include <string.h>

/* Returns whether the text consists of entries "@type{key," with balanced braces. */
static bool is_bibtex(const char *text)
{
    int depth = 0;
    bool begun = false;
    for (; *text && depth >= 0; text++) {
        depth += (*text == '{') - (*text == '}');
        begun = begun || *text == '@';
        if (!begun && !strchr(" \n\t", *text))
            return false;
        if (depth == 0 && *text == '}')
            begun = false;
    }
    return depth == 0 && !begun;
}

bool verify_test_references(verify_context *c)
{
    const ff_model *model = c->model;
    if (!is_bibtex(model->bibtex))
        return verify_fail(c, "bibtex is not a list of \"@type{key, ...}\" with braces that close");
    if (model->bibtex[0] && !model->reference[0])
        return verify_fail(c, "bibtex names literature, but reference is empty");
    for (const char *at = model->licence; *at; at++)
        if (!strchr("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-+() ", *at))
            return verify_fail(c, "the licence \"%s\" is not an SPDX expression", model->licence);
    return true;
}

bool verify_test_presets(verify_context *c)
{
    const ff_model *model = c->model;
    bool good = true;
    for (size_t i = 0; i < model->param_count; i++) {
        const ff_param *row = ff_model_param(model, i);
        ff_value value;
        const char *message;
        if (!row->preset || !good)
            continue;
        verify_read_param(c, i, NULL, &value, &message);
        if (message)
            good = verify_fail(c, "preset of %s", message);
    }
    return good;
}

bool verify_test_places(verify_context *c)
{
    verify_instance instance;
    if (!c->redirected)
        return verify_skip(c, "its calls of malloc cannot be redirected");
    verify_step(c, "create");
    bool good = verify_instance_create(&instance, c);
    if (good && !instance.room)
        verify_skip(c, "its instances are not from malloc: their size cannot be seen");
    verify_instance_close(&instance);
    return good;
}

static ff_status call_services(void *ctx)
{
    const verify_instance *instance = ctx;
    for (size_t i = 0; i < instance->model->output_count; i++)
        if (ff_model_output(instance->model, i)->service)
            instance->model->service(instance->self, (uint32_t)i);
    return FF_OK;
}

/* Calls create, set, ready, service and destroy. Returns true if all succeeded. */
static bool live(const verify_setup *setup)
{
    verify_instance instance;
    ff_status status = verify_instance_open(&instance, setup);
    if (verify_is_good(status))
        status = verify_instance_call(&instance, "service", call_services, &instance);
    bool good = verify_instance_is_sound(&instance, status);
    verify_instance_close(&instance);
    return good;
}

bool verify_test_life(verify_context *c)
{
    const ff_model *model = c->model;
    verify_instance instance, second;
    verify_step(c, "destroying NULL");
    if (model->destroy)
        model->destroy(NULL);
    verify_step(c, "create and destroy without set");
    bool good = verify_instance_create(&instance, c);
    verify_instance_close(&instance);
    verify_step(c, "create, set, ready, service, destroy");
    /* parameters that cannot be drawn are left out */
    verify_setup *setup = verify_open_accepted(c, &instance, true);
    if (setup) { /* two instances at the same time; the older one is destroyed first */
        ff_status status = verify_instance_open(&second, setup);
        verify_instance_close(&instance);
        verify_instance_close(&second);
        if (!verify_is_good(status))
            good = verify_fail(c, "a second instance beside the first gave the status %d: %s",
                               status, second.text);
    }
    return good;
}

/* Returns the memory in use according to the allocator, or 0 if the allocator does not count it. */
static size_t in_use(void)
{
    struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

bool verify_test_leaks(verify_context *c)
{
    enum { WARM = 50, LIVES = 1000, SLACK = 8 * LIVES };
    verify_instance instance;
    verify_setup *setup = verify_open_accepted(c, &instance, false);
    if (!setup)
        return false;
    verify_instance_close(&instance);
    size_t before = 0;
    double end = study_seconds_now() + 1;
    int lives = 0;
    for (; lives < LIVES && (lives <= WARM || study_seconds_now() < end); lives++) {
        if (lives == WARM)
            before = in_use();
        if (!live(setup))
            return false;
    }
    size_t after = in_use(), grown = after > before ? after - before : 0;
    if (after == 0)
        return verify_skip(c, "the allocator of this program does not count");
    if (grown * LIVES > (size_t)(lives - WARM) * SLACK)
        return verify_fail(c, "%d instances left %zu bytes behind", lives - WARM, grown);
    return true;
}

bool verify_test_allocations(verify_context *c)
{
    enum { MOST = 2000 };
    verify_instance instance;
    verify_setup *setup = verify_open_accepted(c, &instance, false);
    if (!setup)
        return false;
    verify_instance_close(&instance);
    if (!c->redirected)
        return verify_skip(c, "its calls of malloc cannot be redirected");
    bool good = true;
    double end = study_seconds_now() + 1;
    for (size_t nth = 1; nth < MOST && good && study_seconds_now() < end; nth++) {
        verify_step(c, "create, set and ready with allocation number %zu failing", nth);
        verify_allocations_fail(nth);
        ff_status status = verify_instance_open(&instance, setup);
        bool struck = verify_allocations_made() >= nth;
        verify_allocations_fail(0);
        good = verify_instance_is_sound(&instance, status);
        verify_instance_close(&instance);
        if (!struck)
            break;
    }
    return good;
}

bool verify_test_limits(verify_context *c)
{
    enum { DRAWS = 300 };
    bool good = true;
    double end = study_seconds_now() + 1;
    for (int i = 0; i < DRAWS && good && study_seconds_now() < end; i++) {
        verify_setup *setup = verify_setup_new(c);
        verify_instance instance;
        verify_setup_draw_params(setup, &c->random, i % 2 ? VERIFY_PHYSICAL : VERIFY_CALIBRATED);
        verify_setup_draw_inputs(setup, &c->random);
        if (!verify_setup_can_be_used(setup, false))
            return false;
        verify_step(c, "set and ready with random parameters, draw %d", i);
        ff_status status = verify_instance_open(&instance, setup);
        good = verify_instance_is_sound(&instance, status);
        verify_instance_close(&instance);
    }
    return good;
}

bool verify_test_environment(verify_context *c)
{
    verify_instance instance;
    verify_setup *setup = verify_open_accepted(c, &instance, false);
    instance.stop_at = study_seconds_now() + 1;
    if (!setup)
        return false;
    verify_step(c, "evaluate");
    if (verify_data_outputs(c->model))
        verify_instance_run(&instance, NULL, setup);
    verify_step(c, "service");
    verify_instance_call(&instance, "service", call_services, &instance);
    verify_step(c, "destroy");
    verify_instance_close(&instance);
    return true;
}
