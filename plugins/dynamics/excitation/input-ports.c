/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inputs of the dynamic models. */
#include "inputs.h"

/* The rows that all models have, in two tables. */
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
         .doc = "mass that the mesh spring sees, I1 I2/(I1 rb2^2 + I2 rb1^2)",                     \
         .dims = "",                                                                               \
         .flags = FF_OPTIONAL},                                                                    \
    [DYNAMICS_IN_MESH_FREQUENCY] = {.name = "operating.mesh_frequency",                            \
                                    .unit = "Hz",                                                  \
                                    .doc = "mesh cycles per second",                               \
                                    .dims = ""},                                                   \
    [DYNAMICS_IN_LINE_FORCE] = {.name = "operating.line_force",                                    \
                                .unit = "N",                                                       \
                                .doc = "static force along the line of action",                    \
                                .dims = ""},                                                       \
    [DYNAMICS_IN_PHASE] = {.name = "stiffness.phase",                                              \
                           .unit = "1",                                                            \
                           .doc = "phase of the mesh cycle, 0 to 1; twice at a jump",              \
                           .dims = "phase"},                                                       \
    [DYNAMICS_IN_STIFFNESS] =                                                                      \
        {.name = "stiffness.stiffness",                                                            \
         .unit = "N/m",                                                                            \
         .doc = "mesh stiffness, straight between phases where they follow no smooth curve",       \
         .dims = "phase"},                                                                         \
    [DYNAMICS_IN_STIFFNESS_MEAN] = {.name = "stiffness.stiffness_mean",                            \
                                    .unit = "N/m",                                                 \
                                    .doc = "mean mesh stiffness",                                  \
                                    .dims = ""},                                                   \
    [DYNAMICS_IN_TRANSMISSION_ERROR] = {.name = "stiffness.transmission_error",                    \
                                        .unit = "m",                                               \
                                        .doc = "unloaded transmission error e; none: 0",           \
                                        .dims = "phase",                                           \
                                        .flags = FF_OPTIONAL},                                     \
    [DYNAMICS_IN_LOADED_ERROR] =                                                                   \
        {.name = "stiffness.loaded_transmission_error",                                            \
         .unit = "m",                                                                              \
         .doc = "transmission error e_l under the line force, to which a slow motion tends also "  \
                "where the stiffness is the slope of the mesh; none: e + F/k",                     \
         .dims = "phase",                                                                          \
         .flags = FF_OPTIONAL},                                                                    \
    [DYNAMICS_IN_TOOTH_FORCE] = {.name = "stiffness.tooth_force",                                  \
                                 .unit = "N",                                                      \
                                 .doc = "quasi-static tooth force W_s",                            \
                                 .dims = "engagement? gear.station"},                              \
    [DYNAMICS_IN_LOAD_SHARE] = {.name = "stiffness.load_share",                                    \
                                .unit = "1",                                                       \
                                .doc = "share of one tooth pair, used where the line force is 0",  \
                                .dims = "engagement? gear.station",                                \
                                .flags = FF_OPTIONAL},                                             \
    [DYNAMICS_IN_FORCE_LEVEL] = {.name = "stiffness.force_level",                                  \
                                 .unit = "N",                                                      \
                                 .doc = "mesh forces from 0 up, to which the level_... belong",    \
                                 .dims = "level",                                                  \
                                 .flags = FF_OPTIONAL},                                            \
    [DYNAMICS_IN_LEVEL_ERROR] = {.name = "stiffness.level_error",                                  \
                                 .unit = "m",                                                      \
                                 .doc = "transmission error under each of them",                   \
                                 .dims = "level phase",                                            \
                                 .flags = FF_OPTIONAL},                                            \
    [DYNAMICS_IN_LEVEL_STIFFNESS] = {.name = "stiffness.level_stiffness",                          \
                                     .unit = "N/m",                                                \
                                     .doc = "slope of the mesh under each of them",                \
                                     .dims = "level phase",                                        \
                                     .flags = FF_OPTIONAL},                                        \
    [DYNAMICS_IN_LEVEL_TOOTH_FORCE] = {.name = "stiffness.level_tooth_force",                      \
                                       .unit = "N",                                                \
                                       .doc = "tooth force of one pair under each of them",        \
                                       .dims = "level gear.station",                               \
                                       .flags = FF_OPTIONAL},                                      \
    [DYNAMICS_IN_REFERENCE_FORCE] = {.name = "operating.reference_force",                          \
                                     .unit = "N",                                                  \
                                     .doc = "force at which stiffness and sharing are those of "   \
                                            "the stiffness; none or 0: the line force",            \
                                     .dims = "",                                                   \
                                     .flags = FF_OPTIONAL},                                        \
    [DYNAMICS_IN_FLUCTUATION_ORDER] =                                                              \
        {.name = "operating.fluctuation_order",                                                    \
         .unit = "1",                                                                              \
         .doc = "orders of what the line force swings by, per turn of gear 1",                     \
         .dims = "fluctuation",                                                                    \
         .flags = FF_OPTIONAL},                                                                    \
    [DYNAMICS_IN_FLUCTUATION_COSINE] =                                                             \
        {.name = "operating.fluctuation_cosine",                                                   \
         .unit = "N",                                                                              \
         .doc = "of each the force in phase with its order times the angle of gear 1",             \
         .dims = "fluctuation",                                                                    \
         .flags = FF_OPTIONAL},                                                                    \
    [DYNAMICS_IN_FLUCTUATION_SINE] = {.name = "operating.fluctuation_sine",                        \
                                      .unit = "N",                                                 \
                                      .doc = "of each the force a quarter of its period later",    \
                                      .dims = "fluctuation",                                       \
                                      .flags = FF_OPTIONAL},                                       \
    [DYNAMICS_IN_FLUCTUATION_PERIOD] =                                                             \
        {.name = "operating.fluctuation_period",                                                   \
         .unit = "1",                                                                              \
         .doc = "mesh cycles after which force and mesh repeat themselves together",               \
         .dims = "",                                                                               \
         .flags = FF_OPTIONAL},                                                                    \
    [DYNAMICS_IN_DRIVEN_MASS] = {.name = "operating.driven_mass",                                  \
                                 .unit = "kg",                                                     \
                                 .doc = "mass that the mesh spring sees where the speed of gear "  \
                                        "1 is given; none or 0: equivalent_mass",                  \
                                 .dims = "",                                                       \
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
                                     .doc = "mesh cycle of the motion in which the pair begins",
                                     .dims = "t",
                                     .flags = FF_OPTIONAL | FF_FEEDBACK,
                                     .from = "ehl"},
    [DYNAMICS_IN_FILM_TRACTION] = {.name = "film.traction",
                                   .unit = "N/m",
                                   .doc = "friction, sign of u1 - u2",
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
                                     .doc = "all that the film dissipates",
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
                                .doc = "highest pressure, which says where the film "
                                       "bears load",
                                .dims = "t",
                                .flags = FF_OPTIONAL | FF_FEEDBACK,
                                .from = "ehl"},
    [DYNAMICS_IN_FILM_LOAD] = {.name = "film.load_per_width",
                               .unit = "N/m",
                               .doc = "load that the film carries, by which pairs share a "
                                      "force: shared",
                               .dims = "t",
                               .flags = FF_OPTIONAL | FF_FEEDBACK,
                               .from = "ehl"},
    [DYNAMICS_IN_FILM_SEPARATION] = {.name = "film.separation",
                                     .unit = "m",
                                     .doc =
                                         "thickness of the film as the teeth in series with it see "
                                         "it; in its place h_central",
                                     .dims = "t",
                                     .flags = FF_OPTIONAL | FF_FEEDBACK,
                                     .from = "ehl"},
    [DYNAMICS_IN_ETA0] = {.name = "oil.eta0",
                          .unit = "Pa s",
                          .doc = "viscosity of the oil between parted flanks",
                          .dims = "",
                          .flags = FF_OPTIONAL,
                          .from = "lubricant"},
};
