/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Evaluates a liquid as a function of temperature, for laws and their callers. */
#ifndef NUMERICS_LIQUID_H
#define NUMERICS_LIQUID_H

#include <flankfilm/laws.h>

#include <math.h>
#include <string.h>

enum { NUMERICS_POINTS = 1024 }; /* largest number of points in one call below */

/* Returns the temperature at which a law is evaluated if its caller gives none. */
static inline double numerics_reference_temperature(const ff_liquid *liquid)
{
    double any = 0, T = NAN;
    if (liquid->eval(liquid->self, FF_LIQUID_REFERENCE_TEMPERATURE, 1, &any, &T, NULL) < 0 ||
        !isfinite(T))
        T = 313.15;
    return T;
}

/* Returns whether the liquid has the property at its reference temperature. */
static inline int numerics_is_known(const ff_liquid *liquid, int32_t property)
{
    double T = numerics_reference_temperature(liquid), value = NAN;
    return liquid->eval(liquid->self, property, 1, &T, &value, NULL) >= 0 && isfinite(value);
}

/* Returns whether all points have the same temperature, so that one evaluation of the liquid
   suffices. */
static inline int numerics_is_uniform(size_t n, const double *T)
{
    return !T || n < 2 || !memcmp(T, T + 1, (n - 1) * sizeof *T);
}

/* Returns the worse of two statuses: FF_DOMAIN is worse than FF_OK; of two errors, the first. */
static inline ff_status numerics_worse(ff_status a, ff_status b)
{
    return a == FF_OK || (a == FF_DOMAIN && b != FF_OK) ? b : a;
}

/* Evaluates a property and its slope at n <= NUMERICS_POINTS temperatures; equal temperatures are
   evaluated once. If T is NULL, evaluates at the reference temperature and returns FF_DOMAIN. An
   unknown value or slope is replaced by 0, with FF_DOMAIN, since a law must give finite numbers. If
   a liquid fails or gives infinite numbers, returns its status or FF_BUG, and all numbers are 0. */
static inline ff_status numerics_liquid_values(const ff_liquid *liquid, int32_t property, size_t n,
                                               const double *T, double *value, double *slope)
{
    double reference = T ? 0 : numerics_reference_temperature(liquid);
    size_t asked = numerics_is_uniform(n, T) && n > 1 ? 1 : n;
    int infinite = 0, unknown = !T;
    ff_status status =
        liquid->eval(liquid->self, property, asked, T ? T : &reference, value, slope);
    int told = status == FF_OK || status == FF_DOMAIN;
    for (size_t i = 0; i < asked; i++) {
        int known = told && !isnan(value[i]);
        infinite |= known && (isinf(value[i]) || isinf(slope[i]));
        unknown |= !known;
        value[i] = known ? value[i] : 0;
        slope[i] = known && !isnan(slope[i]) ? slope[i] : 0;
    }
    for (size_t i = asked; i < n; i++) {
        value[i] = value[0];
        slope[i] = slope[0];
    }
    if (infinite)
        memset(value, 0, n * sizeof *value), memset(slope, 0, n * sizeof *slope);
    if (infinite || (!told && status != FF_UNSUPPORTED))
        return infinite ? FF_BUG : status;
    return unknown ? FF_DOMAIN : status;
}

#endif
