/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "warm-start.h"

#include <math.h>
#include <string.h>

static const char mark[16] = "motion 1";

static void read_motion(dynamics_warm_start *warm_start, const ff_state_bytes *from)
{
    dynamics_warm_start read;
    *warm_start = (dynamics_warm_start){.mesh_frequency = 0};
    if (from->count != sizeof read)
        return;
    memcpy(&read, from->bytes, sizeof read);
    if (!memcmp(read.mark, mark, sizeof mark) && isfinite(read.delta) && isfinite(read.rate) &&
        isfinite(read.mesh_frequency) && read.mesh_frequency > 0)
        *warm_start = read;
}

ff_status dynamics_warm_start_carry(dynamics_warm_start *taken, const ff_state_bytes *from,
                                    const dynamics_warm_start *left, ff_state_bytes *to)
{
    if (from)
        read_motion(taken, from);
    if (to) {
        to->bytes = left;
        to->count = left->mesh_frequency > 0 ? sizeof *left : 0;
    }
    return FF_OK;
}

dynamics_warm_start dynamics_warm_start_motion(const dynamics_excitation *excitation,
                                               double mesh_frequency, int period, double delta,
                                               double rate)
{
    dynamics_warm_start warm_start = {.mesh_frequency = mesh_frequency,
                                      .delta = delta * excitation->length,
                                      .rate = rate * excitation->length * excitation->omega,
                                      .period = period};
    memcpy(warm_start.mark, mark, sizeof mark);
    return warm_start;
}

void dynamics_warm_start_state(const dynamics_warm_start *warm_start,
                               const dynamics_excitation *excitation, double x[2])
{
    x[0] = warm_start->delta / excitation->length;
    x[1] = warm_start->rate / (excitation->length * excitation->omega);
}
