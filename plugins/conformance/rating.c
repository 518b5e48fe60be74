/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draft. Checks of a rating: how it varies with the quantities of its standard. */
#include "evaluation.h"
#include "offer.h"

#include <math.h>
#include <stdlib.h>

enum { MOST = 100000 };

/* Returns `safety` with one input multiplied by a factor; NaN: not available. */
static double safety_at(const ff_fixture *fixture, const char *input, double factor)
{
    conformance_evaluation run;
    if (!conformance_evaluate(&run, fixture, "safety"))
        return (double)NAN;
    conformance_array a = conformance_array_of(&run, input);
    double safety = conformance_scalar_of(&run, "safety");
    double *scaled =
        factor != 1 && a.data && a.count <= MOST ? malloc((a.count + 1) * sizeof *scaled) : NULL;
    for (size_t i = 0; scaled && i < a.count; i++)
        scaled[i] = factor * a.data[i];
    const size_t count = a.count;
    conformance_close(&run);
    if (factor == 1)
        return safety;
    safety = (double)NAN;
    if (scaled && count == 1)
        conformance_give_scalar(fixture, input, scaled[0]);
    else if (scaled)
        conformance_give_series(fixture, input, count, scaled);
    if (scaled && conformance_evaluate(&run, fixture, "safety")) {
        safety = conformance_scalar_of(&run, "safety");
        conformance_close(&run);
    }
    free(scaled);
    return safety;
}

/* Checks that half of the film, or 1.5 times the load or roughness, does not increase the safety.
   Restores each input afterwards. */
static void order(const ff_fixture *fixture)
{
    static const struct {
        const char *input;
        double factor;
        const char *what;
    } worse[] = {
        {"ehl.h_min", 0.5, "half of the film"},
        {"gear.roughness", 1.5, "rougher flanks"},
        {"operating.line_force", 1.5, "more load"},
    };
    if (!fixture->from_run) {
        const double film[] = {0.4e-6, 0.3e-6, 0.5e-6}, rough[] = {0.3e-6, 0.4e-6};
        conformance_give_series(fixture, "ehl.h_min", 3, film);
        conformance_give_series(fixture, "gear.roughness", 2, rough);
        conformance_give_scalar(fixture, "operating.line_force", 4000);
    }
    if (!conformance_offers(fixture, "safety")) {
        fixture->skip(fixture->ctx, NULL);
        return;
    }
    for (size_t i = 0; i < sizeof worse / sizeof *worse; i++) {
        const double before = safety_at(fixture, worse[i].input, 1),
                     after = safety_at(fixture, worse[i].input, worse[i].factor);
        if (isnan(before))
            return;
        if (after > before * (1 + 1e-9)) {
            ff_check_failf(fixture, "safety rises from %.6g to %.6g with %s", before, after,
                           worse[i].what);
            return;
        }
        safety_at(fixture, worse[i].input, 1 / worse[i].factor);
    }
}

static const ff_check checks[] = {
    {"order", "less film, rougher flanks and more load are never safer", order},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks)};

CONFORMANCE_MODEL("rating", "checks of a rating: it falls with load and roughness", "");
