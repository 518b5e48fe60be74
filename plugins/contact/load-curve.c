/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "load-curve.h"

#include "../numerics/interval.h"

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

/* Steffen 1990, section 2.2: one-sided slope at the end of the interval of length h0 and secant s0,
   whose neighbour has h1 and s1. */
static double end_slope(double h0, double h1, double s0, double s1)
{
    double p = s0 + (s0 - s1) * h0 / (h0 + h1);
    if (p * s0 <= 0)
        return 0;
    return fabs(p) > 2 * fabs(s0) ? 2 * s0 : p;
}

/* Steffen 1990, Astron. Astrophys. 239, 443, eqs 8 and 11. */
void contact_monotone_slopes(size_t n, const double *x, const double *y, double *slope)
{
    if (n == 2) {
        slope[0] = slope[1] = (y[1] - y[0]) / (x[1] - x[0]);
        return;
    }
    double h0 = x[1] - x[0], s0 = (y[1] - y[0]) / h0;
    for (size_t i = 1; i + 1 < n; i++) {
        double h1 = x[i + 1] - x[i], s1 = (y[i + 1] - y[i]) / h1;
        double p = (s0 * h1 + s1 * h0) / (h0 + h1);
        if (i == 1)
            slope[0] = end_slope(h0, h1, s0, s1);
        slope[i] =
            (copysign(1, s0) + copysign(1, s1)) * fmin(fmin(fabs(s0), fabs(s1)), fabs(p) / 2);
        if (i + 2 == n)
            slope[n - 1] = end_slope(h1, h0, s1, s0);
        h0 = h1;
        s0 = s1;
    }
}

/* Continues the line of the forces at `last` and at the station before it, in the direction of
   `step`, over the two stations without force that follow it before `end`. */
static void continue_line(const double *angle, const double *force, ptrdiff_t last, ptrdiff_t step,
                          ptrdiff_t end, double *value)
{
    double slope = (force[last] - force[last - step]) / (angle[last] - angle[last - step]);
    ptrdiff_t i = last + step;
    for (int count = 0; count < 2 && i != end && force[i] == 0; count++, i += step) {
        double line = force[last] + slope * (angle[i] - angle[last]);
        if (line < 0) /* of two lines the one nearer to 0 */
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
    /* cubic Hermite polynomial as the chord and what departs from it */
    return y[i] + t * rise + t * (1 - t) * ((1 - t) * d0 + t * d1);
}

static double piece_value(const contact_load_curve *c, const contact_piece *p, double angle)
{
    size_t k = p->first;
    double value = cubic_at(p->last - k + 1, c->angle + k, c->value + k, c->slope + k,
                            fmin(fmax(angle, c->angle[k]), c->angle[p->last]));
    return value < 0 ? 0 : value; /* NaN passes, and is refused by contact_history_set */
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
            for (size_t j = 0; j < 4; j++) { /* stations i, i + 2, i + 4, i + 6 */
                x[j] = c->angle[i + 2 * j];
                y[j] = c->value[i + 2 * j];
            }
            contact_monotone_slopes(4, x, y, slope);
            double coarse = cubic_at(4, x, y, slope, c->angle[i + 3]);
            worst = fmax(worst, fabs(fmax(coarse, 0) - fmax(c->value[i + 3], 0)) / 4);
        }
    }
    return worst;
}
