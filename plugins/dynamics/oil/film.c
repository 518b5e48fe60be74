/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "film.h"

#include <math.h>

/* The load number w of the wedge alone, at beta = 0 (squeeze-law.h). */
static const double wedge_load = 4.8949684937;

/* Converts a phase to mesh cycles. A phase that differs from a node only by round-off is treated as
   just after the node. A phase deliberately placed before a node (landing.c) stays before it. */
static double cycles_to(const dynamics_film *film, double phase)
{
    static const double rounding = 1e-13;
    return film->span > 1 ? (phase + rounding) * film->span : phase;
}

/* Returns the number of whole mesh cycles up to a phase. */
static double whole_cycles(const dynamics_film *film, double phase)
{
    return film->span > 1 ? floor(cycles_to(film, phase)) : 0;
}

double dynamics_film_node(const dynamics_film *film, double phase)
{
    double node = film->pairs - floor(film->pairs);
    return (whole_cycles(film, phase) + node) / fmax(film->span, 1);
}

/* Returns R^1.5 of the pair at x mesh cycles after SAP. */
static double radius_power(const dynamics_film *film, double x)
{
    double r = film->radius[0] + x * (film->radius[1] + x * film->radius[2]);
    return r * sqrt(r);
}

/* Combines the pairs in mesh into one contact, whose width is the sum of their widths. A common
   radius R is chosen so that the squeeze force is exact. The error of the wedge force is then of
   second order in the differences of the radii. */
dynamics_film_place dynamics_film_at(const dynamics_film *film, double phase, double T)
{
    static const double root_of_two = 1.4142135623730951;
    double sum = 0, count = 0, span = fmax(film->span, 1);
    for (double x = cycles_to(film, phase) - whole_cycles(film, phase); x < film->pairs;
         x += 1, count++)
        sum += radius_power(film, x);
    if (count == 0)
        sum = radius_power(film, film->pairs), count = 1;
    dynamics_film_place place = {.squeeze = 3 * M_PI * root_of_two * film->viscosity * sum};
    if (film->rolling) {
        double radius = cbrt(sum / count), u = film->entrainment * span / T;
        radius *= radius;
        place.wedge = count * film->viscosity * u * radius;
        place.speed = u / sqrt(2 * radius);
    }
    return place;
}

dynamics_approach dynamics_film_approach(const dynamics_film *film,
                                         const dynamics_film_place *place, double load, double h)
{
    double root = sqrt(h);
    if (!film->rolling) {
        double by_load = h * root / place->squeeze;
        return (dynamics_approach){load * by_load, by_load, 1.5 * load * root / place->squeeze, 0};
    }
    double w = load * h / place->wedge, slope;
    double beta = dynamics_squeeze_beta(&film->table, w, &slope), unit = place->speed * root;
    return (dynamics_approach){
        .speed = beta * unit,
        .by_load = slope * unit * h / place->wedge,
        .by_film = (0.5 * beta + slope * w) * unit / h,
        .by_entrainment = (beta - slope * w) * unit,
    };
}

double dynamics_film_holding_load(const dynamics_film *film, const dynamics_film_place *place)
{
    return film->rolling ? wedge_load * place->wedge / film->hand_over : 0;
}

/* Solves for the deflection z of the teeth; V(k z, h_c - q + z) increases with z. */
double dynamics_film_quasi_static(const dynamics_film *film, const dynamics_film_place *place,
                                  double stiffness, double q, double speed)
{
    double low = fmax(q, 0), high = low + film->hand_over + fabs(q) + 1, none = low - q;
    if (speed <= 0 && !film->rolling)
        return none;
    for (int i = 0; i < 200 && high - low > 1e-15 * high; i++) {
        double z = 0.5 * (low + high);
        dynamics_approach v =
            dynamics_film_approach(film, place, stiffness * z, film->hand_over - q + z);
        *(v.speed < speed ? &low : &high) = z;
    }
    return low - q;
}
