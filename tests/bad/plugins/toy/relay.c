/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Passes a level on. */
#include <flankfilm/author.h>

#include <stdlib.h>

static const ff_port inputs[] = {
    {.name = "before.level", .unit = "m", .doc = "a level", .dims = "", .from = "toy"},
};

static const ff_port outputs[] = {
    {.name = "level", .unit = "m", .doc = "the same level", .dims = ""},
    {.name = "series", .unit = "s", .doc = "not what a consumer takes", .dims = "t"},
};

static ff_status create(const ff_host *host, void **self)
{
    const ff_host **kept = malloc(sizeof(void *));
    if (!kept)
        return FF_NOMEM;
    *kept = host;
    *self = kept;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const ff_host *host = *(const ff_host **)self;
    double *series = wanted & FF_BIT(1) ? ff_put_series(host, 1, 1) : NULL;
    if (series)
        *series = 1;
    return ff_put_scalar(host, 0, *in[0].data);
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .id = "toy/relay",
    .version = "1.0.0",
    .summary = "A level passed on",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .inputs = inputs,
    .input_count = 1,
    .input_stride = sizeof inputs[0],
    .outputs = outputs,
    .output_count = 2,
    .output_stride = sizeof outputs[0],
    .create = create,
    .evaluate = evaluate,
    .destroy = free,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
