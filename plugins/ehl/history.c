/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "history.h"

#include <flankfilm/author.h>

#include <math.h>

/* A number whose powers in the formulas of the film stay numbers. */
static int is_usable(double value)
{
    return fabs(value) <= 1e30;
}

static ff_status check_row(const ff_history *h, const ff_host *host, size_t i)
{
    if (!is_usable(h->time[i]))
        return ff_failf(host, FF_INVALID, "contact.time", "time %zu is no usable number", i);
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
                        "the speed at time %g s is no usable number", h->time[i]);
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
                        "the engagement at time %g s is no usable number", h->time[i]);
    if (h->roll && !is_usable(h->roll[i]))
        return ff_failf(host, FF_INVALID, "contact.roll_angle",
                        "the roll angle at time %g s is no usable number", h->time[i]);
    return FF_OK;
}

/* The film is entrained from one side during the whole history. */
static ff_status check_direction(ff_history *h, const ff_host *host)
{
    double first = h->speed_1[0] + h->speed_2[0];
    if (fabs(first) <= 0)
        return ff_failf(
            host, FF_INVALID, "contact.speed_1",
            "the entrainment speed (u1 + u2)/2 is zero at the first time: a steady film "
            "to start from needs it positive or negative");
    h->mirrored = first < 0;
    for (size_t i = 1; i < h->count; i++)
        if (first * (h->speed_1[i] + h->speed_2[i]) < 0)
            return ff_failf(host, FF_UNSUPPORTED, "contact.speed_1",
                            "the entrainment speed (u1 + u2)/2 changes its sign at time %g s; it "
                            "must keep one direction",
                            h->time[i]);
    return FF_OK;
}

static const double *from_row(const double *series, size_t row)
{
    return series ? series + row : NULL;
}

size_t ff_history_engagement(const ff_history *h, size_t row, ff_history *one)
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
    return end;
}

static ff_status check_durations(const ff_history *h, const ff_host *host)
{
    ff_history one;
    for (size_t row = 0; row < h->count;) {
        row = ff_history_engagement(h, row, &one);
        if (one.count > 1 && !(one.time[one.count - 1] > one.time[0]))
            return ff_failf(host, FF_INVALID, "contact.time",
                            "the contact history lasts no time: all %zu times are %g s", one.count,
                            one.time[0]);
    }
    return FF_OK;
}

ff_status ff_history_check(ff_history *h, const ff_host *host)
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
    if (!(h->load_max > 0))
        return ff_failf(
            host, FF_INVALID, "contact.load_per_width",
            "the contact is never loaded: at least one load per width must be positive");
    return check_direction(h, host);
}

int ff_is_lost(const ff_history *h, double load)
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

static ff_instant instant(const ff_history *h, between b)
{
    double u1 = mix(h->speed_1, b), u2 = mix(h->speed_2, b);
    return (ff_instant){
        .time = mix(h->time, b),
        .radius = mix(h->radius, b),
        .entrainment = fabs(u1 + u2) / 2,
        .sliding = u1 - u2,
        .load = fmax(mix(h->load, b), h->load_floor),
        .gap = mix(h->gap, b),
        .roll = mix(h->roll, b),
    };
}

ff_instant ff_history_row(const ff_history *h, size_t row)
{
    return instant(h, (between){row, row, 0});
}

/* Number of rows with a time below `time`, or not above it when `upto`. */
static size_t rows_before(const ff_history *h, double time, int upto)
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

size_t ff_history_rows_before(const ff_history *h, double time)
{
    return rows_before(h, time, 1);
}

/* Between row `next` - 1 and row `next`. */
static ff_instant interpolate(const ff_history *h, size_t next, double time)
{
    size_t low = next > 0 ? next - 1 : 0, high = next < h->count ? next : h->count - 1;
    double span = h->time[high] - h->time[low];
    ff_instant at = ff_history_row(h, low);
    if (span > 0)
        at = instant(h, (between){low, high, (time - h->time[low]) / span});
    at.time = time;
    return at;
}

ff_instant ff_history_at(const ff_history *h, double time)
{
    return interpolate(h, rows_before(h, time, 1), time);
}

ff_instant ff_history_before(const ff_history *h, double time)
{
    return interpolate(h, rows_before(h, time, 0), time);
}
