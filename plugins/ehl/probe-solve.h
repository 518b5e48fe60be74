/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Measures the error of a number of cells on steady films at a few instants of a history, against
 * twice the cells: a probe solve of some dozens of deflections predicts the error of a run of
 * thousands.
 */
#ifndef EHL_PROBE_SOLVE_H
#define EHL_PROBE_SOLVE_H

#include "fluid.h"
#include "history.h"

enum { EHL_PROBE_INSTANTS = 2 };

typedef struct ehl_probe {
    size_t cells;   /* 0: nothing has been measured */
    double least;   /* largest error of h_min, over itself */
    double central; /* and of the film at x = 0 */
    size_t worst;   /* the instant with the larger of both */
    double work;    /* deflections times cells times log2(cells) */
} ehl_probe;

/* Solves at the instants given, 1 to EHL_PROBE_INSTANTS, with 16 cells or more. FF_OK with `cells`
   0 where no film is found on so coarse a grid; FF_NOMEM. */
ff_status ehl_probe_solve(const ehl_history *h, const ehl_laws *laws, const ehl_oil *oil,
                          const ehl_instant *at, size_t count, size_t cells, ehl_probe *probe);

#endif
