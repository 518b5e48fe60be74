/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steady films between smooth flanks, on one grid and on nested grids. */
#ifndef EHL_GRID_LEVEL_H
#define EHL_GRID_LEVEL_H

#include "../equations/solver.h"

/* Fills `film` with a first guess of the steady film under `at`; its smallest thickness is
   `thinnest`. */
void ehl_first_guess(ehl_solver *s, const ehl_instant *at, double modulus, double thinnest,
                     ehl_film *film);

/* A grid, with equations, solver and film for a steady film on this grid. */
typedef struct ehl_grid_level {
    ehl_grid grid;
    ehl_reynolds reynolds;
    ehl_solver solver;
    ehl_film film;
    double *memory, *kernel;
    unsigned char *flags;
} ehl_grid_level;

/* Makes a level with `cells` cells on the domain of `s`, with the equations of a steady smooth
   film: laws, oil, wedge, limits of the film. The relative tolerance of its film is at least
   1e-3. */
ff_status ehl_grid_level_create(ehl_grid_level *l, const ehl_solver *s, size_t cells,
                                double modulus);
void ehl_grid_level_destroy(ehl_grid_level *l);

/* Interpolates `film` of the solver `s` linearly from a coarser film on the same domain. */
void ehl_grid_level_refine(const ehl_grid_level *from, ehl_solver *s, ehl_film *film);

/* Solves for the film of the level, starting from that of the level `before`, or from a first guess
   with the smallest thickness `thinnest` if `before` is NULL. Returns FF_OK or FF_NOCONV. */
ff_status ehl_grid_level_solve(ehl_grid_level *l, const ehl_grid_level *before,
                               const ehl_step *step, const ehl_instant *at, double modulus,
                               double thinnest);

/* Fills `film` with the steady film on half the cells of `s`, by nested grids. Returns FF_NOCONV if
   the grid is already coarse, or if no coarser grid has a solution. */
ff_status ehl_nested_film(ehl_solver *s, const ehl_step *step, const ehl_instant *at,
                          double modulus, double thinnest, ehl_film *film);

#endif
