/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fixed uniform grid of a run. Its unit of length is the Hertz half-width at the largest load
   of the history. */
#ifndef EHL_GRID_H
#define EHL_GRID_H

#include "history.h"
#include "liquid.h"

typedef struct ehl_grid {
    size_t nodes;         /* cells + 1 */
    double dx, first;     /* m; x[i] = first + i dx, entrainment towards +x */
    double half_width;    /* m, largest Hertz half-width a */
    double pressure;      /* Pa, largest Hertz pressure */
    double inlet, outlet; /* m, distances of both ends from x = 0 */
    double drawn;         /* m, smallest outlet for contacts that draw in oil at the outlet; 0:
                             there is no such contact */
    int fed;              /* 1: the domain begins with the pressure of a longer inlet */
} ehl_grid;

/* Return the half-width and the pressure of a Hertz line contact: a = sqrt(8 w R/(pi E')), p_H = E'
   a/(4 R) (Johnson 1985, ch. 4). */
double ehl_hertz_half_width(double load, double radius, double modulus);
double ehl_hertz_pressure(double load, double radius, double modulus);

/* Returns the central film thickness of an isothermal smooth line contact in all regimes (Moes
   2000). */
double ehl_moes_film(const ehl_instant *at, double modulus, const ehl_oil *oil);

/* Returns this film thickness for a row of a history, which may have stored it. */
double ehl_row_film(const ehl_history *h, size_t row, const ehl_oil *oil);

/* Returns the distance from a contact of half-width a at which its Hertzian gap has grown by h, for
   distances much shorter than a. The pressure of the inlet rises over this distance (Greenwood
   1972). */
double ehl_hertz_gap_distance(double a, double radius, double h);

/* Returns this distance, but at most sqrt(2 R h), which applies to light loads. */
double ehl_inlet_buildup(double a, double radius, double h);

/* Pressure at x = -end in an infinitely long inlet, Pa, and the integral of the pressure upstream
   of this point, N/m. */
typedef struct ehl_lost {
    double pressure, load;
} ehl_lost;

/* Computes both quantities for a steady film of thickness h. */
ehl_lost ehl_pressure_upstream(const ehl_oil *oil, const ehl_instant *at, double a, double h,
                               double end);

/* Computes the pressure at x = -end, Pa, and the load carried by the oil upstream of it, N/m, in a
   steady film. Both are 0 without load. Both are reduced where the load upstream would exceed a
   quarter of the load of the contact. */
void ehl_inlet_ahead(const ehl_oil *oil, const ehl_instant *at, double modulus, double end,
                     double *pressure, double *load);

/* Fits the grid to a history. `inlet` and `outlet` are multiples of the largest half-width. 0 means
   automatic: long enough for every load and for flanks of the combined roughness rq, with an inlet
   of at least `supplied` (m, ehl_inlet_supplied). */
void ehl_grid_fit(ehl_grid *g, size_t cells, double inlet, double outlet, const ehl_history *h,
                  const ehl_oil *oil, double rq, double supplied);

#endif
