/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adds up what it is fed: the second stage of the command line's tests. */
#include <flankfilm/author.h>

static const ff_port inputs[] = {
    {.name = "wave.height", .unit = "m", .doc = "what to add up", .dims = "t", .from = "toy"},
};

static const ff_port outputs[] = {
    {.name = "sum", .unit = "m", .doc = "the sum", .dims = ""},
    {.name = "partial", .unit = "m", .doc = "the sum so far", .dims = "t"},
};

static ff_status create(const ff_host *host, void **self)
{
    *(const ff_host **)self = host;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const ff_host *host = self;
    (void)wanted;
    double sum = 0, *partial = ff_put_series(host, 1, in[0].shape[0]);
    if (!partial)
        return FF_NOMEM;
    for (size_t i = 0; i < in[0].shape[0]; i++)
        partial[i] = sum += in[0].data[i];
    return ff_put_scalar(host, 0, sum);
}

const ff_model *flankfilm_model_v1(void)
{
    static const ff_model model = {
        .size = sizeof model,
        .abi_major = FF_ABI_MAJOR,
        .abi_minor = FF_ABI_MINOR,
        .id = "toy/sum",
        .version = "1.0.0",
        .summary = "adds up a series",
        .reference = "Nobody 1901, Journal of Toys 2",
        .bibtex = "@article{nobody1901, title={Sums}}",
        .licence = "GPL-3.0-or-later",
        .inputs = inputs,
        .input_count = sizeof inputs / sizeof inputs[0],
        .input_stride = sizeof inputs[0],
        .outputs = outputs,
        .output_count = sizeof outputs / sizeof outputs[0],
        .output_stride = sizeof outputs[0],
        .create = create,
        .evaluate = evaluate,
    };
    return &model;
}
