/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a viscosity law owes: it does not fall with pressure. */
#include "law-checks.h"
#include "offer.h"

#include <flankfilm/laws.h>

static ff_status viscosity(const void *table, size_t n, const double *const *in, double speed,
                           double *const *out)
{
    const ff_viscosity *law = table;
    (void)speed;
    return law->eval(law->self, n, in[0], in[1], out[0], out[1], out[2]);
}

const conformance_function conformance_functions[] = {
    {.service = FF_VISCOSITY_ID,
     .name = "eval",
     .size = sizeof(ff_viscosity),
     .axes = {&conformance_pressure, &conformance_temperature},
     .axis_count = 2,
     .results = {"ln_eta", "dln_dp", "dln_dT"},
     .by = {0, 0, 1},
     .result_count = 3,
     .speed_count = 1,
     .rising = true,
     .call = viscosity},
};
const size_t conformance_function_count =
    sizeof conformance_functions / sizeof conformance_functions[0];

static const double ln_eta = -4;
static const ff_viscosity oil = {sizeof oil, &ln_eta, conformance_constant_law};

static const ff_check checks[] = {CONFORMANCE_LAW_CHECKS};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks),
                                          .service = FF_VISCOSITY_ID,
                                          .plain = &oil};

CONFORMANCE_MODEL("viscosity",
                  "what a viscosity law keeps: finite, pure, never falling with pressure", "");
