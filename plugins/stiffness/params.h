/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of parameters that several models of mesh stiffness have. */
#ifndef STIFFNESS_PARAMS_H
#define STIFFNESS_PARAMS_H

/* Equal steps of the mesh cycle. */
#define STIFFNESS_POINTS_ROW                                                                       \
    {                                                                                              \
        .name = "points", .unit = "1",                                                             \
        .doc = "equal steps of the mesh cycle that the outputs are given at", .type = FF_INT,      \
        .flags = FF_TUNABLE, .preset = "200", .min = 4, .max = 100000                              \
    }

/* Read by stiffness_rim_set. */
#define STIFFNESS_RIM_RADIUS_ROW                                                                   \
    {                                                                                              \
        .name = "rim_radius", .unit = "mm",                                                        \
        .doc =                                                                                     \
            "radius inside which a gear's body is rigid, one value or two; without it the bore "   \
            "radius, or half the root radius for a gear without a bore",                           \
        .type = FF_REALS, .flags = FF_MIN_OPEN, .min = 0, .max = 1e5, .min_count = 1,              \
        .max_count = 2                                                                             \
    }

/* The choice 1 is the tangent. */
#define STIFFNESS_DEFINITION_ROW                                                                   \
    {                                                                                              \
        .name = "definition", .unit = "",                                                          \
        .doc =                                                                                     \
            "secant F/(e_l - e) or tangent dF/d(e_l); they differ where deviations of the flanks " \
            "keep pairs apart",                                                                    \
        .type = FF_CHOICE, .preset = "secant", .choices = "secant|tangent"                         \
    }

/* Read by stiffness_mesh_cycles_set. */
#define STIFFNESS_MESH_CYCLE_ROW                                                                   \
    {                                                                                              \
        .name = "mesh_cycle", .unit = "1",                                                         \
        .doc =                                                                                     \
            "which mesh cycle of the hunting period, where teeth have index deviations, from 0; "  \
            "worst: the one whose pair bears the highest Hertz pressure; all: tooth_force and "    \
            "load_share of the pairs of all of them, the rest of mesh cycle 0",                    \
        .type = FF_INT, .preset = "0", .choices = "worst|all", .min = 0, .max = 1e9                \
    }

#endif
