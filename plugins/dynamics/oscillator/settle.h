/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrates from a start state to the steady motion of a branch, and measures how well it has
 * settled. */
#ifndef DYNAMICS_SETTLE_H
#define DYNAMICS_SETTLE_H

#include "../excitation/excitation.h"

#include <flankfilm/plugin.h>

/* Special values of a period, and numbers of mesh cycles. */
enum {
    DYNAMICS_LONGEST_PERIOD = 8, /* longest period that is distinguished from an aperiodic motion */
    DYNAMICS_APERIODIC = 0,
    DYNAMICS_UNBOUNDED = -1
};

/* The longest mesh cycle that a model integrates, in radians of the highest natural frequency. A
   longer cycle would take too many steps. */
extern const double dynamics_longest_cycle;

/* The lower branch is the stable motion without contact loss; if there is none, the motion that a
   sweep to higher speed reaches. The upper branch is the motion that a sweep to lower speed
   reaches. */
typedef enum dynamics_branch { DYNAMICS_BRANCH_LOWER, DYNAMICS_BRANCH_UPPER } dynamics_branch;

typedef struct dynamics_settling {
    dynamics_branch branch;
    double T;              /* duration of a mesh cycle */
    size_t cycles;         /* largest number of mesh cycles; 0: as many as the damping requires */
    double tolerance;      /* tolerance of the distance to the periodic motion */
    double step_tolerance; /* error of one integration step */
    double from;     /* frequency of a motion to start from, over the natural frequency; 0: none */
    double start[2]; /* state of the motion to start from */
    const ff_host *host;
} dynamics_settling;

typedef struct dynamics_settled {
    int period;      /* in mesh cycles, or DYNAMICS_APERIODIC or DYNAMICS_UNBOUNDED */
    int within;      /* 1: the tolerance was met */
    size_t cycles;   /* cycles needed, without the sweep */
    size_t limit;    /* cycles allowed */
    double distance; /* estimated distance to the periodic motion, in units of excitation->length */
    double delta, rate; /* state at phase 0, before the node */
} dynamics_settled;

/* The integrator that follows the motion: oscillator.h, or flow.h if there is oil between separated
   flanks. */
typedef struct dynamics_follower {
    void *self;
    void (*start)(void *self, double T, double delta, double rate); /* starts at phase 0 */
    int (*cycle)(void *self, double T);                             /* 0: too many steps */
    void (*state)(const void *self, double x[2]);                   /* sets x to (delta, rate) */
} dynamics_follower;

/* The sweep to a branch, for models with another integrator. The functions return the start
   frequency of the sweep for a mesh frequency (both relative to the natural frequency), the
   relative change of the frequency per cycle, and the number of cycles before the sweep. */
double dynamics_sweep_from(dynamics_branch branch, const dynamics_excitation *excitation,
                           double frequency);
double dynamics_sweep_rate(const dynamics_excitation *excitation, double frequency);
size_t dynamics_sweep_start_cycles(const dynamics_excitation *excitation, double T);

/* Relative change of a state over one period that round-off alone may cause. */
extern const double dynamics_state_round_off;

/* Returns the largest number of cycles in which a motion may settle to a tolerance. */
size_t dynamics_settle_limit(const dynamics_excitation *excitation, double T, double tolerance);

/* Writes the quality line `periodicity`. `aperiodic` is the reason why a motion did not repeat. */
void dynamics_periodicity_line(const dynamics_settled *settled, double tolerance,
                               const char *aperiodic, const ff_host *host);

/* Writes the quality line `stability` of a chaotic motion instead of `periodicity`, since the
   motion never settles. `growth` is the growth of a small disturbance per mesh cycle. */
void dynamics_chaos_line(double growth, const ff_host *host);

/* A motion is chaotic if a disturbance grows by more than this factor over about 64 mesh cycles.
   Neither a settling motion nor the slow drift between neighbouring motions reaches this factor. */
extern const double dynamics_chaotic_disturbance;

/* Integrates the motion until it has settled. Returns FF_OK, FF_STOPPED, or FF_NOCONV for too many
   steps. The follower is left at the settled state. */
ff_status dynamics_settle(const dynamics_follower *follower, const dynamics_excitation *excitation,
                          const dynamics_settling *how, dynamics_settled *result);

#endif
