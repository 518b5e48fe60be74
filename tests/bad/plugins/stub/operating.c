/* SPDX-License-Identifier: GPL-3.0-or-later */
/* 100 N m at 150 rad/s. */
#define STUB_MORE .evaluate = evaluate
#include "stub.h"

static const ff_port inputs[] = {
    {.name = "gear.teeth", .unit = "1", .doc = "teeth", .dims = "gear", .flags = FF_OPTIONAL},
    {.name = "gear.base_radius", .unit = "m", .doc = "r_b", .dims = "gear", .flags = FF_OPTIONAL}};

static const ff_port outputs[] = {
    {.name = "torque", .unit = "N m", .doc = "torque", .dims = ""},
    {.name = "speed", .unit = "rad/s", .doc = "speed", .dims = ""},
    {.name = "mesh_frequency", .unit = "Hz", .doc = "frequency", .dims = ""},
    {.name = "line_force", .unit = "N", .doc = "force", .dims = ""},
};

/* The gear that counts. */
static size_t of(const ff_array *in, size_t row, const char *fault)
{
    return is(fault) ? in[row].shape[0] - 1 : 0;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stub *s = self;
    double teeth = in[0].data && in[0].shape[0] ? in[0].data[of(in, 0, "teeth")] : 20,
           radius = in[1].data && in[1].shape[0] ? in[1].data[of(in, 1, "wheel")] : 0.05;
    (void)wanted;
    if (!(fabs(teeth) < 1e6 && fabs(radius) > 1e-6 && fabs(radius) < 1e6))
        return ff_failf(s->host, FF_INVALID, "gear.teeth", "no gear has these teeth or this size");
    ff_put_scalar(s->host, 0, 100);
    ff_put_scalar(s->host, 1, 150);
    ff_put_scalar(s->host, 2, 150 * teeth / (is("frequency") ? 60 : 2 * pi));
    return ff_put_scalar(s->host, 3, 100 / radius);
}

STUB_MODEL
