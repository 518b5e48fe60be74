/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * One mesh cycle of loaded teeth out of the compliance of the pairs: which pairs may touch at a
 * mesh position, their gaps by corner contact and by the deviations of the flanks, how they share
 * the force, and the phases where k or e jumps or bends.
 */
#ifndef STIFFNESS_QUASI_STATIC_H
#define STIFFNESS_QUASI_STATIC_H

#include "gears.h"
#include "load-sharing.h"

/* The pairs that may touch at one mesh position. */
typedef struct stiffness_position {
    size_t count;
    double age[STIFFNESS_MAX_PAIRS];     /* mesh cycles since SAP, increasing by whole cycles */
    double roll[STIFFNESS_MAX_PAIRS][2]; /* roll angles of the contact on both flanks */
} stiffness_position;

/* What a source takes from its wires. */
typedef struct stiffness_conditions {
    stiffness_path path;
    stiffness_deviations deviations;
    stiffness_gears gears;
} stiffness_conditions;

/* Which mesh cycles of the hunting period are shown. */
typedef struct stiffness_mesh_cycles {
    enum { STIFFNESS_CYCLE_NUMBER, STIFFNESS_CYCLE_WORST, STIFFNESS_CYCLE_ALL } which;
    size_t number;
} stiffness_mesh_cycles;

/* The parameter mesh_cycle: a number, `worst` or `all`. */
stiffness_mesh_cycles stiffness_mesh_cycles_set(const ff_value *value);

enum { STIFFNESS_MAX_BENDS = 8 };
typedef struct stiffness_source {
    const ff_host *host;
    const stiffness_conditions *conditions;
    size_t points;
    stiffness_mesh_cycles cycles;
    bool tangent;         /* k is dF/ds rather than F/(s - e) */
    bool corner;          /* contact of tip corners off the line of action */
    double before, after; /* mesh cycles of contact before SAP and after the tip */
    bool sharp;           /* pairs come and go at once: k jumps */
    size_t bends;         /* ages where the compliance of a pair bends */
    double bend[STIFFNESS_MAX_BENDS];
    /* Fills in compliance and Hertzian approach of the pairs. */
    void (*compliance)(const void *self, const stiffness_position *at, stiffness_contacts *c);
    const void *self;
    const char *fault; /* parameter or port to blame when there is no solution */
} stiffness_source;

/* Mesh cycles before SAP and after the tip within which corner contact is looked for. */
extern const double stiffness_corner_reach;

/* Reads and checks what a source takes from its wires; a mesh cycle that the hunting period does
   not have is refused. */
ff_status stiffness_conditions_read(const ff_host *host, const ff_array *in,
                                    const stiffness_rim *rim, stiffness_mesh_cycles cycles,
                                    stiffness_conditions *conditions);

/* Loaded teeth at a mesh position. */
typedef struct stiffness_loaded {
    stiffness_position at;
    stiffness_sharing sharing;
    double stiffness;
    bool solved;
    uint64_t loaded; /* bit of each pair with load, by its age in whole cycles */
    int first;       /* the pair that would touch first without load, likewise */
} stiffness_loaded;

stiffness_loaded stiffness_source_solve(const stiffness_source *s, size_t cycle, double phase,
                                        int side);

/* Computes the cycle, gives the wanted outputs and the quality of the solution. */
ff_status stiffness_source_publish(const stiffness_source *source, uint64_t wanted);

#endif
