/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds a root between two points with values of different sign by false position. The Illinois
   variant (Dowell & Jarratt 1971, A modified regula falsi method, BIT 11, 168-174) halves the value
   at an end that is retained twice, so that both ends converge to the root. */
#ifndef NUMERICS_BRACKET_H
#define NUMERICS_BRACKET_H

#include <assert.h>

typedef struct numerics_bracket {
    double low, f_low, high, f_high; /* points and their values, which differ in sign */
    int moved;                       /* the end that moved last: 1 low, -1 high, 0 none yet */
} numerics_bracket;

/* Returns the point at which the secant through both ends is 0. */
static inline double numerics_bracket_secant(const numerics_bracket *b)
{
    assert(!(b->f_low * b->f_high > 0));
    return b->high - b->f_high * (b->high - b->low) / (b->f_high - b->f_low);
}

/* Moves the end whose value has the sign of `value` to the point x. */
static inline void numerics_bracket_narrow(numerics_bracket *b, double x, double value)
{
    if ((value < 0) == (b->f_low < 0)) {
        b->low = x;
        b->f_low = value;
        b->f_high *= b->moved == 1 ? 0.5 : 1;
        b->moved = 1;
    } else {
        b->high = x;
        b->f_high = value;
        b->f_low *= b->moved == -1 ? 0.5 : 1;
        b->moved = -1;
    }
}

#endif
