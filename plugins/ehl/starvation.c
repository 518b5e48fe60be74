/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "starvation.h"

#include "grid.h"

#include <math.h>

/* Pressure that the oil of an infinite inlet would have at x = -end, Pa, and its integral upstream,
   N/m. */
typedef struct lost {
    double pressure, load;
} lost;

/*
 * The pressure is low there, so that the gap is that of the Hertzian contact, held apart by h, and
 * the oil as at ambient pressure:
 *   p = 12 eta0 u int (gap - h)/gap^3 dx,   x = -end/t,   0 < t < 1
 */
static lost pressure_upstream(const ehl_reynolds *eq, const ehl_instant *at, double a, double h,
                              double end)
{
    enum { POINTS = 12 };
    double push = 12 * eq->oil.viscosity * fabs(at->entrainment);
    lost sum = {0, 0};
    for (int k = 0; k < POINTS; k++) {
        double t = (k + 0.5) / POINTS, x = end / t, s = x / a, y = sqrt((s - 1) * (s + 1));
        double opened = a * a / (2 * at->radius) * (s * y - asinh(y)), gap = h + opened;
        double rise = push * opened / (gap * gap * gap) * x / t / POINTS;
        sum.pressure += rise;
        sum.load += (x - end) * rise;
    }
    return sum;
}

/*
 * A film without load on the oil in front of it follows from what the reduced pressure q =
 * int eta0/eta dp reaches at the edge of the contact (inlet.h): q falls as about film^-1.7. All of
 * the lost pressure is missing there where the oil has thickened, since q only adds up; in an oil
 * that has not, the elastic flanks give way to it over `length`, and it comes through as the root
 * of that over the distance.
 */
static double share_by_pressure(const ehl_reynolds *eq, double p_hertz, double a, double length,
                                double distance, double lost_pressure, double *thickened)
{
    const double depth = 0.72, most = 2.75; /* of the edge, inlet.c */
    double y = depth * depth * length / a, alpha = eq->oil.alpha;
    double p = p_hertz * sqrt(2 * y / (1 + 2 * y));
    p /= 1 + alpha * p / most;
    *thickened = -expm1(-alpha * p);
    double q = alpha * p > 1e-6 ? *thickened / alpha : p;
    double through = 0.75 * fmin(1, sqrt(length / distance));
    return (*thickened + (1 - *thickened) * through) * lost_pressure / (1.7 * q);
}

/*
 * The contact must carry the load that the oil upstream of the domain does not: the film of a rigid
 * cylinder goes with 1/w, that of an elastic one with w^-1/5, and with w^-1/10 where the oil
 * thickens (Moes 2000). The rigid part of the film is 4.9 eta u R/w (Martin 1916), joined as by
 * Moes.
 */
double ehl_starvation(const ehl_reynolds *eq, const ehl_instant *at, double modulus, double h,
                      double end)
{
    double a = ehl_hertz_half_width(at->load, at->radius, modulus), thickened;
    if (!(end > a) || !(h > 0))
        return 1;
    lost l = pressure_upstream(eq, at, a, h, end);
    double p_hertz = ehl_hertz_pressure(at->load, at->radius, modulus);
    double length = ehl_hertz_gap_distance(a, at->radius, h);
    double pressed = share_by_pressure(eq, p_hertz, a, length, end - a, l.pressure, &thickened);
    double unloaded = (l.load + l.pressure * end) / at->load;
    double rigid = 4.9 * eq->oil.viscosity * fabs(at->entrainment) * at->radius / (at->load * h);
    double share = fmin(1, pow(rigid, 7. / 3));
    double elastic = pressed + (0.2 - 0.1 * thickened) * unloaded;
    double missing = share * unloaded + (1 - share) * elastic;
    return missing / (1 + missing); /* of the film without end; missing: of what is there */
}
