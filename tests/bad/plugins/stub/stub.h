/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frame of a model that is right but for the one fault that `stub_fault` names; fault.c has the
   names. The file that includes it defines `inputs`, `outputs` and `evaluate`. */
#ifndef STUB_H
#define STUB_H

#include <flankfilm/author.h>
#include <flankfilm/film.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

extern const char stub_fault[], stub_id[];

static const double pi = 3.14159265358979323846;

typedef struct stub {
    const ff_host *host;
    double value[4];      /* of each parameter, SI; NaN: not given */
    const void *table[4]; /* of each wire that serves a law; NULL: not connected */
    union {
        const void *first; /* its size begins each table */
        ff_viscosity viscosity;
        ff_density density;
        ff_liquid liquid;
        ff_film film;
    } service;
} stub;

static inline int is(const char *fault)
{
    return !strcmp(stub_fault, fault);
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
    for (size_t i = 0; i < sizeof s->value / sizeof *s->value; i++)
        s->value[i] = (double)NAN;
    *self = s;
    return FF_OK;
}

/* Where a model has parameters. */
static inline ff_status stub_set(void *self, uint32_t param, const ff_value *value)
{
    ((stub *)self)->value[param] = value->count ? value->reals[0] : value->real;
    return FF_OK;
}

/* Where its first input rows are laws. */
static inline ff_status stub_wire(void *self, uint32_t input, const void *table)
{
    if (input < 4)
        ((stub *)self)->table[input] = table;
    return FF_OK;
}

static inline const void *stub_service(void *self, uint32_t output)
{
    (void)output;
    return &((stub *)self)->service;
}

/* Further members of the descriptor. */
#ifndef STUB_MORE
#define STUB_MORE .wire = NULL
#endif

#define STUB_MODEL                                                                                 \
    static const ff_model model = {                                                                \
        .size = sizeof model,                                                                      \
        .abi_major = FF_ABI_MAJOR,                                                                 \
        .id = stub_id,                                                                             \
        .version = "1.0.0",                                                                        \
        .summary = "A model with a fault",                                                         \
        .reference = "",                                                                           \
        .bibtex = "",                                                                              \
        .licence = "GPL-3.0-or-later",                                                             \
        .inputs = FF_TABLE(inputs),                                                                \
        .outputs = FF_TABLE(outputs),                                                              \
        .create = create,                                                                          \
        .destroy = free,                                                                           \
        STUB_MORE,                                                                                 \
    };                                                                                             \
    FF_EXPORT const ff_model *flankfilm_model_v1(void)                                             \
    {                                                                                              \
        return &model;                                                                             \
    }

#endif
