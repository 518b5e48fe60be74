/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrates from a start state to the steady motion of a branch, and measures how well it has
 * settled. */
#ifndef DYNAMICS_SETTLE_H
#define DYNAMICS_SETTLE_H

#include "../excitation/excitation.h"

#include <flankfilm/plugin.h>

/* Special periods of a motion, else counts of mesh cycles. */
enum {
    DYNAMICS_LONGEST_PERIOD = 8, /* the longest that is told apart from an aperiodic motion */
    DYNAMICS_APERIODIC = 0,
    DYNAMICS_UNBOUNDED = -1
};

/* The longest mesh cycle that a model follows, in radians of the highest natural frequency. A
 * longer one would take too many steps. */
extern const double dynamics_longest_cycle;

/* The lower branch is the stable motion without contact loss; if there is none, the motion that a
 * rising sweep of the speed reaches. The upper branch is the motion that a falling sweep reaches.
 */
typedef enum dynamics_branch { DYNAMICS_BRANCH_LOWER, DYNAMICS_BRANCH_UPPER } dynamics_branch;

typedef struct dynamics_settling {
    dynamics_branch branch;
    double T;              /* duration of a mesh cycle */
    size_t cycles;         /* most mesh cycles; 0: as many as the damping needs */
    double tolerance;      /* of the distance to the periodic motion */
    double step_tolerance; /* error of one integration step */
    double from;     /* frequency of a motion to start from, over the natural frequency; 0: none */
    double start[2]; /* state of that motion */
    const ff_host *host;
} dynamics_settling;

typedef struct dynamics_settled {
    int period;      /* mesh cycles, DYNAMICS_APERIODIC or DYNAMICS_UNBOUNDED */
    int within;      /* 1: the tolerance was met */
    size_t cycles;   /* cycles that it took, without the sweep */
    size_t limit;    /* cycles that were allowed */
    double distance; /* estimated distance to the periodic motion, in units of excitation->length */
    double delta, rate; /* state at phase 0, before the node */
} dynamics_settled;

/* The integrator that follows the motion: oscillator.h, or flow.h with oil between parted flanks.
 */
typedef struct dynamics_follower {
    void *self;
    void (*start)(void *self, double T, double delta, double rate); /* at phase 0 */
    int (*cycle)(void *self, double T);                             /* 0: too many steps */
    void (*state)(const void *self, double x[2]);                   /* delta, rate */
} dynamics_follower;

/* The sweep that leads to a branch, for models that integrate in another way. The three functions
 * give its start frequency for a mesh frequency (both relative to the natural frequency), the
 * relative change of the frequency per cycle, and the cycles at the start. */
double dynamics_sweep_from(dynamics_branch branch, const dynamics_excitation *excitation,
                           double frequency);
double dynamics_sweep_rate(const dynamics_excitation *excitation, double frequency);
size_t dynamics_sweep_start_cycles(const dynamics_excitation *excitation, double T);

/* Relative change of a state over a period that round-off makes, without any disturbance. */
extern const double dynamics_state_round_off;

/* Returns the most cycles that a motion may take to settle to a tolerance. */
size_t dynamics_settle_limit(const dynamics_excitation *excitation, double T, double tolerance);

/* Writes the quality line `periodicity`; `aperiodic` says why a motion did not repeat itself. */
void dynamics_periodicity_line(const dynamics_settled *settled, double tolerance,
                               const char *aperiodic, const ff_host *host);

/* Writes the quality line `stability` of a chaotic motion in place of `periodicity`, since it will
 * not settle in any number of cycles. `growth` is the growth of a small disturbance per mesh cycle.
 */
void dynamics_chaos_line(double growth, const ff_host *host);

/* Growth of a disturbance over some 64 mesh cycles that proves chaos. A motion that is still
 * settling does not reach it, nor does the shear between neighbouring motions. */
extern const double dynamics_chaotic_disturbance;

/* Returns FF_OK, FF_STOPPED, or FF_NOCONV for too many steps. The follower is left at the settled
 * state. */
ff_status dynamics_settle(const dynamics_follower *follower, const dynamics_excitation *excitation,
                          const dynamics_settling *how, dynamics_settled *result);

#endif
