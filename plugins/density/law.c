/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions shared by the density laws: the density of the oil, and the softening with
   temperature. */
#include "law.h"

#include "tension.h"

#include "../numerics/liquid.h"

#include <math.h>

enum { BLOCK = 256 };

const ff_port density_inputs[1] = {{.name = "oil",
                                    .unit = "",
                                    .doc = "the oil as a function of temperature, instead of rho0",
                                    .dims = "",
                                    .service = FF_LIQUID_ID,
                                    .flags = FF_OPTIONAL,
                                    .from = "lubricant"}};

ff_status density_wire(void *self, uint32_t input, const void *service)
{
    density_law *law = self;
    (void)input;
    law->liquid = service;
    law->rho0 = 1;
    return FF_OK;
}

density_ambient density_begin(const void *self, size_t n, const double *T)
{
    const density_law *law = self;
    density_ambient ambient = {.rho0 = law->rho0, .status = FF_OK};
    if (law->liquid && n > 0) {
        ambient.varies = !numerics_is_uniform(n, T);
        if (!ambient.varies)
            ambient.status = numerics_liquid_values(law->liquid, FF_LIQUID_RHO0, 1, T,
                                                    &ambient.rho0, &ambient.slope);
    }
    return ambient;
}

/* Multiplies rho, which was computed for rho0 = 1, by the density of the liquid. */
static ff_status multiply(const ff_liquid *liquid, size_t n, const double *T, double *rho,
                          double *drho_dp, double *drho_dT)
{
    double rho0[NUMERICS_POINTS], slope[NUMERICS_POINTS];
    ff_status worst = FF_OK;
    for (size_t from = 0; from < n; from += NUMERICS_POINTS) {
        size_t count = n - from < NUMERICS_POINTS ? n - from : NUMERICS_POINTS;
        ff_status status =
            numerics_liquid_values(liquid, FF_LIQUID_RHO0, count, T + from, rho0, slope);
        for (size_t i = 0; i < count; i++) {
            if (drho_dT)
                drho_dT[from + i] = slope[i] * rho[from + i];
            if (drho_dp)
                drho_dp[from + i] *= rho0[i];
            rho[from + i] *= rho0[i];
        }
        worst = status != FF_OK ? status : worst;
    }
    return worst;
}

ff_status density_end(const density_law *law, const density_ambient *ambient, ff_status status,
                      size_t n, const double *T, double *rho, double *drho_dp, double *drho_dT)
{
    ff_status of_liquid = ambient->status;
    if (ambient->varies)
        of_liquid = multiply(law->liquid, n, T, rho, drho_dp, drho_dT);
    for (size_t i = 0; drho_dT && !ambient->varies && i < n; i++)
        drho_dT[i] = ambient->slope / ambient->rho0 * rho[i];
    return of_liquid != FF_OK ? of_liquid : status;
}

FF_SIMD
static int any_outside(size_t n, const double *p, double low, double high)
{
    int64_t outside = 0;
    for (size_t i = 0; i < n; i++)
        outside |= (p[i] < low) | (p[i] > high);
    return outside != 0;
}

static void bend_tension(double rho0, double K0, size_t n, const double *p, double *rho,
                         double *drho_dp)
{
    for (size_t i = 0; i < n; i++) {
        if (!(p[i] < 0))
            continue;
        double y = 1 + p[i] / K0;
        rho[i] = rho0 * density_tension(y);
        if (drho_dp)
            drho_dp[i] = rho0 * density_tension_slope(y) / K0;
    }
}

/* `eval` for a law that does not soften with temperature. */
static ff_status eval_cold(const void *law, const density_shape *shape, size_t n, const double *p,
                           const double *T, double *rho, double *drho_dp, double *drho_dT)
{
    const density_ambient ambient = density_begin(law, n, T);
    double unwanted[BLOCK];
    if (drho_dp)
        shape->curve(law, ambient.rho0, n, p, rho, drho_dp);
    for (size_t from = 0; !drho_dp && from < n; from += BLOCK)
        shape->curve(law, ambient.rho0, n - from < BLOCK ? n - from : BLOCK, p + from, rho + from,
                     unwanted);
    int outside = any_outside(n, p, 0, shape->highest);
    if (outside) {
        bend_tension(ambient.rho0, shape->K0, n, p, rho, drho_dp);
        outside = any_outside(n, p, -shape->K0 / 2, shape->highest);
    }
    return density_end(law, &ambient, outside ? FF_DOMAIN : FF_OK, n, T, rho, drho_dp, drho_dT);
}

