/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates the error of a loss by the time steps, from its series. */
#include "../contact/lanes.h"
#include "results.h"

#include <math.h>

/* Instants on each side that are looked at. */
enum { REACH = 3 };

/* Power of the pressure flow at instant k, which goes with the change of the film in time. */
static double flow_power(const ehl_results *r, size_t k)
{
    const double *row = &r->series.data[k * EHL_SERIES];
    return row[EHL_ROLLING_LOSS] + row[EHL_SQUEEZE_LOSS];
}

static double time_of(const ehl_results *r, size_t k)
{
    return r->series.data[k * EHL_SERIES + EHL_TIME];
}

/* Returns how far instant k is off the polynomial through the `count` instants on one side of it,
   `way` being 1 or -1, by Neville's scheme. */
static double off_polynomial(const ehl_results *r, size_t k, int way, size_t count)
{
    double at[REACH], q[REACH], time = time_of(r, k);
    for (size_t i = 0; i < count; i++) {
        size_t row = way > 0 ? k + 1 + i : k - 1 - i;
        at[i] = time_of(r, row);
        q[i] = flow_power(r, row);
    }
    for (size_t order = 1; order < count; order++)
        for (size_t i = 0; i + order < count; i++)
            q[i] += (time - at[i]) / (at[i + order] - at[i]) * (q[i + 1] - q[i]);
    return flow_power(r, k) - q[0];
}

/*
 * A power that leaps lies on the polynomial from the side which it has leapt to. A smooth curve is
 * to the same side of its lines (count 2) from either side, and a cubic to opposite sides of its
 * parabolas (count 3), and is no error: only an instant that is itself off is so to the same side
 * of both.
 */
static double off_both(const ehl_results *r, size_t k, size_t count)
{
    double before = off_polynomial(r, k, -1, count), behind = off_polynomial(r, k, 1, count);
    return before * behind < 0 ? 0 : fmin(fabs(before), fabs(behind));
}

/* Returns 1 when all instants within REACH are loaded ones of one engagement, later and later. */
static int is_inside(const ehl_results *r, size_t k)
{
    const double *number = &r->series.data[k * EHL_SERIES + EHL_ENGAGEMENT];
    int inside = !(fabs(number[REACH * EHL_SERIES] - number[-REACH * EHL_SERIES]) > 0);
    for (size_t i = k - REACH; i <= k + REACH; i++) /* without load a film has no bound */
        inside = inside && fabs(r->space.data[EHL_SPACE * i + EHL_LEAST]) > 0 &&
                 (i == k - REACH || time_of(r, i) > time_of(r, i - 1));
    return inside;
}

/*
 * (10.2) takes the change in time wrongly by dt (dt + dt_1)/6 of its second derivative, and a power
 * that goes with this change is off by a third of what it is off the line through two neighbours.
 * (10.1) is late by half a step, and one of them behind a kink leaves the parabola of what follows
 * by its error. Negative where no instant has REACH loaded ones on both sides.
 */
double ehl_results_loss_in_time(const ehl_results *r, const ehl_march *m)
{
    double worst = -1;
    for (size_t k = REACH; k + REACH < r->series.count; k++) {
        if (!is_inside(r, k))
            continue;
        ehl_worse(&worst, off_both(r, k, 2) / 3);
        ehl_worse(&worst, off_both(r, k, 3));
        if (m->scheme == EHL_EULER)
            ehl_worse(&worst, fabs(flow_power(r, k) - flow_power(r, k - 1)) / 2);
    }
    return worst;
}
