/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "history.h"

#include <flankfilm/author.h>

#include <math.h>

/* Returns whether a number is within bounds that keep its powers in the film formulas finite. */
static int is_usable(double value)
{
    return fabs(value) <= 1e30;
}

static ff_status check_row(const ehl_history *h, const ff_host *host, size_t i)
{
    if (!is_usable(h->time[i]))
        return ff_failf(host, FF_INVALID, "contact.time", "time %zu is not a usable number", i);
    if (i > 0 && h->time[i] < h->time[i - 1])
        return ff_failf(host, FF_INVALID, "contact.time",
                        "the times must not decrease, but %g s follows %g s", h->time[i],
                        h->time[i - 1]);
    if (!(h->radius[i] > 0 && is_usable(h->radius[i])))
        return ff_failf(host, FF_INVALID, "contact.equivalent_radius",
                        "the equivalent radius must be positive, but it is %g m at time %g s",
                        h->radius[i], h->time[i]);
    if (!is_usable(h->speed_1[i]) || !is_usable(h->speed_2[i]))
        return ff_failf(host, FF_INVALID,
                        is_usable(h->speed_1[i]) ? "contact.speed_2" : "contact.speed_1",
                        "the speed at time %g s is not a usable number", h->time[i]);
    if (!(h->load[i] >= 0 && is_usable(h->load[i])))
        return ff_failf(host, FF_INVALID, "contact.load_per_width",
                        "the load per width must not be negative, but it is %g N/m at time %g s",
                        h->load[i], h->time[i]);
    if (h->gap && !(h->gap[i] >= 0 && is_usable(h->gap[i])))
        return ff_failf(host, FF_INVALID, "contact.gap",
                        "the gap must not be negative, but it is %g m at time %g s", h->gap[i],
                        h->time[i]);
    if (h->engagement && !is_usable(h->engagement[i]))
        return ff_failf(host, FF_INVALID, "contact.engagement",
                        "the engagement at time %g s is not a usable number", h->time[i]);
    if (h->roll && !is_usable(h->roll[i]))
        return ff_failf(host, FF_INVALID, "contact.roll_angle",
                        "the roll angle at time %g s is not a usable number", h->time[i]);
    return FF_OK;
}

static double entrainment(const ehl_history *h, size_t i)
{
    return (h->speed_1[i] + h->speed_2[i]) / 2;
}

/* Finds the first row with motion and the direction of entrainment, and for a start from rest the
   time at which the entrainment speed reaches EHL_CREEP times its maximum. */
static size_t find_start(ehl_history *h)
{
    double least = EHL_CREEP * h->speed_max;
    size_t i = 0;
    h->at_rest = !(fabs(entrainment(h, 0)) > 0);
    while (h->at_rest && i + 1 < h->count && fabs(entrainment(h, i)) < least)
        i++;
    h->mirrored = entrainment(h, i) < 0;
    if (i == 0)
        return 0;
    double sign = h->mirrored ? -1 : 1, low = sign * entrainment(h, i - 1),
           high = sign * entrainment(h, i);
    double share = (least - low) / (high - low);
    h->wakes = h->time[i - 1] + share * (h->time[i] - h->time[i - 1]);
    return i;
}

/* Checks that a film can begin in the first row: the flanks move there, or they move later, or a
   gap without load is given. */
static ff_status check_motion(ehl_history *h, const ff_host *host)
{
    int apart = h->count > 1 && ehl_is_lost(h, h->load[0]) && h->gap && h->gap[0] > 0;
    for (size_t i = 0; i < h->count; i++)
        h->speed_max = fmax(h->speed_max, fabs(entrainment(h, i)));
    if (!(h->speed_max > 0) && !apart)
        return ff_failf(host, FF_INVALID, "contact.speed_1",
                        "the entrainment speed (u1 + u2)/2 is always zero, and there is no "
                        "steady film at rest: a squeeze film must begin with a gap and without "
                        "load");
    size_t first = h->speed_max > 0 ? find_start(h) : 0;
    h->turns = apart && !(fabs(entrainment(h, 0)) > 0);
    h->at_rest = h->at_rest && !apart;
    for (size_t i = apart ? 0 : first; i < h->count; i++)
        h->turns |= (h->mirrored ? -1 : 1) * entrainment(h, i) < 0;
    return FF_OK;
}

