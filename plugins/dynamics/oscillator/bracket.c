/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bracket.h"

#include <assert.h>

double dynamics_bracket_secant(const dynamics_bracket *b)
{
    assert(!(b->f_low * b->f_high > 0));
    return b->high - b->f_high * (b->high - b->low) / (b->f_high - b->f_low);
}

void dynamics_bracket_narrow(dynamics_bracket *b, double x, double value)
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
