/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A stage that asks a viscosity law for one value, and may misbehave in any of its functions. */
static const char role[] = "stage";

#include "misdeed.h"

#include <flankfilm/author.h>
#include <flankfilm/laws.h>

#include <stdbool.h>
#include <stdint.h>

typedef struct stage {
    const ff_host *host;
    const ff_viscosity *law;
    double pressure;
} stage;

static const ff_param params[] = {{.name = "pressure",
                                   .unit = "GPa",
                                   .doc = "where the law is asked",
                                   .type = FF_REAL,
                                   .preset = "0.5 GPa",
                                   .max = 3,
                                   .low = 0.1,
                                   .high = 2}};
static const ff_port inputs[] = {
    {.name = "viscosity", .unit = "", .doc = "the law", .dims = "", .service = FF_VISCOSITY_ID},
    {.name = "first.series", .unit = "1", .doc = "of another", .dims = "n", .flags = FF_OPTIONAL}};
static const ff_port outputs[] = {
    {.name = "ln_eta", .unit = "1", .doc = "what it says", .dims = ""},
    {.name = "series", .unit = "1", .doc = "1, 2, 3, ...", .dims = "n"},
};
enum { LENGTH = 40 };

static ff_status create(const ff_host *host, void **self)
{
    stage *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    s->host = host;
    *self = s;
    misbehave("create");
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    (void)param;
    ((stage *)self)->pressure = value->real;
    misbehave("set");
    return FF_OK;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    if (input == 0)
        ((stage *)self)->law = service;
    misbehave("wire");
    return FF_OK;
}

static ff_status ready(void *self)
{
    (void)self;
    misbehave("ready");
    return FF_OK;
}

/* "stage evaluate behind 3": the third number behind the series. */
static bool writes(const char *where, long *offset)
{
    const char *misdeed = getenv("FLANKFILM_MISDEED");
    size_t length = strlen(where);
    bool asked = misdeed && !strncmp(misdeed, where, length);
    *offset = asked ? strtol(misdeed + length, NULL, 10) : 0;
    return asked;
}

static ff_status give_series(const stage *s, const ff_array *given)
{
    long at;
    double *series = s->host->output(s->host->ctx, 1, 1, (const size_t[]){LENGTH});
    if (!series)
        return FF_NOMEM;
    for (int i = 0; i < LENGTH; i++)
        series[i] = i + 1;
    if (writes("stage evaluate before ", &at))
        series[-at] = 1;
    if (writes("stage evaluate behind ", &at))
        series[LENGTH - 1 + at] = 1;
    if (given->data && writes("stage evaluate input ", &at))
        ((double *)(uintptr_t)given->data)[at] = 1;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    double ln_eta;
    ff_status status = s->law->eval(s->law->self, 1, &s->pressure, NULL, &ln_eta, NULL, NULL);
    misbehave("evaluate");
    if (status == FF_OK && wanted & 2)
        status = give_series(s, &in[1]);
    return status == FF_OK ? ff_put_scalar(s->host, 0, ln_eta) : status;
}

static void destroy(void *self)
{
    misbehave("destroy");
    free(self);
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .id = "misdeed/stage",
    .version = "1.0.0",
    .summary = "A stage that misbehaves",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .inputs = FF_TABLE(inputs),
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .wire = wire,
    .ready = ready,
    .evaluate = evaluate,
    .destroy = destroy,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    misbehave("entry");
    return &model;
}
