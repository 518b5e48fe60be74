/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tracks of the back flanks and of free flight. */
#include "tracks.h"

#include "spring.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

/* Phases that differ by at most this are equal. */
static const double round_off = 1e-12;

static double error_at(const dynamics_piece *p, double phase)
{
    return dynamics_piece_value(p->e, p->degree, phase - p->start);
}

/* Returns the smallest difference of the errors of driving and back flanks at SAMPLES points in
   each piece. A hundredth of the range is subtracted to allow for smaller values between these
   points. */
static double least_room(const dynamics_excitation *x)
{
    enum { SAMPLES = 8 };
    double low = INFINITY, high = -INFINITY;
    for (int k = 0; k < 2; k++) {
        const dynamics_track own = dynamics_track_of(x, k ? 1 : -1);
        for (size_t i = 0; i < own.count; i++)
            for (int j = 0; j <= SAMPLES; j++) {
                const double phase = own.pieces[i].start + own.pieces[i].length * j / SAMPLES;
                const dynamics_piece *other =
                    dynamics_track_piece(dynamics_track_of(x, k ? -1 : 1), phase, j == SAMPLES);
                const double here = error_at(&own.pieces[i], phase), there = error_at(other, phase);
                low = fmin(low, k ? here - there : there - here);
                high = fmax(high, k ? here - there : there - here);
            }
    }
    return low - 0.01 * (high - low);
}

int dynamics_tracks_add_back(dynamics_excitation *x, const dynamics_mesh_curves *curves,
                             const dynamics_spring_nodes *spring)
{
    dynamics_excitation back = *x;
    if (!dynamics_excitation_build_bent(&back, curves, spring))
        return 0;
    for (size_t i = 0; i < back.count; i++)
        for (int k = 0; k <= DYNAMICS_DEGREE; k++)
            back.pieces[i].e[k] = -back.pieces[i].e[k];
    x->back = (dynamics_track){back.pieces, back.count};
    x->k_max = fmax(x->k_max, back.k_max);
    x->back_room = least_room(x);
    return 1;
}

double dynamics_back_lowest(const dynamics_excitation *x)
{
    double lowest = INFINITY;
    for (size_t i = 0; i < x->back.count; i++) {
        const dynamics_piece *p = &x->back.pieces[i];
        lowest = fmin(lowest, -fmax(p->e[0], error_at(p, p->start + p->length)));
    }
    return lowest;
}

/* Adds `share` times the error e of the flank to the e of the piece `to`. */
static void add_error(const dynamics_track *flank, double share, double phase, double length,
                      dynamics_piece *to)
{
    const dynamics_piece *p = dynamics_track_piece(*flank, phase + 0.5 * length, 0);
    double e[DYNAMICS_DEGREE + 1] = {0};
    dynamics_piece_shift(p->e, p->degree, phase - p->start, 1, e);
    for (int k = 0; k <= p->degree; k++)
        to->e[k] += share * e[k];
    to->degree = p->degree > to->degree ? p->degree : to->degree;
}

int dynamics_tracks_add_flight(dynamics_excitation *x, double share)
{
    const dynamics_track driving = dynamics_track_of(x, 1), back = x->back;
    dynamics_piece *pieces = calloc(driving.count + back.count, sizeof *pieces);
    size_t i = 0, k = 0, n = 0;
    if (!pieces)
        return 0;
    for (double at = 0; at < 1 - round_off; n++) {
        while (i + 1 < driving.count && driving.pieces[i + 1].start <= at + round_off)
            i++;
        while (k + 1 < back.count && back.pieces[k + 1].start <= at + round_off)
            k++;
        const double end = fmin(i + 1 < driving.count ? driving.pieces[i + 1].start : 1,
                                k + 1 < back.count ? back.pieces[k + 1].start : 1);
        assert(n < driving.count + back.count && end > at);
        pieces[n].start = at;
        pieces[n].length = end - at;
        pieces[n].degree = 1;
        add_error(&driving, 1 - share, at, end - at, &pieces[n]);
        add_error(&back, share, at, end - at, &pieces[n]);
        at = end;
    }
    x->flight = (dynamics_track){pieces, n};
    x->flight_share = share;
    for (size_t j = 0; j < n; j++)
        pieces[j].jump = fabs(error_at(&pieces[j ? j - 1 : n - 1], j ? pieces[j].start : 1) -
                              pieces[j].e[0]) > round_off;
    return 1;
}
