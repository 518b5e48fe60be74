/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Relative difference of two answers at the points of the reference. */
#include "compare.h"

#include "../memory/memory.h"
#include "estimate.h"

#include <math.h>
#include <stdlib.h>

/* Errors of a series are relative to its value, or to a tenth of its largest value where the value
   is smaller: where a value passes through zero, such as a friction that changes its sign, a
   relative error has no meaning. */
void accuracy_error_scales(const accuracy_series *answer, double *scales)
{
    double most = 0;
    for (size_t i = 0; i < answer->count; i++)
        most = fmax(most, fabs(answer->value[i] - answer->zero_point));
    for (size_t i = 0; i < answer->count; i++) {
        const double own = fabs(answer->value[i] - answer->zero_point);
        scales[i] = answer->absolute ? 1 : fmax(answer->rank ? fmax(own, 0.1 * most) : own, 1e-300);
    }
}

double accuracy_relative(const double *off, const accuracy_series *answer, double *largest)
{
    double *shares = memory_alloc(answer->count * sizeof *shares);
    accuracy_error_scales(answer, shares);
    *largest = 0;
    for (size_t i = 0; i < answer->count; i++) {
        shares[i] = off[i] > 0 ? off[i] / shares[i] : 0;
        *largest = fmax(*largest, shares[i]);
    }
    double typical = accuracy_typical(shares, answer->at, answer->count);
    free(shares);
    return typical;
}

/* Interpolates linearly between the points; constant beyond the ends. Where two points have the
   same place (a jump), `right` selects the value on the right. */
double accuracy_interpolate(const accuracy_series *s, double x, bool right)
{
    size_t low = 0, high = s->count; /* `high`: the first point at x, or the first after x for
                                        the value on the right */
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

static bool same_form(const accuracy_series *a, const accuracy_series *b)
{
    return a->rank == b->rank && a->count > 0 && b->count > 0 &&
           ((a->at && b->at) || a->count == b->count);
}

double accuracy_value_at(const accuracy_series *s, const accuracy_series *points, size_t i)
{
    if (!s->at || !points->at)
        return s->value[i];
    return accuracy_interpolate(s, points->at[i], i > 0 && points->at[i - 1] == points->at[i]);
}

bool accuracy_compare(const accuracy_series *answer, const accuracy_series *reference,
                      accuracy_difference *d)
{
    accuracy_series scaled = *reference;
    bool finite = true, zero = true;
    *d = (accuracy_difference){.largest = 0};
    if (!same_form(answer, reference))
        return false;
    double *off = memory_alloc(reference->count * sizeof *off);
    for (size_t i = 0; i < reference->count; i++) {
        off[i] = fabs(accuracy_value_at(answer, reference, i) - reference->value[i]);
        finite = finite && isfinite(off[i]);
        zero = zero && reference->value[i] == reference->zero_point;
    }
    scaled.absolute = d->absolute = reference->absolute || zero;
    d->typical = accuracy_relative(off, &scaled, &d->largest);
    free(off);
    return finite;
}
