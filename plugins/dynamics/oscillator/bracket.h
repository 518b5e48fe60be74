/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A root between two points of different sign, by false position. The Illinois variant (Dowell &
 * Jarratt 1971, A modified regula falsi method, BIT 11, 168-174) halves the value at an end that
 * stays twice, so that both ends close in on the root.
 */
#ifndef DYNAMICS_BRACKET_H
#define DYNAMICS_BRACKET_H

typedef struct dynamics_bracket {
    double low, f_low, high, f_high; /* points and their values, which differ in sign */
    int moved;                       /* the end that moved last: 1 low, -1 high, 0 none yet */
} dynamics_bracket;

/* Where the secant through both ends is 0. */
double dynamics_bracket_secant(const dynamics_bracket *b);

/* Puts the end of the same sign as `value` to the point x. */
void dynamics_bracket_narrow(dynamics_bracket *b, double x, double value);

#endif
