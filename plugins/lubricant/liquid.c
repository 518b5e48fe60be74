/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "liquid.h"

#include "base-oil.h"

#include <math.h>
#include <stdlib.h>

/* How far from the one temperature of its data an oil still is at it, K. */
static const double SAME = 0.01;

/* A function of T: its value and slope. */
typedef double property(const lubricant_oil *oil, double T, double *slope);

static const lubricant_curve *table_of(const lubricant_oil *oil, int32_t what)
{
    const lubricant_curve *table = &oil->tables[what - FF_LIQUID_RHO0];
    return table->n ? table : NULL;
}

static double unknown(double *slope)
{
    return *slope = NAN;
}

static double constant(double value, double *slope)
{
    *slope = 0;
    return value;
}

static double density(const lubricant_oil *oil, double T, double *slope)
{
    const lubricant_curve *table = table_of(oil, FF_LIQUID_RHO0);
    if (table)
        return lubricant_curve_at(table, T, slope);
    if (!isnan(oil->expansion)) {
        double rho = oil->density_15 * exp(-oil->expansion * (T - 288.15));
        *slope = -oil->expansion * rho;
        return rho;
    }
    return lubricant_d1250_density(oil->density_15, T, slope);
}

static bool has_viscosity(const lubricant_oil *oil, double T)
{
    return oil->viscosity.n > 1 || fabs(T - oil->low) <= SAME;
}

/* Kinematic, m2/s. */
static double kinematic(const lubricant_oil *oil, double T, double *slope)
{
    double dy_dx, dnu_dy;
    double y = lubricant_curve_at(&oil->viscosity, log(T), &dy_dx);
    double nu = lubricant_d341_nu(y, &dnu_dy);
    *slope = oil->viscosity.n > 1 ? dnu_dy * dy_dx / T : NAN;
    return nu;
}

static double ln_eta0(const lubricant_oil *oil, double T, double *slope)
{
    double nu_slope, rho_slope;
    if (!has_viscosity(oil, T))
        return unknown(slope);
    double nu = kinematic(oil, T, &nu_slope), rho = density(oil, T, &rho_slope);
    *slope = nu_slope / nu + rho_slope / rho;
    return log(nu * rho);
}

static double conductivity(const lubricant_oil *oil, double T, double *slope)
{
    const lubricant_curve *table = table_of(oil, FF_LIQUID_CONDUCTIVITY);
    if (table)
        return lubricant_curve_at(table, T, slope);
    if (!isnan(oil->conductivity))
        return constant(oil->conductivity, slope);
    if (oil->base < 0)
        return unknown(slope);
    return lubricant_base_conductivity(oil->base, oil->density_15, T, slope);
}

static double heat_capacity(const lubricant_oil *oil, double T, double *slope)
{
    const lubricant_curve *table = table_of(oil, FF_LIQUID_HEAT_CAPACITY);
    if (table)
        return lubricant_curve_at(table, T, slope);
    if (!isnan(oil->heat_capacity))
        return constant(oil->heat_capacity, slope);
    if (oil->base < 0)
        return unknown(slope);
    return lubricant_base_heat_capacity(oil->base, oil->density_15, T, slope);
}

/* By the correlation of the base. */
static double correlated_alpha(const lubricant_oil *oil, double T, double *slope)
{
    double nu_slope, ln_slope, nu = kinematic(oil, T, &nu_slope), ln = ln_eta0(oil, T, &ln_slope);
    return lubricant_base_pressure_coefficient(oil->base, nu, ln, nu_slope, ln_slope, slope);
}

static double pressure_coefficient(const lubricant_oil *oil, double T, double *slope)
{
    const lubricant_curve *table = table_of(oil, FF_LIQUID_PRESSURE_COEFFICIENT);
    if (table)
        return lubricant_curve_at(table, T, slope);
    if (fabs(T - oil->alpha_at) <= SAME && isnan(oil->alpha_scale)) {
        *slope = NAN;
        return oil->alpha;
    }
    if (isnan(oil->alpha_scale) || !has_viscosity(oil, T))
        return unknown(slope);
    double alpha = correlated_alpha(oil, T, slope);
    *slope *= oil->alpha_scale;
    return oil->alpha_scale * alpha;
}

/* That which the oil runs at by itself, or the nearest to 40 degC of its data. */
static double reference_temperature(const lubricant_oil *oil, double T, double *slope)
{
    (void)T;
    double nearest = fmin(fmax(313.15, oil->low), oil->high);
    return constant(isnan(oil->temperature) ? nearest : oil->temperature, slope);
}

static property *const properties[LUBRICANT_PROPERTIES] = {
    [FF_LIQUID_LN_ETA0] = ln_eta0,
    [FF_LIQUID_RHO0] = density,
    [FF_LIQUID_CONDUCTIVITY] = conductivity,
    [FF_LIQUID_HEAT_CAPACITY] = heat_capacity,
    [FF_LIQUID_PRESSURE_COEFFICIENT] = pressure_coefficient,
    [FF_LIQUID_REFERENCE_TEMPERATURE] = reference_temperature,
};

/* Where ASTM D341 does not hold, all stays as it is where it still does. */
static double value_at(const lubricant_oil *oil, int32_t what, double T, double *slope)
{
    double inside = fmin(fmax(T, oil->coldest), oil->hottest);
    double value = properties[what](oil, inside, slope);
    if (inside < T || inside > T)
        *slope = isnan(value) ? NAN : 0;
    return value;
}

