/* @ID@: ln eta = ln eta0 + alpha p; write your law into `eval`. */
#include <flankfilm/author.h>
#include <flankfilm/viscosity.h>

#include <math.h>
#include <stdlib.h>

typedef struct {
    ff_viscosity service;
    double ln_eta0, alpha;
} law;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const law *l = self;
    (void)T; /* NULL: the reference temperature */
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = l->ln_eta0 + l->alpha * p[i];
        if (dln_dp)
            dln_dp[i] = l->alpha;
        if (dln_dT)
            dln_dT[i] = 0;
    }
    return FF_OK;
}

static const ff_param params[] = {
    {.name = "eta0",
     .unit = "mPa s",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .doc = "viscosity at ambient pressure",
     .min = 0.01,
     .max = 1e6},
    {.name = "alpha",
     .unit = "1/GPa",
     .type = FF_REAL,
     .preset = "11 1/GPa",
     .doc = "pressure-viscosity coefficient",
     .max = 1000,
     .low = 2,
     .high = 50},
};

static const ff_port outputs[] = {
    {.name = "viscosity", .unit = "", .dims = "", .service = FF_VISCOSITY_ID, .doc = "the law"},
};

static ff_status create(const ff_host *host, void **self)
{
    law *l = calloc(1, sizeof *l);
    if (!l)
        return ff_failf(host, FF_NOMEM, NULL, "out of memory");
    l->service = (ff_viscosity){.size = sizeof l->service, .self = l, .eval = eval};
    *self = l;
    return FF_OK;
}

/* The value is in SI units. */
static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    law *l = self;
    if (param == 0)
        l->ln_eta0 = log(value->real);
    if (param == 1)
        l->alpha = value->real;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    return output ? NULL : &((law *)self)->service;
}

/* Takes part where a file says viscosity/auto: seconds for a million points, what it is good for.
 */
static ff_status assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                        ff_assessment *a)
{
    (void)self, (void)wanted, (void)accuracy, (void)in;
    return ff_assess_law(1e-3, "", a);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .id = "@ID@",
    .version = "0.1.0",
    .summary = "one line on what it is good for",
    .reference = "",
    .bibtex = "",
    .licence = "MIT",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .service = service,
    .destroy = free,
    .assess = assess,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