ff_status ehl_history_one_way(const ehl_history *h, const ff_host *host, const char *what)
{
    for (size_t i = 0; i < h->count; i++)
        if ((h->mirrored ? -1 : 1) * entrainment(h, i) < 0 || (i == 0 && h->at_rest))
            return ff_failf(host, FF_UNSUPPORTED, "contact.speed_1",
                            "the entrainment speed (u1 + u2)/2 is %g m/s at time %g s, but %s "
                            "needs entrainment from the start and always in the same direction; "
                            "ehl/finite-volume with smooth flanks has no such restriction",
                            entrainment(h, i), h->time[i], what);
    return FF_OK;
}

static const double *from_row(const double *series, size_t row)
{
    return series ? series + row : NULL;
}

size_t ehl_history_engagement(const ehl_history *h, size_t row, ehl_history *one)
{
    size_t end = row + 1;
    while (end < h->count && (!h->engagement || h->engagement[end] == h->engagement[row]))
        end++;
    *one = *h;
    one->count = end - row;
    one->time += row;
    one->radius += row;
    one->speed_1 += row;
    one->speed_2 += row;
    one->load += row;
    one->roll = from_row(h->roll, row);
    one->gap = from_row(h->gap, row);
    one->engagement = from_row(h->engagement, row);
    one->film = from_row(h->film, row);
    return end;
}

/* Checks that the duration of each engagement, and of the part after a jump, is above 0. */
static ff_status check_durations(const ehl_history *h, const ff_host *host)
{
    ehl_history one;
    for (size_t row = 0; row < h->count;) {
        row = ehl_history_engagement(h, row, &one);
        size_t n = one.count;
        if (n > 1 && !(one.time[n - 1] > one.time[0]))
            return ff_failf(host, FF_INVALID, "contact.time",
                            "the duration of the contact history is 0: all %zu times are %g s", n,
                            one.time[0]);
        if (n > 1 && !(one.time[n - 1] > one.time[n - 2]))
            return ff_failf(host, FF_INVALID, "contact.time",
                            "the contact jumps at the last time, %g s: remove the last row, or add "
                            "rows after the jump",
                            one.time[n - 1]);
    }
    return FF_OK;
}

ff_status ehl_history_check(ehl_history *h, const ff_host *host)
{
    if (h->count == 0)
        return ff_failf(host, FF_INVALID, "contact.time", "the contact history is empty");
    if (!(h->modulus > 0 && is_usable(h->modulus)))
        return ff_failf(host, FF_INVALID, "contact.reduced_modulus",
                        "the reduced modulus must be positive, but it is %g Pa", h->modulus);
    h->load_max = h->load_floor;
    for (size_t i = 0; i < h->count; i++) {
        ff_status status = check_row(h, host, i);
        if (status != FF_OK)
            return status;
        h->load_max = fmax(h->load_max, h->load[i]);
    }
    ff_status status = check_durations(h, host);
    if (status != FF_OK)
        return status;
    int apart = h->gap != NULL;
    for (size_t i = 0; i < h->count && apart; i++)
        apart = h->gap[i] > 0;
    if (!(h->load_max > 0) && !apart)
        return ff_failf(host, FF_INVALID, "contact.load_per_width",
                        "the contact is never loaded: at least one load per width must be "
                        "positive, or a gap must be given at all times for flanks that never "
                        "touch");
    return check_motion(h, host);
}

int ehl_is_lost(const ehl_history *h, double load)
{
    return !(fmax(load, h->load_floor) > 1e-6 * h->load_max);
}

typedef struct between {
    size_t i, k;
    double share;
} between;

static double mix(const double *series, between b)
{
    return series ? (1 - b.share) * series[b.i] + b.share * series[b.k] : 0;
}

static ehl_instant instant(const ehl_history *h, between b)
{
    double u1 = mix(h->speed_1, b), u2 = mix(h->speed_2, b), time = mix(h->time, b);
    int creeps = h->at_rest && (time < h->wakes || (b.k == 0 && time <= h->wakes));
    return (ehl_instant){
        .time = time,
        .radius = mix(h->radius, b),
        .entrainment = fmax(fabs(u1 + u2) / 2, creeps ? EHL_CREEP * h->speed_max : 0),
        .sliding = u1 - u2,
        .load = fmax(mix(h->load, b), h->load_floor),
        .gap = mix(h->gap, b),
        .roll = mix(h->roll, b),
        .mirrored = creeps ? h->mirrored : u1 + u2 < 0,
    };
}

ehl_instant ehl_history_row(const ehl_history *h, size_t row)
{
    return instant(h, (between){row, row, 0});
}

