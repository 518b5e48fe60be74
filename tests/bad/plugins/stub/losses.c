/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loss of a mesh whose pairs lose what the film says. */
#define STUB_MORE .evaluate = evaluate
#include "stub.h"

enum { ROLL, LOSS, FACE, TEETH, TORQUE, SPEED };
enum { MEAN, INPUT, EFFICIENCY };

static const ff_port inputs[] = {
    {.name = "ehl.roll_angle", .unit = "rad", .doc = "roll angle", .dims = "t"},
    {.name = "ehl.power_loss", .unit = "W/m", .doc = "loss", .dims = "t"},
    {.name = "gear.face_width", .unit = "m", .doc = "b", .dims = ""},
    {.name = "gear.teeth", .unit = "1", .doc = "teeth", .dims = "gear"},
    {.name = "operating.torque", .unit = "N m", .doc = "torque", .dims = ""},
    {.name = "operating.speed", .unit = "rad/s", .doc = "speed", .dims = ""},
};

static const ff_port outputs[] = {
    {.name = "power_loss_mean", .unit = "W", .doc = "loss", .dims = ""},
    {.name = "power_input", .unit = "W", .doc = "power", .dims = ""},
    {.name = "efficiency", .unit = "1", .doc = "efficiency", .dims = ""},
};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stub *s = self;
    const size_t count = in[ROLL].shape[0];
    double face = in[FACE].data[0], torque = in[TORQUE].data[0], speed = in[SPEED].data[0],
           teeth = in[TEETH].shape[0] ? in[TEETH].data[0] : 0, work = 0;
    (void)wanted;
    bool good = count > 1 && face > 0 && face < 1e3 && torque > 1e-3 && torque < 1e9 &&
                speed > 1e-3 && speed < 1e6 && teeth > 3 && teeth < 1e4;
    for (size_t i = 0; i < count && good; i++)
        good = fabs(in[ROLL].data[i]) < 1e3 && fabs(in[LOSS].data[i]) < 1e12 &&
               (!i || in[ROLL].data[i] >= in[ROLL].data[i - 1]);
    if (!good)
        return ff_failf(s->host, FF_INVALID, "ehl.roll_angle", "no pair meshes like that");
    for (size_t i = 1; i < count; i++)
        work += (in[ROLL].data[i] - in[ROLL].data[i - 1]) *
                (in[LOSS].data[i] + in[LOSS].data[i - 1]) / 2;
    double path = in[ROLL].data[count - 1] - in[ROLL].data[0], pitch = 2 * pi / teeth;
    double mean = face * work / (is("one-pair") ? fmax(path, 1e-9) : pitch),
           power = torque * speed * off("revolutions", 1 / (2 * pi));
    ff_put_scalar(s->host, MEAN, mean);
    ff_put_scalar(s->host, INPUT, power);
    return ff_put_scalar(s->host, EFFICIENCY,
                         is("reversed") ? 1 / (1 + mean / power) - mean / power : 1 - mean / power);
}

STUB_MODEL
