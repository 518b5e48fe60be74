/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrates from a start state to the steady motion of a branch, and tells how well it has
 * settled. */
#ifndef DYNAMICS_SETTLE_H
#define DYNAMICS_SETTLE_H

#include "../excitation/excitation.h"

#include <flankfilm/plugin.h>

/* Periods of a motion, in mesh cycles. */
enum {
    DYNAMICS_LONGEST_PERIOD = 8, /* the longest that is told from an aperiodic motion */
    DYNAMICS_APERIODIC = 0,
    DYNAMICS_UNBOUNDED = -1
};

/* The longest mesh cycle that a model follows, in radians of the highest natural frequency: a
   longer one would take too many steps. */
extern const double dynamics_longest_cycle;

/* The lower branch is the motion without separation where there is a stable one, else what a sweep
   of the speed from below reaches; the upper one is what a sweep from above reaches. */
typedef enum dynamics_branch { DYNAMICS_BRANCH_LOWER, DYNAMICS_BRANCH_UPPER } dynamics_branch;

typedef struct dynamics_settling {
    dynamics_branch branch;
    double T;              /* duration of a mesh cycle */
    size_t cycles;         /* the most that it may take; 0: as the damping needs */
    double tolerance;      /* of the distance to the periodic motion */
    double step_tolerance; /* error of one integration step */
    double from;           /* mesh over natural frequency of a motion to start from; 0: none */
    double start[2];       /* its state */
    const ff_host *host;
} dynamics_settling;

typedef struct dynamics_settled {
    int period;         /* mesh cycles, DYNAMICS_APERIODIC or DYNAMICS_UNBOUNDED */
    int within;         /* the tolerance was met */
    size_t cycles;      /* that it took, without those of the sweep */
    size_t limit;       /* cycles that were allowed */
    double distance;    /* estimated, to the periodic motion, in units of excitation->length */
    double delta, rate; /* state at phase 0, before the node */
} dynamics_settled;

/* What follows the motion: the integrator of oscillator.h, or, with oil between parted flanks, the
   steps of flow.h. */
typedef struct dynamics_follower {
    void *self;
    void (*start)(void *self, double T, double delta, double rate); /* at phase 0 */
    int (*cycle)(void *self, double T);                             /* 0: too many steps */
    void (*state)(const void *self, double x[2]);                   /* delta, rate */
} dynamics_follower;

/* The sweep that leads to a branch, for models that integrate in another way: the frequency at
   which it starts for a mesh frequency (both relative to the natural one), the relative change of
   the frequency per cycle, and the cycles at the start. */
double dynamics_sweep_from(dynamics_branch branch, double frequency);
double dynamics_sweep_rate(const dynamics_excitation *excitation, double frequency);
size_t dynamics_sweep_start_cycles(const dynamics_excitation *excitation, double T);

/* The most cycles that a motion may take to settle to a tolerance. */
size_t dynamics_settle_limit(const dynamics_excitation *excitation, double T, double tolerance);

/* The quality line `periodicity`; `aperiodic` says why a motion did not repeat itself. */
void dynamics_periodicity_line(const dynamics_settled *settled, double tolerance,
                               const char *aperiodic, const ff_host *host);

/* The quality line `stability` of a chaotic motion, in place of `periodicity`: it will not settle
   in any number of cycles. `growth` is that of a small disturbance per mesh cycle. */
void dynamics_chaos_line(double growth, const ff_host *host);

/* Growth of a disturbance over some 64 mesh cycles that tells chaos: neither a motion that has yet
   to settle nor the shear between neighbouring motions gets there. */
extern const double dynamics_chaotic_disturbance;

/* FF_OK, FF_STOPPED, or FF_NOCONV: too many steps. The follower is then at the settled state. */
ff_status dynamics_settle(const dynamics_follower *follower, const dynamics_excitation *excitation,
                          const dynamics_settling *how, dynamics_settled *result);

#endif
