/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interpolates a force over the roll angle, with jumps and loss of contact. */
#include "load-curve.h"

#include "../numerics/interval.h"
#include "../numerics/steffen.h"

#include <math.h>
#include <stddef.h>

size_t contact_pieces_find(size_t n, const double *angle, double least, contact_piece *pieces)
{
    size_t count = 0, first = 0;
    for (size_t i = 1; i <= n; i++) {
        if (i < n && angle[i] > angle[i - 1])
            continue;
        if (i - first >= 2 && angle[i - 1] - angle[first] > least)
            pieces[count++] = (contact_piece){first, i - 1, angle[first], angle[i - 1]};
        first = i;
    }
    return count;
}

double contact_pieces_make_ramps(size_t count, contact_piece *pieces, double width)
{
    double most = HUGE_VAL;
    if (count < 2)
        return most;
    for (size_t i = 0; i < count; i++) {
        double length = pieces[i].to - pieces[i].from;
        most = fmin(most, i == 0 || i == count - 1 ? 2 * length : length);
    }
    for (size_t i = 0; i < count && width < most; i++) {
        pieces[i].from += i > 0 ? width / 2 : 0;
        pieces[i].to -= i < count - 1 ? width / 2 : 0;
    }
    return most;
}

/* Extrapolates the line through the forces at `last` and at the previous station to the next two
   stations, which have no force, but not beyond `end`. `step` is the direction, 1 or -1. */
static void continue_line(const double *angle, const double *force, ptrdiff_t last, ptrdiff_t step,
                          ptrdiff_t end, double *value)
{
    double slope = (force[last] - force[last - step]) / (angle[last] - angle[last - step]);
    ptrdiff_t i = last + step;
    for (int count = 0; count < 2 && i != end && force[i] == 0; count++, i += step) {
        double line = force[last] + slope * (angle[i] - angle[last]);
        if (line < 0) /* if two lines meet at a station, the one nearer to 0 is used */
            value[i] = value[i] < 0 ? fmax(value[i], line) : line;
    }
}

void contact_load_continue(size_t count, const contact_piece *pieces, const double *angle,
                           const double *force, double *value)
{
    for (size_t k = 0; k < count; k++) {
        const ptrdiff_t first = (ptrdiff_t)pieces[k].first, last = (ptrdiff_t)pieces[k].last;
        for (ptrdiff_t i = first + 1; i < last; i++) {
            if (force[i - 1] > force[i] && force[i] > 0 && force[i + 1] == 0)
                continue_line(angle, force, i, 1, last + 1, value);
            if (force[i + 1] > force[i] && force[i] > 0 && force[i - 1] == 0)
                continue_line(angle, force, i, -1, first - 1, value);
        }
    }
}

/* The cubic through (x, y) with these slopes; x[0] <= at <= x[n-1]. */
static double cubic_at(size_t n, const double *x, const double *y, const double *slope, double at)
{
    size_t i = numerics_interval(n, x, at);
    double h = x[i + 1] - x[i], t = (at - x[i]) / h, rise = y[i + 1] - y[i];
    double d0 = h * slope[i] - rise, d1 = rise - h * slope[i + 1];
    /* cubic Hermite polynomial, as the chord plus the deviation from it */
    return y[i] + t * rise + t * (1 - t) * ((1 - t) * d0 + t * d1);
}

static double piece_value(const contact_load_curve *c, const contact_piece *p, double angle)
{
    size_t k = p->first;
    double value = cubic_at(p->last - k + 1, c->angle + k, c->value + k, c->slope + k,
                            fmin(fmax(angle, c->angle[k]), c->angle[p->last]));
    return value < 0 ? 0 : value; /* NaN passes here and is refused by contact_history_set */
}

double contact_load_at(const contact_load_curve *c, double angle)
{
    size_t k = 0;
    while (k + 1 < c->piece_count && angle >= c->pieces[k + 1].from)
        k++;
    const contact_piece *p = &c->pieces[k];
    if (angle <= p->to || k + 1 == c->piece_count)
        return piece_value(c, p, angle);
    double before = piece_value(c, p, p->to), after = piece_value(c, p + 1, p[1].from);
    return before + (after - before) * (angle - p->to) / (p[1].from - p->to);
}

double contact_load_end(const contact_load_curve *c, size_t i)
{
    if ((c->value[i] > 0) == (c->value[i + 1] > 0) || !(c->angle[i] < c->angle[i + 1]))
        return NAN;
    double loaded = c->angle[c->value[i] > 0 ? i : i + 1],
           unloaded = c->angle[c->value[i] > 0 ? i + 1 : i];
    for (double middle = (loaded + unloaded) / 2; middle != loaded && middle != unloaded;
         middle = (loaded + unloaded) / 2)
        *(contact_load_at(c, middle) > 0 ? &loaded : &unloaded) = middle;
    return unloaded;
}

double contact_load_error(const contact_load_curve *c)
{
    double worst = 0;
    for (size_t k = 0; k < c->piece_count; k++) {
        for (size_t i = c->pieces[k].first; i + 6 <= c->pieces[k].last; i++) {
            double x[4], y[4], slope[4];
            for (size_t j = 0; j < 4; j++) { /* the cubic goes through the stations i, i + 2, i + 4,
                                                i + 6 */
                x[j] = c->angle[i + 2 * j];
                y[j] = c->value[i + 2 * j];
            }
            numerics_steffen_slopes(4, x, y, slope);
            double coarse = cubic_at(4, x, y, slope, c->angle[i + 3]);
            worst = fmax(worst, fabs(fmax(coarse, 0) - fmax(c->value[i + 3], 0)) / 4);
        }
    }
    return worst;
}
