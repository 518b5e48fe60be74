/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "law.h"

#include "tension.h"

#include "../numerics/liquid.h"

#include <math.h>

enum { BLOCK = 256 };

const ff_port density_inputs[1] = {{.name = "oil",
                                    .unit = "",
                                    .doc = "the oil over temperature, in place of rho0",
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

/* rho is that of rho0 = 1. */
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

/* eval of a law that does not soften. */
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

/* Pressures p exp[decay (T - at)], and that factor. Returns whether T was outside the range of the
   softening, 150 to 700 K, beyond which the law stays as it is. */
static int soften(const density_softening *by, size_t n, const double *p, const double *T,
                  double same, double *scaled, double *factor)
{
    int outside = 0;
    for (size_t i = 0; i < n; i++) {
        double t = T ? T[i] : same, in = fmin(fmax(t, 150), 700);
        int known = i && (!T || (T[i] >= T[i - 1] && T[i] <= T[i - 1]));
        factor[i] = known ? factor[i - 1] : exp(by->decay * (in - by->at));
        scaled[i] = factor[i] * p[i];
        outside |= in < t || in > t;
    }
    return outside;
}

/* At n <= BLOCK points: rho/rho0 being a function of that pressure, it follows temperature by decay
   p drho_dp. */
static ff_status eval_soft(const void *law, const density_shape *shape, size_t n, const double *p,
                           const double *T, double *rho, double *drho_dp, double *drho_dT)
{
    double scaled[BLOCK], factor[BLOCK], by_p[BLOCK], decay = shape->softening.decay;
    const ff_liquid *liquid = ((const density_law *)law)->liquid;
    double same = liquid ? numerics_reference_temperature(liquid) : shape->softening.at;
    int outside = soften(&shape->softening, n, p, T, same, scaled, factor);
    ff_status status = eval_cold(law, shape, n, scaled, T, rho, by_p, drho_dT);
    for (size_t i = 0; i < n; i++) {
        double t = T ? T[i] : same;
        if (drho_dT && t >= 150 && t <= 700)
            drho_dT[i] += decay * scaled[i] * by_p[i];
        if (drho_dp)
            drho_dp[i] = factor[i] * by_p[i];
    }
    return status == FF_OK && outside ? FF_DOMAIN : status;
}

ff_status density_eval(const void *law, const density_shape *shape, size_t n, const double *p,
                       const double *T, double *rho, double *drho_dp, double *drho_dT)
{
    ff_status worst = FF_OK;
    if (!(shape->softening.decay < 0 || shape->softening.decay > 0))
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

ff_status density_softening_ready(const ff_host *host, density_softening *softening)
{
    int given = !isnan(softening->at), flat = softening->decay <= 0 && softening->decay >= 0;
    if (!given)
        softening->at = 313.15; /* of no effect */
    return given || flat ? FF_OK
                         : ff_failf(host, FF_INVALID, "at",
                                    "K0_decay needs the temperature that the other constants of "
                                    "the law hold at: at");
}
