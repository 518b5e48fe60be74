/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What a number of cells makes of the steady films at a few instants of a history, against twice
 * the cells: some dozens of deflections tell of a run of thousands how far its film will be off.
 */
#ifndef FF_EHL_PILOT_H
#define FF_EHL_PILOT_H

#include "fluid.h"
#include "history.h"

enum { FF_PILOT_INSTANTS = 2 };

typedef struct ff_pilot {
    size_t cells;   /* 0: nothing has been measured */
    double least;   /* largest error of h_min, over itself */
    double central; /* and of the film at x = 0 */
    size_t worst;   /* the instant with the larger of both */
    double work;    /* deflections times cells times log2(cells) */
} ff_pilot;

/* At the instants given, 1 to FF_PILOT_INSTANTS, with 16 cells or more. FF_OK with `cells` 0 where
   no film is found on so coarse a grid; FF_NOMEM. */
ff_status ff_pilot_fly(const ff_history *h, const ff_laws *laws, const ff_oil *oil,
                       const ff_instant *at, size_t count, size_t cells, ff_pilot *pilot);

#endif
