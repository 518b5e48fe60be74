/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "audit-compare.h"

#include <math.h>
#include <stdlib.h>

void ff_answer_free(ff_answer *answer)
{
    free(answer->at);
    free(answer->value);
}

/* The value of an answer at point i of another: straight lines between its points, constant beyond
   them; of two at one place, which are a jump, the one of the same side. */
static double value_at(const ff_answer *a, const ff_answer *points, size_t i)
{
    if (!a->at || !points->at)
        return a->value[i];
    double x = points->at[i];
    bool right = i > 0 && points->at[i - 1] == x;
    size_t low = 0, high = a->count; /* of the first point at x or, to the right, behind it */
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (a->at[middle] < x || (right && a->at[middle] == x))
            low = middle + 1;
        else
            high = middle;
    }
    if (right && low > 0 && a->at[low - 1] == x)
        return a->value[low - 1];
    if (low == a->count || low == 0 || a->at[low] == x)
        return a->value[low == a->count ? low - 1 : low];
    double share = (x - a->at[low - 1]) / (a->at[low] - a->at[low - 1]);
    return a->value[low - 1] + share * (a->value[low] - a->value[low - 1]);
}

static bool same_form(const ff_answer *a, const ff_answer *b)
{
    return a->series == b->series && a->count > 0 && b->count > 0 &&
           ((a->at && b->at) || a->count == b->count);
}

static double largest_of(const ff_answer *a)
{
    double most = 0;
    for (size_t i = 0; i < a->count; i++)
        most = fmax(most, fabs(a->value[i]));
    return most;
}

/* What a difference at point i is relative to. */
static double scale_of(const ff_answer *a, size_t i, double most)
{
    return fmax(a->series ? fmax(fabs(a->value[i]), 0.1 * most) : fabs(a->value[i]), 1e-300);
}

/* The length that point i stands for in a mean. */
static double weight_of(const ff_answer *a, size_t i)
{
    size_t last = a->count - 1;
    if (!a->at || last == 0)
        return 1;
    return (a->at[i < last ? i + 1 : last] - a->at[i > 0 ? i - 1 : 0]) / 2;
}

bool ff_answer_compare(const ff_answer *answer, const ff_answer *reference, ff_distance *d)
{
    double most, sum = 0, length = 0;
    *d = (ff_distance){0};
    if (!same_form(answer, reference))
        return false;
    most = largest_of(reference);
    for (size_t i = 0; i < reference->count; i++) {
        double off = fabs(value_at(answer, reference, i) - reference->value[i]);
        off = off > 0 ? off / scale_of(reference, i, most) : off;
        if (!isfinite(off))
            return false;
        d->largest = fmax(d->largest, off);
        sum += weight_of(reference, i) * off;
        length += weight_of(reference, i);
    }
    d->mean = length > 0 ? sum / length : d->largest;
    return true;
}

bool ff_answer_slope(const ff_answer *middle, const ff_answer *up, const ff_answer *down,
                     double *slope, bool *bent)
{
    double both = 0, above = 0, below = 0, length = 0, most;
    if (!same_form(up, middle) || !same_form(down, middle))
        return false;
    most = largest_of(middle);
    for (size_t i = 0; i < middle->count; i++) {
        double weight = weight_of(middle, i), part = weight / scale_of(middle, i, most);
        double high = value_at(up, middle, i), low = value_at(down, middle, i);
        both += part * fabs(high - low) / 2;
        above += part * fabs(high - middle->value[i]);
        below += part * fabs(low - middle->value[i]);
        length += weight;
    }
    if (!(length > 0) || !isfinite(above) || !isfinite(below))
        return false;
    *slope = both / length;
    *bent = fmax(above, below) > 2 * fmin(above, below) && fmax(above, below) > 1e-9 * length;
    return true;
}
