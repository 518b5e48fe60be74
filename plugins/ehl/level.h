/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One grid with all that a steady film on it needs. */
#ifndef FF_EHL_LEVEL_H
#define FF_EHL_LEVEL_H

#include "solver.h"

typedef struct ff_level {
    ff_grid grid;
    ff_reynolds reynolds;
    ff_solver solver;
    ff_film film;
    double *memory, *kernel;
    unsigned char *flags;
} ff_level;

/* The domain of `s` with that many cells; of its equations what nest.c and pilot.c need: laws, oil,
   wedge, limits of the film. The film on it is as good as 1e-3 at best. */
ff_status ff_level_create(ff_level *l, const ff_solver *s, size_t cells, double modulus);
void ff_level_destroy(ff_level *l);

/* `film` of the solver `s`: linear between the nodes of a coarser film on the same domain. */
void ff_level_refine(const ff_level *from, ff_solver *s, ff_film *film);

/* The film of the level, from that of the level before or, with NULL, from a first guess that is
   `thinnest` at its thinnest. FF_OK or FF_NOCONV. */
ff_status ff_level_find(ff_level *l, const ff_level *before, const ff_step *step,
                        const ff_instant *at, double modulus, double thinnest);

#endif
