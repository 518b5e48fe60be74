/* @ID@: rho = rho0 (1 + C p/(1 + D p)); write your law into `eval`. */
#include <flankfilm/author.h>
#include <flankfilm/density.h>

#include <stdlib.h>

typedef struct {
    ff_density service;
    double rho0;
} law;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *rho,
                      double *drho_dp, double *drho_dT)
{
    const law *l = self;
    const double C = 0.6e-9, D = 1.7e-9; /* 1/Pa */
    (void)T;                             /* NULL: the reference temperature */
    for (size_t i = 0; i < n; i++) {
        double x = p[i] > 0 ? p[i] : 0, slope = C / ((1 + D * x) * (1 + D * x));
        double tension = p[i] > -0.5 / C ? p[i] - x : -0.5 / C; /* rho stays above 0 */
        rho[i] = l->rho0 * (1 + C * x / (1 + D * x) + slope * tension);
        if (drho_dp)
            drho_dp[i] = l->rho0 * (p[i] > -0.5 / C ? slope : 0);
        if (drho_dT)
            drho_dT[i] = 0;
    }
    return FF_OK;
}

static const ff_param params[] = {
    {.name = "rho0",
     .unit = "kg/m3",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .doc = "density at ambient pressure",
     .min = 1,
     .max = 1e5,
     .low = 600,
     .high = 2000},
};

static const ff_port outputs[] = {
    {.name = "density", .unit = "", .dims = "", .service = FF_DENSITY_ID, .doc = "the law"},
};

static ff_status create(const ff_host *host, void **self)
{
    law *l = calloc(1, sizeof *l);
    if (!l)
        return ff_failf(host, FF_NOMEM, NULL, "out of memory");
    l->service = (ff_density){.size = sizeof l->service, .self = l, .eval = eval};
    *self = l;
    return FF_OK;
}

/* The value is in SI units. */
static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    if (param == 0)
        ((law *)self)->rho0 = value->real;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    return output ? NULL : &((law *)self)->service;
}

/* Takes part where a file says density/auto: seconds for a million points, what it is good for. */
static ff_status assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                        ff_assessment *a)
{
    (void)self, (void)wanted, (void)accuracy, (void)in;
    return ff_assess_law(4e-3, "", a);
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
