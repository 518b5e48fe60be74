/* SPDX-License-Identifier: GPL-3.0-or-later */
/* With index deviations, all mesh cycles of the hunting period differ. These functions find the
   load on the pairs of teeth in each mesh cycle, and the pair with the highest Hertz pressure. */
#ifndef STIFFNESS_HUNTING_H
#define STIFFNESS_HUNTING_H

#include "cycle.h"
#include "equilibrium.h"

typedef struct stiffness_error_range {
    double low, high;
} stiffness_error_range;

typedef struct stiffness_hunting {
    size_t period;
    double *pressure; /* highest Hertz pressure on the pair that enters in each mesh cycle, Pa */
    size_t worst;     /* the cycle with the highest pressure */
    size_t teeth[2];  /* teeth of gear 1 and gear 2 that meet in that cycle, counted from 1 */
    stiffness_error_range all; /* range of the loaded transmission error over all mesh cycles, m */
    double narrowest; /* the smallest range of the loaded transmission error within one mesh cycle,
                         m */
} stiffness_hunting;

/* Solves every mesh cycle of the hunting period at the points of `grid`. The caller frees
 * h->pressure, also after a failure. */
ff_status stiffness_hunting_scan(const stiffness_source *s, const stiffness_cycle *grid,
                                 stiffness_hunting *h);

/* Reports, in a quality line, the difference between mesh cycle `number`, whose outputs are
   written, and the worst mesh cycle. */
void stiffness_hunting_report(const stiffness_source *s, const stiffness_hunting *h, size_t number);

#endif
