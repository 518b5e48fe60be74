/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums the series of a source; optionally adds that of a second one. */
#include <flankfilm/author.h>

#include <stdlib.h>

enum { LEVEL, SERIES, ABSENT, MORE };

static const ff_port inputs[] = {
    {.name = "source.level", .unit = "m", .doc = "a level", .dims = "", .from = "toy|faulty"},
    {.name = "source.series", .unit = "m", .doc = "a series", .dims = "t", .from = "toy|faulty"},
    {.name = "source.absent",
     .unit = "m",
     .doc = "never offered",
     .dims = "t",
     .flags = FF_OPTIONAL,
     .from = "toy|faulty"},
    {.name = "more.series",
     .unit = "m",
     .doc = "a second series",
     .dims = "t",
     .flags = FF_OPTIONAL},
};

static const ff_port outputs[] = {
    {.name = "sum", .unit = "m", .doc = "sum of the series", .dims = ""},
    {.name = "connected", .unit = "1", .doc = "bits of the connected inputs", .dims = ""},
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
    double sum = 0, connected = 0;
    (void)wanted;
    for (int i = LEVEL; i <= MORE; i++)
        connected += in[i].data ? 1 << i : 0;
    for (int i = SERIES; i <= MORE; i++)
        for (size_t k = 0; in[i].data && k < in[i].shape[0]; k++)
            sum += in[i].data[k];
    ff_put_scalar(host, 0, sum);
    ff_put_scalar(host, 1, connected);
    return FF_OK;
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .id = "toy/consumer",
    .version = "1.0.0",
    .summary = "A sum",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .inputs = inputs,
    .input_count = sizeof inputs / sizeof inputs[0],
    .input_stride = sizeof inputs[0],
    .outputs = outputs,
    .output_count = sizeof outputs / sizeof outputs[0],
    .output_stride = sizeof outputs[0],
    .create = create,
    .evaluate = evaluate,
    .destroy = free,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
