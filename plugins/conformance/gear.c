/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a spur gear pair owes: the identities of involutes. */
#include "look.h"
#include "offer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* Radii of curvature r_b roll, which add up to the line of action between the base circles;
   base = working pitch radius times cos alpha_w; contact ratio = path over base pitch. */
static void involute(const ff_bench *bench)
{
    look l;
    if (!look_open(&l, bench, NULL))
        return;
    const double within = 1e-9;
    series roll = look_at(&l, "roll_angle"), r1 = look_at(&l, "radius_1"),
           r2 = look_at(&l, "radius_2"), base = look_at(&l, "base_radius"),
           pitch = look_at(&l, "pitch_radius"), teeth = look_at(&l, "teeth");
    double angle = look_scalar(&l, "working_pressure_angle"), p = look_scalar(&l, "base_pitch");
    if (!look_all(&l, "roll_angle radius_1 radius_2 base_radius pitch_radius teeth "
                      "working_pressure_angle base_pitch contact_ratio path_length")) {
        bench->untried(bench->ctx, NULL);
        return;
    }
    double line = (base.data[0] + base.data[1]) * tan(angle);
    bool good = true;
    for (int i = 0; i < 2 && good; i++)
        good = look_near(&l, "base_radius", (size_t)i, base.data[i], pitch.data[i] * cos(angle),
                         base.data[i], within) &&
               look_near(&l, "base_pitch of the gear", (size_t)i,
                         2 * pi * base.data[i] / teeth.data[i], p, p, within);
    good = good && look_near(&l, "contact_ratio", 0, look_scalar(&l, "contact_ratio"),
                             look_scalar(&l, "path_length") / p, 1, within);
    for (size_t i = 0; i < roll.count && good; i++)
        good =
            look_near(&l, "radius_1", i, r1.data[i], base.data[0] * roll.data[i], line, within) &&
            look_near(&l, "radius_1 + radius_2", i, r1.data[i] + r2.data[i], line, line, within);
    look_close(&l);
}

/* SAP <= LPSTC <= HPSTC <= tip; stations from SAP to tip; as long as the path of contact. */
static void path(const ff_bench *bench)
{
    look l;
    if (!look_open(&l, bench, NULL))
        return;
    static const char *const names[] = {"roll_sap", "roll_lpstc", "roll_hpstc", "roll_tip"};
    series roll = look_at(&l, "roll_angle"), base = look_at(&l, "base_radius");
    double sap = look_scalar(&l, names[0]), tip = look_scalar(&l, names[3]);
    bool good = roll.count > 1 && base.count == 2;
    if (!good)
        bench->untried(bench->ctx, NULL);
    for (int i = 1; i < 4 && good; i++)
        if (look_scalar(&l, names[i]) < look_scalar(&l, names[i - 1])) {
            ff_faultf(bench, "%s is %g rad, before %s at %g rad", names[i],
                      look_scalar(&l, names[i]), names[i - 1], look_scalar(&l, names[i - 1]));
            good = false;
        }
    for (size_t i = 1; i < roll.count && good; i++)
        if (roll.data[i] < roll.data[i - 1]) {
            ff_faultf(bench, "roll_angle falls at station %zu", i);
            good = false;
        }
    if (good && look_near(&l, "the first roll_angle", 0, roll.data[0], sap, tip, 1e-9) &&
        look_near(&l, "the last roll_angle", roll.count - 1, roll.data[roll.count - 1], tip, tip,
                  1e-9))
        look_near(&l, "path_length", 0, look_scalar(&l, "path_length"), base.data[0] * (tip - sap),
                  base.data[0] * tip, 1e-9);
    look_close(&l);
}

static const ff_check checks[] = {
    {"involute", "radii, pitches and contact ratio are those of involutes", involute},
    {"path", "the path of contact runs from SAP to the tip", path},
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
    .id = "conformance/gear",
    .version = "1.0.0",
    .summary = "what a gear pair keeps: the identities of involutes",
    .reference = "DIN 3960:1987",
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
