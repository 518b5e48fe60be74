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

/* Finds the pieces of n >= 2 angles that do not decrease, and returns their number; `pieces` has
 * room for n/2. Pieces not longer than `least` are left out, so that the jumps at their ends
 * become one. */
size_t contact_pieces_find(size_t n, const double *angle, double least, contact_piece *pieces);

/* Shortens the pieces to make room for ramps of the given width. Returns the greatest width that
 * would fit (HUGE_VAL without a jump); the pieces change only if `width` is less than that. */
double contact_pieces_make_ramps(size_t count, contact_piece *pieces, double width);

/* Continues a force that falls to stations where it is 0, or rises from them: the line through
 * its last or first two stations continues to negative values at the next two stations. The
 * curve, cut off at 0, then ends and begins where these lines cross 0, and not at a station
 * without force. On entry, `value` has the forces. */
void contact_load_continue(size_t count, const contact_piece *pieces, const double *angle,
                           const double *force, double *value);

/* The curve is cut off at 0; the ramps join the remaining values. */
typedef struct contact_load_curve {
    size_t n, piece_count;
    const double *angle, *value, *slope; /* n */
    const contact_piece *pieces;
} contact_load_curve;

/* Returns the value of the curve at that roll angle. */
double contact_load_at(const contact_load_curve *curve, double angle);

/* Returns the angle between stations i and i + 1 at which the load ends or begins, on the side
 * without load; NAN: it does neither. */
double contact_load_end(const contact_load_curve *curve, size_t i);

/* Error estimate of the cubic. A cubic through every other station is compared with the stations
 * left out; the largest deviation is divided by 4, since the cubic is at least of second order. */
double contact_load_error(const contact_load_curve *curve);

#endif
