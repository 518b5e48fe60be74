/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions that the check of a kind calls to use the model under test. */
#include "private.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A fixture, with the changes of the check for the instances that it opens. */
typedef struct fixture {
    ff_fixture functions;
    verify_context *context;
    verify_setup *changed; /* values with size 0 are not changed */
    bool *inputs_changed;  /* whether `changed` contains the array or service of an input row */
    bool any_change;
} fixture;

typedef struct opened {
    verify_instance instance;
    const verify_setup *setup;
} opened;

static void step(void *ctx, const char *text)
{
    verify_step(((fixture *)ctx)->context, "%s", text);
}

static void fail(void *ctx, const char *text)
{
    verify_fail(((fixture *)ctx)->context, "%s", text);
}

static void skip(void *ctx, const char *text)
{
    verify_skip(((fixture *)ctx)->context, "%s", text ? text : "");
}

static double random_number(void *ctx)
{
    return verify_uniform(&((fixture *)ctx)->context->random);
}

static double *numbers(void *ctx, size_t count)
{
    (void)ctx;
    double *memory = ff_guarded_new(count);
    memory_require(memory);
    for (size_t i = 0; i < count; i++)
        memory[i] = (double)NAN;
    return memory;
}

static int32_t is_intact(void *ctx, const double *numbers, size_t count)
{
    (void)ctx;
    return !ff_guarded_breach(numbers, count);
}

static int32_t set(void *ctx, const char *param, const char *text)
{
    fixture *f = ctx;
    int index = ff_model_find_param(f->context->model, param);
    const char *message; /* whether a check may leave the calibrated range */
    ff_value value;
    if (index < 0 || !verify_read_param(f->context, (size_t)index, text, &value, &message))
        return 0;
    f->changed->values[index] = value;
    f->any_change = true;
    return 1;
}

static int32_t give(void *ctx, const char *input, uint32_t rank, const size_t *shape,
                    const double *data)
{
    fixture *f = ctx;
    const ff_model *model = f->context->model;
    verify_setup *changed = f->changed;
    int index = input ? ff_model_find_input(model, input) : 0;
    if (index < 0)
        return 0;
    for (size_t i = 0; i < model->input_count; i++) {
        if (input ? i != (size_t)index : ff_model_input(model, i)->service != NULL)
            continue;
        f->inputs_changed[i] = f->any_change = true;
        changed->inputs[i] = (ff_array){.data = NULL};
        if (input && data)
            verify_setup_give(changed, i, data, rank, shape);
    }
    return 1;
}

static int32_t serve(void *ctx, const char *wire, const void *table)
{
    fixture *f = ctx;
    int index = ff_model_find_input(f->context->model, wire);
    if (index < 0 || !ff_model_input(f->context->model, (size_t)index)->service)
        return 0;
    f->changed->services[index] = table;
    f->inputs_changed[index] = f->any_change = true;
    return 1;
}

static void clear_group(verify_setup *setup, size_t param)
{
    const ff_model *model = setup->context->model;
    const char *group = ff_model_param(model, param)->group;
    for (size_t i = 0; group && i < model->param_count; i++) {
        const char *other = ff_model_param(model, i)->group;
        if (other && !strcmp(other, group))
            setup->values[i].size = 0;
    }
}

/* Returns the setup of the user's run, or a random one, with the changes of the check. */
static verify_setup *make_setup(fixture *f)
{
    verify_context *context = f->context;
    const ff_model *model = context->model;
    verify_setup *setup = verify_setup_new(context);
    if (context->given) {
        memcpy(setup->values, context->given->values, model->param_count * sizeof *setup->values);
        memcpy(setup->inputs, context->given->inputs, model->input_count * sizeof *setup->inputs);
    } else {
        verify_setup_draw_params(setup, &context->random,
                                 f->any_change ? VERIFY_REQUIRED : VERIFY_CALIBRATED);
    }
    for (size_t i = 0; i < model->param_count; i++)
        if (f->changed->values[i].size) {
            clear_group(setup, i);
            setup->values[i] = f->changed->values[i];
        }
    for (size_t i = 0; i < model->input_count; i++)
        if (f->inputs_changed[i]) {
            setup->inputs[i] = f->changed->inputs[i];
            setup->services[i] = f->changed->services[i];
        }
    for (size_t i = 0; i < model->param_count; i++)
        if (!f->changed->values[i].size &&
            verify_setup_is_replaced(setup, ff_model_param(model, i)))
            setup->values[i].size = 0;
    return setup;
}

