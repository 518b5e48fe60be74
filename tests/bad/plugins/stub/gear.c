/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A pair of 25 and 40 teeth, base radii 40 and 64 mm. */
#define STUB_MORE .evaluate = evaluate, .params = FF_TABLE(params), .set = stub_set
#include "stub.h"

enum {
    ROLL,
    RADIUS_1,
    RADIUS_2,
    BASE,
    PITCH,
    TEETH,
    ANGLE,
    BASE_PITCH,
    RATIO,
    LENGTH,
    SAP,
    LPSTC,
    HPSTC,
    TIP,
    TIPS,
    CENTRES,
    INERTIA,
    MASS,
    YOUNG,
    POISSON,
    REDUCED
};

static const ff_param params[] = {{.name = "teeth",
                                   .unit = "1",
                                   .doc = "teeth of gear 1",
                                   .type = FF_REAL,
                                   .preset = "25",
                                   .min = 10,
                                   .max = 200,
                                   .low = 17,
                                   .high = 100},
                                  {.name = "module",
                                   .unit = "mm",
                                   .doc = "module",
                                   .type = FF_REAL,
                                   .preset = "3 mm",
                                   .min = 0.1,
                                   .max = 100},
                                  {.name = "pressure_angle",
                                   .unit = "deg",
                                   .doc = "of the rack",
                                   .type = FF_REAL,
                                   .preset = "20 deg",
                                   .min = 14,
                                   .max = 28}};

static const ff_port inputs[] = {
    {.name = "any.level", .unit = "m", .doc = "nothing", .dims = "", .flags = FF_OPTIONAL}};

static const ff_port outputs[] = {
    {.name = "roll_angle", .unit = "rad", .doc = "roll angle", .dims = "station"},
    {.name = "radius_1", .unit = "m", .doc = "radius", .dims = "station"},
    {.name = "radius_2", .unit = "m", .doc = "radius", .dims = "station"},
    {.name = "base_radius", .unit = "m", .doc = "radius", .dims = "gear"},
    {.name = "pitch_radius", .unit = "m", .doc = "radius", .dims = "gear"},
    {.name = "teeth", .unit = "1", .doc = "teeth", .dims = "gear"},
    {.name = "working_pressure_angle", .unit = "rad", .doc = "angle", .dims = ""},
    {.name = "base_pitch", .unit = "m", .doc = "pitch", .dims = ""},
    {.name = "contact_ratio", .unit = "1", .doc = "ratio", .dims = ""},
    {.name = "path_length", .unit = "m", .doc = "length", .dims = ""},
    {.name = "roll_sap", .unit = "rad", .doc = "roll angle", .dims = ""},
    {.name = "roll_lpstc", .unit = "rad", .doc = "roll angle", .dims = ""},
    {.name = "roll_hpstc", .unit = "rad", .doc = "roll angle", .dims = ""},
    {.name = "roll_tip", .unit = "rad", .doc = "roll angle", .dims = ""},
    {.name = "tip_radius", .unit = "m", .doc = "tip", .dims = "gear"},
    {.name = "centre_distance", .unit = "m", .doc = "centre distance", .dims = ""},
    {.name = "inertia", .unit = "kg m2", .doc = "inertia", .dims = "gear"},
    {.name = "equivalent_mass", .unit = "kg", .doc = "mass", .dims = ""},
    {.name = "elastic_modulus", .unit = "Pa", .doc = "E", .dims = "gear"},
    {.name = "poisson_ratio", .unit = "1", .doc = "nu", .dims = "gear"},
    {.name = "reduced_modulus", .unit = "Pa", .doc = "E'", .dims = ""},
};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    enum { STATIONS = 9 };
    const stub *s = self;
    const double angle = (is("wide-angle") ? 25 * pi / 180 : s->value[2]),
                 teeth[] = {s->value[0], s->value[0] + 15},
                 pitch[] = {s->value[1] * teeth[0] / 2, s->value[1] * teeth[1] / 2},
                 base[] = {pitch[0] * cos(angle), pitch[1] * cos(angle)}, cycle = 2 * pi / teeth[0],
                 tips[] = {pitch[0] + s->value[1], pitch[1] + s->value[1]},
                 tip = sqrt(tips[0] * tips[0] - base[0] * base[0]) / base[0],
                 sap = ((base[0] + base[1]) * tan(angle) -
                        sqrt(tips[1] * tips[1] - base[1] * base[1])) /
                       base[0] * off("long", 0.9),
                 ratio = (tip - sap) / cycle, inertia[] = {1e-3, 4e-3}, young[] = {206e9, 170e9},
                 poisson[] = {0.3, 0.28};
    double roll[STATIONS], r1[STATIONS], r2[STATIONS], line = (base[0] + base[1]) * tan(angle);
    (void)wanted, (void)in;
    for (int i = 0; i < STATIONS; i++) {
        roll[i] = sap + (tip - sap) * i / (STATIONS - 1);
        r1[i] = base[0] * roll[i] * off("curvature", 1.001);
        r2[i] = line - r1[i];
    }
    if (is("backwards"))
        roll[4] = roll[2];
    if (is("backwards"))
        r1[4] = r1[2], r2[4] = r2[2];
    put(s, ROLL, STATIONS, roll);
    put(s, RADIUS_1, STATIONS, r1);
    put(s, RADIUS_2, STATIONS, r2);
    put(s, BASE, 2, base);
    put(s, PITCH, 2, pitch);
    put(s, TEETH, 2, teeth);
    ff_put_scalar(s->host, ANGLE, angle);
    ff_put_scalar(s->host, BASE_PITCH, cycle * base[0]);
    ff_put_scalar(s->host, RATIO, ratio * off("ratio", 1.01));
    ff_put_scalar(s->host, LENGTH, ratio * cycle * base[0]);
    ff_put_scalar(s->host, SAP, sap);
    ff_put_scalar(s->host, LPSTC, tip - cycle);
    ff_put_scalar(s->host, HPSTC, sap + cycle);
    ff_put_scalar(s->host, TIP, tip);
    put(s, TIPS, 2, tips);
    ff_put_scalar(s->host, CENTRES, pitch[0] + pitch[1]);
    put(s, INERTIA, 2, inertia);
    put(s, YOUNG, 2, young);
    put(s, POISSON, 2, poisson);
    double compliance =
        (1 - poisson[0] * poisson[0]) / young[0] + (1 - poisson[1] * poisson[1]) / young[1];
    ff_put_scalar(s->host, REDUCED, off("modulus", 0.5) * 2 / compliance);
    return ff_put_scalar(s->host, MASS,
                         inertia[0] * inertia[1] * off("twin", 2) /
                             (inertia[0] * base[1] * base[1] + inertia[1] * base[0] * base[0]));
}

STUB_MODEL
