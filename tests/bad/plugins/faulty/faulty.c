/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A model that is healthy but for the one fault that `faulty_fault` names. It is compiled once;
   each fault is an object of a few lines, fault.c, that says its name and has the entry. */
#include "faulty.h"

#include <fenv.h>
#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

static int is(const char *fault)
{
    return !strcmp(faulty_fault, fault);
}

static void *nowhere(void)
{
    static void *volatile address = NULL;
    return address;
}

static int overflow(volatile int depth)
{
    volatile char room[4096] = {0};
    return depth < 0 ? room[0] : overflow(depth + 1) + room[depth % 4096];
}

__attribute__((constructor)) static void at_load(void)
{
    if (is("crash-load"))
        *(volatile int *)nowhere() = 1;
}

static void *crash(void *unused)
{
    *(volatile int *)nowhere() = 1;
    return unused;
}

static void *leave(void *unused)
{
    exit(0);
    return unused;
}

static void run_thread(void *(*work)(void *))
{
    pthread_t thread;
    if (pthread_create(&thread, NULL, work, NULL) == 0)
        pthread_join(thread, NULL);
}

/* The faults that a stage can have in any of its functions. */
static void misbehave(const char *where)
{
    static volatile int zero = 0;
    char fault[64] = "crash-";
    strcat(fault, where);
    if (is(fault))
        *(volatile int *)nowhere() = 1;
    if (strcmp(where, "evaluate") != 0)
        return;
    if (is("abort"))
        abort();
    if (is("exit"))
        exit(0);
    if (is("thread"))
        run_thread(crash);
    if (is("thread-exit"))
        run_thread(leave);
    if (is("divide"))
        zero = 7 / zero;
    if (is("overflow"))
        zero = overflow(1);
    if (is("rounding"))
        fesetround(FE_UPWARD);
    if (is("locale"))
        setlocale(LC_ALL, "C.UTF-8");
}

static ff_param params[] = {
    {.name = "size", .unit = "mm", .doc = "a size", .type = FF_REAL, .preset = "1 mm"},
    {.name = "words", .unit = "", .doc = "a choice", .type = FF_CHOICE, .choices = "a|b"},
};

static ff_port inputs[] = {
    {.name = "source.level", .unit = "m", .doc = "a level", .dims = "", .flags = FF_OPTIONAL},
    {.name = "source.series", .unit = "m", .doc = "a series", .dims = "t", .flags = FF_OPTIONAL},
    {.name = "law",
     .unit = "",
     .doc = "a law",
     .service = "flankfilm.viscosity/1",
     .flags = FF_OPTIONAL,
     .from = "viscosity"},
};

static ff_port outputs[65] = {
    {.name = "level", .unit = "m", .doc = "a level", .dims = ""},
    {.name = "series", .unit = "m", .doc = "a series", .dims = "t"},
    {.name = "second", .unit = "m", .doc = "another", .dims = "t"},
};

static ff_status create(const ff_host *host, void **self)
{
    size_t shape = 2;
    *self = is("place-null") ? NULL : (void *)(uintptr_t)host;
    if (is("early-output"))
        host->output(host->ctx, 1, 1, &shape);
    misbehave("create");
    return is("fail-create") ? ff_failf(host, FF_BUG, NULL, "bytes \xff\x01 and\nlines") : FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    (void)self, (void)param, (void)value;
    misbehave("set");
    return FF_OK;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    (void)self, (void)input, (void)service;
    return FF_OK;
}

static ff_status ready(void *self)
{
    (void)self;
    misbehave("ready");
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    size_t shape[] = {3, 3, 3, 3, 3, 3}, count = is("lengths") ? 4 : 3;
    const ff_host *host = self;
    misbehave("evaluate");
    if (is("huge"))
        shape[0] = SIZE_MAX / 8;
    if (is("missing") || (is("lies") && wanted == FF_BIT(1)))
        return FF_OK;
    if (is("input") && in[1].data && in[1].rank == 1 && in[1].shape[0])
        *(double *)(uintptr_t)in[1].data += 1;
    double *level = host->output(host->ctx, 0, is("rank") ? 6 : 0, shape);
    double *series = host->output(host->ctx, 1, 1, shape);
    double *second = ff_put_series(host, 2, count);
    if (is("twice"))
        host->output(host->ctx, 1, 1, shape);
    if (is("row"))
        host->output(host->ctx, 99, 1, shape);
    if (is("verdict"))
        host->quality(host->ctx, "balance", 1, 1, 99, NULL);
    if (!level || !series || !second)
        return FF_NOMEM;
    *level = 1e-3;
    for (int i = 0; i < 3; i++)
        series[i] = 1e-3;
    for (size_t i = 0; i < count; i++)
        second[i] = 1e-3;
    if (is("past"))
        series[3] = 1;
    if (is("nan"))
        series[2] = NAN;
    if (is("infinite"))
        *level = INFINITY;
    return FF_OK;
}

static void destroy(void *self)
{
    (void)self;
    misbehave("destroy");
}

static char id[80] = "faulty/";

static ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = id,
    .version = "1.0.0",
    .summary = "A model with a fault",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = params,
    .param_count = sizeof params / sizeof params[0],
    .param_stride = sizeof params[0],
    .inputs = inputs,
    .input_count = sizeof inputs / sizeof inputs[0],
    .input_stride = sizeof inputs[0],
    .outputs = outputs,
    .output_count = 3,
    .output_stride = sizeof outputs[0],
    .create = create,
    .set = set,
    .wire = wire,
    .ready = ready,
    .evaluate = evaluate,
    .destroy = destroy,
};

static void spoil_model(void)
{
    if (is("major"))
        model.abi_major = 2;
    if (is("minor"))
        model.abi_minor = FF_ABI_MINOR + 1;
    if (is("small"))
        model.size = offsetof(ff_model, evaluate);
    if (is("id"))
        model.id = "faulty/another";
    if (is("no-licence"))
        model.licence = NULL;
    if (is("no-evaluate"))
        model.evaluate = NULL;
    if (is("no-create"))
        model.create = NULL;
    if (is("no-table"))
        model.params = NULL;
    if (is("stride"))
        model.output_stride = 8;
    if (is("many"))
        model.output_count = 1001;
    if (is("cost"))
        model.cost = NAN;
    if (is("many-old"))
        model.output_count = 65, model.abi_minor = 1;
    if (is("no-output"))
        model.output_count = 0;
}

static void spoil_params(void)
{
    if (is("param-twice"))
        params[1].name = "size";
    if (is("param-name"))
        params[0].name = "Größe";
    if (is("param-use"))
        params[0].name = "use";
    if (is("param-unit"))
        params[0].unit = "mmm";
    if (is("param-type"))
        params[0].type = 99;
    if (is("param-doc"))
        params[0].doc = "";
    if (is("preset"))
        params[0].preset = "1 kg";
    if (is("preset-limit"))
        params[0].min = 2, params[0].max = 3;
    if (is("limits"))
        params[0].min = 3, params[0].max = 2;
    if (is("choices"))
        params[1].choices = "a||b";
    if (is("no-choices"))
        params[1].choices = NULL;
    if (is("instead"))
        params[0].instead = "nothing";
    if (is("instead-old"))
        params[0].instead = "source", model.abi_minor = 2;
    if (is("instead-needed"))
        params[0].instead = "law", inputs[2].flags = 0;
    if (is("map"))
        params[1].name = "size.of";
    if (is("wire-param"))
        params[0].name = "source";
}

static void spoil_places(void)
{
    if (strncmp(faulty_fault, "place-", 6) != 0)
        return;
    model.self_size = is("place-size") ? 0 : 16;
    params[0].place = is("place-behind") ? 10 : is("place-crooked") ? 5 : 1;
    if (is("place-old"))
        model.abi_minor = 1;
    if (is("place-over"))
        params[1].place = 5;
}

static void spoil_ports(void)
{
    if (is("output-twice"))
        outputs[1].name = "level";
    if (is("output-unit"))
        outputs[0].unit = "furlong";
    if (is("output-si"))
        outputs[0].unit = "mm";
    if (is("dims"))
        outputs[1].dims = "t  x";
    if (is("deep"))
        outputs[1].dims = "a b c d e";
    if (is("optional-dim"))
        outputs[1].dims = "t x?";
    if (is("input-name"))
        inputs[0].name = "level";
    if (!strncmp(faulty_fault, "feedback-", 9) && !is("feedback-output") && !is("feedback-service"))
        inputs[0].flags = inputs[1].flags = FF_OPTIONAL | FF_FEEDBACK;
    if (is("feedback-one"))
        inputs[1].flags = FF_OPTIONAL;
    if (is("feedback-required"))
        inputs[0].flags = FF_FEEDBACK;
    if (is("feedback-old"))
        model.abi_minor = 1;
    if (is("feedback-output"))
        outputs[0].flags = FF_FEEDBACK;
    if (is("bounds"))
        outputs[0].min = 1, outputs[0].max = 0;
    if (is("difference"))
        outputs[0].flags = FF_DIFFERENCE;
    if (is("apart"))
        outputs[0].apart = -1;
    if (is("headline"))
        outputs[0].headline = FF_MEAN + 1;
    if (is("origin"))
        outputs[0].origin = "source.nothing";
    if (is("shown"))
        outputs[0].shown = "kg";
    if (is("feedback-service"))
        inputs[2].flags = FF_OPTIONAL | FF_FEEDBACK;
    if (is("input-from"))
        inputs[1].from = "toy";
}

const ff_model *faulty_model(void)
{
    if (is("null"))
        return NULL;
    if (is("crash-entry"))
        *(volatile int *)nowhere() = 1;
    if (is("exit-entry"))
        exit(0);
    strncpy(id + 7, faulty_fault, sizeof id - 8);
    spoil_model();
    spoil_params();
    spoil_places();
    spoil_ports();
    return &model;
}

const ff_model *const *faulty_models(void)
{
    static const ff_model *list[3];
    static ff_model other;
    list[0] = is("list-empty") ? NULL : &model;
    other = model;
    if (is("list-id"))
        other.id = NULL;
    list[1] = &other;
    return is("list-null") ? NULL : list;
}
