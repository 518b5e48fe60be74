/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A contact between cylinders of 10 and 20 mm. */
#define STUB_MORE .evaluate = evaluate
#include "stub.h"

static const ff_port inputs[] = {
    {.name = "any.level", .unit = "m", .doc = "nothing", .dims = "", .flags = FF_OPTIONAL}};

enum { TIME, R1, R2, R, U1, U2, UR, US, LOAD, WIDTH, PRESSURE, MODULUS, SERIES = 11 };

static const ff_port outputs[] = {
    {.name = "time", .unit = "s", .doc = "time", .dims = "t"},
    {.name = "radius_1", .unit = "m", .doc = "radius", .dims = "t"},
    {.name = "radius_2", .unit = "m", .doc = "radius", .dims = "t"},
    {.name = "equivalent_radius", .unit = "m", .doc = "radius", .dims = "t"},
    {.name = "speed_1", .unit = "m/s", .doc = "speed", .dims = "t"},
    {.name = "speed_2", .unit = "m/s", .doc = "speed", .dims = "t"},
    {.name = "entrainment_speed", .unit = "m/s", .doc = "speed", .dims = "t"},
    {.name = "sliding_speed", .unit = "m/s", .doc = "speed", .dims = "t"},
    {.name = "load_per_width", .unit = "N/m", .doc = "load", .dims = "t"},
    {.name = "hertz_half_width", .unit = "m", .doc = "width", .dims = "t"},
    {.name = "hertz_pressure", .unit = "Pa", .doc = "pressure", .dims = "t"},
    {.name = "reduced_modulus", .unit = "Pa", .doc = "E'", .dims = ""},
};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const double modulus = 226e9, r = 1 / (1 / 0.01 + 1 / 0.02);
    const stub *s = self;
    (void)wanted, (void)in;
    double row[SERIES][3];
    for (int i = 0; i < 3; i++) {
        double load = i == 1 ? 1e5 * off("pulling", -1) : 2e5, u1 = 4, u2 = 3 + i;
        double width = sqrt(8 * fabs(load) * r / (pi * modulus)) * off("hertz", 1 / sqrt(2));
        const double values[SERIES] = {1e-3 * i,
                                       0.01,
                                       0.02,
                                       r,
                                       u1,
                                       u2,
                                       is("entrainment") ? u1 + u2 : (u1 + u2) / 2,
                                       u1 - u2,
                                       load,
                                       width,
                                       2 * fabs(load) / (pi * width)};
        for (int k = 0; k < SERIES; k++)
            row[k][i] = values[k];
    }
    for (uint32_t k = 0; k < SERIES; k++)
        put(s, k, 3, row[k]);
    return ff_put_scalar(s->host, MODULUS, modulus);
}

STUB_MODEL
