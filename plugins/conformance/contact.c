/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the history of a contact owes: kinematics and the measures of Hertz. */
#include "look.h"
#include "offer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static void kinematics(const ff_bench *bench)
{
    look l;
    if (!look_open(&l, bench, NULL))
        return;
    series time = look_at(&l, "time"), u1 = look_at(&l, "speed_1"), u2 = look_at(&l, "speed_2"),
           ur = look_at(&l, "entrainment_speed"), us = look_at(&l, "sliding_speed"),
           slide = look_at(&l, "slide_roll_ratio"), load = look_at(&l, "load_per_width");
    bool good = look_all(&l, "time speed_1 speed_2 entrainment_speed sliding_speed load_per_width");
    if (!good)
        bench->untried(bench->ctx, NULL);
    for (size_t i = 0; i < time.count && good; i++) {
        double size = fabs(u1.data[i]) + fabs(u2.data[i]);
        good = look_near(&l, "entrainment_speed", i, ur.data[i], (u1.data[i] + u2.data[i]) / 2,
                         size, 1e-9) &&
               look_near(&l, "sliding_speed", i, us.data[i], u1.data[i] - u2.data[i], size, 1e-9);
        if (good && slide.data && fabs(ur.data[i]) > 1e-6 * size)
            good = look_near(&l, "slide_roll_ratio", i, slide.data[i], us.data[i] / ur.data[i],
                             size / fabs(ur.data[i]), 1e-9);
        if (good && !(load.data[i] >= 0)) {
            ff_faultf(bench, "load_per_width is %g at point %zu: flanks do not pull", load.data[i],
                      i);
            good = false;
        }
        if (good && i && !(time.data[i] >= time.data[i - 1])) {
            ff_faultf(bench, "time falls at point %zu", i);
            good = false;
        }
    }
    look_close(&l);
}

/* 1/R = 1/r1 + 1/r2, b = sqrt(8 W R/(pi E')), p_H = 2 W/(pi b). */
static void hertz(const ff_bench *bench)
{
    look l;
    if (!look_open(&l, bench, NULL))
        return;
    series r1 = look_at(&l, "radius_1"), r2 = look_at(&l, "radius_2"),
           R = look_at(&l, "equivalent_radius"), b = look_at(&l, "hertz_half_width"),
           p = look_at(&l, "hertz_pressure"), load = look_at(&l, "load_per_width");
    double modulus = look_scalar(&l, "reduced_modulus");
    bool good = R.data && b.data && p.data && load.data && modulus > 0;
    if (!good)
        bench->untried(bench->ctx, NULL);
    for (size_t i = 0; i < R.count && good; i++) {
        double width = sqrt(8 * load.data[i] * R.data[i] / (pi * modulus));
        if (r1.data && r2.data)
            good = look_near(&l, "equivalent_radius", i, R.data[i],
                             r1.data[i] * r2.data[i] / (r1.data[i] + r2.data[i]),
                             fabs(r1.data[i]) + fabs(r2.data[i]), 1e-9);
        good = good && look_near(&l, "hertz_half_width", i, b.data[i], width, width, 1e-9);
        if (good && width > 0)
            good = look_near(&l, "hertz_pressure", i, p.data[i], 2 * load.data[i] / (pi * width),
                             p.data[i], 1e-9);
    }
    look_close(&l);
}

static const ff_check checks[] = {
    {"kinematics", "speeds of rolling and sliding are those of the surfaces", kinematics},
    {"hertz", "radius, width and pressure are those of Hertz", hertz},
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
    .id = "conformance/contact",
    .version = "1.0.0",
    .summary = "what a contact history keeps: kinematics and Hertz",
    .reference = "Hertz 1881; Johnson 1985, Contact Mechanics",
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
