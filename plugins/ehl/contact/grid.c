/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "grid.h"

#include <flankfilm/simd.h>

#include <assert.h>
#include <math.h>

static const double pi = 3.14159265358979323846;

double ehl_hertz_half_width(double load, double radius, double modulus)
{
    assert(load >= 0 && radius > 0 && modulus > 0);
    return sqrt(8 * load * radius / (pi * modulus));
}

double ehl_hertz_pressure(double load, double radius, double modulus)
{
    assert(load >= 0 && radius > 0 && modulus > 0);
    return sqrt(load * modulus / (2 * pi * radius));
}

double ehl_hertz_gap_distance(double a, double radius, double h)
{
    return a * pow(3 / (2 * sqrt(2)) * h * radius / (a * a), 2. / 3);
}

double ehl_inlet_buildup(double a, double radius, double h)
{
    return fmin(ehl_hertz_gap_distance(a, radius, h), sqrt(2 * radius * h));
}

/* Returns the film thickness of a line contact from M = W (2U)^-1/2, L = G (2U)^1/4 and H =
   (h/R)(2U)^-1/2 (Moes 2000, Lubrication and beyond). Returns 0 without load or entrainment, where
   no such film exists. */
double ehl_moes_film(const ehl_instant *at, double modulus, const ehl_oil *oil)
{
    double two_u = 2 * oil->viscosity * at->entrainment / (modulus * at->radius);
    if (!(two_u > 0 && at->load > 0))
        return 0;
    double m = at->load / (modulus * at->radius * sqrt(two_u));
    double l = fmax(oil->alpha * modulus * pow(two_u, 0.25), 1e-6);
    double ri = 3 / m, ei = 2.621 * pow(m, -0.2);
    double rp = 1.287 * pow(l, 2. / 3), ep = 1.311 * pow(m, -0.125) * pow(l, 0.75);
    double s = (7 + 8 * exp(-2 * ei / ri)) / 5;
    double iso = pow(pow(ri, 7. / 3) + pow(ei, 7. / 3), 3 * s / 7);
    double piezo = pow(pow(rp, -3.5) + pow(ep, -3.5), -2 * s / 7);
    return at->radius * sqrt(two_u) * pow(iso + piezo, 1 / s);
}

double ehl_row_film(const ehl_history *h, size_t row, const ehl_oil *oil)
{
    if (h->film)
        return h->film[row];
    ehl_instant at = ehl_history_row(h, row);
    return ehl_moes_film(&at, h->modulus, oil);
}

/* Returns the pressure upstream of x = -end for a Hertzian gap with film thickness h. The pressure
   is low there, so the oil has its properties at ambient pressure: p = 12 eta0 u int (gap -
   h)/gap^3 dx, integrated over 0 < t < 1 with x = -end/t. */
FF_SIMD
ehl_lost ehl_pressure_upstream(const ehl_oil *oil, const ehl_instant *at, double a, double h,
                               double end)
{
    enum { POINTS = 12 };
    const double push = 12 * oil->viscosity * fabs(at->entrainment),
                 bend = a * a / (2 * at->radius);
    double pressure[POINTS], load[POINTS];
    ehl_lost sum = {0, 0};
    for (int k = 0; k < POINTS; k++) {
        double t = (k + 0.5) / POINTS, x = end / t, s = x / a, y = sqrt((s - 1) * (s + 1));
        double opened = bend * (s * y - ff_log(s + y)), gap = h + opened; /* asinh y = ln(s + y) */
        pressure[k] = push * opened / (gap * gap * gap) * x / t / POINTS;
        load[k] = (x - end) * pressure[k];
    }
    for (int k = 0; k < POINTS; k++) {
        sum.pressure += pressure[k];
        sum.load += load[k];
    }
    return sum;
}

void ehl_inlet_ahead(const ehl_oil *oil, const ehl_instant *at, double modulus, double end,
                     double *pressure, double *load)
{
    const double most = 0.25; /* largest load in front of the domain, as a share of the load */
    double h = ehl_moes_film(at, modulus, oil);
    double a = ehl_hertz_half_width(at->load, at->radius, modulus);
    *pressure = *load = 0;
    if (!(h > 0 && end > a))
        return;
    ehl_lost l = ehl_pressure_upstream(oil, at, a, h, end);
    double part = (l.load + l.pressure * end) / (most * at->load);
    double share = 1 / (1 + part * part * part * part);
    *pressure = share * l.pressure;
    *load = share * l.load;
}

/* Returns the relative error of the film if the domain begins at the distance `lengths` times S
   from the contact; S is the length `s` over which the pressure of the inlet rises. Far from the
   contact dp/dx ~ x^-4. The film is too thin in proportion to the missing pressure, so the error is
   proportional to 1/distance^2. The factor of proportionality is 2.4 for a rigid cylinder, whose
   whole pressure arises in the inlet, and 0.08 if the half width a is large compared with S. In
   between it is fitted to solutions with Moes' L from 0 to 8. */
