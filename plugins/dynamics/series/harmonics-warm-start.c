/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "harmonics-warm-start.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const char mark[16] = "series 1";

void dynamics_harmonics_warm_start_set(dynamics_harmonics_warm_start *warm_start,
                                       double mesh_frequency, const double *x, size_t harmonics,
                                       double length)
{
    memcpy(warm_start->mark, mark, sizeof mark);
    warm_start->mesh_frequency = mesh_frequency;
    warm_start->harmonics = harmonics;
    for (size_t i = 0; i <= 2 * harmonics; i++)
        warm_start->x[i] = x[i] * length;
}

static size_t bytes_of(uint64_t harmonics)
{
    return offsetof(dynamics_harmonics_warm_start, x) +
           (2 * (size_t)harmonics + 1) * sizeof(double);
}

static void read_series(dynamics_harmonics_warm_start *c, const ff_state_bytes *from)
{
    c->harmonics = 0;
    if (from->count < offsetof(dynamics_harmonics_warm_start, x) || from->count > sizeof *c)
        return;
    memcpy(c, from->bytes, from->count);
    int good = !memcmp(c->mark, mark, sizeof mark) && c->harmonics <= DYNAMICS_MOST_HARMONICS &&
               from->count == bytes_of(c->harmonics) && isfinite(c->mesh_frequency) &&
               c->mesh_frequency > 0;
    for (size_t i = 0; good && i <= 2 * c->harmonics; i++)
        good = isfinite(c->x[i]);
    if (!good)
        c->harmonics = 0;
}

ff_status dynamics_harmonics_warm_start_carry(dynamics_harmonics_warm_start *taken,
                                              const ff_state_bytes *from,
                                              const dynamics_harmonics_warm_start *left,
                                              ff_state_bytes *to)
{
    if (from)
        read_series(taken, from);
    if (to) {
        to->bytes = left;
        to->count = left->harmonics ? bytes_of(left->harmonics) : 0;
    }
    return FF_OK;
}
