/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wave on flank 1, over one period. */
#define STUB_MORE .evaluate = evaluate
#include "stub.h"

enum { POINTS = 64 };

static const ff_port inputs[] = {
    {.name = "gear.roughness", .unit = "m", .doc = "none", .dims = "gear", .flags = FF_OPTIONAL},
};

static const ff_port outputs[] = {
    {.name = "position", .unit = "m", .doc = "x", .dims = "arc"},
    {.name = "height_1", .unit = "m", .doc = "R1", .dims = "arc"},
    {.name = "height_2", .unit = "m", .doc = "R2", .dims = "arc"},
    {.name = "rq_1", .unit = "m", .doc = "of flank 1", .dims = ""},
    {.name = "rq_2", .unit = "m", .doc = "of flank 2", .dims = ""},
    {.name = "period", .unit = "m", .doc = "it repeats", .dims = ""},
    {.name = "origin", .unit = "m", .doc = "at first", .dims = ""},
};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stub *s = self;
    const double high = 0.3e-6, period = 250e-6;
    double x[POINTS], one[POINTS], two[POINTS];
    (void)wanted, (void)in;
    for (int i = 0; i < POINTS; i++) {
        x[i] = period * i / (is("open") ? POINTS - 1 : POINTS);
        one[i] = high * sin(2 * pi * x[i] / period);
        two[i] = 0;
    }
    put(s, 0, POINTS, x);
    put(s, 1, POINTS, one);
    put(s, 2, POINTS, two);
    ff_put_scalar(s->host, 3, is("amplitude") ? high : high / sqrt(2));
    ff_put_scalar(s->host, 4, 0);
    ff_put_scalar(s->host, 5, period);
    return ff_put_scalar(s->host, 6, 0);
}

STUB_MODEL
