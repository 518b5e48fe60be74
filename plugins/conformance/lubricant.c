/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draft. Checks of an oil: positive properties, and a viscosity that does not rise with
   temperature. */
#include "law-checks.h"
#include "law-data.h"
#include "offer.h"

#include <flankfilm/laws.h>

#include <math.h>

/* Returns whether the oil has a property; the property may be missing, or be known at one
   temperature only. */
static bool is_known(const ff_liquid *oil, int32_t what)
{
    const double T[2] = {313.15, 373.15};
    double value[2] = {NAN, NAN};
    oil->eval(oil->self, what, 2, T, value, NULL);
    return !isnan(value[0]) && !isnan(value[1]);
}

/* Evaluates a property; an unknown one is replaced by a constant. */
static ff_status property(const void *table, int32_t what, size_t n, const double *T, double sign,
                          double *const *out)
{
    const ff_liquid *oil = table;
    ff_status status = oil->eval(oil->self, what, n, T, out[0], out[1]);
    bool known = is_known(oil, what);
    for (size_t i = 0; i < n && status >= FF_OK; i++) {
        out[0][i] = known ? sign * out[0][i] : 1;
        if (out[1])
            out[1][i] = known ? sign * out[1][i] : 0;
    }
    return status;
}

static ff_status fluidity(const void *table, size_t n, const double *const *in, double speed,
                          double *const *out)
{
    (void)speed;
    return property(table, FF_LIQUID_LN_ETA0, n, in[0], -1, out);
}

static ff_status rho0(const void *table, size_t n, const double *const *in, double speed,
                      double *const *out)
{
    (void)speed;
    return property(table, FF_LIQUID_RHO0, n, in[0], 1, out);
}

static ff_status conductivity(const void *table, size_t n, const double *const *in, double speed,
                              double *const *out)
{
    (void)speed;
    return property(table, FF_LIQUID_CONDUCTIVITY, n, in[0], 1, out);
}

static ff_status heat_capacity(const void *table, size_t n, const double *const *in, double speed,
                               double *const *out)
{
    (void)speed;
    return property(table, FF_LIQUID_HEAT_CAPACITY, n, in[0], 1, out);
}

static ff_status pressure_coefficient(const void *table, size_t n, const double *const *in,
                                      double speed, double *const *out)
{
    (void)speed;
    return property(table, FF_LIQUID_PRESSURE_COEFFICIENT, n, in[0], 1, out);
}

static const double temperatures[] = {-1e30, 0, 1, 200, 300, 600, 1000, 1e30};
static const conformance_axis temperature = {.name = "T",
                                             .low = 280,
                                             .high = 420,
                                             .extremes = temperatures,
                                             .extreme_count =
                                                 sizeof temperatures / sizeof *temperatures};

#define PROPERTY(says, value, ...)                                                                 \
    {                                                                                              \
        .service = FF_LIQUID_ID, .size = sizeof(ff_liquid), .name = says, .axes = {&temperature},  \
        .axis_count = 1, .results = {value, "its slope"}, .by = {0, 0}, .result_count = 2,         \
        .speed_count = 1, __VA_ARGS__                                                              \
    }

const conformance_function conformance_functions[] = {
    PROPERTY("eval of the viscosity", "-ln_eta0", .rising = true, .call = fluidity),
    PROPERTY("eval of the density", "rho0", .positive = true, .call = rho0),
    PROPERTY("eval of the conductivity", "conductivity", .positive = true, .call = conductivity),
    PROPERTY("eval of the heat capacity", "heat_capacity", .positive = true, .call = heat_capacity),
    PROPERTY("eval of the pressure coefficient", "alpha", .positive = true,
             .call = pressure_coefficient),
};
const size_t conformance_function_count =
    sizeof conformance_functions / sizeof conformance_functions[0];

/* An oil that does not change with temperature and has no thermal data. */
static ff_status plain_eval(const void *self, int32_t what, size_t n, const double *T,
                            double *value, double *slope)
{
    static const double values[] = {[FF_LIQUID_LN_ETA0] = -4,
                                    [FF_LIQUID_RHO0] = 900,
                                    [FF_LIQUID_CONDUCTIVITY] = NAN,
                                    [FF_LIQUID_HEAT_CAPACITY] = NAN,
                                    [FF_LIQUID_PRESSURE_COEFFICIENT] = 2e-8,
                                    [FF_LIQUID_REFERENCE_TEMPERATURE] = 313.15};
    (void)self, (void)T;
    if (what < 0 || what > FF_LIQUID_REFERENCE_TEMPERATURE)
        return FF_UNSUPPORTED;
    for (size_t i = 0; i < n; i++) {
        value[i] = values[what];
        if (slope)
            slope[i] = isnan(value[i]) ? NAN : 0;
    }
    return FF_OK;
}

static const ff_liquid plain = {sizeof plain, NULL, plain_eval};

/* Returns a property; NaN: unknown. */
static double at(const ff_liquid *oil, int32_t what, double T)
{
    double value = NAN;
    oil->eval(oil->self, what, 1, &T, &value, NULL);
    return value;
}

/* Checks the oil against its data: an ISO VG grade must have its kinematic viscosity at 40 degC
   (ISO 3448), the pressure coefficient must equal alpha at the temperature alpha_at, and the
   density must not rise with temperature. */
static void data(const ff_fixture *fixture)
{
    void *instance;
    bool graded = !fixture->from_run && fixture->set(fixture->ctx, "grade", "ISO VG 100"),
         told = !fixture->from_run && fixture->set(fixture->ctx, "alpha", "12 1/GPa") &&
                fixture->set(fixture->ctx, "alpha_at", "50 degC");
    const ff_liquid *oil = conformance_open_law(fixture, FF_LIQUID_ID, &instance);
    if (!oil)
        return;
    double nu = exp(at(oil, FF_LIQUID_LN_ETA0, 313.15)) / at(oil, FF_LIQUID_RHO0, 313.15),
           alpha = at(oil, FF_LIQUID_PRESSURE_COEFFICIENT, 323.15),
           cool = at(oil, FF_LIQUID_RHO0, 300), warm = at(oil, FF_LIQUID_RHO0, 360);
    if (graded && !(fabs(nu - 1e-4) <= 1e-6))
        ff_check_failf(fixture,
                       "ISO VG 100 has eta0/rho0 = 100 mm2/s at 40 degC, but eta0/rho0 is "
                       "%.4g mm2/s",
                       1e6 * nu);
    else if (told && !(fabs(alpha - 12e-9) <= 1e-11))
        ff_check_failf(fixture, "alpha is %.4g 1/GPa at alpha_at, but must be 12 1/GPa",
                       1e9 * alpha);
    else if (warm > cool * (1 + 1e-9))
        ff_check_failf(fixture, "rho0 rises from %.4g kg/m3 at 300 K to %.4g kg/m3 at 360 K", cool,
                       warm);
    fixture->close(fixture->ctx, instance);
}

static const ff_check checks[] = {
    CONFORMANCE_LAW_CHECKS,
    {"data", "has the properties of its data, and expands with temperature", data},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks),
                                          .service = FF_LIQUID_ID,
                                          .plain = &plain};

CONFORMANCE_MODEL(
    "lubricant",
    "checks of an oil: finite, pure, positive, a viscosity that falls with temperature", "");
