/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a density law owes: positive, not falling with pressure. */
#include "law-checks.h"
#include "offer.h"

#include <flankfilm/laws.h>

static ff_status density(const void *table, size_t n, const double *const *in, double speed,
                         double *const *out)
{
    const ff_density *law = table;
    (void)speed;
    return law->eval(law->self, n, in[0], in[1], out[0], out[1], out[2]);
}

const conformance_function conformance_functions[] = {
    {.service = FF_DENSITY_ID,
     .name = "eval",
     .size = sizeof(ff_density),
     .axes = {&conformance_pressure, &conformance_temperature},
     .axis_count = 2,
     .results = {"rho", "drho_dp", "drho_dT"},
     .by = {0, 0, 1},
     .result_count = 3,
     .speed_count = 1,
     .positive = true,
     .rising = true,
     .call = density},
};
const size_t conformance_function_count =
    sizeof conformance_functions / sizeof conformance_functions[0];

static const double rho = 900;
static const ff_density liquid = {sizeof liquid, &rho, conformance_constant_law};

static const ff_check checks[] = {CONFORMANCE_LAW_CHECKS};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks),
                                          .service = FF_DENSITY_ID,
                                          .plain = &liquid};

CONFORMANCE_MODEL("density",
                  "what a density law keeps: finite, pure, positive, never falling with pressure",
                  "");
