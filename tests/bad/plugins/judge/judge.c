/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Use a law; all but `deaf` can judge one, by how far `value` moves. */
#include "../toy/toy.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int is(const char *name)
{
    return !strcmp(NAME, name);
}

static const ff_port inputs[] = {
    {.name = "law", .unit = "", .doc = "the law", .service = TOY_LAW_ID, .from = "ruled"},
    {.name = "source.level", .unit = "m", .doc = "where it is asked", .dims = "", .from = "toy"},
    {.name = "after.level",
     .unit = "m",
     .doc = "who comes before",
     .dims = "",
     .flags = FF_OPTIONAL,
     .from = "none"},
};

static const ff_port outputs[] = {
    {.name = "value", .unit = "1", .doc = "the law at `level` in mm", .dims = ""},
    {.name = "level", .unit = "m", .doc = "for one that comes after", .dims = ""},
    {.name = "coarse", .unit = "1", .doc = "a tenth of `value`, which judges mildly", .dims = ""},
};

typedef struct judge {
    const ff_host *host;
    const toy_law *law;
    char reason[100];
} judge_;

static ff_status create(const ff_host *host, void **self)
{
    judge_ *j = calloc(1, sizeof *j);
    *self = j;
    if (j)
        j->host = host;
    return j ? FF_OK : FF_NOMEM;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    if (input == 0)
        ((judge_ *)self)->law = service;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const judge_ *j = self;
    double at = 1e3 * in[1].data[0], value = j->law->eval(j->law->self, at);
    (void)wanted;
    ff_status status = ff_put_scalar(j->host, 0, value);
    if (status == FF_OK)
        status = ff_put_scalar(j->host, 1, in[1].data[0]);
    return status == FF_OK ? ff_put_scalar(j->host, 2, value / 10) : status;
}

static ff_status assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                        ff_assessment *a)
{
    (void)self, (void)wanted, (void)accuracy, (void)in;
    a->applies = FF_APPLIES;
    a->error = 0.001;
    a->cost = 1;
    a->reason = "always";
    return FF_OK;
}

static ff_status judge(void *self, uint64_t wanted, uint32_t input, const void *service,
                       const ff_array *in, ff_assessment *a)
{
    judge_ *j = self;
    const toy_law *other = service;
    double at = 1e3 * in[1].data[0];
    double moves = other->eval(other->self, at) / j->law->eval(j->law->self, at) - 1;
    if (input != 0 || at > 90)
        return ff_failf(j->host, FF_UNSUPPORTED, NULL, "nothing is known beyond 90 mm");
    snprintf(j->reason, sizeof j->reason, "moves the value by %.3g %%", 100 * moves);
    a->applies = moves > 5 ? FF_APPLIES_NOT : FF_APPLIES;
    a->error = at > 80 ? NAN : wanted & FF_BIT(0) ? fabs(moves) : fabs(moves) / 10;
    a->reason = j->reason;
    return FF_OK;
}

const ff_model *flankfilm_model_v1(void)
{
    static ff_model model = {
        .size = sizeof model,
        .abi_major = FF_ABI_MAJOR,
        .abi_minor = FF_ABI_MINOR,
        .id = "judge/" NAME,
        .version = "1.0.0",
        .summary = "a user of laws",
        .reference = "",
        .bibtex = "",
        .licence = "GPL-3.0-or-later",
        .param_stride = sizeof(ff_param),
        .inputs = inputs,
        .input_count = 3,
        .input_stride = sizeof inputs[0],
        .outputs = outputs,
        .output_count = 3,
        .output_stride = sizeof outputs[0],
        .create = create,
        .wire = wire,
        .evaluate = evaluate,
        .destroy = free,
        .assess = assess,
        .judge = judge,
    };
    if (is("deaf")) {
        model.judge = NULL;
        model.assess = NULL;
    }
    return &model;
}
