/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The gear pair as an oscillator with one degree of freedom (Li & Kahraman 2011, eqs 2a and 2b),
 * without dimensions:
 *
 *   s'' + 2 zeta (s' - e') + k g(s - e) = load
 *
 * in the unit of length `length`, the mean mesh stiffness and the unit of time 1/omega, omega^2 =
 * mean stiffness / equivalent mass. g is the dead zone of half width `half_gap`. k and e are
 * straight between the nodes of a mesh cycle and may jump there.
 */
#ifndef FF_DYNAMICS_MESH_H
#define FF_DYNAMICS_MESH_H

#include <stddef.h>

/* When the damper acts. */
enum {
    FF_DAMPING_ALWAYS,  /* in the gap too, as Li & Kahraman 2011 */
    FF_DAMPING_CONTACT, /* only while the flanks touch */
    FF_DAMPING_CLIPPED  /* only while they touch, and they never pull */
};

/* A stretch of the mesh cycle; values at its start and their change per mesh cycle. */
typedef struct ff_piece {
    double start, length; /* mesh cycles */
    double k, k_rate;
    double e, e_rate;
    int jump; /* k or e is discontinuous at the start */
} ff_piece;

typedef struct ff_mesh {
    ff_piece *pieces;
    size_t count;
    double k_max;
    double zeta, load, half_gap;
    int damping;
    double length, stiffness, omega; /* units: m, N/m, rad/s */
} ff_mesh;

/* Excitation in SI as a stiffness model gives it: `phase` from 0 to 1, twice at a jump. */
typedef struct ff_excitation {
    size_t count;
    const double *phase, *stiffness;
    const double *error; /* NULL: none */
} ff_excitation;

/* Makes `mesh` ready, whose scalars are set, from a checked excitation; 0: out of memory. */
int ff_mesh_build(ff_mesh *mesh, const ff_excitation *excitation);
void ff_mesh_free(ff_mesh *mesh);

/* The piece at a phase in [0, 1], and at a node the one before it (`left`) or behind it. */
const ff_piece *ff_mesh_piece(const ff_mesh *mesh, double phase, int left);

/* Mesh force, eq. 4: spring and damper; `delta` = s - e, `rate` its derivative. */
double ff_mesh_force(const ff_mesh *mesh, double k, double delta, double rate);

#endif
