/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums over the tooth pairs in mesh. */
#include "mesh-sum.h"

#include "../numerics/interval.h"

#include <math.h>

/* phases closer than this, in pitches, are treated as equal */
static const double slack = 1e-9;

double losses_interpolate(const double *x, const double *y, size_t i, double at)
{
    double width = x[i + 1] - x[i], share = width > 0 ? (at - x[i]) / width : 0;
    share = fmin(fmax(share, 0), 1);
    return (1 - share) * y[i] + share * y[i + 1];
}

/* Returns the length of the path of contact in pitches, which is the contact ratio. */
static double pitches(const losses_engagement *e)
{
    return (e->roll[e->n - 1] - e->roll[0]) / e->pitch;
}

double losses_leaving_phase(const losses_engagement *e)
{
    double phase = pitches(e) - floor(pitches(e));
    return phase < slack || phase > 1 - slack ? 0 : phase;
}

double losses_mesh_loss(const losses_engagement *e, double phase, bool before)
{
    const double all = pitches(e);
    double sum = 0;
    for (double at = phase; at <= all + slack; at += 1) {
        if (before ? at < slack : at > all - slack)
            continue;
        double roll = e->roll[0] + at * e->pitch;
        sum += losses_interpolate(e->roll, e->loss, numerics_interval(e->n, e->roll, roll), roll);
    }
    return sum;
}

double losses_mesh_mean(const losses_engagement *e, const double *value)
{
    double sum = 0;
    for (size_t i = 0; i + 1 < e->n; i++)
        sum += (e->roll[i + 1] - e->roll[i]) * (value[i] + value[i + 1]) / 2;
    return sum / e->pitch;
}
