/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A dry contact's pressure and Moes' film, which is level. */
#define STUB_MORE .wire = wire, .evaluate = evaluate
#include "stub.h"

#include <flankfilm/viscosity.h>

enum { POINTS = 801 };
enum { TIME, X, PRESSURE, FILM, H, H_ERROR, MASS };
enum { T, R, U1, U2, LOAD, MODULUS, OIL };

static const ff_port inputs[] = {
    {.name = "contact.time", .unit = "s", .doc = "time", .dims = "t"},
    {.name = "contact.equivalent_radius", .unit = "m", .doc = "R", .dims = "t"},
    {.name = "contact.speed_1", .unit = "m/s", .doc = "u1", .dims = "t"},
    {.name = "contact.speed_2", .unit = "m/s", .doc = "u2", .dims = "t"},
    {.name = "contact.load_per_width", .unit = "N/m", .doc = "w", .dims = "t"},
    {.name = "contact.reduced_modulus", .unit = "Pa", .doc = "E'", .dims = ""},
    {.name = "viscosity", .unit = "", .doc = "oil", .dims = "", .service = FF_VISCOSITY_ID},
};

static const ff_port outputs[] = {
    {.name = "time", .unit = "s", .doc = "time", .dims = "t"},
    {.name = "x", .unit = "m", .doc = "place", .dims = "x"},
    {.name = "pressure", .unit = "Pa", .doc = "p", .dims = "t x"},
    {.name = "film", .unit = "m", .doc = "h", .dims = "t x"},
    {.name = "h_central", .unit = "m", .doc = "h", .dims = "t"},
    {.name = "h_min_error", .unit = "m", .doc = "error", .dims = "t"},
#ifdef SOLVES
    {.name = "mass_error", .unit = "1", .doc = "error", .dims = "t"},
#endif
};

static const ff_viscosity *oil; /* one instance at a time */

static ff_status wire(void *self, uint32_t input, const void *service)
{
    (void)self;
    if (input == OIL)
        oil = service;
    return FF_OK;
}

/* Moes 2000 */
static double moes(double M, double L)
{
    double ri = 3 / M, ei = 2.621 * pow(M, -0.2), rp = 1.287 * pow(L, 2. / 3),
           ep = 1.311 * pow(M, -0.125) * pow(L, 0.75), s = (7 + 8 * exp(-2 * ei / ri)) / 5;
    double stiff = rp > 0 ? pow(pow(rp, -3.5) + pow(ep, -3.5), -2 * s / 7) : 0;
    return pow(pow(pow(ri, 7. / 3) + pow(ei, 7. / 3), 3 * s / 7) + stiff, 1 / s);
}

static double film(const ff_array *in, size_t i)
{
    double zero = 0, ln_eta, alpha, r = in[R].data[i], E = in[MODULUS].data[0];
    oil->eval(oil->self, 1, &zero, NULL, &ln_eta, &alpha, NULL);
    double two_u = exp(ln_eta) * (in[U1].data[i] + in[U2].data[i]) / (E * r);
    double M = in[LOAD].data[i] / (E * r) / sqrt(two_u), L = alpha * E * pow(two_u, 0.25);
    return moes(M, L) * r * sqrt(two_u) * off("thin", 0.9);
}

static int usable(const ff_array *in)
{
    int good = in[T].shape[0] > 0 && in[MODULUS].data[0] > 1e6 && in[MODULUS].data[0] < 1e20;
    for (size_t i = 0; i < in[T].shape[0] && good; i++)
        for (int k = R; k <= LOAD && good; k++)
            good = in[k].data[i] > 1e-6 && in[k].data[i] < 1e9;
    return good;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stub *s = self;
    size_t shape[] = {usable(in) ? in[T].shape[0] : 0, POINTS};
    double x[POINTS], widest = 0;
    (void)wanted;
    if (shape[0] == 0)
        return ff_failf(s->host, FF_INVALID, "contact.time", "no contact has such a history");
    double *p = s->host->output(s->host->ctx, PRESSURE, 2, shape),
           *h = s->host->output(s->host->ctx, FILM, 2, shape),
           *central = ff_put_series(s->host, H, shape[0]),
           *error = ff_put_series(s->host, H_ERROR, shape[0]);
    if (!p || !h || !central || !error)
        return FF_NOMEM;
    for (size_t i = 0; i < shape[0]; i++)
        widest =
            fmax(widest, sqrt(8 * in[LOAD].data[i] * in[R].data[i] / (pi * in[MODULUS].data[0])));
    for (size_t j = 0; j < POINTS; j++)
        x[j] = widest * (3 * (double)j / (POINTS - 1) - 1.5);
    for (size_t i = 0; i < shape[0]; i++) {
        double w = in[LOAD].data[i], b = sqrt(8 * w * in[R].data[i] / (pi * in[MODULUS].data[0]));
        central[i] = film(in, i);
        error[i] = 0.01 * central[i];
        for (size_t j = 0; j < POINTS; j++) {
            h[i * POINTS + j] = central[i];
            p[i * POINTS + j] =
                2 * w / (pi * b) * sqrt(fmax(0, 1 - x[j] * x[j] / (b * b))) * off("light", 0.98);
        }
    }
    put(s, TIME, shape[0], in[T].data);
    put(s, X, POINTS, x);
#ifdef SOLVES
    ff_put_series(s->host, MASS, shape[0]);
#endif
    return FF_OK;
}

STUB_MODEL
