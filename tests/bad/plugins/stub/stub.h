/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frame of a model KIND/FAULT that is right but for the one fault that FAULT names. The file that
   includes it defines `inputs`, `outputs` and `evaluate`. */
#ifndef STUB_H
#define STUB_H

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

typedef struct stub {
    const ff_host *host;
} stub;

static inline int is(const char *fault)
{
    return !strcmp(FAULT, fault);
}

/* The factor that the fault puts on a figure that is else right. */
static inline double off(const char *fault, double factor)
{
    return is(fault) ? factor : 1;
}

static inline void put(const stub *s, uint32_t output, size_t count, const double *data)
{
    double *memory = ff_put_series(s->host, output, count);
    if (memory && count)
        memcpy(memory, data, count * sizeof *data);
}

static ff_status create(const ff_host *host, void **self)
{
    stub *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    s->host = host;
    *self = s;
    return FF_OK;
}

#ifndef STUB_WIRE
#define STUB_WIRE NULL
#endif

#define STUB_MODEL                                                                                 \
    static const ff_model model = {                                                                \
        .size = sizeof model,                                                                      \
        .abi_major = FF_ABI_MAJOR,                                                                 \
        .id = KIND "/" FAULT,                                                                      \
        .version = "1.0.0",                                                                        \
        .summary = "A model with a fault",                                                         \
        .reference = "",                                                                           \
        .bibtex = "",                                                                              \
        .licence = "GPL-3.0-or-later",                                                             \
        .inputs = FF_TABLE(inputs),                                                                \
        .outputs = FF_TABLE(outputs),                                                              \
        .create = create,                                                                          \
        .wire = STUB_WIRE,                                                                         \
        .evaluate = evaluate,                                                                      \
        .destroy = free,                                                                           \
    };                                                                                             \
    FF_EXPORT const ff_model *flankfilm_model_v1(void)                                             \
    {                                                                                              \
        return &model;                                                                             \
    }

#endif
