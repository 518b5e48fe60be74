/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The service flankfilm.liquid/1: properties of an oil as functions of temperature. */
#include "liquid.h"

#include "base-oil.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <stdlib.h>

enum { BLOCK = 256 };

/* An oil known at one temperature only has its data within this distance of that temperature, K. */
static const double SAME = 0.01;

/* The slopes of an oil decrease to 0 between hottest - BEND and hottest + BEND, K. */
static const double BEND = 50;

/* A function of T: returns the value, and writes the slope. */
typedef double property(const lubricant_oil *oil, double T, double *slope);

static const lubricant_curve *table_of(const lubricant_oil *oil, int32_t what)
{
    const lubricant_curve *table = &oil->tables[what - FF_LIQUID_RHO0];
    return table->n ? table : NULL;
}

static double on_curve(const lubricant_curve *table, double T, double *slope)
{
    double value;
    lubricant_curve_values(table, 1, &T, &value, slope);
    return value;
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

/* Density of an oil without a table. */
FF_SIMD
static void expand(const lubricant_oil *oil, size_t n, const double *restrict T,
                   double *restrict rho, double *restrict slope)
{
    const double density_15 = oil->density_15, expansion = oil->expansion;
    for (size_t i = 0; i < n; i++) {
        rho[i] = density_15 * ff_exp(-expansion * (T[i] - 288.15));
        slope[i] = -expansion * rho[i];
    }
}

static void density(const lubricant_oil *oil, size_t n, const double *T, double *rho, double *slope)
{
    const lubricant_curve *table = table_of(oil, FF_LIQUID_RHO0);
    if (table)
        lubricant_curve_values(table, n, T, rho, slope);
    else if (!isnan(oil->expansion))
        expand(oil, n, T, rho, slope);
    else
        lubricant_d1250_density(oil->density_15, n, T, rho, slope);
}

static bool has_viscosity(const lubricant_oil *oil, double T)
{
    return oil->viscosity.n > 1 || fabs(T - oil->low) <= SAME;
}

FF_SIMD
static void take_log(size_t n, const double *restrict x, double *restrict ln)
{
    for (size_t i = 0; i < n; i++)
        ln[i] = ff_log(x[i]);
}

/* Converts slopes over ln(T) to slopes over T. */
FF_SIMD
static void by_temperature(size_t n, const double *restrict T, const double *restrict dy_dx,
                           double *restrict slope)
{
    for (size_t i = 0; i < n; i++)
        slope[i] = slope[i] * dy_dx[i] / T[i];
}

/* Kinematic viscosity at n <= BLOCK points, m2/s. */
static void kinematic(const lubricant_oil *oil, size_t n, const double *T, double *nu,
                      double *slope)
{
    double x[BLOCK], y[BLOCK], dy_dx[BLOCK];
    take_log(n, T, x);
    lubricant_curve_values(&oil->viscosity, n, x, y, dy_dx);
    lubricant_d341_nu(n, y, nu, slope);
    by_temperature(n, T, dy_dx, slope);
    for (size_t i = 0; i < n && oil->viscosity.n < 2; i++)
        slope[i] = NAN;
}

/* Multiplies n values by other values; the slopes of the latter are those of their logarithms. */
FF_SIMD
static void take_product(size_t n, double *restrict a, const double *restrict a_slope,
                         const double *restrict b, const double *restrict b_slope,
                         double *restrict slope)
{
    for (size_t i = 0; i < n; i++) {
        slope[i] = a_slope[i] / a[i] + b_slope[i] / b[i];
        a[i] *= b[i];
    }
}

/* ln(eta0) at n <= BLOCK points. */
static void ln_eta0(const lubricant_oil *oil, size_t n, const double *T, double *ln, double *slope)
{
    double nu_slope[BLOCK], rho[BLOCK], rho_slope[BLOCK], eta[BLOCK];
    kinematic(oil, n, T, eta, nu_slope);
    density(oil, n, T, rho, rho_slope);
    take_product(n, eta, nu_slope, rho, rho_slope, slope);
    take_log(n, eta, ln);
    for (size_t i = 0; i < n && oil->viscosity.n < 2; i++)
        if (!has_viscosity(oil, T[i]))
            ln[i] = unknown(&slope[i]);
}

static double conductivity(const lubricant_oil *oil, double T, double *slope)
{
    const lubricant_curve *table = table_of(oil, FF_LIQUID_CONDUCTIVITY);
    if (table)
        return on_curve(table, T, slope);
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
        return on_curve(table, T, slope);
    if (!isnan(oil->heat_capacity))
        return constant(oil->heat_capacity, slope);
    if (oil->base < 0)
        return unknown(slope);
    return lubricant_base_heat_capacity(oil->base, oil->density_15, T, slope);
}

/* Returns alpha by the correlation for the base oil. */
static double correlated_alpha(const lubricant_oil *oil, double T, double *slope)
{
    double nu, nu_slope, ln, ln_slope;
    kinematic(oil, 1, &T, &nu, &nu_slope);
    ln_eta0(oil, 1, &T, &ln, &ln_slope);
    return lubricant_base_pressure_coefficient(oil->base, nu, ln, nu_slope, ln_slope, slope);
}

static double pressure_coefficient(const lubricant_oil *oil, double T, double *slope)
{
    const lubricant_curve *table = table_of(oil, FF_LIQUID_PRESSURE_COEFFICIENT);
    if (table)
        return on_curve(table, T, slope);
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

/* Returns the reference temperature: the temperature of the run; without a run, the temperature of
   the oil's data nearest to 40 degC. */
static double reference_temperature(const lubricant_oil *oil, double T, double *slope)
{
    (void)T;
    double nearest = fmin(fmax(313.15, oil->low), oil->high);
    return constant(isnan(oil->temperature) ? nearest : oil->temperature, slope);
}

static double base_oil(const lubricant_oil *oil, double T, double *slope)
{
    (void)T;
    return oil->base < 0 ? unknown(slope) : constant(oil->base, slope);
}

static double base_coefficient(const lubricant_oil *oil, double T, double *slope)
{
    return oil->base < 0 ? unknown(slope) : lubricant_base_coefficient(oil->base, T, slope);
}

static double conductivity_number(const lubricant_oil *oil, size_t which, double *slope)
{
    const ff_reals *c = &oil->conductivity_pressure;
    return c->count == 0 ? unknown(slope) : constant(c->count > which ? c->data[which] : 0, slope);
}

static double conductivity_rise(const lubricant_oil *oil, double T, double *slope)
{
    (void)T;
    return conductivity_number(oil, 0, slope);
}

static double conductivity_bend(const lubricant_oil *oil, double T, double *slope)
{
    (void)T;
    return conductivity_number(oil, 1, slope);
}

/* Properties that are evaluated point by point. */
static property *const properties[LUBRICANT_PROPERTIES] = {
    [FF_LIQUID_CONDUCTIVITY] = conductivity,
    [FF_LIQUID_HEAT_CAPACITY] = heat_capacity,
    [FF_LIQUID_PRESSURE_COEFFICIENT] = pressure_coefficient,
    [FF_LIQUID_REFERENCE_TEMPERATURE] = reference_temperature,
    [FF_LIQUID_BASE] = base_oil,
    [FF_LIQUID_BASE_COEFFICIENT] = base_coefficient,
    [FF_LIQUID_CONDUCTIVITY_RISE] = conductivity_rise,
    [FF_LIQUID_CONDUCTIVITY_BEND] = conductivity_bend,
};

/* Clamps temperatures to the range of ASTM D341, and computes the slopes of the clamped
   temperatures over the given ones. Heated films reach the upper end of the range. The clamped
   temperature approaches this end on a parabola, since the heat of compression depends on the slope
   of the density, which must not jump. */
FF_SIMD
static void hold(const lubricant_oil *oil, size_t n, const double *restrict T,
                 double *restrict held, double *restrict by_T)
{
    const double coldest = oil->coldest, hottest = oil->hottest, bend = BEND;
    for (size_t i = 0; i < n; i++) {
        double above = T[i] > coldest ? T[i] : coldest, left = hottest + bend - above;
        double part = (left > 0 ? left : 0) / (2 * bend), rise = part < 1 ? part : 1;
        by_T[i] = T[i] < coldest ? 0 : rise;
        held[i] = part < 1 ? hottest - bend * part * part : above;
    }
}

/* Multiplies slopes by those of the clamped temperatures. */
FF_SIMD
static void hold_slopes(size_t n, const double *restrict by_T, const double *restrict value,
                        double *restrict slope)
{
    for (size_t i = 0; i < n; i++) {
        double level = value[i] - value[i]; /* 0, or NaN */
        double bent = by_T[i] > 0 ? by_T[i] * slope[i] : level;
        slope[i] = by_T[i] < 1 ? bent : slope[i];
    }
}

/* Evaluates a property at n <= BLOCK points. */
static void values_at(const lubricant_oil *oil, int32_t what, size_t n, const double *T,
                      double *value, double *slope)
{
    double held[BLOCK], by_T[BLOCK];
    hold(oil, n, T, held, by_T);
    if (what == FF_LIQUID_LN_ETA0)
        ln_eta0(oil, n, held, value, slope);
    else if (what == FF_LIQUID_RHO0)
        density(oil, n, held, value, slope);
    for (size_t i = 0; properties[what] && i < n; i++)
        value[i] = properties[what](oil, held[i], &slope[i]);
    hold_slopes(n, by_T, value, slope);
}

static ff_status eval(const void *self, int32_t what, size_t n, const double *T, double *value,
                      double *slope)
{
    const lubricant_oil *oil = self;
    double unwanted[BLOCK];
    ff_status status = FF_OK;
    if (what < 0 || what >= LUBRICANT_PROPERTIES)
        return FF_UNSUPPORTED;
    bool runs = n == 1 && *T <= oil->run_temperature && *T >= oil->run_temperature;
    if (runs) { /* false for NaN */
        *value = oil->run_value[what];
        *(slope ? slope : unwanted) = oil->run_slope[what];
    }
    for (size_t from = 0; from < n && !runs; from += BLOCK)
        values_at(oil, what, n - from < BLOCK ? n - from : BLOCK, T + from, value + from,
                  slope ? slope + from : unwanted);
    for (size_t i = 0; i < n; i++)
        if (T[i] < oil->low - SAME || T[i] > oil->high + SAME)
            status = FF_DOMAIN;
    return status;
}

/* Finds the temperature limits up to which the linear extrapolation of the curve is in the range of
   ASTM D341. */
static void find_limits(lubricant_oil *oil)
{
    const lubricant_curve *c = &oil->viscosity;
    double least = lubricant_d341_ordinate(LUBRICANT_D341_LEAST),
           most = lubricant_d341_ordinate(LUBRICANT_D341_MOST);
    size_t last = c->n - 1;
    oil->coldest = oil->low;
    oil->hottest = oil->high;
    if (last == 0) { /* the thermal data may cover a wider range */
        oil->coldest = fmin(oil->low, 150);
        oil->hottest = fmax(oil->high + BEND, 700);
        return;
    }
    oil->coldest = fmax(150, exp(c->x[0] + (most - c->y[0]) / c->slope[0]));
    oil->hottest = fmin(700, exp(c->x[last] + (least - c->y[last]) / c->slope[last]));
    /* so that the given data are returned unchanged */
    oil->hottest = fmax(oil->hottest, oil->high + BEND);
}

static ff_status find_alpha(lubricant_oil *oil)
{
    double slope, alpha = 1;
    bool given = !isnan(oil->alpha);
    if (given && isnan(oil->alpha_at))
        return ff_failf(oil->host, FF_INVALID, "alpha_at",
                        "alpha needs alpha_at, the temperature at which it is given");
    if (!given && !isnan(oil->alpha_at))
        return ff_failf(oil->host, FF_INVALID, "alpha_at", "alpha_at is given without alpha");
    if (given && table_of(oil, FF_LIQUID_PRESSURE_COEFFICIENT))
        return ff_failf(oil->host, FF_INVALID, "alpha", "the table already has a column alpha");
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
        values_at(oil, what, 1, &T, &oil->run_value[what], &oil->run_slope[what]);
    oil->run_temperature = T;
}

double lubricant_density(const lubricant_oil *oil, double T)
{
    double rho, slope;
    density(oil, 1, &T, &rho, &slope);
    return rho;
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
                            "the table already has a column %s", twice[i].name);
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
