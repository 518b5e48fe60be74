/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The input ports of the dynamic models. */
#include "inputs.h"

/* The rows that all models share. Two tables contain them. */
#define COMMON_ROWS                                                                                \
    [DYNAMICS_IN_ROLL_ANGLE] = {.name = "gear.roll_angle",                                         \
                                .unit = "rad",                                                     \
                                .doc = "roll angle of gear 1 along the path of contact",           \
                                .dims = "station"},                                                \
    [DYNAMICS_IN_ROLL_SAP] = {.name = "gear.roll_sap",                                             \
                              .unit = "rad",                                                       \
                              .doc = "roll angle at the start of active profile",                  \
                              .dims = ""},                                                         \
    [DYNAMICS_IN_TEETH] = {.name = "gear.teeth",                                                   \
                           .unit = "1",                                                            \
                           .doc = "numbers of teeth",                                              \
                           .dims = "gear"},                                                        \
    [DYNAMICS_IN_BACKLASH] = {.name = "gear.backlash",                                             \
                              .unit = "m",                                                         \
                              .doc = "backlash along the line of action, 2 b",                     \
                              .dims = ""},                                                         \
    [DYNAMICS_IN_EQUIVALENT_MASS] =                                                                \
        {.name = "gear.equivalent_mass",                                                           \
         .unit = "kg",                                                                             \
         .doc = "equivalent mass at the mesh spring, I1 I2/(I1 rb2^2 + I2 rb1^2)",                 \
         .dims = "",                                                                               \
         .flags = FF_OPTIONAL},                                                                    \
    [DYNAMICS_IN_MESH_FREQUENCY] = {.name = "operating.mesh_frequency",                            \
                                    .unit = "Hz",                                                  \
                                    .doc = "mesh frequency: mesh cycles per second",               \
                                    .dims = ""},                                                   \
    [DYNAMICS_IN_LINE_FORCE] = {.name = "operating.line_force",                                    \
                                .unit = "N",                                                       \
                                .doc = "static force along the line of action",                    \
                                .dims = ""},                                                       \
    [DYNAMICS_IN_PHASE] = {.name = "stiffness.phase",                                              \
                           .unit = "1",                                                            \
                           .doc =                                                                  \
                               "phase of the mesh cycle, 0 to 1; a repeated value marks a jump",   \
                           .dims = "phase"},                                                       \
    [DYNAMICS_IN_STIFFNESS] =                                                                      \
        {.name = "stiffness.stiffness",                                                            \
         .unit = "N/m",                                                                            \
         .doc = "mesh stiffness; linear between phases, or a smooth curve if it fits the values",  \
         .dims = "phase"},                                                                         \
    [DYNAMICS_IN_STIFFNESS_MEAN] = {.name = "stiffness.stiffness_mean",                            \
                                    .unit = "N/m",                                                 \
                                    .doc = "mean mesh stiffness",                                  \
                                    .dims = ""},                                                   \
    [DYNAMICS_IN_TRANSMISSION_ERROR] = {.name = "stiffness.transmission_error",                    \
                                        .unit = "m",                                               \
                                        .doc = "unloaded transmission error e; default: 0",        \
                                        .dims = "phase",                                           \
                                        .flags = FF_OPTIONAL},                                     \
    [DYNAMICS_IN_LOADED_ERROR] =                                                                   \
        {.name = "stiffness.loaded_transmission_error",                                            \
         .unit = "m",                                                                              \
         .doc = "transmission error e_l under the line force, which is the limit of a slow "       \
                "motion; default: e + F/k",                                                        \
         .dims = "phase",                                                                          \
         .flags = FF_OPTIONAL},                                                                    \
    [DYNAMICS_IN_TOOTH_FORCE] = {.name = "stiffness.tooth_force",                                  \
                                 .unit = "N",                                                      \
                                 .doc = "quasi-static tooth force W_s",                            \
                                 .dims = "engagement? gear.station"},                              \
    [DYNAMICS_IN_LOAD_SHARE] = {.name = "stiffness.load_share",                                    \
                                .unit = "1",                                                       \
                                .doc =                                                             \
                                    "load share of one tooth pair, used if the line force is 0",   \
                                .dims = "engagement? gear.station",                                \
                                .flags = FF_OPTIONAL},                                             \
    [DYNAMICS_IN_FORCE_LEVEL] = {.name = "stiffness.force_level",                                  \
                                 .unit = "N",                                                      \
                                 .doc = "mesh forces, increasing from 0, at which the level_... "  \
                                        "inputs are given",                                        \
                                 .dims = "level",                                                  \
                                 .flags = FF_OPTIONAL},                                            \
    [DYNAMICS_IN_LEVEL_ERROR] = {.name = "stiffness.level_error",                                  \
                                 .unit = "m",                                                      \
                                 .doc = "transmission error at each force_level",                  \
                                 .dims = "level phase",                                            \
                                 .flags = FF_OPTIONAL},                                            \
    [DYNAMICS_IN_LEVEL_STIFFNESS] = {.name = "stiffness.level_stiffness",                          \
                                     .unit = "N/m",                                                \
                                     .doc = "slope of the mesh force at each force_level",         \
                                     .dims = "level phase",                                        \
                                     .flags = FF_OPTIONAL},                                        \
    [DYNAMICS_IN_LEVEL_TOOTH_FORCE] = {.name = "stiffness.level_tooth_force",                      \
                                       .unit = "N",                                                \
                                       .doc = "tooth force of one pair at each force_level",       \
                                       .dims = "level gear.station",                               \
                                       .flags = FF_OPTIONAL},                                      \
    [DYNAMICS_IN_REFERENCE_FORCE] = {.name = "operating.reference_force",                          \
                                     .unit = "N",                                                  \
                                     .doc = "line force at which stiffness and load sharing were " \
                                            "computed; not given or 0: the line force",            \
                                     .dims = "",                                                   \
                                     .flags = FF_OPTIONAL},                                        \
    [DYNAMICS_IN_FLUCTUATION_ORDER] =                                                              \
        {.name = "operating.fluctuation_order",                                                    \
         .unit = "1",                                                                              \
         .doc = "orders of the fluctuation of the line force, per turn of gear 1",                 \
         .dims = "fluctuation",                                                                    \
         .flags = FF_OPTIONAL},                                                                    \
    [DYNAMICS_IN_FLUCTUATION_COSINE] =                                                             \
        {.name = "operating.fluctuation_cosine",                                                   \
         .unit = "N",                                                                              \
         .doc = "amplitude of cos(order angle) in the line force, for each order; angle of gear "  \
                "1",                                                                               \
         .dims = "fluctuation",                                                                    \
         .flags = FF_OPTIONAL},                                                                    \
    [DYNAMICS_IN_FLUCTUATION_SINE] = {.name = "operating.fluctuation_sine",                        \
                                      .unit = "N",                                                 \
                                      .doc = "amplitude of sin(order angle) in the line force, "   \
                                             "for each order",                                     \
                                      .dims = "fluctuation",                                       \
                                      .flags = FF_OPTIONAL},                                       \
    [DYNAMICS_IN_FLUCTUATION_PERIOD] =                                                             \
        {.name = "operating.fluctuation_period",                                                   \
         .unit = "1",                                                                              \
         .doc = "mesh cycles after which the line force and the mesh repeat together",             \
         .dims = "",                                                                               \
         .flags = FF_OPTIONAL},                                                                    \
    [DYNAMICS_IN_DRIVEN_MASS] = {.name = "operating.driven_mass",                                  \
                                 .unit = "kg",                                                     \
                                 .doc = "equivalent mass at the mesh spring if the speed of gear " \
                                        "1 is prescribed; not given or 0: equivalent_mass",        \
                                 .dims = "",                                                       \
                                 .flags = FF_OPTIONAL},                                            \
    [DYNAMICS_IN_BACK_PHASE] = {.name = "stiffness.back_phase",                                    \
                                .unit = "1",                                                       \
                                .doc = "phase of the curves of the back flanks, opposite to "      \
                                       "those that carry the line force; not given or empty: "     \
                                       "they mirror the driving flanks",                           \
                                .dims = "back_phase",                                              \
                                .flags = FF_OPTIONAL},                                             \
    [DYNAMICS_IN_BACK_OFFSET] = {.name = "stiffness.back_offset",                                  \
                                 .unit = "1",                                                      \
                                 .doc = "sum of the two phases at which the two flanks of a "      \
                                        "tooth of gear 1 are in contact at the same roll angle",   \
                                 .dims = "",                                                       \
                                 .flags = FF_OPTIONAL},                                            \
    [DYNAMICS_IN_BACK_STIFFNESS] = {.name = "stiffness.back_stiffness",                            \
                                    .unit = "N/m",                                                 \
                                    .doc = "mesh stiffness of the back flanks",                    \
                                    .dims = "back_phase",                                          \
                                    .flags = FF_OPTIONAL},                                         \
    [DYNAMICS_IN_BACK_ERROR] = {.name = "stiffness.back_transmission_error",                       \
                                .unit = "m",                                                       \
                                .doc = "transmission error of the back flanks without load",       \
                                .dims = "back_phase",                                              \
                                .flags = FF_OPTIONAL},                                             \
    [DYNAMICS_IN_BACK_LOADED_ERROR] = {.name = "stiffness.back_loaded_transmission_error",         \
                                       .unit = "m",                                                \
                                       .doc = "transmission error of the back flanks under load",  \
                                       .dims = "back_phase",                                       \
                                       .flags = FF_OPTIONAL},                                      \
    [DYNAMICS_IN_BACK_LEVEL_ERROR] = {.name = "stiffness.back_level_error",                        \
                                      .unit = "m",                                                 \
                                      .doc = "transmission error of the back flanks under each "   \
                                             "force_level",                                        \
                                      .dims = "back_level back_phase",                             \
                                      .flags = FF_OPTIONAL},                                       \
    [DYNAMICS_IN_BACK_LEVEL_STIFFNESS] = {.name = "stiffness.back_level_stiffness",                \
                                          .unit = "N/m",                                           \
                                          .doc = "slope of the mesh force of the back flanks at "  \
                                                 "each force_level",                               \
                                          .dims = "back_level back_phase",                         \
                                          .flags = FF_OPTIONAL},                                   \
    [DYNAMICS_IN_BACK_LEVEL_TOOTH_FORCE] = {.name = "stiffness.back_level_tooth_force",            \
                                            .unit = "N",                                           \
                                            .doc = "tooth force of one pair of back flanks at "    \
                                                   "each force_level",                             \
                                            .dims = "back_level gear.station",                     \
                                            .flags = FF_OPTIONAL}

