/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The motion that a case of a chain hands to its neighbour, as a slow sweep of the speed would. */
#ifndef DYNAMICS_CARRIED_H
#define DYNAMICS_CARRIED_H

#include "mesh.h"

#include <flankfilm/plugin.h>

typedef struct dynamics_carried {
    char mark[16];
    double mesh_frequency; /* Hz; 0: there is none */
    double delta, rate;    /* m, m/s: s - e at phase 0, before the node */
    int64_t period;        /* mesh cycles; below 1: it did not repeat itself */
} dynamics_carried;

/* Takes over the motion, or none when the bytes are not of that kind. */
void dynamics_carried_read(dynamics_carried *carried, const ff_state_bytes *from);
void dynamics_carried_write(const dynamics_carried *carried, ff_state_bytes *to);

/* From and to a state in the units of the mesh. */
dynamics_carried dynamics_carried_motion(const dynamics_mesh *mesh, double mesh_frequency,
                                         int period, double delta, double rate);
void dynamics_carried_state(const dynamics_carried *carried, const dynamics_mesh *mesh,
                            double x[2]);

#endif
