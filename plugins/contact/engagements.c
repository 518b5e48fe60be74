/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Picks engagements evenly from a long motion. */
#include "engagements.h"

#include <assert.h>
#include <math.h>

/* If a motion nearly repeats after 2, 3 or 4 mesh cycles, equal steps would always pick the same
   phase of it. Therefore one engagement is picked in each of `most` equal parts, and its position
   within the part advances by the golden section, whose multiples fill the unit interval evenly
   (Kronecker's sequence; Niederreiter 1992, ch. 3). */
size_t contact_engagements_pick(size_t available, size_t most, size_t *picked)
{
    assert(most >= 1);
    const double golden = 0.61803398874989485;
    size_t count = available < most ? available : most;
    for (size_t i = 0, next = 0; i < count; i++) {
        double share = fmod(golden * (double)i, 1);
        size_t pick = (size_t)(((double)i + share) * (double)available / (double)count);
        size_t last = available - (count - i); /* leaves one for each remaining part */
        pick = pick < next ? next : pick > last ? last : pick;
        picked[i] = count == available ? i : pick;
        next = pick + 1;
    }
    return count;
}