const ff_port dynamics_input_ports[DYNAMICS_COUPLED_INPUT_COUNT] = {
    COMMON_ROWS,
    [DYNAMICS_IN_BASE_RADIUS] = {.name = "gear.base_radius",
                                 .unit = "m",
                                 .doc = "base circle radii",
                                 .dims = "gear"},
    [DYNAMICS_IN_CENTRE_DISTANCE] = {.name = "gear.centre_distance",
                                     .unit = "m",
                                     .doc = "mounted centre distance",
                                     .dims = ""},
    [DYNAMICS_IN_MASS] = {.name = "gear.mass",
                          .unit = "kg",
                          .doc = "masses of the gears",
                          .dims = "gear",
                          .flags = FF_OPTIONAL},
};

const ff_port dynamics_oil_input_ports[DYNAMICS_OIL_INPUT_COUNT] = {
    COMMON_ROWS,
    [DYNAMICS_IN_RADIUS_1] = {.name = "gear.radius_1",
                              .unit = "m",
                              .doc = "radius of curvature of flank 1",
                              .dims = "station",
                              .flags = FF_OPTIONAL},
    [DYNAMICS_IN_RADIUS_2] = {.name = "gear.radius_2",
                              .unit = "m",
                              .doc = "radius of curvature of flank 2",
                              .dims = "station",
                              .flags = FF_OPTIONAL},
    [DYNAMICS_IN_FACE_WIDTH] = {.name = "gear.face_width",
                                .unit = "m",
                                .doc = "width of the teeth in contact",
                                .dims = "",
                                .flags = FF_OPTIONAL},
    [DYNAMICS_IN_INERTIA] = {.name = "gear.inertia",
                             .unit = "kg m2",
                             .doc = "polar moments of inertia",
                             .dims = "gear",
                             .flags = FF_OPTIONAL},
    [DYNAMICS_IN_FILM_ROLL_ANGLE] = {.name = "film.roll_angle",
                                     .unit = "rad",
                                     .doc = "roll angle of gear 1 at the steps of the film",
                                     .dims = "t",
                                     .flags = FF_OPTIONAL | FF_FEEDBACK,
                                     .from = "ehl"},
    [DYNAMICS_IN_FILM_ENGAGEMENT] = {.name = "film.engagement",
                                     .unit = "1",
                                     .doc = "number of the mesh cycle of the motion in which the "
                                            "pair enters mesh",
                                     .dims = "t",
                                     .flags = FF_OPTIONAL | FF_FEEDBACK,
                                     .from = "ehl"},
    [DYNAMICS_IN_FILM_TRACTION] = {.name = "film.traction",
                                   .unit = "N/m",
                                   .doc = "friction force per width, with the sign of u1 - u2",
                                   .dims = "t",
                                   .flags = FF_OPTIONAL | FF_FEEDBACK,
                                   .from = "ehl"},
    [DYNAMICS_IN_FILM_ROLLING_LOSS] = {.name = "film.rolling_loss",
                                       .unit = "W/m",
                                       .doc = "entrainment speed times the integral of h dp/dx",
                                       .dims = "t",
                                       .flags = FF_OPTIONAL | FF_FEEDBACK,
                                       .from = "ehl"},
    [DYNAMICS_IN_FILM_POWER_LOSS] = {.name = "film.power_loss",
                                     .unit = "W/m",
                                     .doc = "total power dissipated by the film, per width",
                                     .dims = "t",
                                     .flags = FF_OPTIONAL | FF_FEEDBACK,
                                     .from = "ehl"},
    [DYNAMICS_IN_FILM_H_CENTRAL] = {.name = "film.h_central",
                                    .unit = "m",
                                    .doc = "film thickness at x = 0",
                                    .dims = "t",
                                    .flags = FF_OPTIONAL | FF_FEEDBACK,
                                    .from = "ehl"},
    [DYNAMICS_IN_FILM_P_MAX] = {.name = "film.p_max",
                                .unit = "Pa",
                                .doc = "highest pressure, which shows whether the film is loaded",
                                .dims = "t",
                                .flags = FF_OPTIONAL | FF_FEEDBACK,
                                .from = "ehl"},
    [DYNAMICS_IN_FILM_LOAD] = {.name = "film.load_per_width",
                               .unit = "N/m",
                               .doc = "load carried by the film; with force: shared it "
                                      "determines the load sharing",
                               .dims = "t",
                               .flags = FF_OPTIONAL | FF_FEEDBACK,
                               .from = "ehl"},
    [DYNAMICS_IN_FILM_SEPARATION] = {.name = "film.separation",
                                     .unit = "m",
                                     .doc = "film thickness that acts in series with the teeth, "
                                            "instead of h_central",
                                     .dims = "t",
                                     .flags = FF_OPTIONAL | FF_FEEDBACK,
                                     .from = "ehl"},
    [DYNAMICS_IN_ETA0] = {.name = "oil.eta0",
                          .unit = "Pa s",
                          .doc = "viscosity of the oil between separated flanks",
                          .dims = "",
                          .flags = FF_OPTIONAL,
                          .from = "lubricant"},
};
