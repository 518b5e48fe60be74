/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Several models in one object: toy/several, and toy/wide with more outputs than `wanted` has bits.
 */
#include <flankfilm/author.h>

#include <stdlib.h>

enum { WIDTH = 100, NAME = 8 };

static ff_status create(const ff_host *host, void **self)
{
    *self = (void *)(uintptr_t)host;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    (void)wanted, (void)in;
    return ff_put_scalar(self, 0, 1);
}

static const ff_port outputs[] = {{.name = "one", .unit = "1", .doc = "the number 1", .dims = ""}};

#define TEXTS                                                                                      \
    .size = sizeof(ff_model), .abi_major = FF_ABI_MAJOR, .abi_minor = FF_ABI_MINOR,                \
    .version = "1.0.0", .reference = "", .bibtex = "", .licence = "GPL-3.0-or-later"

static const ff_model several = {
    TEXTS,
    .id = "toy/several",
    .summary = "The first model of its object",
    .outputs = FF_TABLE(outputs),
    .create = create,
    .evaluate = evaluate,
};

/* Each output is its rank; the last one counts those that are wanted. */
static ff_status evaluate_wide(void *self, uint64_t wanted, const ff_array *in)
{
    const ff_host *host = self;
    ff_status status = FF_OK;
    double count = 0;
    (void)in;
    for (uint32_t i = 0; i < WIDTH; i++)
        count += host->wanted(host->ctx, i);
    for (uint32_t i = 0; i < WIDTH && status == FF_OK; i++) {
        if (i < 64 && !(wanted >> i & 1) != !host->wanted(host->ctx, i))
            return FF_BUG;
        if (host->wanted(host->ctx, i))
            status = ff_put_scalar(host, i, i == WIDTH - 1 ? count : i);
    }
    return status;
}

static const ff_model *wide(void)
{
    static char names[WIDTH][NAME];
    static ff_port rows[WIDTH];
    static ff_model model = {
        TEXTS,
        .id = "toy/wide",
        .summary = "More outputs than a mask of 64 bits has room for",
        .outputs = rows,
        .output_count = WIDTH,
        .output_stride = sizeof rows[0],
        .create = create,
        .evaluate = evaluate_wide,
    };
    for (int i = 0; i < WIDTH; i++) {
        snprintf(names[i], sizeof names[i], "o%d", i);
        rows[i] = (ff_port){.name = names[i], .unit = "1", .doc = "its rank", .dims = ""};
    }
    return &model;
}

FF_EXPORT const ff_model *const *flankfilm_models_v1(void)
{
    static const ff_model *list[3] = {&several};
    list[1] = wide();
    return list;
}
