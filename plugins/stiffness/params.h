/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of parameters that several models of mesh stiffness share. */
#ifndef STIFFNESS_PARAMS_H
#define STIFFNESS_PARAMS_H

#include <flankfilm/author.h>

/* Number of equal steps of the mesh cycle: the member `points`. */
#define STIFFNESS_POINTS_ROW(type)                                                                 \
    FF_COUNT("points", type, points, FF_TUNABLE, "200", NULL, 4, 100000, 0, 0,                     \
             "number of equal steps of the mesh cycle at which the outputs are given")

/* Radii of the rims, for stiffness_conditions_read: the member `rim`. */
#define STIFFNESS_RIM_RADIUS_ROW(type)                                                             \
    FF_LIST("rim_radius", "mm", type, rim, FF_MIN_OPEN, NULL, NULL, 0, 1e5, 0, 0, 1, 2,            \
            "radius inside which a gear's body is rigid, one value or two; left out: the bore "    \
            "radius, or half the root radius for a gear without a bore")

/* The parameter row of the stiffness definition, 1: tangent. The member `definition`. */
#define STIFFNESS_DEFINITION_ROW(type)                                                             \
    FF_ONE_OF("secant|tangent", "definition", type, definition, 0, "secant",                       \
              "definition of the stiffness: secant F/(e_l - e) or tangent dF/d(e_l); they differ " \
              "where deviations of the flanks separate pairs")

/* The parameter mesh_cycle, which stiffness_mesh_cycles_set sets. */
#define STIFFNESS_MESH_CYCLE_ROW                                                                   \
    FF_ROW("mesh_cycle", "1",                                                                      \
           "mesh cycle of the hunting period, from 0, for teeth with index deviations; worst: "    \
           "the mesh cycle whose pair has the highest Hertz pressure; all: tooth_force and "       \
           "load_share of the pairs of all mesh cycles, other outputs of mesh cycle 0",            \
           FF_INT, 0, "0", "worst|all", NULL, 0, 1e9, 0, 0, 0, 0, 0)

#endif
