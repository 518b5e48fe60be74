/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws of one kind that a file can choose among, each in the way that NAME says. */
#include "../toy/toy.h"

#include <flankfilm/author.h>

#include <stdlib.h>
#include <string.h>

static int is(const char *name)
{
    return !strcmp(NAME, name);
}

static const ff_param params[] = {
    {.name = "gain", .unit = "1", .doc = "the factor", .type = FF_REAL, .flags = FF_REQUIRED},
    {.name = "key", .unit = "", .doc = "a text", .type = FF_TEXT, .flags = FF_REQUIRED},
};

static const ff_port outputs[] = {
    {.name = "law", .unit = "", .doc = "a linear law", .service = TOY_LAW_ID},
};

typedef struct ruled {
    toy_law table;
    double gain;
} ruled;

static double eval(const void *self, double x)
{
    return ((const ruled *)self)->gain * x;
}

static ff_status create(const ff_host *host, void **self)
{
    ruled *r = calloc(1, sizeof *r);
    (void)host;
    if (!r)
        return FF_NOMEM;
    r->table = (toy_law){.size = sizeof r->table, .self = r, .eval = eval};
    *self = r;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    if (param == 0)
        ((ruled *)self)->gain = value->real;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    (void)output;
    return &((ruled *)self)->table;
}

static ff_status assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                        ff_assessment *a)
{
    (void)self, (void)wanted, (void)accuracy, (void)in;
    a->applies = FF_APPLIES;
    a->cost = is("costly") ? 9 : is("cheap") ? 1 : 2;
    a->reason = "it is " NAME;
    return FF_OK;
}

const ff_model *flankfilm_model_v1(void)
{
    static ff_model model = {
        .size = sizeof model,
        .abi_major = FF_ABI_MAJOR,
        .abi_minor = FF_ABI_MINOR,
        .id = "ruled/" NAME,
        .version = "1.0.0",
        .summary = "one law of several",
        .reference = "",
        .bibtex = "",
        .licence = "GPL-3.0-or-later",
        .params = params,
        .param_count = 1,
        .param_stride = sizeof params[0],
        .outputs = outputs,
        .output_count = 1,
        .output_stride = sizeof outputs[0],
        .create = create,
        .set = set,
        .service = service,
        .destroy = free,
        .assess = assess,
    };
    if (is("keyed"))
        model.param_count = 2;
    if (is("silent"))
        model.assess = NULL;
    return &model;
}
