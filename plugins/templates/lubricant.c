/* @ID@: an oil whose properties vary exponentially or linearly with temperature. Write your data
   into `value_at`. */
#include <flankfilm/author.h>
#include <flankfilm/laws.h>

#include <math.h>

static const double reference = 313.15; /* K */

typedef struct {
    const ff_host *host;
    ff_liquid service;
    double eta0, thinning, rho0, expansion, alpha;
} oil;

static const ff_param params[] = {
    FF_QUANTITY("eta0", "mPa s", oil, eta0, FF_REQUIRED, NULL, NULL, 0.01, 1e6, 1, 1e4,
                "viscosity at 40 degC"),
    FF_QUANTITY("thinning", "1/K", oil, thinning, 0, "0.035 1/K", NULL, 0, 0.2, 0.01, 0.08,
                "-dln(eta0)/dT"),
    FF_QUANTITY("rho0", "kg/m3", oil, rho0, 0, "870 kg/m3", NULL, 100, 1e4, 600, 2000,
                "density at 40 degC"),
    FF_QUANTITY("expansion", "1/K", oil, expansion, 0, "7e-4 1/K", NULL, 0, 2e-3, 4e-4, 1e-3,
                "-drho0/dT over the density at 40 degC"),
    FF_QUANTITY("alpha", "1/GPa", oil, alpha, 0, "20 1/GPa", NULL, 0, 1000, 2, 50,
                "pressure coefficient"),
};

/* Returns a property, and NaN if the property is unknown. */
static double value_at(const oil *o, int32_t property, double T, double *slope)
{
    /* the temperature is clamped to the range of the data */
    double warm = fmin(fmax(T, 200), 600) - reference;
    int inside = T > 200 && T < 600;
    *slope = 0;
    switch (property) {
    case FF_LIQUID_LN_ETA0:
        *slope = inside ? -o->thinning : 0;
        return log(o->eta0) - o->thinning * warm;
    case FF_LIQUID_RHO0:
        *slope = inside ? -o->rho0 * o->expansion : 0;
        return o->rho0 * (1 - o->expansion * warm);
    case FF_LIQUID_PRESSURE_COEFFICIENT:
        return o->alpha;
    case FF_LIQUID_REFERENCE_TEMPERATURE:
        return reference;
    default: /* conductivity, heat capacity */
        *slope = NAN;
        return NAN;
    }
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

FF_SERVICE_MODEL(model, oil, "oil", FF_LIQUID_ID, "the oil as a function of temperature",
                 ((ff_liquid){sizeof(ff_liquid), NULL, eval}), .id = "@ID@", .version = "0.1.0",
                 .summary = "one line that says what the model is for", .reference = "",
                 .bibtex = "", .licence = "MIT", .params = FF_TABLE(params));
FF_EXPORT_MODELS(&model);
