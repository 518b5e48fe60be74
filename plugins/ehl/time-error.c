/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates the errors of p_max by the time steps, and those of extremes that lie between two
   instants. */
#include "time-error.h"

#include "grid.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

double ehl_pressure_of_error(const ehl_reynolds *eq, const double *error, double modulus, double a,
                             double x)
{
    const double *h = eq->h;
    size_t first = (size_t)fmax(0, ceil((-a - eq->first) / eq->dx - 0.5));
    double sum = 0;
    for (size_t i = first; i + 1 < eq->nodes; i++) {
        double s = eq->first + ((double)i + 0.5) * eq->dx;
        if (!(s < a))
            break;
        sum += sqrt(fmax(0, a * a - s * s)) * (error[i + 1] * h[i + 1] - error[i] * h[i]) / (x - s);
    }
    return modulus / (4 * pi * sqrt(a * a - x * x)) * sum;
}

void ehl_results_peak_in_time(ehl_results *r, const ehl_march *m, double p_max)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *p = m->state[0].film.p;
    double a = ehl_hertz_half_width(m->at.load, m->at.radius, m->history->modulus);
    double buildup = ehl_inlet_buildup(a, m->at.radius, r->row[EHL_H_CENTRAL]);
    double first = ceil((buildup - a - eq->first) / eq->dx),
           last = floor((a - 1.6 * buildup - eq->first) / eq->dx);
    size_t peak = 0;
    if (m->rough || !ehl_march_is_loaded(m) || !(last > first))
        return;
    while (peak + 1 < eq->nodes && p[peak] < p_max)
        peak++;
    double x = eq->first + fmin(fmax((double)peak, first), last) * eq->dx;
    double off = fabs(ehl_pressure_of_error(eq, m->accumulated_error, m->history->modulus, a, x));
    ehl_worse(&r->worst_peak_in_time, off / p_max);
    r->highest_in_time = fmax(r->highest_in_time, p_max + off);
}

/* How far the parabola in time through three instants, at t[0] ... t[2], goes beyond a middle value
   that is not below the others. */
static double beyond_middle(const double t[3], const double y[3])
{
    double up = (y[1] - y[0]) / (t[1] - t[0]), down = (y[1] - y[2]) / (t[2] - t[1]);
    double before = t[1] - t[0], after = t[2] - t[1], both = before + after;
    double slope = (up * after - down * before) / both, bend = 2 * (up + down) / both;
    return bend > 0 ? slope * slope / (2 * bend) : 0;
}

double ehl_beyond_instants(const ehl_results *r, uint32_t column, double way)
{
    double most = -HUGE_VAL, extreme = -HUGE_VAL;
    for (size_t k = 0; k < r->series.count; k++) {
        const double *row = &r->series.data[k * EHL_SERIES], *before = row - EHL_SERIES,
                     *after = row + EHL_SERIES;
        double here = way * row[column], beyond = 0;
        extreme = fmax(extreme, here);
        int inner = k > 0 && k + 1 < r->series.count &&
                    !(before[EHL_ENGAGEMENT] < row[EHL_ENGAGEMENT]) &&
                    !(row[EHL_ENGAGEMENT] < after[EHL_ENGAGEMENT]) &&
                    before[EHL_TIME] < row[EHL_TIME] && row[EHL_TIME] < after[EHL_TIME];
        if (inner && way * before[column] <= here && way * after[column] <= here)
            beyond = beyond_middle((double[]){before[EHL_TIME], row[EHL_TIME], after[EHL_TIME]},
                                   (double[]){way * before[column], here, way * after[column]});
        most = fmax(most, here + beyond);
    }
    return (most - extreme) / fabs(extreme);
}
