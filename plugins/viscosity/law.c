/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "law.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const ff_port viscosity_law_outputs[1] = {{.name = "viscosity",
                                           .unit = "",
                                           .doc = "the viscosity law",
                                           .dims = "",
                                           .service = FF_VISCOSITY_ID}};

ff_status viscosity_law_create(const ff_host *host, size_t size, double cost, viscosity_eval *eval,
                               void **self)
{
    viscosity_law *law = calloc(1, size);
    if (!law)
        return FF_NOMEM;
    law->service = (ff_viscosity){.size = sizeof law->service, .self = law, .eval = eval};
    law->host = host;
    law->cost = cost;
    law->grade = -1;
    *self = law;
    return FF_OK;
}

ff_status viscosity_law_set(viscosity_law *law, uint32_t param, const ff_value *value)
{
    switch (param) {
    case VISCOSITY_LAW_ETA0:
        law->eta0 = value->real;
        break;
    case VISCOSITY_LAW_GRADE:
        law->grade = viscosity_grade_find(value->text);
        if (law->grade < 0)
            return ff_failf(law->host, FF_INVALID, "grade", "no grade \"%.40s\"; there is %s",
                            value->text, VISCOSITY_GRADES);
        break;
    case VISCOSITY_LAW_NU_40:
        law->nu_40 = value->real;
        break;
    case VISCOSITY_LAW_NU_100:
        law->nu_100 = value->real;
        break;
    case VISCOSITY_LAW_DENSITY_15:
        law->density_15 = value->real;
        break;
    case VISCOSITY_LAW_BASE:
        law->base = value->integer;
        break;
    case VISCOSITY_LAW_TEMPERATURE:
        law->temperature = value->real;
        break;
    case VISCOSITY_LAW_PRESSURE_CAP:
        law->pressure_cap = value->text ? 0 : value->real;
        break;
    default:
        return FF_BUG;
    }
    return FF_OK;
}

/* eta0 = nu rho from the figures of a data sheet. */
static ff_status find_eta0(const viscosity_law *law, double *eta0)
{
    const ff_host *host = law->host;
    double nu_40 = law->grade < 0 ? law->nu_40 : viscosity_grade_nu_40(law->grade);
    double nu_100 = law->nu_100;
    if (nu_100 == 0 && law->grade >= 0)
        nu_100 = viscosity_grade_nu_100(law->grade, law->base);
    if (nu_100 == 0)
        return ff_failf(host, FF_INVALID, "nu_100", "nu_40 needs nu_100 beside it");
    if (nu_100 >= nu_40)
        return ff_failf(host, FF_INVALID, "nu_100",
                        "nu_100 is %g cSt, but must be below the %g cSt at 40 degC", 1e6 * nu_100,
                        1e6 * nu_40);
    if (law->temperature == 0)
        return ff_failf(host, FF_INVALID, "temperature",
                        "temperature is missing: a grade or nu_40 needs it to find eta0");
    double T = law->temperature;
    double density_15 =
        law->density_15 > 0 ? law->density_15 : viscosity_grade_density_15(law->base);
    *eta0 = viscosity_nu_at(nu_40, nu_100, T) * viscosity_density_at(density_15, T);
    if (!(*eta0 >= 1e-5 && *eta0 <= 1e6))
        return ff_failf(host, FF_INVALID, "temperature",
                        "ASTM D341 gives no usable viscosity at %g degC for %g cSt at 40 and "
                        "%g cSt at 100 degC",
                        T - 273.15, 1e6 * nu_40, 1e6 * nu_100);
    return FF_OK;
}

ff_status viscosity_law_ready(viscosity_law *law, double auto_cap)
{
    double eta0 = law->eta0;
    ff_status status = eta0 > 0 ? FF_OK : find_eta0(law, &eta0);
    if (status != FF_OK)
        return status;
    law->ln_eta0 = log(eta0);
    if (law->pressure_cap == 0)
        law->pressure_cap = auto_cap;
    return FF_OK;
}

ff_status viscosity_law_assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                               ff_assessment *assessment)
{
    const viscosity_law *law = self;
    (void)wanted;
    (void)accuracy;
    (void)in;
    return ff_assess_law(law->cost, "", assessment);
}

const void *viscosity_law_service(void *self, uint32_t output)
{
    const viscosity_law *law = self;
    return output == 0 ? &law->service : NULL;
}

void viscosity_law_destroy(void *self)
{
    free(self);
}

ff_status viscosity_law_end(const viscosity_law *law, size_t n, const double *p, double *dln_dT)
{
    double highest = 0;
    for (size_t i = 0; i < n; i++)
        highest = p[i] > highest ? p[i] : highest;
    if (dln_dT)
        memset(dln_dT, 0, n * sizeof *dln_dT);
    return highest > law->pressure_cap ? FF_DOMAIN : FF_OK;
}
