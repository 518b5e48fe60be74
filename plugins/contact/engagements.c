/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engagements.h"

#include <math.h>

/*
 * A motion that nearly repeats itself after 2, 3 or 4 cycles would show equal steps always the same
 * side of it; the place within each part therefore moves on by the golden section, whose multiples
 * fill every part of the unit evenly (Kronecker's sequence; Niederreiter 1992, ch. 3).
 */
size_t contact_engagements_pick(size_t had, size_t most, size_t *picked)
{
    const double golden = 0.61803398874989485;
    size_t count = had < most ? had : most;
    for (size_t i = 0, next = 0; i < count; i++) {
        double share = fmod(golden * (double)i, 1);
        size_t pick = (size_t)(((double)i + share) * (double)had / (double)count);
        size_t last = had - (count - i); /* leaves one for each to come */
        pick = pick < next ? next : pick > last ? last : pick;
        picked[i] = count == had ? i : pick;
        next = pick + 1;
    }
    return count;
}
