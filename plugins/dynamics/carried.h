/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The motion that a case of a chain hands to its neighbour, as a slow sweep of the speed would. */
#ifndef FF_DYNAMICS_CARRIED_H
#define FF_DYNAMICS_CARRIED_H

#include "mesh.h"

#include <flankfilm/plugin.h>

typedef struct ff_carried {
    char mark[16];
    double mesh_frequency; /* Hz; 0: there is none */
    double delta, rate;    /* m, m/s: s - e at phase 0, before the node */
    int64_t period;        /* mesh cycles; below 1: it did not repeat itself */
} ff_carried;

/* Takes over the motion, or none when the bytes are not of that kind. */
void ff_carried_read(ff_carried *carried, const ff_state_bytes *from);
void ff_carried_write(const ff_carried *carried, ff_state_bytes *to);

/* From and to a state in the units of the mesh. */
ff_carried ff_carried_motion(const ff_mesh *mesh, double mesh_frequency, int period, double delta,
                             double rate);
void ff_carried_state(const ff_carried *carried, const ff_mesh *mesh, double x[2]);

#endif
