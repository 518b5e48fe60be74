/* @ID@: psi = sqrt(1/eta^2 + (u_s/(tau0 h))^2) of Ree and Eyring; write your law into `flow` and
   `shear`. */
#include <flankfilm/author.h>
#include <flankfilm/rheology.h>

#include <math.h>
#include <stdlib.h>

typedef struct {
    ff_rheology service;
    double tau0;
} law;

static ff_status flow(const void *self, size_t n, const double *ln_eta, const double *h, double u_s,
                      double *psi, double *dpsi_dln_eta, double *dpsi_dh)
{
    const law *l = self;
    for (size_t i = 0; i < n; i++) {
        int inside = fabs(ln_eta[i]) < 600;
        int thick = h[i] > 1e-12;
        double film = thick ? h[i] : 1e-12;
        double a = exp(-fmax(-600, fmin(600, ln_eta[i]))), b = u_s / (l->tau0 * film);
        psi[i] = hypot(a, b);
        if (dpsi_dln_eta)
            dpsi_dln_eta[i] = inside ? -a * (a / psi[i]) : 0;
        if (dpsi_dh)
            dpsi_dh[i] = thick ? -b / film * (b / psi[i]) : 0;
    }
    return FF_OK;
}

static ff_status shear(const void *self, size_t n, const double *p, const double *ln_eta,
                       const double *h, double u_s, double *tau)
{
    const law *l = self;
    (void)p; /* for laws with a limiting stress */
    for (size_t i = 0; i < n; i++) {
        double newtonian = fmin(exp(fmin(600, ln_eta[i])) / fmax(h[i], 1e-12), 1e300);
        tau[i] = l->tau0 * asinh(newtonian / l->tau0 * u_s);
    }
    return FF_OK;
}

static const ff_param params[] = {
    {.name = "tau0",
     .unit = "MPa",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .doc = "Eyring stress",
     .min = 1e-3,
     .max = 1e3,
     .low = 1,
     .high = 20},
};

static const ff_port outputs[] = {
    {.name = "rheology", .unit = "", .dims = "", .service = FF_RHEOLOGY_ID, .doc = "the law"},
};

static ff_status create(const ff_host *host, void **self)
{
    law *l = calloc(1, sizeof *l);
    if (!l)
        return ff_failf(host, FF_NOMEM, NULL, "out of memory");
    l->service = (ff_rheology){.size = sizeof l->service, .self = l, .flow = flow, .shear = shear};
    *self = l;
    return FF_OK;
}

/* The value is in SI units. */
static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    if (param == 0)
        ((law *)self)->tau0 = value->real;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    return output ? NULL : &((law *)self)->service;
}

/* Takes part where a file says rheology/auto: seconds for a million points, what it is good for. */
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
