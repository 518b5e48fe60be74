/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A pair of 25 and 40 teeth, base radii 40 and 64 mm. */
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
    TIP
};

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
};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    enum { STATIONS = 9 };
    const stub *s = self;
    const double angle = 20 * pi / 180, base[] = {0.04, 0.064}, teeth[] = {25, 40},
                 pitch[] = {base[0] / cos(angle), base[1] / cos(angle)}, cycle = 2 * pi / 25,
                 sap = 0.2, tip = sap + 1.6 * cycle;
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
    ff_put_scalar(s->host, RATIO, 1.6 * off("ratio", 1.01));
    ff_put_scalar(s->host, LENGTH, 1.6 * cycle * base[0]);
    ff_put_scalar(s->host, SAP, sap);
    ff_put_scalar(s->host, LPSTC, sap + 0.6 * cycle);
    ff_put_scalar(s->host, HPSTC, sap + cycle);
    return ff_put_scalar(s->host, TIP, tip);
}

STUB_MODEL