static void *open_instance(void *ctx)
{
    enum { TRIES = 400 };
    fixture *f = ctx;
    opened *made = memory_alloc(sizeof *made);
    char last[sizeof f->context->outcome->step];
    memcpy(last, f->context->outcome->step, sizeof last);
    verify_step(f->context, "create, set and ready");
    for (int i = 0; i < (f->context->given ? 1 : TRIES); i++) {
        made->setup = make_setup(f);
        if (!verify_setup_can_be_used(made->setup, false))
            return NULL;
        bool whole = verify_setup_is_complete(made->setup);
        if (verify_is_good(whole ? verify_instance_open(&made->instance, made->setup)
                                 : verify_instance_new(&made->instance, made->setup))) {
            verify_step(f->context, "%s", last);
            return made;
        }
        verify_instance_close(&made->instance);
    }
    verify_skip(f->context,
                "no parameters were found that it accepts%s%s; --pipeline FILE gives some",
                made->instance.text[0] ? ": " : "", made->instance.text);
    return NULL;
}

typedef struct service_call {
    const verify_instance *instance;
    uint32_t output;
    const void *table;
} service_call;

static ff_status call_service(void *ctx)
{
    service_call *call = ctx;
    call->table = call->instance->model->service(call->instance->self, call->output);
    return FF_OK;
}

static const void *service(void *ctx, void *instance, uint32_t output)
{
    verify_step(((fixture *)ctx)->context, "service");
    service_call call = {.instance = &((opened *)instance)->instance, .output = output};
    verify_instance_call(&((opened *)instance)->instance, "service", call_service, &call);
    return call.table;
}

/* Returns the words that name a data output of the model, without those in `refused`. */
static char *known_words(const ff_model *model, const char *words, const char *refused)
{
    char *known = memory_copy_text("", 0), word[64];
    for (; *words; words += strspn(words, " ")) {
        size_t length = strcspn(words, " ");
        snprintf(word, sizeof word, "%.*s", (int)length, words);
        words += length;
        int output = ff_model_find_output(model, word);
        if (output < 0 || ff_model_output(model, (size_t)output)->service || !strcmp(word, refused))
            continue;
        memory_add_text(&known, " %s", word);
    }
    return known;
}

static ff_status evaluate(void *ctx, void *instance, const char *wanted)
{
    opened *made = instance;
    const ff_model *model = ((fixture *)ctx)->context->model;
    char *words = wanted ? known_words(model, wanted, "") : NULL;
    ff_status status = verify_instance_run(&made->instance, words, made->setup);
    while (status == FF_UNSUPPORTED && words) {
        char *fewer = known_words(model, words, ff_instance_item(made->instance.made));
        bool refused = strcmp(fewer, words) != 0;
        free(words);
        words = fewer;
        if (!refused || !*words)
            break;
        status = verify_instance_run(&made->instance, words, made->setup);
    }
    free(words);
    return status;
}

static ff_array array(void *ctx, void *instance, const char *name)
{
    const ff_model *model = ((fixture *)ctx)->context->model;
    opened *made = instance;
    const ff_result *result;
    int input = ff_model_find_input(model, name);
    if (input >= 0)
        return made->setup->inputs[input];
    if (ff_instance_result(made->instance.made, name, &result) != FF_OK)
        return (ff_array){.data = NULL};
    return (ff_array){.data = result->data, .shape = result->shape, .rank = result->rank};
}

static const char *why(void *ctx, void *instance)
{
    (void)ctx;
    return ((opened *)instance)->instance.text;
}

static void close_instance(void *ctx, void *instance)
{
    verify_step(((fixture *)ctx)->context, "destroy");
    if (instance)
        verify_instance_close(&((opened *)instance)->instance);
}

void verify_run_check(verify_context *context, const ff_check *check)
{
    const ff_model *model = context->model;
    fixture f = {.functions = {.size = sizeof f.functions,
                               .ctx = &f,
                               .model = model,
                               .step = step,
                               .fail = fail,
                               .skip = skip,
                               .random = random_number,
                               .numbers = numbers,
                               .is_intact = is_intact,
                               .set = set,
                               .give = give,
                               .serve = serve,
                               .open = open_instance,
                               .service = service,
                               .evaluate = evaluate,
                               .array = array,
                               .why = why,
                               .close = close_instance,
                               .from_run = context->given != NULL},
                 .context = context,
                 .changed = verify_setup_new(context),
                 .inputs_changed = memory_alloc(model->input_count * sizeof *f.inputs_changed)};
    verify_step(context, "%s", check->name);
    check->run(&f.functions);
}
