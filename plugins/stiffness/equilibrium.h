/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibrium of the loaded teeth at one mesh position: the pairs that may touch, their gaps
 * from corner contact and flank deviations, and how they share the force. */
#ifndef STIFFNESS_EQUILIBRIUM_H
#define STIFFNESS_EQUILIBRIUM_H

#include "conditions.h"
#include "load-sharing.h"

#include <stdint.h>

/* The pairs that may touch at one mesh position. */
typedef struct stiffness_position {
    size_t count;
    double age[STIFFNESS_MAX_PAIRS];     /* mesh cycles since SAP, increasing by whole cycles */
    double roll[STIFFNESS_MAX_PAIRS][2]; /* roll angles of the contact, on both flanks */
} stiffness_position;

enum { STIFFNESS_MAX_SLOPE_CHANGES = 8 };
/* A stiffness model given by the compliance of its pairs. */
typedef struct stiffness_source {
    const ff_host *host;
    const stiffness_conditions *conditions;
    size_t points; /* number of equal steps of the mesh cycle */
    stiffness_mesh_cycles cycles;
    bool tangent;         /* k is dF/ds instead of F/(s - e) */
    bool corner;          /* tip corner contact off the line of action is included */
    double before, after; /* mesh cycles of contact before SAP and after the tip */
    bool sharp;           /* pairs enter and leave abruptly, so that k jumps */
    size_t slope_changes; /* ages at which the compliance of a pair changes its slope */
    double slope_change[STIFFNESS_MAX_SLOPE_CHANGES];
    /* Computes compliance and Hertzian approach of the pairs. */
    void (*compliance)(const void *self, const stiffness_position *at, stiffness_contacts *c);
    const void *self;
    const char *fault; /* parameter or port named in the error if there is no solution */
} stiffness_source;

/* The loaded teeth at one mesh position. */
typedef struct stiffness_loaded {
    stiffness_position at;
    stiffness_sharing sharing;
    double stiffness; /* N/m */
    bool solved;      /* false: the pairs cannot carry the force */
    uint64_t loaded;  /* one bit per loaded pair, numbered by its age in whole cycles */
    int first;        /* age in whole mesh cycles of the pair that touches first without load */
} stiffness_loaded;

/* Solves one phase of one mesh cycle of the hunting period. If pairs enter or leave at that phase,
   `side` selects the limit. */
stiffness_loaded stiffness_source_solve(const stiffness_source *s, size_t cycle, double phase,
                                        int side);

/* Solves one phase for several forces, N; 0 means a very small force. */
void stiffness_source_solve_all(const stiffness_source *s, size_t cycle, double phase, int side,
                                size_t count, const double *force, stiffness_loaded *loaded);

/* Returns the force on the pair of that age, N; 0: it is not loaded. */
double stiffness_loaded_force(const stiffness_loaded *loaded, double age, double phase);

/* Returns the total force on the pairs, N. */
double stiffness_source_force(const stiffness_source *s);

/* Returns the transmission error without load: the smallest gap of all pairs, m. */
double stiffness_source_unloaded(const stiffness_source *s, size_t cycle, double phase);

#endif
