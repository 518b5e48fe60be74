/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates the error of a loss due to the time steps, from its series. */
#include "../contact/simd-reductions.h"
#include "results.h"

#include <math.h>

/* Instants on each side that enter the estimate. */
enum { REACH = 3 };

/* Power of the pressure flow at instant k. It depends on the change of the film in time. */
static double flow_power(const ehl_results *r, size_t k)
{
    const double *row = &r->series.data[k * EHL_SERIES];
    return row[EHL_ROLLING_LOSS] + row[EHL_SQUEEZE_LOSS];
}

static double time_of(const ehl_results *r, size_t k)
{
    return r->series.data[k * EHL_SERIES + EHL_TIME];
}

/* Returns the distance of instant k from the polynomial through the `count` instants on one side of
 * it, by Neville's scheme; `way` is 1 for the later side, -1 for the earlier one. */
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

/* Returns the smaller distance of instant k from the polynomials of both sides; 0 if they have
 * different signs. A power that jumps lies on the polynomial of the side it has jumped to. A smooth
 * curve lies on the same side of both lines (count 2), a cubic on opposite sides of both parabolas
 * (count 3), which is no error: only an instant that is itself wrong lies on the same side of both
 * parabolas. */
static double off_both(const ehl_results *r, size_t k, size_t count)
{
    double before = off_polynomial(r, k, -1, count), behind = off_polynomial(r, k, 1, count);
    return before * behind < 0 ? 0 : fmin(fabs(before), fabs(behind));
}

/* Returns 1 if all instants within REACH are loaded, of one engagement, and each is later than the
 * one before. */
static int is_inside(const ehl_results *r, size_t k)
{
    const double *number = &r->series.data[k * EHL_SERIES + EHL_ENGAGEMENT];
    int inside = !(fabs(number[REACH * EHL_SERIES] - number[-REACH * EHL_SERIES]) > 0);
    for (size_t i = k - REACH; i <= k + REACH; i++) /* without load a film has no bound */
        inside = inside && fabs(r->space.data[EHL_SPACE * i + EHL_LEAST]) > 0 &&
                 (i == k - REACH || time_of(r, i) > time_of(r, i - 1));
    return inside;
}

/* The error of (10.2) in the change in time is dt (dt + dt_1)/6 times its second derivative, so
 * that the error of a power that depends on this change is a third of its distance from the line
 * through two neighbours. (10.1) is late by half a step. A wrong instant behind a kink leaves the
 * parabola of the later instants by its error. Negative if no instant has REACH loaded ones on both
 * sides. */
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
