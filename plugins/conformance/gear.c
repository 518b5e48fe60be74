/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a spur gear pair owes: the identities of involutes. */
#include "evaluation.h"
#include "offer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* Radii of curvature r_b roll, which add up to the line of action between the base circles;
   base = working pitch radius times cos alpha_w; contact ratio = path over base pitch. */
static void involute(const ff_fixture *fixture)
{
    conformance_evaluation run;
    if (!conformance_evaluate(&run, fixture, NULL))
        return;
    const double within = 1e-9;
    conformance_array roll = conformance_array_of(&run, "roll_angle"),
                      r1 = conformance_array_of(&run, "radius_1"),
                      r2 = conformance_array_of(&run, "radius_2"),
                      base = conformance_array_of(&run, "base_radius"),
                      pitch = conformance_array_of(&run, "pitch_radius"),
                      teeth = conformance_array_of(&run, "teeth");
    double angle = conformance_scalar_of(&run, "working_pressure_angle"),
           p = conformance_scalar_of(&run, "base_pitch");
    if (!conformance_has_all(&run, "roll_angle radius_1 radius_2 base_radius pitch_radius teeth "
                                   "working_pressure_angle base_pitch contact_ratio path_length")) {
        fixture->skip(fixture->ctx, NULL);
        return;
    }
    double line = (base.data[0] + base.data[1]) * tan(angle);
    bool good = true;
    for (int i = 0; i < 2 && good; i++)
        good = conformance_near(&run, "base_radius", (size_t)i, base.data[i],
                                pitch.data[i] * cos(angle), base.data[i], within) &&
               conformance_near(&run, "base_pitch of the gear", (size_t)i,
                                2 * pi * base.data[i] / teeth.data[i], p, p, within);
    good = good &&
           conformance_near(&run, "contact_ratio", 0, conformance_scalar_of(&run, "contact_ratio"),
                            conformance_scalar_of(&run, "path_length") / p, 1, within);
    for (size_t i = 0; i < roll.count && good; i++)
        good = conformance_near(&run, "radius_1", i, r1.data[i], base.data[0] * roll.data[i], line,
                                within) &&
               conformance_near(&run, "radius_1 + radius_2", i, r1.data[i] + r2.data[i], line, line,
                                within);
    conformance_close(&run);
}

/* SAP <= LPSTC <= HPSTC <= tip; stations from SAP to tip; as long as the path of contact. */
static void path(const ff_fixture *fixture)
{
    conformance_evaluation run;
    if (!conformance_evaluate(&run, fixture, NULL))
        return;
    static const char *const names[] = {"roll_sap", "roll_lpstc", "roll_hpstc", "roll_tip"};
    conformance_array roll = conformance_array_of(&run, "roll_angle"),
                      base = conformance_array_of(&run, "base_radius");
    double sap = conformance_scalar_of(&run, names[0]), tip = conformance_scalar_of(&run, names[3]);
    bool good = roll.count > 1 && base.count == 2;
    if (!good)
        fixture->skip(fixture->ctx, NULL);
    for (int i = 1; i < 4 && good; i++)
        if (conformance_scalar_of(&run, names[i]) < conformance_scalar_of(&run, names[i - 1])) {
            ff_check_failf(fixture, "%s is %g rad, before %s at %g rad", names[i],
                           conformance_scalar_of(&run, names[i]), names[i - 1],
                           conformance_scalar_of(&run, names[i - 1]));
            good = false;
        }
    for (size_t i = 1; i < roll.count && good; i++)
        if (roll.data[i] < roll.data[i - 1]) {
            ff_check_failf(fixture, "roll_angle falls at station %zu", i);
            good = false;
        }
    if (good && conformance_near(&run, "the first roll_angle", 0, roll.data[0], sap, tip, 1e-9) &&
        conformance_near(&run, "the last roll_angle", roll.count - 1, roll.data[roll.count - 1],
                         tip, tip, 1e-9))
        conformance_near(&run, "path_length", 0, conformance_scalar_of(&run, "path_length"),
                         base.data[0] * (tip - sap), base.data[0] * tip, 1e-9);
    conformance_close(&run);
}

static const ff_check checks[] = {
    {"involute", "radii, pitches and contact ratio are those of involutes", involute},
    {"path", "the path of contact runs from SAP to the tip", path},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks)};

CONFORMANCE_MODEL("gear", "what a gear pair keeps: the identities of involutes", "DIN 3960:1987");
