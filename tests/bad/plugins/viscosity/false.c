/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A viscosity law, ln eta = ln eta0 + alpha p, that is right but for the one fault that false_fault
   names. It is compiled once; each fault is an object of a few lines, false-fault.c. */
#include <flankfilm/author.h>
#include <flankfilm/viscosity.h>

#include <float.h>
#include <locale.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

extern const char false_fault[];
const ff_model *false_law(void);

typedef struct law {
    ff_viscosity service;
    const ff_host *host;
    double alpha;
} law;

static int is(const char *fault)
{
    return !strcmp(false_fault, fault);
}

static double shared_alpha, scratch[8192];
static volatile int calls, one = 1;

static void misbehave(const law *l, size_t n, const double *p)
{
    if (is("overrun") && n == 1)
        ((volatile char *)(uintptr_t)l)[sizeof *l + 8] = 1;
    if (is("print") && n == 257)
        puts("computing 257 points");
    if (is("exit") && n == 1)
        exit(0);
    if (is("crash") && n == 1)
        abort();
    if (is("crash-empty") && n == 0)
        abort();
    while (is("hang") && n == 1 && one)
        pause(); /* nobody pays for the time */
    if (is("input") && n)
        *(double *)(uintptr_t)p += 1;
}

/* What the fault makes of the value at a point. */
static double value(const law *l, double p)
{
    double ln_eta = -5 + (is("shared") ? shared_alpha : l->alpha) * p;
    if (is("nan") && p == 0)
        return NAN;
    if (is("overflow"))
        return log(exp(ln_eta));
    if (is("falling") && p > 2e9)
        return -5 + l->alpha * (4e9 - p);
    if (is("jump") && p >= 2e8)
        return ln_eta + 1;
    if (is("small-jump") && p >= 2e8)
        return ln_eta + 1e-4;
    if (is("counter"))
        return ln_eta * (1 + 4 * DBL_EPSILON * (double)(calls++ % 3));
    return ln_eta;
}

/* Steep, and with a kink, but without a fault. */
static double extra(double p, double *slope)
{
    const double middle = 2e8, width = 1e3;
    double rise = is("steep") ? tanh((p - middle) / width) : 0;
    *slope = is("steep") ? (1 - rise * rise) / width : is("kink") && p > middle ? 4e-9 : 0;
    return is("kink") ? fmax(p - middle, 0) * 4e-9 : rise;
}

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const law *l = self;
    double factor = is("derivative") ? 1.001 : 1;
    (void)T;
    misbehave(l, n, p);
    for (size_t i = 0; i < n; i++) {
        scratch[i] = p[i];
        double slope, more = extra(p[i], &slope);
        ln_eta[i] = value(l, is("thread") ? ((volatile double *)scratch)[i] : p[i]) + more;
        if (dln_dp)
            dln_dp[i] = (is("falling") && p[i] > 2e9 ? -l->alpha : factor * l->alpha) + slope;
        if (dln_dT)
            dln_dT[i] = is("temperature") ? 1e-6 : 0;
    }
    if (is("thread"))
        for (size_t i = 0; i < n; i++)
            ln_eta[i] = value(l, ((volatile double *)scratch)[i]);
    if (is("past") && n % 4)
        for (size_t i = n; i % 4; i++)
            ln_eta[i] = 0;
    if (is("optional") && !dln_dp && n)
        ln_eta[0] += 1e-9;
    if (is("single") && n == 1)
        ln_eta[0] += 1e-9;
    return is("status") ? FF_NOCONV : FF_OK;
}

static const ff_param params[] = {
    {.name = "alpha",
     .unit = "1/GPa",
     .doc = "pressure coefficient",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .max = 1000,
     .low = 2,
     .high = 50},
    {.name = "extra",
     .unit = "mm",
     .doc = "something more",
     .type = FF_REAL,
     .preset = "1 mm",
     .min = 0,
     .max = 10,
     .low = 0.1,
     .high = 5},
};
static ff_param strange[2];

static const ff_port outputs[] = {
    {.name = "viscosity", .unit = "", .doc = "the law", .dims = "", .service = FF_VISCOSITY_ID}};

static void stop(int number)
{
    _exit(number);
}

static ff_status create(const ff_host *host, void **self)
{
    law *l = calloc(1, sizeof *l);
    if (!l && !is("allocation"))
        return FF_NOMEM;
    l->service = (ff_viscosity){.size = sizeof l->service, .self = l, .eval = eval};
    l->host = host;
    *self = l;
    if (is("locale"))
        setlocale(LC_ALL, "C.UTF-8");
    if (is("signal"))
        signal(SIGTERM, stop);
    if (is("folder") && chdir("/") != 0)
        return FF_BUG;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    law *l = self;
    if (param == 0)
        l->alpha = shared_alpha = value->real;
    if (is("silent") && param == 0 && value->real > 30e-9)
        return FF_INVALID;
    if (is("limit") && param == 1 && value->real == 0)
        abort();
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    (void)output;
    if (is("size"))
        ((law *)self)->service.size = 0;
    return is("no-table") ? NULL : &((law *)self)->service;
}

static void destroy(void *self)
{
    if (is("destroy") && !((law *)self)->service.eval)
        return;
    if (!is("leak"))
        free(self);
}

static char id[80] = "viscosity/";

static ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .id = id,
    .version = "1.0.0",
    .summary = "A law with a fault",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .service = service,
    .destroy = destroy,
};

const ff_model *false_law(void)
{
    strncpy(id + 10, false_fault, sizeof id - 11);
    memcpy(strange, params, sizeof params);
    strange[1].preset = "8 mm";
    if (is("preset"))
        model.params = strange;
    if (is("self-size")) { /* four bytes more than create allocates */
        model.params = strange;
        model.abi_minor = 2;
        model.self_size = sizeof(law) + 4;
        strange[1].preset = "1 mm";
        strange[0].place = offsetof(law, alpha) + 1;
    }
    if (is("bibtex"))
        model.bibtex = "@article{Barus1893, author={Barus}";
    return &model;
}
