/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A motion on its way through a mesh cycle, for flow.c and for its steps in oil, flow-film.c. */
#ifndef DYNAMICS_FLOW_RUN_H
#define DYNAMICS_FLOW_RUN_H

#include "../excitation/spring.h"
#include "flow.h"

typedef struct dynamics_run {
    const dynamics_flow *flow;
    const dynamics_excitation *excitation;
    const dynamics_piece *piece;
    double T, at, end; /* duration of the cycle, phase in it, phase at which a step would end */
    int side, pressed; /* as in oscillator.c; with oil, the flank that is held */
    int band;          /* of the spring (spring.h) */
    int open[2];       /* with oil: whether the film of a flank carries */
    double stride;     /* the time that the next step in oil may take */
    int idle;
    int variation;
    dynamics_state *y;
    const dynamics_observer *observer;
} dynamics_run;

/* A condition that holds as long as p >= 0; then the contact changes to (side, pressed), or the
   spring alone to another band. */
enum { DYNAMICS_RUN_GATES = 4 };
typedef struct dynamics_gate {
    double p[DYNAMICS_ORDER_MAX + 1];
    int side, pressed, knee, band;
} dynamics_gate;

/* Changes of contact in a row that each advance by less than dynamics_slip, rad, before the contact
   is held for that time. */
enum { DYNAMICS_MAX_IDLE = 6 };
static const double dynamics_slip = 1e-6;

static inline double dynamics_run_stiffness(const dynamics_run *r)
{
    return dynamics_piece_value(r->piece->k, r->piece->degree, r->at - r->piece->start);
}

/* The phase at which a piece ends. */
static inline double dynamics_piece_end(const dynamics_excitation *excitation,
                                        const dynamics_piece *piece)
{
    return piece + 1 < excitation->pieces + excitation->count ? piece[1].start : 1;
}

/* Sets what is held and what carries, from the state; the films that follow the flanks, where delta
   has jumped; and what is held and carries when the held flank lets go. */
void dynamics_run_find_films(dynamics_run *r);
void dynamics_run_follow_flanks(dynamics_run *r);
void dynamics_run_release_flank(dynamics_run *r);

/* One step while no flank is held. 0: it cannot be solved. */
int dynamics_run_step_in_oil(dynamics_run *r);

/* Carries the derivatives over a step of the series, whose responses to delta and rate are v (of
   delta) and w (of its rate); then those of the films follow from delta. */
void dynamics_run_carry_films(dynamics_run *r, const double v[2], const double w[2]);

/* The least load at which the held flank stays so, over a step of the series: its value at the
   start and its change over the step. */
void dynamics_run_holding_load(const dynamics_run *r, double end, double load[2]);

#endif
