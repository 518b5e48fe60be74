/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A stage that asks a viscosity law for one value, and may misbehave in any of its functions. */
static const char role[] = "stage";

#include "misdeed.h"

#include <flankfilm/author.h>
#include <flankfilm/laws.h>

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
    {.name = "viscosity", .unit = "", .doc = "the law", .dims = "", .service = FF_VISCOSITY_ID}};
static const ff_port outputs[] = {
    {.name = "ln_eta", .unit = "1", .doc = "what it says", .dims = ""}};

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
    (void)input;
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

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    double ln_eta;
    (void)wanted, (void)in;
    ff_status status = s->law->eval(s->law->self, 1, &s->pressure, NULL, &ln_eta, NULL, NULL);
    misbehave("evaluate");
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
