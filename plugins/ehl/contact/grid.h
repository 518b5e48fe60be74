/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fixed uniform grid of a run: its length scale is the largest load of the history. */
#ifndef EHL_GRID_H
#define EHL_GRID_H

#include "history.h"
#include "liquid.h"

typedef struct ehl_grid {
    size_t nodes;         /* cells + 1 */
    double dx, first;     /* m; x[i] = first + i dx, entrainment towards +x */
    double half_width;    /* m, largest Hertz half-width a */
    double pressure;      /* Pa, largest Hertz pressure */
    double inlet, outlet; /* m, distances of the ends from x = 0 */
    int fed;              /* the oil in front of the inlet has the pressure of a longer one */
} ehl_grid;

/* Hertz line contact: a = sqrt(8 w R/(pi E')), p_H = E' a/(4 R) (Johnson 1985, ch. 4). */
double ehl_hertz_half_width(double load, double radius, double modulus);
double ehl_hertz_pressure(double load, double radius, double modulus);

/* Central film of an isothermal smooth line contact, all regimes (Moes 2000). */
double ehl_moes_film(const ehl_instant *at, double modulus, const ehl_oil *oil);

/* The same of a row of a history, which may know it. */
double ehl_row_film(const ehl_history *h, size_t row, const ehl_oil *oil);

/* Distance from the contact of half-width a at which its Hertzian gap has grown by h, where that is
   short against a: over it the pressure of the inlet rises (Greenwood 1972). */
double ehl_hertz_gap_distance(double a, double radius, double h);

/* The same, but no more than sqrt(2 R h), as under light loads. */
double ehl_inlet_buildup(double a, double radius, double h);

/* Pressure that the oil of an infinite inlet would have at x = -end, Pa, and its integral upstream,
   N/m. */
typedef struct ehl_lost {
    double pressure, load;
} ehl_lost;

/* Both in front of x = -end, in a steady film of h. */
ehl_lost ehl_pressure_upstream(const ehl_oil *oil, const ehl_instant *at, double a, double h,
                               double end);

/* The pressure at x = -end, Pa, and the load that the oil in front of it carries, N/m, in a steady
   film; 0 without load, and next to 0 where it would be more than a part of the load. */
void ehl_inlet_ahead(const ehl_oil *oil, const ehl_instant *at, double modulus, double end,
                     double *pressure, double *load);

/* inlet, outlet: multiples of the largest half-width, or 0: long enough for every load and for
   flanks with the combined roughness rq, the inlet at least `supplied` (m, ehl_inlet_supplied). */
void ehl_grid_fit(ehl_grid *g, size_t cells, double inlet, double outlet, const ehl_history *h,
                  const ehl_oil *oil, double rq, double supplied);

#endif
