/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Needs a law. */
#include "toy.h"

#include <flankfilm/author.h>

#include <stdlib.h>

static const ff_param params[] = {
    {.name = "at", .unit = "1", .doc = "where the law is asked", .type = FF_REAL, .preset = "2"},
};

static const ff_port inputs[] = {
    {.name = "law", .unit = "", .doc = "the law", .service = TOY_LAW_ID, .from = "toy"},
};

static const ff_port outputs[] = {
    {.name = "value", .unit = "1", .doc = "what it says", .dims = ""},
};

typedef struct user {
    const ff_host *host;
    const toy_law *law;
    double at;
} user;

static ff_status create(const ff_host *host, void **self)
{
    user *u = calloc(1, sizeof *u);
    if (!u)
        return FF_NOMEM;
    u->host = host;
    *self = u;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    (void)param;
    ((user *)self)->at = value->real;
    return FF_OK;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    (void)input;
    ((user *)self)->law = service;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const user *u = self;
    (void)wanted, (void)in;
    return ff_put_scalar(u->host, 0, u->law->eval(u->law->self, u->at));
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .id = "toy/user",
    .version = "1.0.0",
    .summary = "A user of a law",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = params,
    .param_count = 1,
    .param_stride = sizeof params[0],
    .inputs = inputs,
    .input_count = 1,
    .input_stride = sizeof inputs[0],
    .outputs = outputs,
    .output_count = 1,
    .output_stride = sizeof outputs[0],
    .create = create,
    .set = set,
    .wire = wire,
    .evaluate = evaluate,
    .destroy = free,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
