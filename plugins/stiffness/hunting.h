/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Index deviations make every mesh cycle of the hunting period another one: what the pairs of teeth
 * go through in each, and which of them is worst.
 */
#ifndef STIFFNESS_HUNTING_H
#define STIFFNESS_HUNTING_H

#include "cycle.h"
#include "equilibrium.h"

typedef struct stiffness_range {
    double low, high;
} stiffness_range;

typedef struct stiffness_hunt {
    size_t period;
    double *pressure;    /* highest Hertz pressure on the pair that enters in each mesh cycle, Pa */
    size_t worst;        /* the cycle with the highest of them */
    size_t teeth[2];     /* that meet in it, from 1 */
    stiffness_range all; /* of the loaded transmission error, over all mesh cycles, m */
    double narrowest;    /* of its ranges within one mesh cycle, m */
} stiffness_hunt;

/* Solves every mesh cycle of the hunting period at the points of `grid`. h->pressure is freed by
   the caller, also after a failure. */
ff_status stiffness_hunt_scan(const stiffness_source *s, const stiffness_cycle *grid,
                              stiffness_hunt *h);

/* Says how far mesh cycle `number`, which stands for all, is from the worst. */
void stiffness_hunt_report(const stiffness_source *s, const stiffness_hunt *h, size_t number);

#endif
