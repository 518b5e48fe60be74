/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Integrates the oscillator of mesh.h by an embedded Runge-Kutta method (GSL). Every step lies
 * within one piece of the mesh cycle and one state of contact, where the equation is smooth, so
 * that the order of the method holds: steps end at the nodes, and at the instants at which the
 * flanks meet or part, which are found to round-off.
 *
 * The coordinate is delta = s - e. Between nodes e is straight and delta'' = s''; at a node delta
 * and its rate jump against e and e', so that s and s' are continuous and e'' is never needed.
 */
#ifndef FF_DYNAMICS_OSCILLATOR_H
#define FF_DYNAMICS_OSCILLATOR_H

#include "mesh.h"

/* Components of the state; the last six are integrated on demand. */
enum {
    FF_DELTA,
    FF_RATE,
    FF_M11, /* monodromy: derivative of (delta, rate) after their start values */
    FF_M12,
    FF_M21,
    FF_M22,
    FF_LOSS, /* energy taken by the damper */
    FF_WORK, /* energy brought in by the changes of k and by e */
    FF_STATE_SIZE
};

enum { FF_MOTION = 2, FF_MOTION_AND_VARIATION = FF_STATE_SIZE };

typedef struct ff_oscillator ff_oscillator;

/* The motion at a phase; twice where the excitation jumps. */
typedef struct ff_sample {
    double phase; /* mesh cycles since the start of the record */
    double s, s_rate, force;
} ff_sample;

/* Samples of consecutive mesh cycles, `per_cycle` in each, and where the excitation jumps. */
typedef struct ff_record {
    size_t per_cycle, count, capacity;
    size_t cycles; /* recorded so far */
    ff_sample *samples;
} ff_record;

/* NULL: out of memory. `tolerance` is the error per step; `refine` divides the longest step, to see
   what the steps cost in accuracy; `components`: FF_MOTION or FF_MOTION_AND_VARIATION. */
ff_oscillator *ff_oscillator_new(const ff_mesh *mesh, double tolerance, int refine,
                                 size_t components);
void ff_oscillator_free(ff_oscillator *o);

/* At phase 0, before the node that may lie there, of mesh cycles of duration T. Resets the
   variation and the clocks. */
void ff_oscillator_start(ff_oscillator *o, double T, double delta, double rate);
const double *ff_oscillator_state(const ff_oscillator *o);

/* Goes on by one mesh cycle of duration T; `record` may be NULL. 0: too many steps. */
int ff_oscillator_cycle(ff_oscillator *o, double T, ff_record *record);

/* Time since the start during which the flanks were parted, the wrong flanks touched, and the
   damper acted. */
typedef struct ff_clocks {
    double parted, back, damped;
} ff_clocks;
ff_clocks ff_oscillator_clocks(const ff_oscillator *o);

/* Energy of the motion, the potential of the load included. */
double ff_oscillator_energy(const ff_oscillator *o);

/* Steps made since the start, the rejected ones and those of the root finder included. */
size_t ff_oscillator_steps(const ff_oscillator *o);

int ff_record_init(ff_record *record, const ff_mesh *mesh, size_t per_cycle, size_t cycles);
void ff_record_free(ff_record *record);

#endif
