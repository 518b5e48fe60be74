/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far one answer is from another: relative, at the points of the reference. */
#include "compare.h"

#include <math.h>
#include <stdlib.h>

double ff_largest(const double *values, size_t count)
{
    double most = 0;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, fabs(values[i]));
    return most;
}

/* Where a series is small, a tenth of its largest value takes over: a friction that changes its
   sign has no error relative to its zero. */
double ff_scale(double value, double most, size_t rank)
{
    return fmax(rank ? fmax(fabs(value), 0.1 * most) : fabs(value), 1e-300);
}

/* Straight lines between the points, constant beyond the ends; of two values at one place (a jump)
   the left or the right one. */
double ff_interpolate(const ff_series *s, double x, bool right)
{
    size_t low = 0, high = s->count; /* the first point at or, for the right value, behind x */
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (s->at[middle] < x || (right && s->at[middle] <= x))
            low = middle + 1;
        else
            high = middle;
    }
    if (right && low > 0 && s->at[low - 1] == x)
        return s->value[low - 1];
    if (low == s->count)
        return s->value[s->count - 1];
    if (low == 0 || s->at[low] == x)
        return s->value[low];
    double share = (x - s->at[low - 1]) / (s->at[low] - s->at[low - 1]);
    return s->value[low - 1] + share * (s->value[low] - s->value[low - 1]);
}

/* The length that point i stands for in a mean. */
static double weight(const ff_series *s, size_t i)
{
    size_t last = s->count - 1;
    if (!s->at || last == 0)
        return 1;
    return (s->at[i < last ? i + 1 : last] - s->at[i > 0 ? i - 1 : 0]) / 2;
}

bool ff_compare(const ff_series *answer, const ff_series *reference, ff_difference *d)
{
    double most = ff_largest(reference->value, reference->count), sum = 0, length = 0;
    bool placed = answer->at && reference->at;
    *d = (ff_difference){.largest = 0};
    if (answer->rank != reference->rank || answer->count == 0 || reference->count == 0 ||
        (!placed && answer->count != reference->count))
        return false;
    for (size_t i = 0; i < reference->count; i++) {
        bool right = placed && i > 0 && reference->at[i] == reference->at[i - 1];
        double value = placed ? ff_interpolate(answer, reference->at[i], right) : answer->value[i];
        double off = fabs(value - reference->value[i]);
        off = off > 0 ? off / ff_scale(reference->value[i], most, reference->rank) : off;
        if (off > d->largest) {
            d->largest = off;
            d->where = i;
        }
        if (!isfinite(off))
            return false;
        sum += weight(reference, i) * off * off;
        length += weight(reference, i);
    }
    d->rms = length > 0 ? sqrt(sum / length) : d->largest;
    return true;
}
