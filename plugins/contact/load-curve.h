/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A quantity given at stations along the path of contact, as a function of the roll angle. An
 * angle that stands twice in a row marks a jump; between jumps the values are joined by a
 * monotone cubic, and a jump is replaced by a linear ramp centred on it.
 */
#ifndef CONTACT_LOAD_CURVE_H
#define CONTACT_LOAD_CURVE_H

#include <stdbool.h>
#include <stddef.h>

/* Stations first to last lie between two jumps; the cubic holds from `from` to `to`. */
typedef struct contact_piece {
    size_t first, last;
    double from, to;
} contact_piece;

/* Finds the pieces of n >= 2 angles that do not decrease, and gives their number; `pieces` holds
   n/2. Pieces up to `least` long are left out, so that the jumps at their ends become one. */
size_t contact_pieces_find(size_t n, const double *angle, double least, contact_piece *pieces);

/* Shortens the pieces by ramps of the given width. Gives the greatest width that would fit
   (HUGE_VAL without a jump); the pieces are changed only when `width` is less than that. */
double contact_pieces_make_ramps(size_t count, contact_piece *pieces, double width);

/* Where a force falls towards stations at which it is 0, or rises from them, the line of its last
   or first two stations carries on below 0 at the next two: the curve, which is cut off at 0, ends
   and begins where they point, and not at the station without force. `value` has the forces before.
 */
void contact_load_continue(size_t count, const contact_piece *pieces, const double *angle,
                           const double *force, double *value);

/* The curve is cut off at 0, and the ramps join the values that are left. */
typedef struct contact_load_curve {
    size_t n, piece_count;
    const double *angle, *value, *slope; /* n */
    const contact_piece *pieces;
} contact_load_curve;

/* The value of the curve at that roll angle. */
double contact_load_at(const contact_load_curve *curve, double angle);

/* Where the load ends or begins between stations i and i + 1: the angle without load next to those
   with load; NAN: it does neither. */
double contact_load_end(const contact_load_curve *curve, size_t i);

/* Error estimate of the cubic: the largest deviation of the cubic through every other station at
   those left out, over 4, since the cubic is at least of second order. */
double contact_load_error(const contact_load_curve *curve);

#endif
