/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of a density law: positive, not decreasing with pressure, and at ambient pressure equal
   to the density of the wired oil. */
#include "law-checks.h"
#include "law-data.h"
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

/* At p = 0 and at each temperature, the law must give the density of the wired oil, or rho0. */
static void ambient(const ff_fixture *fixture)
{
    if (conformance_is_oil(fixture, FF_DENSITY_ID, FF_LIQUID_RHO0, 1))
        conformance_is_as_set(fixture, FF_DENSITY_ID, "rho0", "850 kg/m3", 850, 1);
}

/* Liquids lose at most a third of their volume up to 1 GPa (Bridgman 1931: 20 to 30 %). */
static void compression(const ff_fixture *fixture)
{
    void *instance;
    fixture->serve(fixture->ctx, "oil", NULL);
    fixture->set(fixture->ctx, "rho0", "850 kg/m3");
    const ff_density *law = conformance_open_law(fixture, FF_DENSITY_ID, &instance);
    if (!law)
        return;
    double level = conformance_law_at(law->eval, law->self, 0, NULL, NULL),
           pressed = conformance_law_at(law->eval, law->self, 1e9, NULL, NULL);
    if (!(pressed <= 1.5 * level))
        ff_check_failf(fixture,
                       "rho is %.4g at p = 0 and %.4g at 1 GPa: no liquid becomes denser by "
                       "half",
                       level, pressed);
    fixture->close(fixture->ctx, instance);
}

static const ff_check checks[] = {
    CONFORMANCE_LAW_CHECKS,
    {"ambient", "equals its oil at ambient pressure, and decreases with temperature", ambient},
    {"compression", "is as compressible as a liquid", compression},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks),
                                          .service = FF_DENSITY_ID,
                                          .plain = &liquid};

CONFORMANCE_MODEL("density",
                  "checks of a density law: finite, pure, positive, not decreasing with pressure, "
                  "equal to the wired oil at ambient pressure",
                  "Bridgman 1931, The Physics of High Pressure");
