/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outputs: the properties of an oil at the temperature of the run. */
#include "liquid.h"

#include "standards.h"

#include <math.h>

static const double ZERO = 273.15; /* 0 degC in K */

const ff_port lubricant_inputs[1] = {{.name = "operating.oil_temperature",
                                      .unit = "K",
                                      .doc = "temperature of the oil in the inlet",
                                      .dims = "",
                                      .flags = FF_OPTIONAL,
                                      .from = "operating"}};

enum { OUT_OIL, OUT_TEMPERATURE, OUT_VALUES };

/* Rows from OUT_VALUES on are in the order of the properties; the thermal expansion is last. */
const ff_port lubricant_outputs[8] = {
    {.name = "oil",
     .unit = "",
     .doc = "the oil as a function of temperature",
     .dims = "",
     .service = FF_LIQUID_ID},
    {.name = "temperature", .unit = "K", .doc = "temperature of the oil in the inlet", .dims = ""},
    {.name = "eta0",
     .unit = "Pa s",
     .doc = "viscosity at ambient pressure",
     .dims = "",
     .max = INFINITY},
    {.name = "rho0",
     .unit = "kg/m3",
     .doc = "density at ambient pressure",
     .dims = "",
     .max = INFINITY},
    {.name = "conductivity",
     .unit = "W/(m K)",
     .doc = "thermal conductivity",
     .dims = "",
     .max = INFINITY},
    {.name = "heat_capacity",
     .unit = "J/(kg K)",
     .doc = "specific heat",
     .dims = "",
     .max = INFINITY},
    {.name = "alpha",
     .unit = "1/Pa",
     .doc = "pressure coefficient dln(eta)/dp at ambient pressure",
     .dims = ""},
    {.name = "expansion",
     .unit = "1/K",
     .doc = "thermal expansion coefficient, -drho0/dT over "
            "rho0",
     .dims = ""},
};

static ff_status find_temperature(const lubricant_oil *oil, const ff_array *in, double *T)
{
    const ff_host *host = oil->host;
    bool wired = in && in->data, given = !isnan(oil->temperature);
    if (wired && given && fabs(in->data[0] - oil->temperature) > 1e-6)
        return ff_failf(host, FF_INVALID, "temperature",
                        "the oil temperature is given twice: here %g degC, and as oil_temperature "
                        "of the operating stage, %g degC; leave it out here",
                        oil->temperature - ZERO, in->data[0] - ZERO);
    if (!wired && !given)
        return ff_failf(host, FF_INVALID, "temperature",
                        "the temperature of the oil is missing: give oil_temperature to an "
                        "operating stage, or temperature here");
    *T = wired ? in->data[0] : oil->temperature;
    if (!(*T >= oil->coldest && *T <= oil->hottest))
        return ff_failf(host, FF_INVALID, wired ? "operating.oil_temperature" : "temperature",
                        "the viscosity of this oil is not known at %g degC: ASTM D341 covers %.0f "
                        "to %.0f degC",
                        *T - ZERO, oil->coldest - ZERO, oil->hottest - ZERO);
    return FF_OK;
}

static ff_status put(const lubricant_oil *oil, uint32_t output, double T)
{
    static const char *const missing[] = {
        [FF_LIQUID_LN_ETA0] = "its viscosity is known at one temperature only",
        [FF_LIQUID_CONDUCTIVITY] = "neither conductivity nor a base oil with known conductivity is "
                                   "given",
        [FF_LIQUID_HEAT_CAPACITY] = "neither heat_capacity nor a base oil with known heat capacity "
                                    "is given",
        [FF_LIQUID_PRESSURE_COEFFICIENT] = "neither a base oil, nor alpha at this temperature, is "
                                           "given"};
    double value, slope;
    bool expansion = output == OUT_VALUES + FF_LIQUID_PRESSURE_COEFFICIENT + 1;
    int32_t what = expansion ? FF_LIQUID_RHO0 : (int32_t)(output - OUT_VALUES);
    oil->service.eval(oil, what, 1, &T, &value, &slope);
    if (isnan(value))
        return ff_failf(oil->host, what == FF_LIQUID_LN_ETA0 ? FF_INVALID : FF_UNSUPPORTED,
                        lubricant_outputs[output].name,
                        "%s of this oil is not known at %g degC: %s",
                        lubricant_outputs[output].name, T - ZERO, missing[what]);
    if (what == FF_LIQUID_LN_ETA0)
        value = exp(value);
    return ff_put_scalar(oil->host, output, expansion ? 0 - slope / value : value);
}

static void judge(const lubricant_oil *oil, double T)
{
    double beyond = fmax(0, fmax(oil->low - T, T - oil->high));
    char text[160];
    snprintf(
        text, sizeof text,
        "distance of the oil temperature from the range of the data, %.0f to %.0f degC, in K; the "
        "viscosity is extrapolated",
        oil->low - ZERO, oil->high - ZERO);
    oil->host->quality(oil->host->ctx, "extrapolation", beyond, 0, beyond > 0 ? FF_RANGE : FF_GOOD,
                       beyond > 0 ? text : NULL);
    double index = oil->viscosity_index;
    if (index < LUBRICANT_LEAST_INDEX || index > LUBRICANT_MOST_INDEX)
        oil->host->quality(oil->host->ctx, "viscosity_index", index,
                           index < 0 ? LUBRICANT_LEAST_INDEX : LUBRICANT_MOST_INDEX, FF_RANGE,
                           "viscosity index by ASTM D2270 from the viscosities at 40 and 100 degC; "
                           "no oil has this value: check oil and unit of both viscosities");
}

ff_status lubricant_evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    lubricant_oil *oil = self;
    double T = 0;
    ff_status status = find_temperature(oil, in, &T);
    if (status == FF_OK)
        lubricant_keep_run(oil, T);
    if (status == FF_OK && wanted & FF_BIT(OUT_TEMPERATURE))
        status = ff_put_scalar(oil->host, OUT_TEMPERATURE, T);
    for (uint32_t i = OUT_VALUES; i < 8 && status == FF_OK; i++)
        if (wanted & FF_BIT(i))
            status = put(oil, i, T);
    if (status == FF_OK)
        judge(oil, T);
    return status;
}
