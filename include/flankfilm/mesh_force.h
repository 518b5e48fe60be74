/* SPDX-License-Identifier: MIT */
/*
 * Draft: may change until the version that freezes it.
 *
 * Service "flankfilm.mesh_force/1": the force between two gears as a function of their phase and
 * their approach, exactly. A stiffness offers it where it can solve the sharing of the load between
 * the pairs in contact at any force; a motion prefers it to the level outputs of docs/abi.md.
 *
 * x is the mesh phase in cycles, 0 where the entering pair is at SAP; s the approach
 * r_b1 theta_1 - r_b2 theta_2 along the line of action, m, positive where the drive flanks press;
 * G the sum of the tooth forces, N. G is 0 for s below the unloaded transmission error e(x), and
 * continuous and increasing above it. On the back flank s counts from the mirrored contact.
 * All functions are pure, allocate nothing, and may be called from any thread.
 */
#ifndef FLANKFILM_MESH_FORCE_H
#define FLANKFILM_MESH_FORCE_H

#include "plugin.h"

#define FF_MESH_FORCE_ID "flankfilm.mesh_force/1"

enum { FF_DRIVE_FLANK = 0, FF_BACK_FLANK = 1 };

typedef struct ff_mesh_force {
    size_t size;
    const void *self;
    /* The phases at which G jumps or has a kink at fixed s, ascending; at most `most` are written.
       The result is their number. */
    size_t (*breaks)(const void *self, int32_t flank, size_t most, double *x);
    /*
     * At one phase x, for n approaches s: G, N, n; dG_ds, N/m, n, may be NULL; dG_dx, N per mesh
     * cycle, n, may be NULL. side  -1: just before x, 1: just behind it, where x is a break.
     * FF_DOMAIN where a force is outside of the range that the source covers.
     */
    ff_status (*force)(const void *self, int32_t flank, double x, int32_t side, size_t n,
                       const double *s, double *G, double *dG_ds, double *dG_dx);
    /*
     * The pairs in contact at phase x that share the force F, N, >= 0. age  phase of each pair
     * since it was at SAP, cycles; W  its tooth force, N; both have room for `most`. *count: how
     * many pairs; their forces add up to F.
     */
    ff_status (*teeth)(const void *self, int32_t flank, double x, int32_t side, double F,
                       size_t most, double *age, double *W, size_t *count);
} ff_mesh_force;

#endif
