/* SPDX-License-Identifier: GPL-3.0-or-later */
/* lubricant/grade: a typical oil of an ISO viscosity grade. */
#include "base-oil.h"
#include "liquid.h"

#include <math.h>

static const ff_param params[] = {
    FF_PHRASE_LIKE(LUBRICANT_GRADE_NAMES, "grade", lubricant_oil, grade, FF_REQUIRED, NULL, NULL,
                   "ISO 3448 viscosity grade, such as ISO VG 220; the number is the kinematic "
                   "viscosity at 40 degC in cSt"),
    FF_ONE_OF(LUBRICANT_BASES, "base", lubricant_oil, base, 0, "mineral",
              "base oil: viscosity index (95, 150, 150, 200), density at 15 degC (890, 850, 975, "
              "1050 kg/m3), pressure coefficient and thermal data of a typical oil"),
    FF_QUANTITY("nu_100", "cSt", lubricant_oil, nu_100, 0, NULL, NULL, 0.5, 1e4, 1, 500,
                "kinematic viscosity at 100 degC, instead of the typical value of the base oil"),
    FF_QUANTITY("density_15", "kg/m3", lubricant_oil, density_15, 0, NULL, NULL, 500, 2500, 800,
                1164,
                "density at 15 degC, instead of the typical density of the base oil; it decreases "
                "with temperature by ASTM D1250"),
    LUBRICANT_ROWS,
};

static ff_status ready(void *self)
{
    lubricant_oil *oil = self;
    oil->expansion = NAN;
    int64_t rank = oil->grade ? lubricant_grade_find(oil->grade) : -1;
    if (rank < 0)
        return ff_failf(oil->host, FF_INVALID, "grade", "no grade \"%.40s\"; the grades are %s",
                        oil->grade ? oil->grade : "", LUBRICANT_GRADES);
    double nu_40 = lubricant_grade_nu_40(rank);
    double nu_100 = isnan(oil->nu_100) ? lubricant_grade_nu_100(rank, oil->base) : oil->nu_100;
    if (isnan(oil->density_15))
        oil->density_15 = lubricant_base_density_15(oil->base);
    return lubricant_oil_ready_from(oil, nu_40, nu_100);
}

FF_MODEL(
    lubricant_grade, lubricant_oil, .id = "lubricant/grade", .version = "1.0.0",
    .summary = "a typical oil of an ISO viscosity grade and base oil, as a function of temperature",
    .reference = LUBRICANT_REFERENCE, .bibtex = LUBRICANT_BIBTEX, .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params), .inputs = FF_TABLE(lubricant_inputs),
    .outputs = FF_TABLE(lubricant_outputs), .ready = ready, .evaluate = lubricant_evaluate,
    .service = lubricant_service, .destroy = lubricant_destroy);
