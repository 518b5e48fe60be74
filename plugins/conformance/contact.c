/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of a contact history: kinematics and Hertz. */
#include "evaluation.h"
#include "offer.h"

#include <flankfilm/rows.h>

#include <math.h>

static const double pi = 3.14159265358979323846;

static void kinematics(const ff_fixture *fixture)
{
    conformance_evaluation run;
    if (!conformance_evaluate(&run, fixture, NULL))
        return;
    conformance_array time = conformance_array_of(&run, "time"),
                      u1 = conformance_array_of(&run, "speed_1"),
                      u2 = conformance_array_of(&run, "speed_2"),
                      ur = conformance_array_of(&run, "entrainment_speed"),
                      us = conformance_array_of(&run, "sliding_speed"),
                      slide = conformance_array_of(&run, "slide_roll_ratio"),
                      load = conformance_array_of(&run, "load_per_width");
    bool good = conformance_has_all(
        &run, "time speed_1 speed_2 entrainment_speed sliding_speed load_per_width");
    if (!good)
        fixture->skip(fixture->ctx, NULL);
    for (size_t i = 0; i < time.count && good; i++) {
        double size = fabs(u1.data[i]) + fabs(u2.data[i]);
        good = conformance_near(&run, "entrainment_speed", i, ur.data[i],
                                (u1.data[i] + u2.data[i]) / 2, size, 1e-9) &&
               conformance_near(&run, "sliding_speed", i, us.data[i], u1.data[i] - u2.data[i], size,
                                1e-9);
        if (good && slide.data && fabs(ur.data[i]) > 1e-6 * size)
            good = conformance_near(&run, "slide_roll_ratio", i, slide.data[i],
                                    us.data[i] / ur.data[i], size / fabs(ur.data[i]), 1e-9);
        if (good && !(load.data[i] >= 0)) {
            ff_check_failf(fixture,
                           "load_per_width is %g at point %zu: it is negative, but flanks "
                           "do not pull",
                           load.data[i], i);
            good = false;
        }
        if (good && i && !(time.data[i] >= time.data[i - 1])) {
            ff_check_failf(fixture, "time decreases at point %zu", i);
            good = false;
        }
    }
    conformance_close(&run);
}

/* Checks Hertz' line contact under the load per width W: 1/R = 1/r1 + 1/r2, half width b = sqrt(8 W
   R/(pi E')), pressure p_H = 2 W/(pi b). */
static void hertz(const ff_fixture *fixture)
{
    conformance_evaluation run;
    if (!conformance_evaluate(&run, fixture, NULL))
        return;
    conformance_array r1 = conformance_array_of(&run, "radius_1"),
                      r2 = conformance_array_of(&run, "radius_2"),
                      R = conformance_array_of(&run, "equivalent_radius"),
                      b = conformance_array_of(&run, "hertz_half_width"),
                      p = conformance_array_of(&run, "hertz_pressure"),
                      load = conformance_array_of(&run, "load_per_width");
    double modulus = conformance_scalar_of(&run, "reduced_modulus");
    bool good = R.data && b.data && p.data && load.data && modulus > 0;
    if (!good)
        fixture->skip(fixture->ctx, NULL);
    for (size_t i = 0; i < R.count && good; i++) {
        double width = sqrt(8 * load.data[i] * R.data[i] / (pi * modulus));
        if (r1.data && r2.data)
            good = conformance_near(&run, "equivalent_radius", i, R.data[i],
                                    r1.data[i] * r2.data[i] / (r1.data[i] + r2.data[i]),
                                    fabs(r1.data[i]) + fabs(r2.data[i]), 1e-9);
        good = good && conformance_near(&run, "hertz_half_width", i, b.data[i], width, width, 1e-9);
        if (good && width > 0)
            good = conformance_near(&run, "hertz_pressure", i, p.data[i],
                                    2 * load.data[i] / (pi * width), p.data[i], 1e-9);
    }
    conformance_close(&run);
}

