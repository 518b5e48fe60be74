/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random numbers, and random values of parameters. */
#include "private.h"

#include <math.h>

double verify_uniform(verify_random *random)
{
    uint64_t z = random->state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

size_t verify_below(verify_random *random, size_t count)
{
    return (size_t)(verify_uniform(random) * (double)count);
}

/* Draws uniformly over the numbers, or over their logarithms if the range is more than two
   decades. */
static double between(verify_random *random, double low, double high)
{
    double share = verify_uniform(random);
    if (low > 0 && high / low > 100)
        return low * pow(high / low, share);
    if (low == 0 && high > 1e3)
        return high * pow(1e-9, share);
    return low + share * (high - low);
}

/* The result is in the row's unit. */
double verify_draw_number(const ff_param *row, verify_random *random, verify_range range)
{
    double low = row->low, high = row->high;
    bool at_limit = range == VERIFY_PHYSICAL && verify_below(random, 3) == 0;
    if (!(low < high) || range == VERIFY_PHYSICAL) {
        bool limited = row->min < row->max;
        low = limited && row->min > -1e6 ? row->min : -1e6;
        high = limited && row->max < 1e6 ? row->max : fmax(1e6, low);
        if (!limited)
            low = -1e6;
        if (limited && row->max > 1e6 && row->min >= 0)
            high = fmax(row->min, 1) * (range == VERIFY_PHYSICAL ? 1e9 : 1e3);
        if (high > row->max && limited)
            high = row->max;
    }
    if (at_limit && verify_below(random, 2) == 0 && !(row->flags & FF_MIN_OPEN))
        return low;
    if (at_limit && !(row->flags & FF_MAX_OPEN) && isfinite(high))
        return high;
    double number = between(random, low, high);
    return number > low ? number : low + 0.5 * (high - low);
}
