/* SPDX-License-Identifier: MIT */
/*
 * lubricant/vogel: an oil of which three viscosities were measured: ln eta = A + B/(T - T0) through
 * them (Vogel 1921), a density that falls in a straight line, and what else is known of it.
 *
 * From y_i = ln eta_i at T_1 < T_2 < T_3:  q = (y_1 - y_2)/(y_2 - y_3) (T_3 - T_2)/(T_2 - T_1),
 * T0 = (q T_1 - T_3)/(q - 1), and B, A from two of the points.
 */
#include <flankfilm/author.h>
#include <flankfilm/laws.h>

#include <math.h>

typedef struct oil {
    const ff_host *host;
    ff_liquid service;
    ff_reals temperature, viscosity;                                  /* K, Pa s */
    double rho15, expansion, alpha, thinning, conductivity, capacity; /* NaN: not known */
    double A, B, T0;
} oil;

static const ff_param params[] = {
    FF_LIST("temperature", "degC", oil, temperature, FF_REQUIRED | FF_INCREASING, NULL, NULL, -60,
            300, 0, 0, 3, 3, "where the viscosity was measured, the coldest first"),
    FF_LIST("viscosity", "mPa s", oil, viscosity, FF_REQUIRED | FF_MIN_OPEN, NULL, NULL, 0, 1e9, 0,
            0, 3, 3, "dynamic viscosity there"),
    FF_QUANTITY("density", "kg/m3", oil, rho15, 0, "870 kg/m3", NULL, 100, 1e4, 600, 2000,
                "at 15 degC"),
    FF_QUANTITY("expansion", "1/K", oil, expansion, 0, "7e-4 1/K", NULL, 0, 2e-3, 4e-4, 1e-3,
                "-d(density)/dT over the density at 15 degC"),
    FF_QUANTITY("alpha", "1/GPa", oil, alpha, 0, NULL, NULL, 0, 1000, 2, 50,
                "pressure coefficient at 40 degC; left out: the law has its own"),
    FF_QUANTITY("alpha_slope", "1/K", oil, thinning, 0, "0.006 1/K", NULL, 0, 0.1, 0, 0.02,
                "-dln(alpha)/dT"),
    FF_QUANTITY("conductivity", "W/(m K)", oil, conductivity, 0, NULL, NULL, 1e-3, 1e3, 0.05, 1,
                "thermal conductivity"),
    FF_QUANTITY("heat_capacity", "J/(kg K)", oil, capacity, 0, NULL, NULL, 1, 1e5, 1000, 5000,
                "specific heat"),
};

static const double COLD = 200, HOT = 600; /* K: kept beyond, where no oil is */

static ff_status ready(void *self)
{
    oil *o = self;
    const double *T = o->temperature.data, *eta = o->viscosity.data;
    double fall_1 = log(eta[0] / eta[1]), fall_2 = log(eta[1] / eta[2]);
    if (!(T[0] < T[1] && T[1] < T[2]))
        return ff_failf(o->host, FF_INVALID, "temperature", "three different ones are needed");
    if (!(fall_1 > 0 && fall_2 > 0))
        return ff_failf(o->host, FF_INVALID, "viscosity", "it must fall with temperature");
    double q = fall_1 / fall_2 * (T[2] - T[1]) / (T[1] - T[0]);
    o->T0 = (q * T[0] - T[2]) / (q - 1);
    if (!(q > 1 && o->T0 > 0 && o->T0 < COLD - 10))
        return ff_failf(o->host, FF_INVALID, "viscosity",
                        "no oil of Vogel's passes through these three: ln(viscosity) must level "
                        "off with temperature, with a pole between 0 K and %g K",
                        COLD - 10);
    o->B = fall_1 / (1 / (T[0] - o->T0) - 1 / (T[1] - o->T0));
    o->A = log(eta[0]) - o->B / (T[0] - o->T0);
    return FF_OK;
}

static double value_at(const oil *o, int32_t property, double temperature, double *slope)
{
    double T = fmax(COLD, fmin(HOT, temperature)), value = NAN;
    int inside = temperature > COLD && temperature < HOT;
    *slope = 0;
    switch (property) {
    case FF_LIQUID_LN_ETA0:
        *slope = -o->B / ((T - o->T0) * (T - o->T0));
        value = o->A + o->B / (T - o->T0);
        break;
    case FF_LIQUID_RHO0:
        *slope = -o->rho15 * o->expansion;
        value = o->rho15 * (1 - o->expansion * (T - 288.15));
        break;
    case FF_LIQUID_PRESSURE_COEFFICIENT:
        value = o->alpha * exp(-o->thinning * (T - 313.15));
        *slope = -o->thinning * value;
        break;
    case FF_LIQUID_CONDUCTIVITY:
        value = o->conductivity;
        break;
    case FF_LIQUID_HEAT_CAPACITY:
        value = o->capacity;
        break;
    case FF_LIQUID_REFERENCE_TEMPERATURE:
        value = 313.15;
        break;
    }
    *slope = isnan(value) ? NAN : inside ? *slope : 0;
    return value;
}

static ff_status eval(const void *self, int32_t property, size_t n, const double *T, double *value,
                      double *slope)
{
    if (property < FF_LIQUID_LN_ETA0 || property > FF_LIQUID_REFERENCE_TEMPERATURE)
        return FF_UNSUPPORTED;
    for (size_t i = 0; i < n; i++) {
        double by_T;
        value[i] = value_at(self, property, T[i], &by_T);
        if (slope)
            slope[i] = by_T;
    }
    return FF_OK;
}

FF_SERVICE_MODEL(model, oil, "oil", FF_LIQUID_ID, "the oil over temperature",
                 ((ff_liquid){sizeof(ff_liquid), NULL, eval}), .id = "lubricant/vogel",
                 .version = "1.0.0", .summary = "an oil of three measured viscosities",
                 .reference = "Vogel 1921, Phys. Z. 22, 645-646", .bibtex = "", .licence = "MIT",
                 .params = FF_TABLE(params), .ready = ready);
FF_EXPORT_MODELS(&model);