/* A pair of 25 and 40 teeth, module 3 mm, 20 deg, 18 mm wide, at 150 rad/s. */
static void give_pair(const ff_fixture *fixture)
{
    enum { STATIONS = 41 };
    const double angle = 20 * pi / 180, teeth[] = {25, 40},
                 base[] = {0.0375 * cos(angle), 0.06 * cos(angle)},
                 line = (base[0] + base[1]) * tan(angle);
    double roll[STATIONS], r1[STATIONS], r2[STATIONS], force[STATIONS];
    for (int i = 0; i < STATIONS; i++) {
        roll[i] = 0.2 + 0.4 * i / (STATIONS - 1);
        r1[i] = base[0] * roll[i];
        r2[i] = line - r1[i];
        force[i] = 2500;
    }
    fixture->give(fixture->ctx, NULL, 0, NULL, NULL);
    conformance_give_series(fixture, "gear.roll_angle", STATIONS, roll);
    conformance_give_series(fixture, "gear.radius_1", STATIONS, r1);
    conformance_give_series(fixture, "gear.radius_2", STATIONS, r2);
    conformance_give_series(fixture, "gear.teeth", 2, teeth);
    conformance_give_scalar(fixture, "gear.face_width", 0.018);
    conformance_give_scalar(fixture, "gear.reduced_modulus", 210e9);
    conformance_give_scalar(fixture, "operating.speed", 150);
    conformance_give_series(fixture, "load.tooth_force", STATIONS, force);
}

/* Checks the kinematics of a tooth pair at the stations of the gear: roll angle = omega t, surface
   speeds u1 = omega R1 and u2 = omega z1/z2 R2, load per width = tooth force over face width. */
static void passage(const ff_fixture *fixture)
{
    conformance_evaluation run;
    if (ff_model_find_input(fixture->model, "load.tooth_force") < 0 ||
        ff_model_find_input(fixture->model, "gear.radius_1") < 0) {
        fixture->skip(fixture->ctx, NULL); /* the model does not describe a tooth pair */
        return;
    }
    give_pair(fixture);
    if (!conformance_evaluate(&run, fixture, NULL))
        return;
    conformance_array time = conformance_array_of(&run, "time"),
                      r1 = conformance_array_of(&run, "radius_1"),
                      r2 = conformance_array_of(&run, "radius_2"),
                      u1 = conformance_array_of(&run, "speed_1"),
                      u2 = conformance_array_of(&run, "speed_2"),
                      load = conformance_array_of(&run, "load_per_width");
    const double omega = 150, ratio = 25.0 / 40, base = 0.0375 * cos(20 * pi / 180), within = 1e-6;
    bool good =
        conformance_has_all(&run, "time radius_1 radius_2 speed_1 speed_2 load_per_width") &&
        conformance_near(&run, "reduced_modulus", 0, conformance_scalar_of(&run, "reduced_modulus"),
                         210e9, 210e9, within);
    for (size_t i = 0; i < time.count && good; i++)
        good =
            conformance_near(&run, "radius_1", i, r1.data[i],
                             base * (0.2 + omega * (time.data[i] - time.data[0])), base, within) &&
            conformance_near(&run, "speed_1", i, u1.data[i], omega * r1.data[i], omega * r1.data[i],
                             within) &&
            conformance_near(&run, "speed_2", i, u2.data[i], omega * ratio * r2.data[i],
                             omega * r2.data[i], within) &&
            (load.data[i] <= 0 || i + 1 == time.count || i == 0 ||
             conformance_near(&run, "load_per_width", i, load.data[i], 2500 / 0.018, 2500 / 0.018,
                              within));
    conformance_close(&run);
}

static const ff_check checks[] = {
    {"kinematics", "entrainment and sliding speed follow from the surface speeds", kinematics},
    {"hertz", "radius, half width and pressure agree with Hertz", hertz},
    {"passage", "speeds and load of a tooth pair follow from those of the gears", passage},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks)};

CONFORMANCE_MODEL("contact", "checks of a contact history: kinematics and Hertz",
                  "Hertz 1881; Johnson 1985, Contact Mechanics");
