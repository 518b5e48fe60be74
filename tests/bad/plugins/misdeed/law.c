/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A viscosity law of ln eta = -5 + alpha p that may misbehave in any of its functions. */
static const char role[] = "law";

#include "misdeed.h"

#include <flankfilm/author.h>
#include <flankfilm/laws.h>

#include <math.h>
#include <stdbool.h>

typedef struct law {
    ff_viscosity service;
    double alpha;
} law;

/* What the law says above 0.3 GPa instead of `right`. */
static double answer(double right)
{
    const char *misdeed = getenv("FLANKFILM_MISDEED");
    return !misdeed                                 ? right
           : !strcmp(misdeed, "law eval infinity")  ? INFINITY
           : !strcmp(misdeed, "law eval no-number") ? NAN
                                                    : right;
}

/* "law eval status -77": -77. */
static ff_status status_of_eval(void)
{
    static const char begin[] = "law eval status ";
    const char *misdeed = getenv("FLANKFILM_MISDEED");
    bool asked = misdeed && !strncmp(misdeed, begin, sizeof begin - 1);
    return asked ? atoi(misdeed + sizeof begin - 1) : FF_OK;
}

/* "law eval slope 1e6": the slope above 0.3 GPa, over the right one. */
static double slope_factor(void)
{
    static const char begin[] = "law eval slope ";
    const char *misdeed = getenv("FLANKFILM_MISDEED");
    bool asked = misdeed && !strncmp(misdeed, begin, sizeof begin - 1);
    return asked ? atof(misdeed + sizeof begin - 1) : 1;
}

/* "law eval past 4000": so many numbers behind those that were asked for. */
static void write_past(double *end)
{
    static const char begin[] = "law eval past ";
    const char *misdeed = getenv("FLANKFILM_MISDEED");
    bool asked = misdeed && !strncmp(misdeed, begin, sizeof begin - 1);
    for (long left = asked ? atol(misdeed + sizeof begin - 1) : 0; left > 0; left--)
        *(volatile double *)end++ = -1;
}

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const law *l = self;
    (void)T;
    misbehave("eval");
    double factor = slope_factor();
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = p[i] > 0.3e9 ? answer(-5 + l->alpha * p[i]) : -5 + l->alpha * p[i];
        if (dln_dp)
            dln_dp[i] = p[i] > 0.3e9 ? factor * l->alpha : l->alpha;
        if (dln_dT)
            dln_dT[i] = 0;
    }
    write_past(ln_eta + n);
    return status_of_eval();
}

static const ff_param params[] = {{.name = "alpha",
                                   .unit = "1/GPa",
                                   .doc = "pressure coefficient",
                                   .type = FF_REAL,
                                   .preset = "15 1/GPa",
                                   .max = 100,
                                   .low = 2,
                                   .high = 50}};
static const ff_port outputs[] = {
    {.name = "viscosity", .unit = "", .doc = "the law", .dims = "", .service = FF_VISCOSITY_ID}};

static ff_status create(const ff_host *host, void **self)
{
    law *l = calloc(1, sizeof *l);
    (void)host;
    if (!l)
        return FF_NOMEM;
    l->service = (ff_viscosity){.size = sizeof l->service, .self = l, .eval = eval};
    *self = l;
    misbehave("create");
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    (void)param;
    ((law *)self)->alpha = value->real;
    misbehave("set");
    return FF_OK;
}

static ff_status ready(void *self)
{
    (void)self;
    misbehave("ready");
    return FF_OK;
}

/* "law table null": tables that are none. */
static const void *service(void *self, uint32_t output)
{
    const char *misdeed = getenv("FLANKFILM_MISDEED");
    ff_viscosity *table = &((law *)self)->service;
    (void)output;
    misbehave("service");
    if (misdeed && !strcmp(misdeed, "law table null"))
        table->eval = NULL;
    if (misdeed && !strcmp(misdeed, "law table short"))
        table->size = 8;
    return misdeed && !strcmp(misdeed, "law table wild") ? (const void *)(uintptr_t)0x123456789000u
                                                         : table;
}

static void destroy(void *self)
{
    misbehave("destroy");
    free(self);
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .id = "viscosity/misdeed",
    .version = "1.0.0",
    .summary = "A law that misbehaves",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .ready = ready,
    .service = service,
    .destroy = destroy,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    misbehave("entry");
    return &model;
}
