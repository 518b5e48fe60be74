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

/* Finds the pieces of n >= 2 angles that do not decrease, but for those up to `least` long, whose
   jumps become one; pieces holds n/2. Gives their number. */
size_t contact_pieces_find(size_t n, const double *angle, double least, contact_piece *pieces);

/* Makes room for ramps of the given width. Gives the greatest width that would fit (HUGE_VAL
   without a jump); the pieces are changed only when `width` is less. */
double contact_pieces_cut(size_t count, contact_piece *pieces, double width);

/* Slopes of Steffen's monotone cubic; n >= 2 increasing x. */
void contact_monotone_slopes(size_t n, const double *x, const double *y, double *slope);

/* The cubic through (x, y) with these slopes; x[0] <= at <= x[n-1]. */
double contact_monotone_value(size_t n, const double *x, const double *y, const double *slope,
                              double at);

/* Rank of the last entry of the n that do not decrease which is <= at, at most n - 2. */
size_t contact_interval(size_t n, const double *x, double at);

/* The negative parts of a curve are cut off: max(0, .), with ramps between the values cut off. */
typedef struct contact_load_curve {
    size_t n, piece_count;
    const double *angle, *value, *slope; /* n */
    const contact_piece *pieces;
} contact_load_curve;

double contact_load_at(const contact_load_curve *curve, double angle);

/* Error of the cubic, from leaving out every other station: greatest deviation at those left out,
   over 4, since the cubic is at least of second order. */
double contact_load_error(const contact_load_curve *curve);

#endif
