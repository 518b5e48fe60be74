/* SPDX-License-Identifier: MIT */
/*
 * Draft: may change until a version freezes it.
 *
 * Service "flankfilm.mesh_force/1": the exact force between two gears as a function of mesh phase
 * and approach. A stiffness offers it if it can solve the load sharing between the pairs in contact
 * for any force. A dynamics model prefers it to the level outputs of docs/abi.md.
 *
 * x is the mesh phase in cycles, 0 when the entering pair is at SAP. s is the approach r_b1 theta_1
 * - r_b2 theta_2 along the line of action, m, positive if the drive flanks press on each other. G
 * is the sum of the tooth forces, N. G is 0 for s below the unloaded transmission error e(x); above
 * it, G is continuous and increasing. On the back flank, s is measured from the mirrored contact.
 * All functions are pure, allocate no memory, and may be called from any thread.
 */
#ifndef FLANKFILM_MESH_FORCE_H
#define FLANKFILM_MESH_FORCE_H

#include "plugin.h"

#define FF_MESH_FORCE_ID "flankfilm.mesh_force/1"

enum { FF_DRIVE_FLANK = 0, FF_BACK_FLANK = 1 };

typedef struct ff_mesh_force {
    size_t size;
    const void *self;
    /* Writes the phases at which G has a jump or a kink at fixed s, ascending, at most `most`.
       Returns their number. */
    size_t (*breaks)(const void *self, int32_t flank, size_t most, double *x);
    /*
     * At one phase x, for n approaches s: G, N, n; dG_ds, N/m, n, may be NULL; dG_dx, N per mesh
     * cycle, n, may be NULL. If x is a break, side -1 gives the values just before x, side 1 just
     * after it. FF_DOMAIN: a force lies outside the range that the source covers.
     */
    ff_status (*force)(const void *self, int32_t flank, double x, int32_t side, size_t n,
                       const double *s, double *G, double *dG_ds, double *dG_dx);
    /*
     * The pairs in contact at phase x that share the force F, N, >= 0. age: phase of each pair
     * since SAP, cycles; W: its tooth force, N; both have room for `most` pairs. *count: number of
     * pairs. The tooth forces add up to F.
     */
    ff_status (*teeth)(const void *self, int32_t flank, double x, int32_t side, double F,
                       size_t most, double *age, double *W, size_t *count);
} ff_mesh_force;

#endif
