/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A track is a set of pieces of the mesh cycle that a motion follows. s is the dynamic transmission
 * error, e the static one (theory, section 4), delta = s - e. Driving flanks touch at s - e =
 * half_gap. Back flanks touch at s - e = -half_gap, with their own k, e (the negative of their
 * transmission error) and nodes. In free flight, a damper that also acts in the gap uses the e of
 * the driving flanks. If a fluctuating force presses the driving flanks and the back flanks in
 * turn, the damper uses a weighted mean of the e of both; with equal weights this mean is the
 * middle of the gap. On every track s = delta + e, and s and s' are continuous when the motion
 * changes to another track.
 *
 * If the back flanks have no track of their own, they are the mirror image of the driving flanks in
 * the middle of the gap.
 */
#ifndef DYNAMICS_TRACKS_H
#define DYNAMICS_TRACKS_H

#include "excitation.h"

struct dynamics_spring_nodes;

/* Returns the track of the driving flanks (1), of free flight (0) or of the back flanks (-1). */
static inline dynamics_track dynamics_track_of(const dynamics_excitation *x, int side)
{
    if (side < 0 && x->back.count)
        return x->back;
    if (side == 0 && x->flight.count)
        return x->flight;
    return (dynamics_track){x->pieces, x->count};
}

static inline int dynamics_track_holds(dynamics_track c, const dynamics_piece *p)
{
    return c.count && p >= c.pieces && p < c.pieces + c.count;
}

/* Returns the track that contains a piece. */
static inline dynamics_track dynamics_track_with(const dynamics_excitation *x,
                                                 const dynamics_piece *p)
{
    return dynamics_track_holds(x->back, p)     ? x->back
           : dynamics_track_holds(x->flight, p) ? x->flight
                                                : (dynamics_track){x->pieces, x->count};
}

/* Returns whether driving and back flanks have separate tracks. */
static inline int dynamics_tracks_differ(const dynamics_excitation *x)
{
    return x->back.count > 0;
}

/* Adds the track of the back flanks. `curves` are those of the back flanks over the phase of the
 * driving flanks, `spring` is their spring at the nodes (NULL: linear). Returns 0 if out of memory.
 */
int dynamics_tracks_add_back(dynamics_excitation *x, const dynamics_mesh_curves *curves,
                             const struct dynamics_spring_nodes *spring);

/* Returns the smallest transmission error of the back flanks at the nodes of their track. */
double dynamics_back_lowest(const dynamics_excitation *x);

/* Adds the track of free flight. Its e is the mean of the e of both flanks, with the weight `share`
 * for the back flanks; 0.5 is the middle of the gap. Returns 0 if out of memory. */
int dynamics_tracks_add_flight(dynamics_excitation *x, double share);

#endif