static ff_status eval(const void *self, int32_t what, size_t n, const double *T, double *value,
                      double *slope)
{
    const lubricant_oil *oil = self;
    ff_status status = FF_OK;
    if (what < 0 || what >= LUBRICANT_PROPERTIES)
        return FF_UNSUPPORTED;
    for (size_t i = 0; i < n; i++) {
        double ignored;
        bool run = T[i] <= oil->run_temperature && T[i] >= oil->run_temperature; /* no NaN is */
        double *to = slope ? &slope[i] : &ignored;
        value[i] = run ? oil->run_value[what] : value_at(oil, what, T[i], to);
        if (run)
            *to = oil->run_slope[what];
        if (T[i] < oil->low - SAME || T[i] > oil->high + SAME)
            status = FF_DOMAIN;
    }
    return status;
}

/* Temperatures between which the straight ends of the curve keep ASTM D341. */
static void find_limits(lubricant_oil *oil)
{
    const lubricant_curve *c = &oil->viscosity;
    double least = lubricant_d341_ordinate(LUBRICANT_D341_LEAST),
           most = lubricant_d341_ordinate(LUBRICANT_D341_MOST);
    size_t last = c->n - 1;
    oil->coldest = oil->low;
    oil->hottest = oil->high;
    if (last == 0) { /* the thermal data may reach further */
        oil->coldest = fmin(oil->low, 150);
        oil->hottest = fmax(oil->high, 700);
        return;
    }
    oil->coldest = fmax(150, exp(c->x[0] + (most - c->y[0]) / c->slope[0]));
    oil->hottest = fmin(700, exp(c->x[last] + (least - c->y[last]) / c->slope[last]));
}

static ff_status find_alpha(lubricant_oil *oil)
{
    double slope, alpha = 1;
    bool given = !isnan(oil->alpha);
    if (given && isnan(oil->alpha_at))
        return ff_failf(oil->host, FF_INVALID, "alpha_at",
                        "alpha needs the temperature that it holds at: alpha_at");
    if (!given && !isnan(oil->alpha_at))
        return ff_failf(oil->host, FF_INVALID, "alpha_at", "alpha_at stands without alpha");
    if (given && table_of(oil, FF_LIQUID_PRESSURE_COEFFICIENT))
        return ff_failf(oil->host, FF_INVALID, "alpha", "the table has a column alpha already");
    oil->alpha_scale = oil->base < 0 ? NAN : 1;
    if (given && oil->base >= 0 && has_viscosity(oil, oil->alpha_at)) {
        alpha = correlated_alpha(oil, oil->alpha_at, &slope);
        oil->alpha_scale = oil->alpha / alpha;
    } else if (given) {
        oil->alpha_scale = NAN;
    }
    return FF_OK;
}

void lubricant_keep_run(lubricant_oil *oil, double T)
{
    for (int32_t what = 0; what < LUBRICANT_PROPERTIES; what++)
        oil->run_value[what] = value_at(oil, what, T, &oil->run_slope[what]);
    oil->run_temperature = T;
}

double lubricant_density(const lubricant_oil *oil, double T)
{
    double slope;
    return density(oil, T, &slope);
}

ff_status lubricant_oil_ready(lubricant_oil *oil)
{
    const struct {
        double given;
        int32_t what;
        const char *name;
    } twice[] = {{oil->conductivity, FF_LIQUID_CONDUCTIVITY, "conductivity"},
                 {oil->heat_capacity, FF_LIQUID_HEAT_CAPACITY, "heat_capacity"}};
    for (size_t i = 0; i < sizeof twice / sizeof *twice; i++)
        if (!isnan(twice[i].given) && table_of(oil, twice[i].what))
            return ff_failf(oil->host, FF_INVALID, twice[i].name,
                            "the table has a column %s already", twice[i].name);
    oil->run_temperature = NAN;
    oil->service = (ff_liquid){.size = sizeof oil->service, .self = oil, .eval = eval};
    find_limits(oil);
    return find_alpha(oil);
}

ff_status lubricant_oil_ready_from(lubricant_oil *oil, double nu_40, double nu_100)
{
    if (nu_100 >= nu_40)
        return ff_failf(oil->host, FF_INVALID, "nu_100",
                        "nu_100 is %g cSt, but must be below the %g cSt at 40 degC", 1e6 * nu_100,
                        1e6 * nu_40);
    oil->viscosity_index = lubricant_viscosity_index(nu_40, nu_100);
    double x[2] = {log(313.15), log(373.15)};
    double y[2] = {lubricant_d341_ordinate(nu_40), lubricant_d341_ordinate(nu_100)};
    oil->low = 273.15;
    oil->high = 423.15;
    return lubricant_curve_make(&oil->viscosity, 2, x, y) ? lubricant_oil_ready(oil) : FF_NOMEM;
}

const void *lubricant_service(void *self, uint32_t output)
{
    const lubricant_oil *oil = self;
    return output == 0 ? &oil->service : NULL;
}

void lubricant_destroy(void *self)
{
    lubricant_oil *oil = self;
    if (oil) {
        lubricant_curve_free(&oil->viscosity);
        for (size_t i = 0; i < sizeof oil->tables / sizeof *oil->tables; i++)
            lubricant_curve_free(&oil->tables[i]);
    }
    free(oil);
}
