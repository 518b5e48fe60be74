/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates the errors of p_max due to the time steps, and the errors of extremes that lie between
   two instants. */
#include "time-error.h"

#include "../contact/grid.h"
#include "../contact/simd-reductions.h"
#include "../time/truncation.h"

#include <flankfilm/simd.h>

#include <math.h>

static const double pi = 3.14159265358979323846;

/* Computes (a^2 - s^2)^(1/2) d'(s) dx/(x - s) for n cells. e and h are values at the nodes, s is
   the middle of the first cell. */
FF_SIMD
static void fill_parts(size_t n, const double *restrict e, const double *restrict h, double a,
                       double s, double dx, double x, double *restrict part)
{
    for (size_t i = 0; i < n; i++) {
        double here = s + (double)(int)i * dx, square = a * a - here * here;
        double change = e[i + 1] * h[i + 1] - e[i] * h[i];
        part[i] = sqrt(square > 0 ? square : 0) * change / (x - here);
    }
}

double ehl_pressure_of_error(const ehl_reynolds *eq, const double *error, double modulus, double a,
                             double x)
{
    enum { AT_ONCE = 64 };
    /* number of cells whose middle is upstream of a */
    const double inside = (a - eq->first) / eq->dx - 0.5;
    size_t i = (size_t)fmax(0, ceil((-a - eq->first) / eq->dx - 0.5)),
           end = (size_t)fmax(0, fmin((double)eq->nodes - 1, ceil(inside)));
    double sum = 0, part[AT_ONCE];
    for (size_t n; i < end; i += n) {
        n = end - i < AT_ONCE ? end - i : AT_ONCE;
        fill_parts(n, error + i, eq->h + i, a, eq->first + ((double)i + 0.5) * eq->dx, eq->dx, x,
                   part);
        sum += ehl_sum(n, part);
    }
    return modulus / (4 * pi * sqrt(a * a - x * x)) * sum;
}

void ehl_results_peak_in_time(ehl_results *r, const ehl_march *m, size_t peak, double p_max)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    double a = ehl_hertz_half_width(m->at.load, m->at.radius, m->history->modulus);
    r->row[EHL_P_MAX_ERROR] = 0;
    if (m->rough || !r->peaks || !ehl_march_is_loaded(m))
        return;
    double buildup = ehl_inlet_buildup(a, m->at.radius, r->row[EHL_H_CENTRAL]);
    double first = ceil((buildup - a - eq->first) / eq->dx),
           end = floor(ehl_outlet_begins(eq, a, buildup));
    if (!(end > first))
        return;
    double x = eq->first + fmax(first, fmin((double)peak, end)) * eq->dx;
    double off = fabs(ehl_pressure_of_error(eq, m->accumulated_error, m->history->modulus, a, x));
    r->row[EHL_P_MAX_ERROR] = off;
    ehl_worse(&r->worst_peak_in_time, off / p_max);
    ehl_worse(&r->highest_in_time, p_max + off);
}

/* Returns by how much a parabola exceeds both values between t[1] and t[2]. Two parabolas pass
   through three of the four neighbours; the flatter one counts. At a smooth peak both are curved.
   If the value drops or has a kink at an instant, the flatter one is that of the smooth side. */
static double beyond_both(const double t[4], const double y[4])
{
    double slope[3], within = t[2] - t[1];
    for (int i = 0; i < 3; i++)
        slope[i] = (y[i + 1] - y[i]) / (t[i + 1] - t[i]);
    double bend =
        fmin(2 * (slope[0] - slope[1]) / (t[2] - t[0]), 2 * (slope[1] - slope[2]) / (t[3] - t[1]));
    double rise = bend * within / 2 - fabs(slope[1]);
    return rise > 0 ? rise * rise / (2 * bend) : 0;
}

/* Returns whether a row belongs to the same engagement as the previous row, and is later. */
static int goes_on(const double *row)
{
    const double *before = row - EHL_SERIES;
    return row[EHL_TIME] > before[EHL_TIME] && !(row[EHL_ENGAGEMENT] > before[EHL_ENGAGEMENT]);
}

double ehl_beyond_instants(const ehl_results *r, uint32_t column, double way)
{
    double most = -HUGE_VAL, extreme = -HUGE_VAL;
    for (size_t k = 0; k < r->series.count; k++) {
        const double *row = &r->series.data[k * EHL_SERIES];
        double t[4], y[4];
        extreme = fmax(extreme, way * row[column]);
        if (k < 3 || !goes_on(row) || !goes_on(row - EHL_SERIES) || !goes_on(row - 2 * EHL_SERIES))
            continue;
        for (size_t i = 0; i < 4; i++) {
            const double *of = row - (3 - i) * EHL_SERIES;
            t[i] = of[EHL_TIME];
            y[i] = way * of[column];
        }
        most = fmax(most, fmax(y[1], y[2]) + beyond_both(t, y));
    }
    return (fmax(most, extreme) - extreme) / fabs(extreme);
}
