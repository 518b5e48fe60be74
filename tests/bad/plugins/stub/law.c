/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A density of 900 (1 + 0.2 p/GPa) kg/m3 or a Ree-Eyring film of 5 MPa, with the fault FAULT. */
#include "stub.h"

#include <flankfilm/density.h>
#include <flankfilm/rheology.h>

static ff_status rho(const void *self, size_t n, const double *p, const double *T, double *value,
                     double *by_p, double *by_T)
{
    (void)self, (void)T;
    for (size_t i = 0; i < n; i++) {
        int inside = p[i] > 0 && p[i] < 1e12;
        double at = fmin(fmax(p[i], 0), 1e12);
        double slope = is("falling") ? -180e-12 : is("slope") ? 180.2e-9 : 180e-9;
        value[i] = 900 + (is("falling") ? -180e-12 : 180e-9) * at - (is("negative") ? 1000 : 0);
        if (by_p)
            by_p[i] = inside ? slope : 0;
        if (by_T)
            by_T[i] = 0;
    }
    return FF_OK;
}

static const double tau0 = 5e6;

/* The rate over the stress, in place of its slope. */
static void secant(double ln_eta, double h, double u, double *psi, double *by_ln_eta, double *by_h)
{
    double s = fmin(u / h / tau0, 1e100), x = s * exp(fmin(fmax(ln_eta, -300), 200)),
           root = asinh(x), turn = root > 0 ? s / root / root * x / hypot(1, x) : 0;
    *psi = x > 1e-6 ? s / root : exp(-fmin(fmax(ln_eta, -300), 300));
    if (by_ln_eta)
        *by_ln_eta = x > 1e-6 ? -turn : -*psi;
    if (by_h)
        *by_h = x > 1e-6 ? -*psi / h + turn / h : 0;
}

/* psi = sqrt(1/eta^2 + (u_s/(tau0 h))^2) */
static ff_status flow(const void *self, size_t n, const double *ln_eta, const double *h, double u_s,
                      double *psi, double *by_ln_eta, double *by_h)
{
    (void)self;
    for (size_t i = 0; i < n; i++) {
        double inverse = exp(-fmin(fmax(ln_eta[i], -300), 300)),
               shear = fmin(u_s * u_s / (tau0 * tau0) / h[i] / h[i], 1e250) *
                       off("one-way", u_s > 0 ? 1 : 0) *
                       off("wide", 1e-12 / fmax(h[i] * h[i], 1e-40));
        psi[i] = sqrt(inverse * inverse + shear) * off("thick", 0.7);
        int flat = fabs(ln_eta[i]) > 300;
        if (by_ln_eta)
            by_ln_eta[i] = flat ? 0 : -inverse * inverse / psi[i] * off("thick", 0.49);
        if (by_h)
            by_h[i] =
                shear >= 1e250 ? 0 : -shear / psi[i] / h[i] * off("thick", 0.49) * off("wide", 2);
        if (is("secant") && u_s * u_s > 0 && h[i] > 1e-12)
            secant(ln_eta[i], h[i], fabs(u_s), &psi[i], by_ln_eta ? &by_ln_eta[i] : NULL,
                   by_h ? &by_h[i] : NULL);
    }
    return FF_OK;
}

static ff_status shear(const void *self, size_t n, const double *p, const double *ln_eta,
                       const double *h, double u_s, double *tau)
{
    (void)self, (void)p;
    for (size_t i = 0; i < n; i++) {
        double rate = fmin(fmax(u_s / h[i] / tau0, -1e200), 1e200);
        double x = rate * exp(fmin(ln_eta[i], 200));
        if (is("wide"))
            x *= 1e-6 / fmin(fmax(h[i], 1e-12), 1e-2);
        tau[i] = tau0 * off("wide", fmin(fmax(h[i], 1e-12), 1e-2) / 1e-6) * asinh(x) *
                 off("strong", 1.5) * off("peaked", 1 / (1 + 1e-3 * fabs(x))) *
                 (u_s < 0 ? off("lame", 0.9) : 1);
    }
    return FF_OK;
}

static const ff_density density = {sizeof density, NULL, rho};
static const ff_rheology rheology = {sizeof rheology, NULL, flow, shear};

static const void *service(void *self, uint32_t output)
{
    (void)self, (void)output;
    return !strcmp(KIND, "density") ? (const void *)&density : &rheology;
}

static ff_port outputs[] = {{.name = "law", .unit = "", .doc = "the law", .dims = ""}};

static ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .id = stub_id,
    .version = "1.0.0",
    .summary = "A law with a fault",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .outputs = FF_TABLE(outputs),
    .create = create,
    .service = service,
    .destroy = free,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    outputs[0].service = !strcmp(KIND, "density") ? FF_DENSITY_ID : FF_RHEOLOGY_ID;
    return &model;
}
