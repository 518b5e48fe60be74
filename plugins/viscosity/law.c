/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions shared by the viscosity laws: the oil, the pressure cap, and the slope over
   temperature. */
#include "law.h"

#include "../numerics/liquid.h"

#include <math.h>
#include <stdbool.h>

enum { BLOCK = 256 };

const ff_port viscosity_inputs[1] = {
    {.name = "oil",
     .unit = "",
     .doc = "the oil as a function of temperature, instead of eta0",
     .dims = "",
     .service = FF_LIQUID_ID,
     .flags = FF_OPTIONAL,
     .from = "lubricant"}};

ff_status viscosity_wire(void *self, uint32_t input, const void *service)
{
    (void)input;
    ((viscosity_law *)self)->oil.liquid = service;
    return FF_OK;
}

void viscosity_oil_ready(viscosity_oil *oil, double auto_cap)
{
    oil->ln_eta0 = oil->liquid ? 0 : log(oil->eta0);
    if (isnan(oil->pressure_cap))
        oil->pressure_cap = auto_cap;
}

ff_status viscosity_alpha_ready(const ff_host *host, const viscosity_oil *oil, const char *other)
{
    if (!oil->liquid)
        return ff_failf(host, FF_INVALID, "alpha",
                        "alpha%s is missing, and no oil is wired to give it", other);
    if (numerics_is_known(oil->liquid, FF_LIQUID_PRESSURE_COEFFICIENT))
        return FF_OK;
    return ff_failf(host, FF_INVALID, "alpha",
                    "alpha%s is missing, and the oil has no pressure coefficient; give alpha here, "
                    "or give alpha and alpha_at, or a base oil, to the oil stage",
                    other);
}

static ff_status add_liquid(const ff_liquid *liquid, size_t n, const double *T, double *ln_eta,
                            double *dln_dT)
{
    double ln_eta0[NUMERICS_POINTS], slope[NUMERICS_POINTS];
    ff_status worst = FF_OK;
    for (size_t from = 0; from < n; from += NUMERICS_POINTS) {
        size_t count = n - from < NUMERICS_POINTS ? n - from : NUMERICS_POINTS;
        ff_status status = numerics_liquid_values(liquid, FF_LIQUID_LN_ETA0, count,
                                                  T ? T + from : NULL, ln_eta0, slope);
        for (size_t i = 0; i < count; i++) {
            ln_eta[from + i] += ln_eta0[i];
            if (dln_dT)
                dln_dT[from + i] = slope[i];
        }
        worst = status != FF_OK ? status : worst;
    }
    return worst;
}

viscosity_ambient viscosity_oil_begin(const viscosity_oil *oil, size_t n, const double *T)
{
    viscosity_ambient ambient = {.ln_eta0 = oil->ln_eta0, .status = FF_OK};
    if (oil->liquid && n > 0) {
        ambient.varies = !numerics_is_uniform(n, T);
        if (!ambient.varies)
            ambient.status = numerics_liquid_values(oil->liquid, FF_LIQUID_LN_ETA0, 1, T,
                                                    &ambient.ln_eta0, &ambient.slope);
    }
    return ambient;
}

FF_SIMD
static int any_above(size_t n, const double *p, double limit)
{
    int64_t above = 0;
    for (size_t i = 0; i < n; i++)
        above |= p[i] > limit;
    return above != 0;
}

ff_status viscosity_oil_end(const viscosity_oil *oil, const viscosity_ambient *ambient, size_t n,
                            const double *p, const double *T, double *ln_eta, double *dln_dT)
{
    ff_status status = ambient->status;
    if (ambient->varies)
        status = add_liquid(oil->liquid, n, T, ln_eta, dln_dT);
    for (size_t i = 0; dln_dT && !ambient->varies && i < n; i++)
        dln_dT[i] = ambient->slope;
    return any_above(n, p, oil->pressure_cap) ? FF_DOMAIN : status;
}

