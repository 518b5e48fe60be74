/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of a spur gear pair: the identities of involutes. */
#include "evaluation.h"
#include "offer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* A radius of curvature is base radius times roll angle, and both radii sum to the length of the
   line of action between the base circles. The base radius is the working pitch radius times cos
   alpha_w. The contact ratio is the length of the path of contact over the base pitch. */
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

/* SAP <= LPSTC <= HPSTC <= tip; the stations run from SAP to tip and cover the path of contact. */
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
            ff_check_failf(fixture, "roll_angle decreases at station %zu", i);
            good = false;
        }
    if (good && conformance_near(&run, "the first roll_angle", 0, roll.data[0], sap, tip, 1e-9) &&
        conformance_near(&run, "the last roll_angle", roll.count - 1, roll.data[roll.count - 1],
                         tip, tip, 1e-9))
        conformance_near(&run, "path_length", 0, conformance_scalar_of(&run, "path_length"),
                         base.data[0] * (tip - sap), base.data[0] * tip, 1e-9);
    conformance_close(&run);
}

/* No flank extends beyond the tip circle, where R = sqrt(r_a^2 - r_b^2). */
static bool ends_at_tips(const conformance_evaluation *run)
{
    conformance_array base = conformance_array_of(run, "base_radius"),
                      tip = conformance_array_of(run, "tip_radius");
    if (tip.count != 2 || base.count != 2)
        return true;
    double line = (base.data[0] + base.data[1]) *
                  tan(conformance_scalar_of(run, "working_pressure_angle")),
           reached[] = {base.data[0] * conformance_scalar_of(run, "roll_tip"),
                        line - base.data[0] * conformance_scalar_of(run, "roll_sap")};
    for (int i = 0; i < 2; i++) {
        double most = sqrt(tip.data[i] * tip.data[i] - base.data[i] * base.data[i]);
        if (reached[i] > most * (1 + 1e-9))
            return ff_check_failf(run->fixture,
                                  "at %s the flank of gear %d has a radius of curvature of %.6g m, "
                                  "but at its tip_radius %g m it has only %.6g m",
                                  i ? "roll_sap" : "roll_tip", i + 1, reached[i], tip.data[i],
                                  most);
    }
    return true;
}

/* r_b = z m cos(alpha)/2; the centre distance is the sum of the pitch radii; 2/E' = sum (1 -
 * nu^2)/E; m = I1 I2/(I1 r_b2^2 + I2 r_b1^2). */
static void pair(const ff_fixture *fixture)
{
    const double module = 4e-3, angle = 22 * pi / 180, within = 1e-9;
    conformance_evaluation run;
    bool told = !fixture->from_run && fixture->set(fixture->ctx, "module", "4 mm") &&
                fixture->set(fixture->ctx, "pressure_angle", "22 deg");
    if (told)
        fixture->set(fixture->ctx, "teeth", "[27, 41]");
    if (!conformance_evaluate(&run, fixture, NULL))
        return;
    conformance_array base = conformance_array_of(&run, "base_radius"),
                      pitch = conformance_array_of(&run, "pitch_radius"),
                      teeth = conformance_array_of(&run, "teeth"),
                      inertia = conformance_array_of(&run, "inertia"),
                      young = conformance_array_of(&run, "elastic_modulus"),
                      poisson = conformance_array_of(&run, "poisson_ratio");
    bool good = base.count == 2 && pitch.count == 2 && teeth.count == 2;
    for (size_t i = 0; i < 2 && good && told; i++)
        good =
            conformance_near(&run, "base_radius, for a module of 4 mm and 22 deg,", i, base.data[i],
                             teeth.data[i] * module * cos(angle) / 2, base.data[i], within);
    good =
        good && ends_at_tips(&run) &&
        conformance_near(&run, "centre_distance", 0, conformance_scalar_of(&run, "centre_distance"),
                         pitch.data[0] + pitch.data[1], pitch.data[0], within);
    if (good && young.count == 2 && poisson.count == 2) {
        double sum = 0;
        for (int i = 0; i < 2; i++)
            sum += (1 - poisson.data[i] * poisson.data[i]) / young.data[i];
        good = conformance_near(&run, "reduced_modulus", 0,
                                conformance_scalar_of(&run, "reduced_modulus"), 2 / sum, 2 / sum,
                                within);
    }
    if (good && inertia.count == 2) {
        const double *I = inertia.data, *r = base.data;
        double mass = I[0] * I[1] / (I[0] * r[1] * r[1] + I[1] * r[0] * r[0]);
        conformance_near(&run, "equivalent_mass", 0, conformance_scalar_of(&run, "equivalent_mass"),
                         mass, mass, within);
    }
    conformance_close(&run);
}

static const ff_check checks[] = {
    {"involute", "radii, pitches and contact ratio agree with involutes", involute},
    {"path", "the path of contact runs from SAP to the tip", path},
    {"pair", "radii, centre distance, mass and modulus follow from the data of the pair", pair},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks)};

CONFORMANCE_MODEL("gear", "checks of a gear pair: the identities of involutes", "DIN 3960:1987");
