/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The mesh cycle: phase 0 to 1, 0 = the entering pair at SAP. A point where a value may jump is
 * there twice in a row: its limit from below, then its limit from above.
 */
#ifndef STIFFNESS_CYCLE_H
#define STIFFNESS_CYCLE_H

#include <stdbool.h>
#include <stddef.h>

/* Two phases that differ by no more are one. */
#define STIFFNESS_PHASE_TOLERANCE 1e-9

/* Which limit is meant at a phase where a value jumps. */
enum { STIFFNESS_BELOW = -1, STIFFNESS_ABOVE = 1 };

typedef struct stiffness_cycle {
    size_t count;
    double *phase; /* from 0 to 1, both included, not decreasing */
} stiffness_cycle;

/* A phase in [0, 1) that the cycle must hold exactly; twice when `jump`. */
typedef struct stiffness_breakpoint {
    double phase;
    bool jump;
} stiffness_breakpoint;

/* `points` equal steps and the `count` breaks, which increase. False: out of memory. */
bool stiffness_cycle_make(stiffness_cycle *cycle, size_t points, size_t count,
                          const stiffness_breakpoint *breaks);
void stiffness_cycle_free(stiffness_cycle *cycle);

/* The limit that point i stands for: STIFFNESS_BELOW at the first of two equal phases and at
 * phase 1. */
int stiffness_cycle_side(const stiffness_cycle *cycle, size_t i);

/* Mean of `value`, linear between the points of the cycle; exact. */
double stiffness_cycle_mean(const stiffness_cycle *cycle, const double *value);
/* Amplitude of harmonic n of the same function, jumps included:
   |2 int_0^1 v(phi) exp(-2 pi i n phi) dphi|; exact. */
double stiffness_cycle_amplitude(const stiffness_cycle *cycle, const double *value, int n);

/* True when a pair that met at SAP `age` mesh cycles ago is in contact on that side of `age`. */
bool stiffness_touches(double contact_ratio, double age, int side);
/* Pairs in contact. The youngest has age `phase`, the next phase + 1, and so on. */
size_t stiffness_pairs(double contact_ratio, double phase, int side);
/* The phase of [0, 1] at which a pair has `age`: 1 rather than 0 when the limit from below is
   meant. */
double stiffness_phase_of(double age, int side);

#endif
