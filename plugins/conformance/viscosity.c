/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of a viscosity law: it does not fall with pressure or rise with temperature, and equals
   its oil at ambient pressure. */
#include "law-checks.h"
#include "law-data.h"
#include "offer.h"

#include <flankfilm/laws.h>
#include <flankfilm/rows.h>

#include <math.h>

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

/* At p = 0 and at each temperature, the law must give the viscosity of the wired oil, or eta0. */
static void ambient(const ff_fixture *fixture)
{
    if (!conformance_is_oil(fixture, FF_VISCOSITY_ID, FF_LIQUID_LN_ETA0, 0.01))
        return;
    /* parameters that some laws require if there is no oil */
    static const char *const known[][2] = {
        {"alpha", "20 1/GPa"}, {"at", "40 degC"}, {"base", "paraffinic"}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        fixture->set(fixture->ctx, known[i][0], known[i][1]);
    conformance_is_as_set(fixture, FF_VISCOSITY_ID, "eta0", "0.05 Pa s", log(0.05), 0.01);
}

/* Returns alpha*, 1/alpha* = int eta0/eta dp, by Simpson's rule up to 3 GPa. */
static double star_of(const ff_viscosity *law)
{
    enum { STEPS = 3000 };
    const double step = 1e6, zero = conformance_law_at(law->eval, law->self, 0, NULL, NULL);
    double sum = 0;
    for (int i = 0; i <= STEPS; i++) {
        double weight = i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2;
        sum += weight * exp(zero - conformance_law_at(law->eval, law->self, i * step, NULL, NULL));
    }
    return 3 / (step * sum);
}

/* Checks that the slope at p = 0 or alpha* equals `alpha` to 15 %; a law may match neither
   definition exactly. */
static bool rises(const ff_fixture *fixture, const ff_viscosity *law, double alpha,
                  const char *whose)
{
    double slope, star = star_of(law);
    conformance_law_at(law->eval, law->self, 0, NULL, &slope);
    return fmin(fabs(slope / alpha - 1), fabs(star / alpha - 1)) <= 0.15 ||
           ff_check_failf(
               fixture,
               "dln_dp at p = 0 is %.4g 1/GPa and alpha* %.4g 1/GPa, but %s has %.4g 1/GPa",
               1e9 * slope, 1e9 * star, whose, 1e9 * alpha);
}

/* The alpha of a law is its slope at p = 0 or its alpha*; a law without an alpha uses that of the
   oil. */
static void coefficient(const ff_fixture *fixture)
{
    void *instance;
    if (ff_model_find_param(fixture->model, "alpha") < 0)
        return;
    if (fixture->serve(fixture->ctx, "oil", &conformance_oil)) {
        const ff_viscosity *wired = conformance_open_law(fixture, FF_VISCOSITY_ID, &instance);
        bool good = wired && rises(fixture, wired, 20e-9, "the wired oil");
        fixture->close(fixture->ctx, instance);
        fixture->serve(fixture->ctx, "oil", NULL);
        if (!good)
            return;
    }
    fixture->set(fixture->ctx, "alpha", "12 1/GPa");
    const ff_viscosity *law = conformance_open_law(fixture, FF_VISCOSITY_ID, &instance);
    if (law)
        rises(fixture, law, 12e-9, "its parameter alpha");
    fixture->close(fixture->ctx, instance);
}

static const ff_check checks[] = {
    CONFORMANCE_LAW_CHECKS,
    {"ambient", "equals its oil at ambient pressure, and decreases with temperature", ambient},
    {"coefficient",
     "rises with pressure according to its parameter alpha, or to the alpha of its "
     "oil",
     coefficient},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks),
                                          .service = FF_VISCOSITY_ID,
                                          .plain = &oil};

CONFORMANCE_MODEL(
    "viscosity",
    "checks of a viscosity law: finite, pure, not falling with pressure, equal to its oil", "");
