/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of a motion inside a mesh cycle, shared by flow.c, flow-gates.c and flow-film.c (steps
   with oil between the flanks). */
#ifndef DYNAMICS_FLOW_RUN_H
#define DYNAMICS_FLOW_RUN_H

#include "../excitation/spring.h"
#include "../excitation/tracks.h"
#include "flow.h"

typedef struct dynamics_run {
    const dynamics_flow *flow;
    const dynamics_excitation *excitation;
    const dynamics_piece *piece;
    double T, at, end; /* duration of the cycle, current phase, phase at the end of the step */
    int side, pressed; /* see oscillator-state.h; with oil, `side` is the flank that is held */
    int band;          /* band of the spring (spring.h) */
    int open[2];       /* with oil: whether the film of each flank carries load */
    double stride;     /* with oil: proposed duration of the next step */
    int idle;
    int variation;
    dynamics_state *y;
    const dynamics_observer *observer;
} dynamics_run;

/* A gate is a condition that holds while its polynomial p is not negative. When p becomes negative,
   the contact changes to (side, pressed); at a knee only the band of the spring changes. */
enum { DYNAMICS_RUN_GATES = 4 };
typedef struct dynamics_gate {
    double p[DYNAMICS_ORDER_MAX + 1];
    int side, pressed, knee, band;
} dynamics_gate;

/* A change of contact is idle if it comes less than dynamics_slip (rad) after the previous one.
   After DYNAMICS_MAX_IDLE idle changes in a row the contact is kept for that time. */
enum { DYNAMICS_MAX_IDLE = 6 };
static const double dynamics_slip = 1e-6;

static inline double dynamics_run_stiffness(const dynamics_run *r)
{
    return dynamics_piece_value(r->piece->k, r->piece->degree, r->at - r->piece->start);
}

/* Returns the phase at which a piece ends. */
static inline double dynamics_piece_end(const dynamics_excitation *excitation,
                                        const dynamics_piece *piece)
{
    const dynamics_track track = dynamics_track_with(excitation, piece);
    return piece + 1 < track.pieces + track.count ? piece[1].start : 1;
}

/* Returns whether the step is too short to reach the edge of the gap. */
int dynamics_run_misses_edge(const dynamics_run *r, const dynamics_taylor_series *s, double tiny);

/* Finds the first change of contact within the step. Returns its x and sets its gate; returns -1 if
   there is none. */
double dynamics_run_find_event(const dynamics_run *r, const dynamics_taylor_series *s,
                               dynamics_gate g[DYNAMICS_RUN_GATES], const dynamics_gate **which);

/* Update the contact with oil. find_films sets the held flank and the films that carry load, from
   the state. follow_flanks sets the films without load after a jump of delta. release_flank
   releases the held flank and starts the films. */
void dynamics_run_find_films(dynamics_run *r);
void dynamics_run_follow_flanks(dynamics_run *r);
void dynamics_run_release_flank(dynamics_run *r);

/* Takes one step while no flank is held. Returns 0 if the step has no solution. */
int dynamics_run_step_in_oil(dynamics_run *r);

/* Advances the derivatives over a step of the Taylor series. v and w are the responses of delta and
   of the rate to (delta, rate). The derivatives of the films follow from that of delta. */
void dynamics_run_carry_films(dynamics_run *r, const double v[2], const double w[2]);

/* Computes the smallest load that keeps the flank held: its value at the start of a Taylor step,
   and its change over the step. */
void dynamics_run_holding_load(const dynamics_run *r, double end, double load[2]);

#endif
