/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Probabilities and percentiles. The values of a cheap level are first put on the scale of level 0,
 * by the line through the samples on both. Then P(y <= t) = P(z <= t) + P(y <= t < z) - P(z <= t <
 * y): the first term uses the many samples of the cheap level, the others the few samples on both.
 * The interval is that of a sum of proportions: Wilson's for each, joined as in Newcombe 1998
 * (Stat. Med. 17, 873; MOVER). The interval of a percentile ends where the interval of the
 * probability contains the percentile's share (Woodruff 1952). */
#include "estimate.h"

#include "../../../../memory/memory.h"

#include <math.h>
#include <stdlib.h>

static const double z95 = 1.959963984540054;

enum { PRIOR = 10 };

/* The cheap values that have a partner on level 0, and the other cheap values. */
typedef struct pairs {
    double *y, *z, *all;      /* all: the cheap values of all samples */
    size_t pair_count, count; /* numbers of pairs, and of all cheap values */
    double opposite; /* share of pairs with y and z on different sides of the median, from their
                      * correlation */
} pairs;

/* The level for which the estimate of a probability near 1/2 has the smallest variance: two normal
   variates of correlation r lie on different sides of their median with probability acos(r) / pi. 0
   if no level is better than level 0 alone. */
static size_t companion(const estimate_samples *s, double *scale, double *shift, double *most)
{
    double least = 0.25 / (double)s->count[0];
    size_t best = 0;
    for (size_t k = 1; k < s->levels; k++) {
        estimate_moments m = estimate_pairs(s->values[0], s->values[k], s->count[0], NULL, 0);
        if (m.count < 3 || !(m.aa > 0 && m.bb > 0))
            continue;
        double r = fmin(1, fabs(m.ab) / sqrt(m.aa * m.bb)), opposite = acos(r) / acos(-1);
        double variance = opposite / (double)s->count[0] + 0.25 / (double)s->count[k];
        if (variance < least) {
            least = variance;
            *most = opposite;
            best = k;
            /* ratio of the spreads; the slope of the regression would make z narrower than level
               0 */
            *scale = copysign(sqrt(m.aa / m.bb), m.ab);
            *shift = m.mean_a - *scale * m.mean_b;
        }
    }
    return best;
}

static pairs pair_up(const estimate_samples *s)
{
    double scale = 1, shift = 0, opposite = 0;
    size_t k = companion(s, &scale, &shift, &opposite);
    pairs p = {.y = memory_alloc((s->count[0] + 1) * sizeof *p.y),
               .z = memory_alloc((s->count[0] + 1) * sizeof *p.z),
               .all = memory_alloc((s->count[k] + 1) * sizeof *p.all)};
    p.opposite = opposite;
    for (size_t i = 0; i < s->count[k]; i++) {
        double z = shift + scale * s->values[k][i];
        bool both = i < s->count[0];
        if (!isfinite(z) || (both && !isfinite(s->values[0][i])))
            continue;
        p.all[p.count++] = z;
        if (both) {
            p.y[p.pair_count] = s->values[0][i];
            p.z[p.pair_count++] = z;
        }
    }
    return p;
}

static void pairs_free(pairs *p)
{
    free(p->y);
    free(p->z);
    free(p->all);
}

/* Wilson's interval of a proportion (1927). */
static void wilson(double hits, double n, double *low, double *high)
{
    double p = hits / n, shrink = 1 + z95 * z95 / n, middle = (p + z95 * z95 / (2 * n)) / shrink;
    double half = z95 / shrink * sqrt(p * (1 - p) / n + z95 * z95 / (4 * n * n));
    *low = fmax(0, middle - half);
    *high = fmin(1, middle + half);
}

/* Computes how far the interval of a probability extends down and up, from the number of cheap
 * values not above t and the number of pairs on different sides of t. Few pairs determine this
 * number poorly, so PRIOR pairs are added, which lie on different sides as often as normal variates
 * of that correlation. */
static void interval_of(const pairs *p, double below, size_t opposite, double value, double *down,
                        double *up)
{
    double n = (double)p->count, m = (double)p->pair_count, low, high;
    wilson(below, n, &low, &high);
    *down = below / n - low;
    *up = high - below / n;
    if (!(p->opposite > 0))
        return;
    double prior = 4 * value * (1 - value) * p->opposite;
    double half = z95 * sqrt(((double)opposite + PRIOR * prior) / (m + PRIOR) / m);
    *down = hypot(*down, half);
    *up = hypot(*up, half);
}

