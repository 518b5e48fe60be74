/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the history of a contact owes: kinematics and the measures of Hertz. */
#include "evaluation.h"
#include "offer.h"

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
            ff_check_failf(fixture, "load_per_width is %g at point %zu: flanks do not pull",
                           load.data[i], i);
            good = false;
        }
        if (good && i && !(time.data[i] >= time.data[i - 1])) {
            ff_check_failf(fixture, "time falls at point %zu", i);
            good = false;
        }
    }
    conformance_close(&run);
}

/* 1/R = 1/r1 + 1/r2, b = sqrt(8 W R/(pi E')), p_H = 2 W/(pi b). */
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

static const ff_check checks[] = {
    {"kinematics", "speeds of rolling and sliding are those of the surfaces", kinematics},
    {"hertz", "radius, width and pressure are those of Hertz", hertz},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks)};

CONFORMANCE_MODEL("contact", "what a contact history keeps: kinematics and Hertz",
                  "Hertz 1881; Johnson 1985, Contact Mechanics");
