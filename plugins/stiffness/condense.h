/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A sector of a gear condensed to the nodes of its two sides and to a number of loads: static
 * condensation by one sparse Cholesky factorisation of its inside. The rim is held.
 */
#ifndef FF_STIFFNESS_CONDENSE_H
#define FF_STIFFNESS_CONDENSE_H

#include "sector.h"

typedef struct ff_condensed {
    size_t side; /* freedoms of one side, x and y of its nodes from the rim outward */
    size_t loads;
    double *stiffness; /* of the sides, 2 side x 2 side, column-major: left (y < 0), then right */
    double *pull;      /* forces that the loads put on the sides, 2 side x loads, column-major */
    double *held;      /* compliance between the loads with both sides held, loads x loads */
} ff_condensed;

enum { FF_CONDENSED, FF_CONDENSE_MEMORY, FF_CONDENSE_SINGULAR };
int ff_condense(ff_condensed *c, const ff_sector *sector, const ff_material *material, size_t loads,
                size_t parts, const ff_nodal *part);
void ff_condensed_free(ff_condensed *c);

#endif