estimate estimate_probability(const estimate_samples *s, double limit)
{
    pairs p = pair_up(s);
    size_t below = 0, only_y = 0, only_z = 0;
    for (size_t i = 0; i < p.count; i++)
        below += p.all[i] <= limit;
    for (size_t i = 0; i < p.pair_count; i++) {
        only_y += p.y[i] <= limit && p.z[i] > limit;
        only_z += p.z[i] <= limit && p.y[i] > limit;
    }
    estimate e = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    double down, up,
        value = (double)below / (double)p.count +
                ((double)only_y - (double)only_z) / (double)p.pair_count;
    value = fmin(1, fmax(0, value));
    interval_of(&p, (double)below, only_y + only_z, value, &down, &up);
    if (p.pair_count > 0)
        e = (estimate){value, fmax(0, value - down), fmin(1, value + up), (double)NAN};
    pairs_free(&p);
    return e;
}

size_t estimate_values(const estimate_samples *s, double *values)
{
    pairs p = pair_up(s);
    size_t count = p.count;
    for (size_t i = 0; i < count; i++)
        values[i] = p.all[i];
    pairs_free(&p);
    return count;
}

/* A value at which the probability changes as t rises. */
typedef struct event {
    double at;
    size_t pair; /* SIZE_MAX for a cheap value without a pair */
    bool is_y;
} event;

static int by_place(const void *a, const void *b)
{
    double x = ((const event *)a)->at, y = ((const event *)b)->at;
    return (x > y) - (x < y);
}

static event *events_of(const pairs *p, size_t *count)
{
    event *events = memory_alloc((p->count + 2 * p->pair_count + 1) * sizeof *events);
    *count = 0;
    for (size_t i = 0; i < p->count; i++)
        events[(*count)++] = (event){p->all[i], SIZE_MAX, false};
    for (size_t i = 0; i < p->pair_count; i++) {
        events[(*count)++] = (event){p->y[i], i, true};
        events[(*count)++] = (event){p->z[i], i, false};
    }
    qsort(events, *count, sizeof *events, by_place);
    return events;
}

/* Returns the value at which the probability crosses a share: half-way between the first place with
 * a probability at or above the share and the last place below it. The probability may fall
 * slightly where t passes a cheap value whose partner is larger. */
typedef struct crossing {
    double share, first, last;
    size_t only_y, only_z; /* of the pairs at this value */
} crossing;

static void pass(crossing *c, double value, size_t only_y, size_t only_z, double at, double next)
{
    if (isnan(c->first) && value >= c->share) {
        c->first = at;
        c->only_y = only_y;
        c->only_z = only_z;
    }
    if (value <= c->share && isfinite(next))
        c->last = next;
}

static double place_of(const crossing *c)
{
    return isnan(c->first) ? INFINITY : (c->first + fmax(c->first, c->last)) / 2;
}

static void walk(const pairs *p, const event *events, size_t count, crossing *all, size_t crossings)
{
    size_t below = 0, only_y = 0, only_z = 0;
    for (size_t i = 0; i < count; i++) {
        const event *at = &events[i];
        double next = i + 1 < count ? events[i + 1].at : INFINITY;
        if (at->pair == SIZE_MAX)
            below++;
        else if (at->is_y && p->z[at->pair] <= at->at)
            only_z -= p->z[at->pair] < at->at;
        else if (at->is_y)
            only_y++;
        else if (p->y[at->pair] <= at->at)
            only_y -= p->y[at->pair] < at->at;
        else
            only_z++;
        double value = (double)below / (double)p->count +
                       ((double)only_y - (double)only_z) / (double)p->pair_count;
        for (size_t k = 0; next > at->at && k < crossings; k++)
            pass(&all[k], value, only_y, only_z, at->at, next);
    }
}

estimate estimate_percentile(const estimate_samples *s, double share)
{
    pairs p = pair_up(s);
    estimate e = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    crossing middle = {.share = share, .first = (double)NAN, .last = -INFINITY}, ends[2];
    size_t count;
    event *events = events_of(&p, &count);
    double n = (double)p.count, least, most;
    walk(&p, events, count, &middle, 1);
    interval_of(&p, share * n, middle.only_y + middle.only_z, share, &least, &most);
    ends[0] = ends[1] = (crossing){.first = (double)NAN, .last = -INFINITY};
    ends[0].share = share - least;
    ends[1].share = share + most;
    walk(&p, events, count, ends, 2);
    if (p.pair_count > 0)
        e = (estimate){place_of(&middle), place_of(&ends[0]), place_of(&ends[1]), (double)NAN};
    /* n values give no bound beyond the outermost one */
    double outside = z95 * z95 / (n + z95 * z95);
    if (share < outside || ends[0].share <= 0)
        e.low = -INFINITY;
    if (1 - share < outside || ends[1].share >= 1)
        e.high = INFINITY;
    free(events);
    pairs_free(&p);
    return e;
}
