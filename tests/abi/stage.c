/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A stage as it was compiled against the headers of an older interface: the viscosity at the Hertz
   pressure of a contact; every function of the host is called. */
#include <flankfilm/author.h>
#include <flankfilm/viscosity.h>

#include <math.h>
#include <stdlib.h>

#ifndef FROZEN_MINOR
#error "FROZEN_MINOR is the minor version of the headers"
#elif FF_ABI_MINOR != FROZEN_MINOR
#error "these are the headers of another version"
#endif

typedef struct stage {
    const ff_host *host;
    const ff_viscosity *oil;
    double factor;
} stage;

static const ff_param params[] = {{.name = "factor",
                                   .unit = "1",
                                   .doc = "of the pressure",
                                   .type = FF_REAL,
                                   .preset = "1",
                                   .max = 1}};

static const ff_port inputs[] = {
    {.name = "contact.hertz_pressure", .unit = "Pa", .doc = "p_H", .dims = "t"},
    {.name = "viscosity", .unit = "", .doc = "oil", .dims = "", .service = FF_VISCOSITY_ID},
};

#if FROZEN_MINOR >= 3
#define MEANING                                                                                    \
    .dims = "contact.t", .min = -30, .max = 1e5, .label = "viscosity", .headline = FF_LARGEST
#else
#define MEANING .dims = "t"
#endif

static const ff_port outputs[] = {
    {.name = "ln_eta", .unit = "1", .doc = "ln(eta/1 Pa s)", MEANING},
    {.name = "highest", .unit = "1", .doc = "largest of them", .dims = ""},
};

static ff_status create(const ff_host *host, void **self)
{
    stage *s = calloc(1, sizeof *s);
    if (!s)
        return host->fail(host->ctx, FF_NOMEM, NULL, "out of memory");
    s->host = host;
    *self = s;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    (void)param;
    ((stage *)self)->factor = value->real;
    return FF_OK;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    if (input == 1)
        ((stage *)self)->oil = service;
    return FF_OK;
}

static ff_status ready(void *self)
{
    const stage *s = self;
    return s->factor >= 0 ? FF_OK : ff_failf(s->host, FF_INVALID, "factor", "it is negative");
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    const ff_host *host = s->host;
    size_t count = in[0].shape[0];
    double highest = -INFINITY, *ln_eta = ff_put_series(host, 0, count);
    double *p = malloc((count + 1) * sizeof *p);
    if (!ln_eta || !p || host->extension(host->ctx, "of.no/1")) {
        free(p);
        return FF_NOMEM;
    }
    for (size_t i = 0; i < count; i++)
        p[i] = fmin(fmax(s->factor * in[0].data[i], 0), 1e11);
    ff_status status = s->oil->eval(s->oil->self, count, p, NULL, ln_eta, NULL, NULL);
    for (size_t i = 0; i < count; i++)
        highest = fmax(highest, ln_eta[i]);
    free(p);
    if (count == 0)
        return ff_failf(host, FF_INVALID, "contact.hertz_pressure", "the contact has no history");
    host->quality(host->ctx, "points", (double)count, 1, FF_GOOD, NULL);
    host->log(host->ctx, FF_LOG_INFO, "done");
    if (host->progress(host->ctx, 1))
        return FF_STOPPED;
    return wanted & FF_BIT(1) && ff_put_scalar(host, 1, highest) != FF_OK ? FF_NOMEM : status;
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = "lab/" FROZEN_NAME,
    .version = "1.0.0",
    .summary = "a stage of an older interface",
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
    .destroy = free,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
