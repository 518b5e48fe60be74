/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "law.h"

#include <math.h>
#include <string.h>

/* eta0 = nu rho from the figures of a data sheet. */
static ff_status find_eta0(const ff_host *host, const viscosity_oil *oil, double *eta0)
{
    int64_t grade = oil->grade ? viscosity_grade_find(oil->grade) : -1;
    if (oil->grade && grade < 0)
        return ff_failf(host, FF_INVALID, "grade", "no grade \"%.40s\"; there is %s", oil->grade,
                        VISCOSITY_GRADES);
    double nu_40 = grade < 0 ? oil->nu_40 : viscosity_grade_nu_40(grade);
    double nu_100 = oil->nu_100;
    if (isnan(nu_100) && grade >= 0)
        nu_100 = viscosity_grade_nu_100(grade, oil->base);
    if (isnan(nu_100))
        return ff_failf(host, FF_INVALID, "nu_100", "nu_40 needs nu_100 beside it");
    if (nu_100 >= nu_40)
        return ff_failf(host, FF_INVALID, "nu_100",
                        "nu_100 is %g cSt, but must be below the %g cSt at 40 degC", 1e6 * nu_100,
                        1e6 * nu_40);
    if (isnan(oil->temperature))
        return ff_failf(host, FF_INVALID, "temperature",
                        "temperature is missing: a grade or nu_40 needs it to find eta0");
    double T = oil->temperature;
    double density_15 =
        isnan(oil->density_15) ? viscosity_grade_density_15(oil->base) : oil->density_15;
    *eta0 = viscosity_nu_at(nu_40, nu_100, T) * viscosity_density_at(density_15, T);
    if (!(*eta0 >= 1e-5 && *eta0 <= 1e6))
        return ff_failf(host, FF_INVALID, "temperature",
                        "ASTM D341 gives no usable viscosity at %g degC for %g cSt at 40 and "
                        "%g cSt at 100 degC",
                        T - 273.15, 1e6 * nu_40, 1e6 * nu_100);
    return FF_OK;
}

ff_status viscosity_oil_ready(const ff_host *host, viscosity_oil *oil, double auto_cap)
{
    double eta0 = oil->eta0;
    ff_status status = isnan(eta0) ? find_eta0(host, oil, &eta0) : FF_OK;
    if (status != FF_OK)
        return status;
    oil->ln_eta0 = log(eta0);
    if (isnan(oil->pressure_cap))
        oil->pressure_cap = auto_cap;
    return FF_OK;
}

ff_status viscosity_oil_end(const viscosity_oil *oil, size_t n, const double *p, double *dln_dT)
{
    double highest = 0;
    for (size_t i = 0; i < n; i++)
        highest = p[i] > highest ? p[i] : highest;
    if (dln_dT)
        memset(dln_dT, 0, n * sizeof *dln_dT);
    return highest > oil->pressure_cap ? FF_DOMAIN : FF_OK;
}
