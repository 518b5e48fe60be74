/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an operating point owes: power that flows through the mesh. */
#include "look.h"
#include "offer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* f = z n, F = T/r_b. */
static void power(const ff_bench *bench)
{
    const double teeth[] = {24, 37}, radius[] = {0.03, 0.04625};
    look l;
    give_series(bench, "gear.teeth", 2, teeth);
    give_series(bench, "gear.base_radius", 2, radius);
    if (!look_open(&l, bench, NULL))
        return;
    double speed = look_scalar(&l, "speed"), mesh = look_scalar(&l, "mesh_frequency"),
           torque = look_scalar(&l, "torque"), force = look_scalar(&l, "line_force"),
           expected = speed * teeth[0] / (2 * pi);
    if (look_near(&l, "mesh_frequency", 0, mesh, expected, expected, 1e-9))
        look_near(&l, "line_force", 0, force, torque / radius[0], force, 1e-9);
    look_close(&l);
}

static const ff_check checks[] = {
    {"power", "mesh frequency and line force follow from speed and torque", power},
};

static const ff_conformance asks = {.size = sizeof asks, .checks = FF_TABLE(checks)};

static const void *service(void *self, uint32_t output)
{
    (void)self, (void)output;
    return &asks;
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .id = "conformance/operating",
    .version = "1.0.0",
    .summary = "what an operating point keeps: speed and torque carried to the mesh",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .outputs = FF_TABLE(offer_outputs),
    .create = offer_create,
    .service = service,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
