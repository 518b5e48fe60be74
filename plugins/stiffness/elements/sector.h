/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plane finite elements of one sector of a gear: a tooth with its fillets, and the body below it,
   fixed at the rim radius. Quadratic eight-node elements on a grid that follows the contour. */
#ifndef STIFFNESS_SECTOR_H
#define STIFFNESS_SECTOR_H

#include "contour.h"

#include <stddef.h>

typedef struct stiffness_material {
    double elastic_modulus, poisson_ratio, width; /* Pa, 1, m */
    int plane_strain;
} stiffness_material;

/* A part of a load, distributed over the three nodes of an element's side. */
typedef struct stiffness_nodal {
    size_t load; /* index of the load to which it belongs */
    size_t node[3];
    double weight[3];
    stiffness_point direction;
} stiffness_nodal;

typedef struct stiffness_sector {
    size_t nodes, elements;
    stiffness_point *node;
    size_t (*element)[8];        /* corners, then middles of the sides, counter-clockwise */
    size_t rows, columns;        /* size of the grid of nodes */
    size_t body_rows;            /* from the rim to the fillets, both included */
    size_t tooth_from, tooth_to; /* columns that continue into the tooth */
    size_t *grid;                /* node at row and column, or STIFFNESS_NO_NODE */
    const stiffness_contour *contour;
} stiffness_sector;
#define STIFFNESS_NO_NODE ((size_t)-1)

/* Creates about `elements` elements between the rim radius and the tip. Returns 0 if memory is
   short. */
int stiffness_sector_make(stiffness_sector *s, const stiffness_contour *contour, double rim_radius,
                          size_t elements);
void stiffness_sector_free(stiffness_sector *s);

/* stiffness_sector_force returns a unit normal force on the flank at that roll angle.
   stiffness_sector_axis returns a unit force in the same direction on the point of the tooth's axis
   below; its weights also interpolate the displacement of that point along the force. */
stiffness_nodal stiffness_sector_force(const stiffness_sector *s, double roll);
stiffness_nodal stiffness_sector_axis(const stiffness_sector *s, double roll);

/* Computes the stiffness matrix of an element for the displacements x0 y0 x1 y1 ... of its
   nodes. */
void stiffness_sector_stiffness(const stiffness_sector *s, size_t element,
                                const stiffness_material *material, double k[16][16]);

#endif
