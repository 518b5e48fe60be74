/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Film over roughness. */
#define STUB_MORE .evaluate = evaluate
#include "stub.h"

static const ff_port inputs[] = {
    {.name = "ehl.h_min", .unit = "m", .doc = "film", .dims = "t"},
    {.name = "gear.roughness", .unit = "m", .doc = "of both flanks", .dims = "gear"},
};

static const ff_port outputs[] = {
    {.name = "safety", .unit = "1", .doc = "film over roughness", .dims = ""},
};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stub *s = self;
    double film = INFINITY, square = 0;
    (void)wanted;
    for (size_t i = 0; i < in[0].shape[0]; i++)
        film = fmin(film, in[0].data[i]);
    for (size_t i = 0; i < in[1].shape[0]; i++)
        square += in[1].data[i] * in[1].data[i];
    if (!(film > 0 && film < 1e3 && square > 1e-24 && square < 1e6))
        return ff_failf(s->host, FF_INVALID, "ehl.h_min", "there is no film, or no roughness");
    return ff_put_scalar(s->host, 0,
                         is("rough")
                             ? film * sqrt(square) * 1e12
                             : (is("film") ? 1e-6 / film : film * 1e6) / sqrt(square) * 1e-6);
}

STUB_MODEL
