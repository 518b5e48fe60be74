/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interpolates tables over one mesh cycle. */
#include "interpolation.h"

#include "../numerics/steffen.h"

#include "cycle.h"

#include <math.h>
#include <stdlib.h>

static const char *check(size_t count, const double *phase, size_t *bad)
{
    for (size_t i = 0; i < count; i++) {
        *bad = i;
        if (!(phase[i] >= 0 && phase[i] <= 1))
            return "a phase must lie between 0 and 1";
        if ((phase[i] > 0 && phase[i] < STIFFNESS_PHASE_TOLERANCE) ||
            (phase[i] < 1 && phase[i] > 1 - STIFFNESS_PHASE_TOLERANCE))
            return "a phase within 1e-9 of 0 or 1 must be written as 0 or 1";
        if (i > 0 && phase[i] < phase[i - 1])
            return "the phases must not decrease";
        if (i > 0 && phase[i] > phase[i - 1] && phase[i] < phase[i - 1] + STIFFNESS_PHASE_TOLERANCE)
            return "two phases closer than 1e-9 must be equal, which marks a jump";
        if (i > 1 && !(phase[i] > phase[i - 2]))
            return "a phase may be given at most twice, with the values before and after a jump";
    }
    *bad = count ? count - 1 : 0;
    size_t ends = 0;
    for (size_t i = 0; i < count; i++)
        ends += phase[i] <= 0 || phase[i] >= 1;
    return ends > 2 ? "phases 0 and 1 may have at most two values together, since phase 1 is phase "
                      "0 of the next cycle"
                    : NULL;
}

const char *stiffness_table_phases_make(stiffness_table_phases *points, size_t count,
                                        const double *phase, size_t *bad)
{
    const char *why = check(count, phase, bad);
    if (why)
        return why;
    if (count == 0)
        return "at least one phase is needed";
    points->phase = malloc(count * sizeof *points->phase);
    points->before = malloc(count * sizeof *points->before);
    points->after = malloc(count * sizeof *points->after);
    points->count = 0;
    if (!points->phase || !points->before || !points->after) {
        stiffness_table_phases_free(points);
        return "";
    }
    size_t n = 0, last = count - 1;
    bool at_0 = phase[0] <= 0, at_1 = phase[last] >= 1;
    /* the value before phase 1 is the first sample at phase 1; the value after it is the last
       sample at phase 0 or, without one, at phase 1 */
    if (at_1) {
        size_t first = count > 1 && phase[last - 1] >= 1 ? last - 1 : last;
        points->phase[n] = 0;
        points->before[n] = first;
        points->after[n++] = at_0 ? 0 : last;
    }
    for (size_t i = at_0 && at_1 ? 1 : 0; i < count && phase[i] < 1; i++) {
        if (n > 0 && i > 0 && !(phase[i] > phase[i - 1])) {
            points->after[n - 1] = i;
            continue;
        }
        points->phase[n] = phase[i];
        points->before[n] = points->after[n] = i;
        n++;
    }
    points->count = n;
    return NULL;
}

void stiffness_table_phases_free(stiffness_table_phases *points)
{
    free(points->phase);
    free(points->before);
    free(points->after);
    *points = (stiffness_table_phases){0};
}

/* The piece between two neighbouring breakpoints that contains `phase`; the last piece wraps
 * around. */
typedef struct piece {
    size_t from, to;
    double length, t; /* t: 0 at `from`, 1 at `to` */
} piece;

static double length_after(const stiffness_table_phases *points, size_t i)
{
    if (i + 1 < points->count)
        return points->phase[i + 1] - points->phase[i];
    return points->phase[0] + (1 - points->phase[i]);
}

/* Finds the piece of a phase. At a breakpoint, `side` chooses between the pieces before and
 * after it. */
static piece find(const stiffness_table_phases *points, double phase, int side)
{
    /* breakpoints with an index below `high` are at or before the phase */
    size_t low = 0, high = points->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        double at = points->phase[middle];
        if (side == STIFFNESS_ABOVE ? at <= phase : at < phase)
            low = middle + 1;
        else
            high = middle;
    }
    piece p = {.from = (low > 0 ? low : points->count) - 1};
    p.to = p.from + 1 < points->count ? p.from + 1 : 0;
    p.length = length_after(points, p.from);
    double into = phase - points->phase[p.from]; /* negative before the first breakpoint */
    p.t = fmin(fmax((low > 0 ? into : into + 1) / p.length, 0), 1);
    return p;
}

double stiffness_linear_at(const stiffness_table_phases *points, const double *value, double phase,
                           int side)
{
    piece p = find(points, phase, side);
    return (1 - p.t) * value[points->after[p.from]] + p.t * value[points->before[p.to]];
}

/* Returns the difference between the values at the ends of the piece. */
static double difference(const stiffness_table_phases *points, const double *value, size_t from)
{
    size_t to = from + 1 < points->count ? from + 1 : 0;
    return value[points->before[to]] - value[points->after[from]];
}

void stiffness_steffen_slopes(const stiffness_table_phases *points, const double *value,
                              double *before, double *after)
{
    size_t n = points->count;
    for (size_t i = 0; i < n; i++) {
        size_t back = (i + n - 1) % n, back2 = (i + n + n - 2) % n, next = (i + 1) % n;
        double h0 = length_after(points, back), h1 = length_after(points, i);
        double s0 = difference(points, value, back) / h0, s1 = difference(points, value, i) / h1;
        if (!stiffness_jumps_at(points, value, i)) {
            before[i] = after[i] = numerics_steffen_inner(h0, s0, h1, s1);
            continue;
        }
        double hb = length_after(points, back2), hn = length_after(points, next);
        before[i] = stiffness_jumps_at(points, value, back)
                        ? s0
                        : numerics_steffen_end(h0, s0, hb, difference(points, value, back2) / hb);
        after[i] = stiffness_jumps_at(points, value, next)
                       ? s1
                       : numerics_steffen_end(h1, s1, hn, difference(points, value, next) / hn);
    }
}

double stiffness_cubic_at(const stiffness_table_phases *points, const double *value,
                          const double *slope_before, const double *slope_after, double phase,
                          int side)
{
    piece p = find(points, phase, side);
    double t = p.t, u = 1 - t; /* Hermite basis */
    double a = value[points->after[p.from]], b = value[points->before[p.to]];
    double da = p.length * slope_after[p.from], db = p.length * slope_before[p.to];
    return u * u * (1 + 2 * t) * a + t * t * (1 + 2 * u) * b + t * u * (u * da - t * db);
}

bool stiffness_jumps_at(const stiffness_table_phases *points, const double *value, size_t i)
{
    double a = value[points->before[i]], b = value[points->after[i]];
    return a < b || b < a;
}

bool stiffness_slope_changes_at(const stiffness_table_phases *points, const double *value, size_t i)
{
    size_t back = (i + points->count - 1) % points->count;
    double h0 = length_after(points, back), h1 = length_after(points, i);
    double slope_change = difference(points, value, i) / h1 - difference(points, value, back) / h0;
    double size = fabs(value[points->before[i]]) + fabs(value[points->after[i]]);
    return stiffness_jumps_at(points, value, i) || fabs(slope_change) * fmin(h0, h1) > 1e-12 * size;
}
