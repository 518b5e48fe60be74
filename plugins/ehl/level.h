/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One grid with all that a steady film on it needs. */
#ifndef EHL_LEVEL_H
#define EHL_LEVEL_H

#include "solver.h"

typedef struct ehl_level {
    ehl_grid grid;
    ehl_reynolds reynolds;
    ehl_solver solver;
    ehl_film film;
    double *memory, *kernel;
    unsigned char *flags;
} ehl_level;

/* The domain of `s` with that many cells; of its equations what nest.c and pilot.c need: laws, oil,
   wedge, limits of the film. The film on it is as good as 1e-3 at best. */
ff_status ehl_level_create(ehl_level *l, const ehl_solver *s, size_t cells, double modulus);
void ehl_level_destroy(ehl_level *l);

/* `film` of the solver `s`: linear between the nodes of a coarser film on the same domain. */
void ehl_level_refine(const ehl_level *from, ehl_solver *s, ehl_film *film);

/* The film of the level, from that of the level before or, with NULL, from a first guess that is
   `thinnest` at its thinnest. FF_OK or FF_NOCONV. */
ff_status ehl_level_find(ehl_level *l, const ehl_level *before, const ehl_step *step,
                         const ehl_instant *at, double modulus, double thinnest);

#endif
