/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "law.h"

#include "../numerics/liquid.h"

#include <math.h>
#include <string.h>

/* eta0 = nu rho from the figures of a data sheet. */
static ff_status find_eta0(const ff_host *host, const viscosity_oil *oil, double *eta0)
{
    int64_t grade = oil->grade ? lubricant_grade_find(oil->grade) : -1;
    if (oil->grade && grade < 0)
        return ff_failf(host, FF_INVALID, "grade", "no grade \"%.40s\"; there is %s", oil->grade,
                        LUBRICANT_GRADES);
    double nu_40 = grade < 0 ? oil->nu_40 : lubricant_grade_nu_40(grade);
    double nu_100 = oil->nu_100;
    if (isnan(nu_100) && grade >= 0)
        nu_100 = lubricant_grade_nu_100(grade, oil->base);
    if (isnan(nu_100))
        return ff_failf(host, FF_INVALID, "nu_100", "nu_40 needs nu_100 beside it");
    if (nu_100 >= nu_40)
        return ff_failf(host, FF_INVALID, "nu_100",
                        "nu_100 is %g cSt, but must be below the %g cSt at 40 degC", 1e6 * nu_100,
                        1e6 * nu_40);
    if (isnan(oil->temperature))
        return ff_failf(host, FF_INVALID, "temperature",
                        "temperature is missing: a grade or nu_40 needs it to find eta0");
    double T = oil->temperature, slope;
    double density_15 =
        isnan(oil->density_15) ? lubricant_base_density_15(oil->base) : oil->density_15;
    *eta0 =
        lubricant_d341_between(nu_40, nu_100, T) * lubricant_d1250_density(density_15, T, &slope);
    if (!(*eta0 >= 1e-5 && *eta0 <= 1e6))
        return ff_failf(host, FF_INVALID, "temperature",
                        "ASTM D341 gives no usable viscosity at %g degC for %g cSt at 40 and "
                        "%g cSt at 100 degC",
                        T - 273.15, 1e6 * nu_40, 1e6 * nu_100);
    return FF_OK;
}

const ff_port viscosity_inputs[1] = {
    {.name = "oil",
     .unit = "",
     .doc = "the oil over temperature, in place of what here says which oil it is",
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

ff_status viscosity_oil_ready(const ff_host *host, viscosity_oil *oil, double auto_cap)
{
    double eta0 = oil->liquid ? 1 : oil->eta0;
    ff_status status = isnan(eta0) ? find_eta0(host, oil, &eta0) : FF_OK;
    if (status != FF_OK)
        return status;
    oil->ln_eta0 = log(eta0);
    if (isnan(oil->pressure_cap))
        oil->pressure_cap = auto_cap;
    return FF_OK;
}

ff_status viscosity_alpha_ready(const ff_host *host, const viscosity_oil *oil)
{
    if (!oil->liquid || numerics_is_known(oil->liquid, FF_LIQUID_PRESSURE_COEFFICIENT))
        return FF_OK;
    return ff_failf(host, FF_INVALID, "oil",
                    "the pressure coefficient of the oil is not known: give it alpha and alpha_at, "
                    "or a base oil");
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

ff_status viscosity_oil_end(const viscosity_oil *oil, size_t n, const double *p, const double *T,
                            double *ln_eta, double *dln_dT)
{
    double highest = 0;
    ff_status status = FF_OK;
    for (size_t i = 0; i < n; i++)
        highest = p[i] > highest ? p[i] : highest;
    if (oil->liquid)
        status = add_liquid(oil->liquid, n, T, ln_eta, dln_dT);
    else if (dln_dT)
        memset(dln_dT, 0, n * sizeof *dln_dT);
    return highest > oil->pressure_cap ? FF_DOMAIN : status;
}
