/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "carried.h"

#include <math.h>
#include <string.h>

static const char mark[16] = "motion 1";

void dynamics_carried_read(dynamics_carried *carried, const ff_state_bytes *from)
{
    dynamics_carried read;
    *carried = (dynamics_carried){.mesh_frequency = 0};
    if (from->count != sizeof read)
        return;
    memcpy(&read, from->bytes, sizeof read);
    if (!memcmp(read.mark, mark, sizeof mark) && isfinite(read.delta) && isfinite(read.rate) &&
        isfinite(read.mesh_frequency) && read.mesh_frequency > 0)
        *carried = read;
}

void dynamics_carried_write(const dynamics_carried *carried, ff_state_bytes *to)
{
    to->bytes = carried;
    to->count = carried->mesh_frequency > 0 ? sizeof *carried : 0;
}

dynamics_carried dynamics_carried_motion(const dynamics_mesh *mesh, double mesh_frequency,
                                         int period, double delta, double rate)
{
    dynamics_carried carried = {.mesh_frequency = mesh_frequency,
                                .delta = delta * mesh->length,
                                .rate = rate * mesh->length * mesh->omega,
                                .period = period};
    memcpy(carried.mark, mark, sizeof mark);
    return carried;
}

void dynamics_carried_state(const dynamics_carried *carried, const dynamics_mesh *mesh, double x[2])
{
    x[0] = carried->delta / mesh->length;
    x[1] = carried->rate / (mesh->length * mesh->omega);
}
