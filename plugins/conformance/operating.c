/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of an operating point: speed and torque at the mesh. */
#include "evaluation.h"
#include "offer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* Checks the mesh frequency f = z n and the line force F = T/r_b. */
static void power(const ff_fixture *fixture)
{
    const double teeth[] = {24, 37}, radius[] = {0.03, 0.04625};
    conformance_evaluation run;
    conformance_give_series(fixture, "gear.teeth", 2, teeth);
    conformance_give_series(fixture, "gear.base_radius", 2, radius);
    if (!conformance_evaluate(&run, fixture, NULL))
        return;
    double speed = conformance_scalar_of(&run, "speed"),
           mesh = conformance_scalar_of(&run, "mesh_frequency"),
           torque = conformance_scalar_of(&run, "torque"),
           force = conformance_scalar_of(&run, "line_force"),
           expected = speed * teeth[0] / (2 * pi);
    if (conformance_near(&run, "mesh_frequency", 0, mesh, expected, expected, 1e-9))
        conformance_near(&run, "line_force", 0, force, torque / radius[0], force, 1e-9);
    conformance_close(&run);
}

static const ff_check checks[] = {
    {"power", "mesh frequency and line force follow from speed and torque", power},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks)};

CONFORMANCE_MODEL("operating", "checks of an operating point: speed and torque at the mesh", "");
