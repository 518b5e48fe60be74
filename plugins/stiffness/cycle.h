/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mesh cycle: phase 0 to 1, where phase 0 is the entering pair at SAP. A point at which a
   value may jump appears twice in a row: first with the limit from below, then with the limit
   from above. */
#ifndef STIFFNESS_CYCLE_H
#define STIFFNESS_CYCLE_H

#include <stdbool.h>
#include <stddef.h>

/* Phases that differ by no more than this are treated as equal. */
#define STIFFNESS_PHASE_TOLERANCE 1e-9

/* The two limits at a phase where a value jumps. */
enum { STIFFNESS_BELOW = -1, STIFFNESS_ABOVE = 1 };

typedef struct stiffness_cycle {
    size_t count;
    double *phase; /* from 0 to 1, both included, not decreasing */
} stiffness_cycle;

/* A phase in [0, 1) that must be a point of the cycle; if `jump` is set it appears twice. */
typedef struct stiffness_breakpoint {
    double phase;
    bool jump;
} stiffness_breakpoint;

/* Creates `points` equal steps and inserts the `count` breaks, which must be in increasing order.
   Returns false if out of memory. */
bool stiffness_cycle_make(stiffness_cycle *cycle, size_t points, size_t count,
                          const stiffness_breakpoint *breaks);
void stiffness_cycle_free(stiffness_cycle *cycle);

/* Returns the limit that point i represents: STIFFNESS_BELOW at the first of two equal phases and
   at phase 1. */
int stiffness_cycle_side(const stiffness_cycle *cycle, size_t i);

/* Returns the exact mean of `value`, which is linear between the points. */
double stiffness_cycle_mean(const stiffness_cycle *cycle, const double *value);
/* Returns the exact amplitude of harmonic n of `value`, including jumps: |2 int_0^1 v(phi) exp(-2
   pi i n phi) dphi|. */
double stiffness_cycle_amplitude(const stiffness_cycle *cycle, const double *value, int n);

/* Returns whether a pair that was at SAP `age` mesh cycles ago is in contact; `side` selects the
   limit from below or above. */
bool stiffness_touches(double contact_ratio, double age, int side);
/* Counts the pairs in contact. The youngest has the age `phase`, the next one phase + 1, and so
   on. */
size_t stiffness_pairs(double contact_ratio, double phase, int side);
/* Returns the phase in [0, 1] at which a pair has `age`. At a whole number of mesh cycles it is 1
   for the limit from below, otherwise 0. */
double stiffness_phase_of(double age, int side);

#endif