/* Returns the number of rows with a time below `time`, or not above `time` if `upto` is set. */
static size_t rows_before(const ehl_history *h, double time, int upto)
{
    size_t low = 0, high = h->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (upto ? h->time[middle] <= time : h->time[middle] < time)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

size_t ehl_history_rows_before(const ehl_history *h, double time)
{
    return rows_before(h, time, 1);
}

/* Interpolates between row `next` - 1 and row `next`. */
static ehl_instant interpolate(const ehl_history *h, size_t next, double time)
{
    size_t low = next > 0 ? next - 1 : 0, high = next < h->count ? next : h->count - 1;
    double span = h->time[high] - h->time[low];
    double share = span > 0 ? (time - h->time[low]) / span : 0;
    ehl_instant at = instant(h, (between){low, span > 0 ? high : low, share});
    at.time = time;
    return at;
}

ehl_instant ehl_history_at(const ehl_history *h, double time)
{
    return interpolate(h, rows_before(h, time, 1), time);
}

ehl_instant ehl_history_before(const ehl_history *h, double time)
{
    return interpolate(h, rows_before(h, time, 0), time);
}

/* Returns the deviation of `at` from the straight line between a and b at that time, over the
   allowed deviation. */
static double deviation_from_line(const ehl_history *h, const ehl_instant *a, const ehl_instant *b,
                                  const ehl_instant *at, double within, double film)
{
    const double none = 1e-2; /* loads and speeds below this share of the largest value are compared
                                 with this share instead of with their own value */
    double share = (at->time - a->time) / (b->time - a->time), rest = 1 - share;
    double load = fabs(at->load - rest * a->load - share * b->load),
           speed = fabs(at->entrainment - rest * a->entrainment - share * b->entrainment),
           sliding = fabs(at->sliding - rest * a->sliding - share * b->sliding),
           radius = fabs(at->radius - rest * a->radius - share * b->radius),
           gap = fabs(at->gap - rest * a->gap - share * b->gap);
    double most = load / (2 * (at->load + none * h->load_max));
    most = fmax(most, fmax(speed, sliding) / fmax(at->entrainment + none * h->speed_max, 1e-300));
    most = fmax(most, radius / at->radius);
    return fmax(most, gap / (10 * (at->gap + film))) / within;
}

double ehl_history_straight(const ehl_history *h, double from, double to, double within,
                            double film)
{
    ehl_instant begin = ehl_history_at(h, from), end = ehl_history_before(h, to);
    size_t first = rows_before(h, from, 1), last = rows_before(h, to, 0), furthest;
    for (;; last = furthest) {
        double worst = 1;
        furthest = last;
        for (size_t i = first; i < last; i++) {
            ehl_instant at = ehl_history_row(h, i);
            double off = deviation_from_line(h, &begin, &end, &at, within, film);
            if (off > worst) {
                worst = off;
                furthest = i;
            }
        }
        if (furthest == last)
            return end.time;
        end = ehl_history_row(h, furthest);
    }
}

void ehl_history_sample(const ehl_history *h, double from, double to, ehl_sampling *sum)
{
    size_t first = rows_before(h, from, 1), past = rows_before(h, to, 0);
    ehl_instant begin = interpolate(h, first, from), end = interpolate(h, past, to), last = begin;
    double before = 0;
    sum->sampled = fmax(sum->sampled, fmax(begin.load / begin.radius, end.load / end.radius));
    sum->passed = fmax(sum->passed, sum->sampled);
    for (size_t i = first; i <= past; i++) {
        ehl_instant at = i < past ? ehl_history_row(h, i) : end;
        double share = (at.time - from) / (to - from);
        double off = fabs(at.load - (1 - share) * begin.load - share * end.load);
        sum->missed += (before + off) / 2 * (at.time - last.time);
        sum->load += (last.load + at.load) / 2 * (at.time - last.time);
        sum->passed = fmax(sum->passed, at.load / at.radius);
        before = off;
        last = at;
    }
}

double ehl_sampling_missed(const ehl_sampling *s)
{
    return s->load > 0 ? fmax(s->missed / s->load, sqrt(s->passed / s->sampled) - 1) : 0;
}

void ehl_lowest_add(ehl_lowest *l, double engagement, double h_min)
{
    if (l->count > 0 && engagement == l->number) {
        l->here = fmin(l->here, h_min);
        return;
    }
    l->sum += l->here;
    l->least = l->count > 1 ? fmin(l->least, l->here) : l->here;
    l->most = l->count > 1 ? fmax(l->most, l->here) : l->here;
    l->number = engagement;
    l->here = h_min;
    l->count++;
}

double ehl_lowest_mean(const ehl_lowest *l)
{
    return l->count > 0 ? (l->sum + l->here) / l->count : 0;
}

double ehl_lowest_spread(const ehl_lowest *l)
{
    return l->count > 1 ? fmax(l->most, l->here) - fmin(l->least, l->here) : 0;
}