/* The thermal expansion of the oil at `at`, and the exponent of density_softening. */
typedef struct expansion {
    double rho0, exponent;
    int known;
} expansion;

static expansion expansion_at(const ff_liquid *liquid, const density_softening *by)
{
    expansion e = {0};
    double slope;
    numerics_liquid_values(liquid, FF_LIQUID_RHO0, 1, &by->at, &e.rho0, &slope);
    e.known = e.rho0 > 0 && slope < 0;
    e.exponent = e.known ? -by->decay * e.rho0 / slope : 1;
    return e;
}

/* For n <= BLOCK points, with rho and by_p for rho0 = 1 at `at`; `s` is (rho0(at)/rho0)^n of
   (6.26). Below ambient pressure density_tension keeps the density positive. */
static void scale(const density_shape *shape, double exponent, size_t n, const double *p,
                  const double *rho0, const double *slope, const double *s, double *rho,
                  double *by_p, double *by_T)
{
    for (size_t i = 0; i < n; i++) {
        double f = rho[i], to_p = by_p[i], of_T = 1;
        if (p[i] >= 0) {
            double e = pow(f, -exponent), z = s[i] + (1 - s[i]) * e,
                   root = f * pow(z, 1 / exponent);
            to_p *= root / f * s[i] / z;
            of_T = root * e / z;
            f = root;
        } else {
            double y = 1 + s[i] * p[i] / shape->K0, bend = density_tension_slope(y);
            f = density_tension(y);
            to_p = bend * s[i] / shape->K0;
            of_T = f - exponent * (y - 1) * bend;
        }
        rho[i] = rho0[i] * f;
        by_p[i] = rho0[i] * to_p;
        if (by_T)
            by_T[i] = slope[i] * of_T;
    }
}

/* Evaluates n <= BLOCK points. */
static ff_status eval_soft(const void *law, const density_shape *shape, size_t n, const double *p,
                           const double *T, double *rho, double *drho_dp, double *drho_dT)
{
    double rho0[BLOCK], slope[BLOCK], s[BLOCK], unwanted[BLOCK], lowest = 1;
    const ff_liquid *liquid = ((const density_law *)law)->liquid;
    const expansion e = expansion_at(liquid, &shape->softening);
    ff_status status = numerics_liquid_values(liquid, FF_LIQUID_RHO0, n, T, rho0, slope);
    for (size_t i = 0; i < n; i++) {
        int same = i && rho0[i] >= rho0[i - 1] && rho0[i] <= rho0[i - 1];
        s[i] = same ? s[i - 1] : e.known && rho0[i] > 0 ? pow(e.rho0 / rho0[i], e.exponent) : 1;
        lowest = fmin(lowest, s[i] * p[i] / shape->K0);
    }
    double *by_p = drho_dp ? drho_dp : unwanted;
    shape->curve(law, 1, n, p, rho, by_p);
    scale(shape, e.exponent, n, p, rho0, slope, s, rho, by_p, drho_dT);
    int outside = !e.known || lowest < -0.5 || any_outside(n, p, -HUGE_VAL, shape->highest);
    return status == FF_OK && outside ? FF_DOMAIN : status;
}

ff_status density_eval(const void *law, const density_shape *shape, size_t n, const double *p,
                       const double *T, double *rho, double *drho_dp, double *drho_dT)
{
    ff_status worst = FF_OK;
    if (!(shape->softening.decay > 0))
        return eval_cold(law, shape, n, p, T, rho, drho_dp, drho_dT);
    for (size_t from = 0; from < n; from += BLOCK) {
        size_t count = n - from < BLOCK ? n - from : BLOCK;
        ff_status status =
            eval_soft(law, shape, count, p + from, T ? T + from : NULL, rho + from,
                      drho_dp ? drho_dp + from : NULL, drho_dT ? drho_dT + from : NULL);
        worst = numerics_worse(worst, status);
    }
    return worst;
}

ff_status density_softening_ready(const void *self, density_softening *softening)
{
    const density_law *law = self;
    int given = !isnan(softening->at), flat = softening->decay <= 0;
    if (!given)
        softening->at = 313.15; /* `at` then has no effect */
    if (!flat && !law->liquid) {
        law->host->log(law->host->ctx, FF_LOG_WARNING,
                       "K0_decay has no effect without an oil, since it acts through the expansion "
                       "of the oil");
        softening->decay = 0;
        return FF_OK;
    }
    return given || flat ? FF_OK
                         : ff_failf(law->host, FF_INVALID, "at",
                                    "K0_decay needs the temperature for which the other constants "
                                    "of the law are given: at");
}