void viscosity_points(viscosity_curve *curve, const void *law, double ln_eta0, size_t n,
                      const double *p, double *ln_eta, double *dln_dp)
{
    double unwanted[BLOCK];
    if (dln_dp)
        curve(law, ln_eta0, n, p, ln_eta, dln_dp);
    for (size_t from = 0; !dln_dp && from < n; from += BLOCK)
        curve(law, ln_eta0, n - from < BLOCK ? n - from : BLOCK, p + from, ln_eta + from, unwanted);
}

ff_status viscosity_eval(const viscosity_law *law, viscosity_curve *curve, size_t n,
                         const double *p, const double *T, double *ln_eta, double *dln_dp,
                         double *dln_dT)
{
    const viscosity_ambient ambient = viscosity_oil_begin(&law->oil, n, T);
    viscosity_points(curve, law, ambient.ln_eta0, n, p, ln_eta, dln_dp);
    return viscosity_oil_end(&law->oil, &ambient, n, p, T, ln_eta, dln_dT);
}

ff_status viscosity_at_ready(const ff_host *host, double *at, double slope, const char *name)
{
    bool given = !isnan(*at), flat = slope <= 0 && slope >= 0;
    if (!given)
        *at = 313.15; /* unused, since the slope is 0 */
    return given || flat ? FF_OK
                         : ff_failf(host, FF_INVALID, "at",
                                    "%s needs the temperature for which the other constants of the "
                                    "law are given: at",
                                    name);
}

double viscosity_one_temperature(const viscosity_law *law, double at, const double *T)
{
    if (T)
        return *T;
    return law->oil.liquid ? numerics_reference_temperature(law->oil.liquid) : at;
}

/* Evaluates n <= BLOCK points. */
static ff_status eval_rise_some(const viscosity_law *law, viscosity_rise *rise, size_t n,
                                const double *p, const double *T, double *ln_eta, double *dln_dp,
                                double *dln_dT)
{
    double by_p[BLOCK], by_T[BLOCK], ln_eta0[BLOCK], slope[BLOCK];
    const ff_liquid *liquid = law->oil.liquid;
    ff_status status = FF_OK;
    if (liquid)
        status = numerics_liquid_values(liquid, FF_LIQUID_LN_ETA0, n, T, ln_eta0, slope);
    bool outside = rise(law, n, p, T, ln_eta, dln_dp ? dln_dp : by_p, by_T);
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] += liquid ? ln_eta0[i] : law->oil.ln_eta0;
        if (dln_dT)
            dln_dT[i] = by_T[i] + (liquid ? slope[i] : 0);
    }
    return numerics_worse(status, outside ? FF_DOMAIN : FF_OK);
}

ff_status viscosity_eval_rise(const viscosity_law *law, viscosity_rise *rise, double at, size_t n,
                              const double *p, const double *T, double *ln_eta, double *dln_dp,
                              double *dln_dT)
{
    double same[BLOCK];
    ff_status worst = T || !law->oil.liquid ? FF_OK : FF_DOMAIN;
    for (size_t i = 0; !T && i < BLOCK && n; i++)
        same[i] = viscosity_one_temperature(law, at, NULL);
    for (size_t from = 0; from < n; from += BLOCK)
        worst = numerics_worse(worst, eval_rise_some(law, rise, n - from < BLOCK ? n - from : BLOCK,
                                                     p + from, T ? T + from : same, ln_eta + from,
                                                     dln_dp ? dln_dp + from : NULL,
                                                     dln_dT ? dln_dT + from : NULL));
    return worst;
}

ff_status viscosity_alpha_values(const viscosity_alpha *own, const ff_liquid *liquid, size_t n,
                                 const double *T, double *alpha, double *slope)
{
    if (isnan(own->alpha))
        return numerics_liquid_values(liquid, FF_LIQUID_PRESSURE_COEFFICIENT, n, T, alpha, slope);
    const double reference = liquid ? numerics_reference_temperature(liquid) : own->at;
    for (size_t i = 0; i < n; i++) {
        double t = T ? T[i] : reference, in = viscosity_temperature(t);
        alpha[i] = own->alpha * exp(own->slope * (in - own->at));
        slope[i] = in < t || in > t ? 0 : own->slope * alpha[i];
    }
    return FF_OK;
}
