/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A quantity given at stations along the path of contact, as a function of the roll angle. A
 * repeated angle marks a jump. Between jumps the values are joined by a monotone cubic, and a
 * jump is replaced by a linear ramp centred on it. */
#ifndef CONTACT_LOAD_CURVE_H
#define CONTACT_LOAD_CURVE_H

#include <stdbool.h>
#include <stddef.h>

/* Stations first to last lie between two jumps; the cubic is used from `from` to `to`. */
typedef struct contact_piece {
    size_t first, last;
    double from, to;
} contact_piece;

/* Finds the pieces of n >= 2 non-decreasing angles and returns their number; `pieces` must have
   room for n/2. Pieces not longer than `least` are dropped; the jumps at their ends are merged. */
size_t contact_pieces_find(size_t n, const double *angle, double least, contact_piece *pieces);

/* Shortens the pieces to make room for ramps of the given width. Returns the largest width that
   fits (HUGE_VAL without a jump). The pieces are unchanged if `width` does not fit. */
double contact_pieces_make_ramps(size_t count, contact_piece *pieces, double width);

/* Extends a force beyond its last station with load: the line through the last two stations with
   load continues to negative values at the next two stations. The same is done before the first
   station with load. The curve is clipped at 0, so the load begins and ends where these lines cross
   0, and not at a station. On entry, `value` has the forces. */
void contact_load_continue(size_t count, const contact_piece *pieces, const double *angle,
                           const double *force, double *value);

/* The curve is clipped at 0; the ramps join the clipped values. */
typedef struct contact_load_curve {
    size_t n, piece_count;
    const double *angle, *value, *slope; /* n */
    const contact_piece *pieces;
} contact_load_curve;

/* Returns the value of the curve at that roll angle. */
double contact_load_at(const contact_load_curve *curve, double angle);

/* Returns the angle between stations i and i + 1 at which the load ends or begins; NAN if it does
   neither. The angle is on the side without load. */
double contact_load_end(const contact_load_curve *curve, size_t i);

/* Estimates the error of the cubic. A cubic through every other station is compared with the
   stations in between. The largest deviation is divided by 4, since the cubic is at least of second
   order. */
double contact_load_error(const contact_load_curve *curve);

#endif
