/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A tooth pair from SAP to tip: u = omega R, t = roll/omega, w = W/b. */
#define STUB_MORE .evaluate = evaluate
#include "stub.h"

enum { ROLL, R1, R2, FACE, TEETH, E, SPEED, FORCE };
enum { TIME, RADIUS_1, RADIUS_2, RADIUS, U1, U2, UR, US, LOAD, WIDTH, PRESSURE, ANGLE, MODULUS };

static const ff_port inputs[] = {
    {.name = "gear.roll_angle", .unit = "rad", .doc = "roll angle", .dims = "station"},
    {.name = "gear.radius_1", .unit = "m", .doc = "R1", .dims = "station"},
    {.name = "gear.radius_2", .unit = "m", .doc = "R2", .dims = "station"},
    {.name = "gear.face_width", .unit = "m", .doc = "b", .dims = ""},
    {.name = "gear.teeth", .unit = "1", .doc = "teeth", .dims = "gear"},
    {.name = "gear.reduced_modulus", .unit = "Pa", .doc = "E'", .dims = ""},
    {.name = "operating.speed", .unit = "rad/s", .doc = "omega", .dims = ""},
    {.name = "load.tooth_force", .unit = "N", .doc = "W", .dims = "station"},
};

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
    {.name = "roll_angle", .unit = "rad", .doc = "roll angle", .dims = "t"},
    {.name = "reduced_modulus", .unit = "Pa", .doc = "E'", .dims = ""},
};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stub *s = self;
    const size_t count = in[ROLL].shape[0];
    const double omega = in[SPEED].data[0], modulus = in[E].data[0] * off("soft", 0.5),
                 face = in[FACE].data[0];
    double *row[MODULUS];
    (void)wanted;
    bool good = count > 1 && in[TEETH].shape[0] == 2 && omega > 1e-3 && omega < 1e6 &&
                modulus > 1e3 && modulus < 1e20 && face > 1e-6 && face < 1e3;
    for (size_t i = 0; i < count && good; i++)
        good = in[R1].data[i] > 1e-9 && in[R1].data[i] < 1e3 && in[R2].data[i] > 1e-9 &&
               in[R2].data[i] < 1e3 && in[FORCE].data[i] >= 0 && in[FORCE].data[i] < 1e12 &&
               fabs(in[ROLL].data[i]) < 1e3 && (!i || in[ROLL].data[i] >= in[ROLL].data[i - 1]);
    if (!good)
        return ff_failf(s->host, FF_INVALID, "gear.roll_angle", "no pair meshes like that");
    const double ratio = in[TEETH].data[0] / in[TEETH].data[1];
    for (uint32_t k = 0; k < MODULUS; k++)
        if (!(row[k] = ff_put_series(s->host, k, count)))
            return FF_NOMEM;
    for (size_t i = 0; i < count; i++) {
        size_t at = is("mirrored") ? count - 1 - i : i;
        double r1 = in[R1].data[at], r2 = in[R2].data[at], r = r1 * r2 / (r1 + r2), u1 = omega * r1,
               u2 = omega * ratio * r2 * off("slow-wheel", 1 / ratio),
               w = in[FORCE].data[i] / face * off("heavy", face),
               b = sqrt(8 * w * r / (pi * modulus));
        const double values[MODULUS] = {(in[ROLL].data[i] - in[ROLL].data[0]) / omega *
                                            off("fast", 0.5),
                                        r1,
                                        r2,
                                        r,
                                        u1,
                                        u2,
                                        (u1 + u2) / 2,
                                        u1 - u2,
                                        w,
                                        b,
                                        b > 0 ? 2 * w / (pi * b) : 0,
                                        in[ROLL].data[i]};
        for (int k = 0; k < MODULUS; k++)
            row[k][i] = values[k];
    }
    return ff_put_scalar(s->host, MODULUS, modulus);
}

STUB_MODEL
