/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * One mesh cycle of loaded teeth out of the compliance of the pairs: which pairs may touch at a
 * mesh position, their gaps by corner contact and by the deviations of the flanks, how they share
 * the force, and the phases where k or e jumps or bends.
 */
#ifndef FF_STIFFNESS_QUASI_STATIC_H
#define FF_STIFFNESS_QUASI_STATIC_H

#include "gears.h"
#include "sharing.h"

/* The pairs that may touch at one mesh position. */
typedef struct ff_position {
    size_t count;
    double age[FF_MAX_PAIRS];     /* mesh cycles since SAP, increasing by whole cycles */
    double roll[FF_MAX_PAIRS][2]; /* roll angles of the contact on both flanks */
} ff_position;

/* What a source takes from its wires. */
typedef struct ff_scene {
    ff_engagement path;
    ff_deviations deviations;
    ff_gears gears;
} ff_scene;

/* Which mesh cycles of the hunting period are shown. */
typedef struct ff_mesh_cycles {
    enum { FF_CYCLE_NUMBER, FF_CYCLE_WORST, FF_CYCLE_ALL } which;
    size_t number;
} ff_mesh_cycles;

/* The parameter mesh_cycle: a number, `worst` or `all`. */
ff_mesh_cycles ff_mesh_cycles_set(const ff_value *value);

enum { FF_MAX_BENDS = 8 };
typedef struct ff_source {
    const ff_host *host;
    const ff_scene *scene;
    size_t points;
    ff_mesh_cycles cycles;
    bool tangent;         /* k is dF/ds rather than F/(s - e) */
    bool corner;          /* contact of tip corners off the line of action */
    double before, after; /* mesh cycles of contact before SAP and after the tip */
    bool sharp;           /* pairs come and go at once: k jumps */
    size_t bends;         /* ages where the compliance of a pair bends */
    double bend[FF_MAX_BENDS];
    /* Fills in compliance and Hertzian approach of the pairs. */
    void (*compliance)(const void *self, const ff_position *at, ff_contacts *c);
    const void *self;
    const char *fault; /* parameter or port to blame when there is no solution */
} ff_source;

/* Mesh cycles before SAP and after the tip within which corner contact is looked for. */
extern const double ff_corner_reach;

/* Reads and checks what a source takes from its wires; a mesh cycle that the hunting period does
   not have is refused. */
ff_status ff_scene_read(const ff_host *host, const ff_array *in, const ff_rim *rim,
                        ff_mesh_cycles cycles, ff_scene *scene);

/* Loaded teeth at a mesh position. */
typedef struct ff_loaded {
    ff_position at;
    ff_sharing sharing;
    double stiffness;
    bool solved;
    uint64_t loaded; /* bit of each pair with load, by its age in whole cycles */
    int first;       /* the pair that would touch first without load, likewise */
} ff_loaded;

ff_loaded ff_source_solve(const ff_source *s, size_t cycle, double phase, int side);

/* Computes the cycle, gives the wanted outputs and the quality of the solution. */
ff_status ff_source_publish(const ff_source *source, uint64_t wanted);

#endif
