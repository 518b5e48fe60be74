/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "jump.h"

#include <math.h>

enum { INTERVALS = 256, HALVINGS = 80 };

/* smallest jump to report, relative to the value: a law may join its pieces with rounded
   constants */
static const double least = 1e-6;

typedef struct point {
    double x, value, slope; /* slope 0: the law gives no slope */
} point;

static point point_at(const conformance_line *l, double x)
{
    double out[CONFORMANCE_RESULTS];
    point p = {.x = x, .value = conformance_value_at(l, x, out)};
    for (size_t i = 1; i < l->function->result_count; i++)
        if (l->function->by[i] == l->axis)
            p.slope = out[i];
    return p;
}

static double unexplained(point a, point b)
{
    return fabs(b.value - a.value - (b.x - a.x) * (a.slope + b.slope) / 2);
}

static double size_of(point a, point b)
{
    return fmax(fabs(a.value), fabs(b.value));
}

static bool is_jump(const conformance_line *l, point a, point b, conformance_jump *jump)
{
    if (!(unexplained(a, b) > least / 10 * size_of(a, b)))
        return false;
    for (int i = 0; i < HALVINGS; i++) {
        point middle = point_at(l, a.x + (b.x - a.x) / 2);
        if (middle.x <= a.x || middle.x >= b.x)
            break;
        if (unexplained(a, middle) > unexplained(middle, b))
            b = middle;
        else
            a = middle;
    }
    *jump = (conformance_jump){.at = b.x, .before = a.value, .after = b.value};
    return fabs(b.value - a.value) > least * size_of(a, b);
}

bool conformance_find_jump(const conformance_line *l, conformance_jump *jump)
{
    const conformance_axis *axis = l->function->axes[l->axis];
    bool below = axis->logarithmic && axis->extremes[0] < 0; /* the axis continues below 0 */
    point last = point_at(l, below ? -axis->low : axis->low);
    bool found = false;
    for (int i = below ? 0 : 1; i <= INTERVALS && !found; i++) {
        double share = (double)i / INTERVALS;
        point next = point_at(l, axis->logarithmic ? axis->low * pow(axis->high / axis->low, share)
                                                   : axis->low + share * (axis->high - axis->low));
        found = is_jump(l, last, next, jump);
        last = next;
    }
    return found;
}
