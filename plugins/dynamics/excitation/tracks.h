/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Which pieces of the mesh cycle a motion follows. Driving flanks touch where s - e = half_gap and
 * bend by k and e of the pieces. Back flanks touch where s - e = -half_gap with an e of their own,
 * the negative of their transmission error, and k of their own, each with its own nodes. In free
 * flight a damper that acts always follows the e of the driving flanks, or, under a force that
 * presses both flanks in turn, a mean of both, which is the middle of the gap where neither
 * prevails. So s = delta + e on every track, and s and s' are continuous where one track takes over
 * from another.
 *
 * Without a track of the back flanks these mirror the driving ones in the middle of the gap.
 */
#ifndef DYNAMICS_TRACKS_H
#define DYNAMICS_TRACKS_H

#include "excitation.h"

struct dynamics_spring_nodes;

/* The track of the driving flanks (1), of free flight (0) or of the back flanks (-1). */
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

/* The track that a piece belongs to. */
static inline dynamics_track dynamics_track_with(const dynamics_excitation *x,
                                                 const dynamics_piece *p)
{
    return dynamics_track_holds(x->back, p)     ? x->back
           : dynamics_track_holds(x->flight, p) ? x->flight
                                                : (dynamics_track){x->pieces, x->count};
}

/* Whether driving and back flanks have tracks of their own. */
static inline int dynamics_tracks_differ(const dynamics_excitation *x)
{
    return x->back.count > 0;
}

/* Adds the track of the back flanks, from curves over the phase of the driving ones and the spring
 * at their nodes (NULL: it does not bend). 0: out of memory. */
int dynamics_tracks_add_back(dynamics_excitation *x, const dynamics_mesh_curves *curves,
                             const struct dynamics_spring_nodes *spring);

/* The least transmission error of the back flanks, at the nodes of their track. */
double dynamics_back_lowest(const dynamics_excitation *x);

/* Adds the track of free flight, with that share of the error of the back flanks in its own; 0.5:
 * in the middle of the gap. 0: out of memory. */
int dynamics_tracks_add_flight(dynamics_excitation *x, double share);

#endif
