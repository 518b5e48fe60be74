/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Offers a service and nothing else. */
#include "toy.h"

#include <flankfilm/author.h>

#include <stdlib.h>

static const ff_param params[] = {
    {.name = "gain", .unit = "1", .doc = "the factor", .type = FF_REAL, .flags = FF_REQUIRED},
};

static const ff_port outputs[] = {
    {.name = "law", .unit = "", .doc = "a linear law", .service = TOY_LAW_ID},
};

typedef struct law {
    toy_law table;
    double gain;
    const ff_host *host;
} law;

static double eval(const void *self, double x)
{
    return ((const law *)self)->gain * x;
}

static ff_status create(const ff_host *host, void **self)
{
    law *l = calloc(1, sizeof *l);
    if (!l)
        return FF_NOMEM;
    l->host = host;
    l->table = (toy_law){.size = sizeof l->table, .self = l, .eval = eval};
    *self = l;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    (void)param;
    ((law *)self)->gain = value->real;
    return FF_OK;
}

/* A gain below 0 is out of range; below -10 there is no solution. */
static ff_status ready(void *self)
{
    const law *l = self;
    return l->gain >= 0 ? FF_OK
                        : ff_failf(l->host, l->gain < -10 ? FF_NOCONV : FF_DOMAIN, NULL,
                                   "a gain of %g", l->gain);
}

static const void *service(void *self, uint32_t output)
{
    (void)output;
    return &((law *)self)->table;
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .id = "toy/law",
    .version = "1.0.0",
    .summary = "A linear law",
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
    .ready = ready,
    .service = service,
    .destroy = free,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
