/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Integrates the oscillator of excitation.h by the embedded Runge-Kutta method of Prince & Dormand,
 * of order 8 (GSL's rk8pd). Every step lies within one piece of the mesh cycle and one state of
 * contact, where the equation is smooth, so that the method keeps its order. Steps end at the nodes
 * and at the instants at which flanks meet or separate. These instants are located to round-off.
 * The coordinate is delta = s - e. At a node delta and its rate jump by minus the jumps of e and
 * e', so that s and s' are continuous.
 */
#ifndef DYNAMICS_OSCILLATOR_H
#define DYNAMICS_OSCILLATOR_H

#include "../excitation/excitation.h"

/* Components of the state. The last six are integrated only on demand. */
enum {
    DYNAMICS_DELTA,
    DYNAMICS_RATE,
    DYNAMICS_M11, /* monodromy: derivative of (delta, rate) with respect to their initial values */
    DYNAMICS_M12,
    DYNAMICS_M21,
    DYNAMICS_M22,
    DYNAMICS_LOSS, /* energy taken by the damper */
    DYNAMICS_WORK, /* energy supplied by changes of k and e */
    DYNAMICS_STATE_SIZE
};

enum { DYNAMICS_MOTION = 2, DYNAMICS_MOTION_AND_VARIATION = DYNAMICS_STATE_SIZE };

typedef struct dynamics_oscillator dynamics_oscillator;

/* The motion at a phase. At a jump of the excitation there are two samples. */
typedef struct dynamics_sample {
    double phase; /* mesh cycles since the start of the record */
    double s, s_rate, force;
    double film; /* film thickness on the driving flank minus the hand-over thickness, if there is
                    oil */
} dynamics_sample;

/* Samples of consecutive mesh cycles: `per_cycle` in each cycle, and one more at each jump of the
   excitation. */
typedef struct dynamics_record {
    size_t per_cycle, count, capacity;
    size_t cycles; /* number of cycles recorded so far */
    dynamics_sample *samples;
} dynamics_record;

/* Makes an integrator. `tolerance` is the error per step. `refine` divides the longest step, so
   that the error of the steps can be measured. `components` is DYNAMICS_MOTION or
   DYNAMICS_MOTION_AND_VARIATION. Returns NULL if out of memory. */
dynamics_oscillator *dynamics_oscillator_new(const dynamics_excitation *excitation,
                                             double tolerance, int refine, size_t components);
void dynamics_oscillator_free(dynamics_oscillator *o);

/* Starts mesh cycles of duration T at phase 0, before a node there. Resets the variation and the
   clocks. */
void dynamics_oscillator_start(dynamics_oscillator *o, double T, double delta, double rate);
const double *dynamics_oscillator_state(const dynamics_oscillator *o);

/* Integrates one mesh cycle of duration T. `record` may be NULL. Returns 0 if there are too many
   steps. */
int dynamics_oscillator_cycle(dynamics_oscillator *o, double T, dynamics_record *record);

/* Times since the start in which the flanks were separated, the back flanks touched, and the damper
   acted. */
typedef struct dynamics_clocks {
    double parted, back, damped;
} dynamics_clocks;
dynamics_clocks dynamics_oscillator_clocks(const dynamics_oscillator *o);

/* Returns the energy of the motion, including the potential of the load. */
double dynamics_oscillator_energy(const dynamics_oscillator *o);

/* Returns the number of steps since the start, including rejected steps and those of the root
   finder. */
size_t dynamics_oscillator_steps(const dynamics_oscillator *o);

int dynamics_record_init(dynamics_record *record, const dynamics_excitation *excitation,
                         size_t per_cycle, size_t cycles);
void dynamics_record_free(dynamics_record *record);

#endif