static double inlet_shortfall(double a, double s, double lengths)
{
    return (0.08 + 2.45 / (1 + pow(0.65 * (a + s) / s, 7))) / (lengths * lengths);
}

/* Extends the domain for one instant. At the largest load, starvation reduces the film by less than
   0.1 %; at other loads the inlet is at least `supplied` (ehl_grid_fit). The film ends before a +
   0.5 S. Loads below 2 % of the largest load do not extend the domain, since this would make the
   cells too coarse for the other loads. */
static void reach(ehl_grid *g, const ehl_instant *at, double modulus, double film, int largest)
{
    const double missing = 7.5e-4;
    double a = ehl_hertz_half_width(at->load, at->radius, modulus);
    double s = sqrt(2 * at->radius * film);
    double lengths = s > 0 ? sqrt(inlet_shortfall(a, s, 1) / missing) : 0;
    g->inlet = fmax(g->inlet, largest ? a + lengths * s : a + s);
    g->outlet = fmax(g->outlet, a + 2 * s);
}

/* Returns the gap of a Hertzian contact of half-width `from` at x = a, times 2 R. */
static double gap_times_2R(double from, double a)
{
    if (!(from > 0))
        return a * a;
    double s = a / from, y = sqrt((s - 1) * (s + 1));
    return from * from * (s * y - log(s + y)); /* acosh s = ln(s + y) */
}

/* Extends the outlet for a contact whose half width grows faster than the oil leaves. This contact
   draws in oil at its outlet, too. The film thickness h there is that of a contact with the
   difference of both speeds as entrainment speed, but at most the gap that was there before. The
   outlet extends 2 sqrt(2 R h) beyond the contact, as for a film that leaves the contact. */
static void reach_swelling(ehl_grid *g, const ehl_history *h, size_t row, const ehl_oil *oil)
{
    ehl_instant at = ehl_history_row(h, row), before = ehl_history_row(h, row - 1);
    double a = ehl_hertz_half_width(at.load, at.radius, h->modulus),
           from = ehl_hertz_half_width(before.load, before.radius, h->modulus);
    double dt = at.time - before.time, square = gap_times_2R(from, fmax(a, from));
    int together = !h->engagement || !(fabs(h->engagement[row] - h->engagement[row - 1]) > 0);
    if (!together || !(a - from > at.entrainment * dt))
        return;
    if (dt > 0) {
        at.entrainment = (a - from) / dt - at.entrainment;
        square = fmin(square, 2 * at.radius * ehl_moes_film(&at, h->modulus, oil));
    }
    g->drawn = fmax(g->drawn, a + 2 * sqrt(square));
}

/* Extends the inlet for a gap that is squeezed at rest: ten lengths sqrt(2 R gap) contain 99.9 % of
   the force on a cylinder. */
static void fit_squeezed_gap(ehl_grid *g, const ehl_instant *at, double half_width)
{
    g->inlet = fmax(g->inlet, half_width + 10 * sqrt(2 * at->radius * at->gap));
}

/* Extends the domain for rough flanks: at its ends the gap of the rigid bodies has grown by 4 Rq, a
   height that asperities rarely reach. */
static void fit_roughness(ehl_grid *g, const ehl_instant *at, double modulus, double rq)
{
    double end = ehl_hertz_half_width(at->load, at->radius, modulus) + sqrt(8 * at->radius * rq);
    g->inlet = fmax(g->inlet, end);
    g->outlet = fmax(g->outlet, end);
}

void ehl_grid_fit(ehl_grid *g, size_t cells, double inlet, double outlet, const ehl_history *h,
                  const ehl_oil *oil, double rq, double supplied)
{
    assert(cells >= 2);
    *g = (ehl_grid){.nodes = cells + 1, .inlet = supplied};
    for (size_t i = 0; i < h->count; i++) {
        ehl_instant at = ehl_history_row(h, i);
        double a = ehl_hertz_half_width(at.load, at.radius, h->modulus);
        g->half_width = fmax(g->half_width, a);
        g->pressure = fmax(g->pressure, ehl_hertz_pressure(at.load, at.radius, h->modulus));
        if (at.load >= EHL_LIGHT_LOAD * h->load_max)
            reach(g, &at, h->modulus, ehl_row_film(h, i, oil), at.load >= 0.5 * h->load_max);
        if (i > 0 && at.load >= EHL_LIGHT_LOAD * h->load_max)
            reach_swelling(g, h, i, oil);
        if (rq > 0)
            fit_roughness(g, &at, h->modulus, rq);
        if (!(at.entrainment > 0))
            fit_squeezed_gap(g, &at, a);
    }
    g->outlet = fmax(g->outlet, g->drawn);
    if (inlet > 0)
        g->inlet = inlet * g->half_width;
    if (outlet > 0)
        g->outlet = outlet * g->half_width;
    if (h->turns) /* if the entrainment reverses, each end is an inlet at some time */
        g->inlet = g->outlet = fmax(g->inlet, g->outlet);
    g->dx = (g->inlet + g->outlet) / (double)cells;
    g->first = -g->inlet;
}
