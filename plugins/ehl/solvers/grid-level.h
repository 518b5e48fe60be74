/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steady films between smooth flanks: of one grid, and of nested grids. */
#ifndef EHL_GRID_LEVEL_H
#define EHL_GRID_LEVEL_H

#include "../equations/solver.h"

/* Fills `film` with a first guess of the steady film under `at` whose least thickness is
   `thinnest`. */
void ehl_first_guess(ehl_solver *s, const ehl_instant *at, double modulus, double thinnest,
                     ehl_film *film);

/* One grid with all that a steady film on it needs. */
typedef struct ehl_grid_level {
    ehl_grid grid;
    ehl_reynolds reynolds;
    ehl_solver solver;
    ehl_film film;
    double *memory, *kernel;
    unsigned char *flags;
} ehl_grid_level;

/* The domain of `s` with that many cells; of its equations what a steady smooth film
   needs: laws, oil, wedge, limits of the film. The film on it is as good as 1e-3 at best. */
ff_status ehl_grid_level_create(ehl_grid_level *l, const ehl_solver *s, size_t cells,
                                double modulus);
void ehl_grid_level_destroy(ehl_grid_level *l);

/* `film` of the solver `s`: linear between the nodes of a coarser film on the same domain. */
void ehl_grid_level_refine(const ehl_grid_level *from, ehl_solver *s, ehl_film *film);

/* The film of the level, from that of the level before or, with NULL, from a first guess that is
   `thinnest` at its thinnest. FF_OK or FF_NOCONV. */
ff_status ehl_grid_level_solve(ehl_grid_level *l, const ehl_grid_level *before,
                               const ehl_step *step, const ehl_instant *at, double modulus,
                               double thinnest);

/* Fills `film` with the steady film of half the cells of `s`, by nested grids. FF_NOCONV: the grid
   is coarse itself, or none of the coarser ones has a solution. */
ff_status ehl_nested_film(ehl_solver *s, const ehl_step *step, const ehl_instant *at,
                          double modulus, double thinnest, ehl_film *film);

#endif
