/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A sector of a gear, condensed to the nodes of its two sides and to a number of loads by one
   sparse Cholesky factorisation of its inner nodes. The rim is fixed. */
#ifndef STIFFNESS_CONDENSE_H
#define STIFFNESS_CONDENSE_H

#include "sector.h"

typedef struct stiffness_condensed {
    size_t side; /* degrees of freedom of one side: x and y of its nodes from the rim outwards */
    size_t loads;
    double *stiffness; /* stiffness of the sides, 2 side x 2 side, column-major: left (y < 0),
                          then right */
    double *pull;      /* forces on the sides due to the loads, 2 side x loads, column-major */
    double *held;      /* compliance between the loads with both sides fixed, loads x loads */
} stiffness_condensed;

/* Condenses the sector. Each load is the sum of some of the `parts` nodal forces `part`. Returns
   one of these values; the caller frees the result, also after an error. */
enum { STIFFNESS_CONDENSED, STIFFNESS_CONDENSE_MEMORY, STIFFNESS_CONDENSE_SINGULAR };
int stiffness_condense(stiffness_condensed *c, const stiffness_sector *sector,
                       const stiffness_material *material, size_t loads, size_t parts,
                       const stiffness_nodal *part);
void stiffness_condensed_free(stiffness_condensed *c);

#endif
