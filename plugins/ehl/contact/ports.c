/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ports.h"

#include <flankfilm/film.h>

#include <math.h>

/* The rows of contact and oil, which all models share. `another` completes the doc text of
   contact.engagement. */
#define CONTACT_AND_OIL(another)                                                                   \
    [EHL_IN_TIME] = {.name = "contact.time",                                                       \
                     .unit = "s",                                                                  \
                     .doc = "times of the history, not decreasing; a single time is a steady "     \
                            "contact",                                                             \
                     .dims = "t"},                                                                 \
    [EHL_IN_RADIUS] = {.name = "contact.equivalent_radius",                                        \
                       .unit = "m",                                                                \
                       .doc = "equivalent radius R: 1/R = 1/r1 + 1/r2",                            \
                       .dims = "t"},                                                               \
    [EHL_IN_SPEED_1] = {.name = "contact.speed_1",                                                 \
                        .unit = "m/s",                                                             \
                        .doc = "surface speed u1",                                                 \
                        .dims = "t"},                                                              \
    [EHL_IN_SPEED_2] = {.name = "contact.speed_2",                                                 \
                        .unit = "m/s",                                                             \
                        .doc = "surface speed u2",                                                 \
                        .dims = "t"},                                                              \
    [EHL_IN_LOAD] = {.name = "contact.load_per_width",                                             \
                     .unit = "N/m",                                                                \
                     .doc = "normal load per width; 0: contact lost",                              \
                     .dims = "t"},                                                                 \
    [EHL_IN_MODULUS] = {.name = "contact.reduced_modulus",                                         \
                        .unit = "Pa",                                                              \
                        .doc = "reduced modulus E': 2/E' = sum (1 - nu^2)/E",                      \
                        .dims = ""},                                                               \
    [EHL_IN_ROLL] = {.name = "contact.roll_angle",                                                 \
                     .unit = "rad",                                                                \
                     .doc = "roll angle of gear 1",                                                \
                     .dims = "t",                                                                  \
                     .flags = FF_OPTIONAL},                                                        \
    [EHL_IN_GAP] = {.name = "contact.gap",                                                         \
                    .unit = "m",                                                                   \
                    .doc = "separation of the flanks while contact is lost",                       \
                    .dims = "t",                                                                   \
                    .flags = FF_OPTIONAL},                                                         \
    [EHL_IN_ENGAGEMENT] =                                                                          \
        {.name = "contact.engagement",                                                             \
         .unit = "1",                                                                              \
         .doc = "number of the engagement at each time; each engagement begins " another,          \
         .dims = "t",                                                                              \
         .flags = FF_OPTIONAL},                                                                    \
    [EHL_IN_VISCOSITY] = {.name = "viscosity",                                                     \
                          .unit = "",                                                              \
                          .doc = "viscosity of the oil",                                           \
                          .dims = "",                                                              \
                          .service = FF_VISCOSITY_ID},                                             \
    [EHL_IN_DENSITY] = {.name = "density",                                                         \
                        .unit = "",                                                                \
                        .doc = "density of the oil",                                               \
                        .dims = "",                                                                \
                        .service = FF_DENSITY_ID},                                                 \
    [EHL_IN_RHEOLOGY] = {.name = "rheology",                                                       \
                         .unit = "",                                                               \
                         .doc = "shear law of the oil; default: Newtonian",                        \
                         .dims = "",                                                               \
                         .service = FF_RHEOLOGY_ID,                                                \
                         .flags = FF_OPTIONAL},                                                    \
    [EHL_IN_RHEOLOGY_AT_PRESSURE] = {.name = "rheology.at_pressure",                               \
                                     .unit = "",                                                   \
                                     .doc = "shear law of the oil with stresses that depend on "   \
                                            "pressure and temperature",                            \
                                     .dims = "",                                                   \
                                     .service = FF_RHEOLOGY_3_ID,                                  \
                                     .flags = FF_OPTIONAL},                                        \
    [EHL_IN_OIL] = NUMERICS_OIL_ROWS, NUMERICS_OIL_DENSITY_ROW,                                    \
    [EHL_IN_LIQUID] = {.name = "oil",                                                              \
                       .unit = "",                                                                 \
                       .doc = "properties of the oil over temperature, for thermal",               \
                       .dims = "",                                                                 \
                       .service = FF_LIQUID_ID,                                                    \
                       .flags = FF_OPTIONAL,                                                       \
                       .from = "lubricant"}

/* Rows of the flanks that both kinds of film models share: hardness, load on asperities, and
   temperature with `thermal`. */
#define HARDNESS_ROW                                                                               \
    {                                                                                              \
        .name = "gear.hardness", .unit = "Pa",                                                     \
        .doc = "hardness of both gears, for rough flanks; 0: not known", .dims = "gear",           \
        .flags = FF_OPTIONAL                                                                       \
    }
#define ASPERITIES_ROW                                                                             \
    {                                                                                              \
        .name = "surface.asperities", .unit = "",                                                  \
        .doc = "asperity pressure of flanks described by statistics", .dims = "",                  \
        .service = FF_ASPERITY_ID, .flags = FF_OPTIONAL                                            \
    }
#define BULK_ROW(thermal)                                                                          \
    {                                                                                              \
        .name = "bulk.bulk_temperature", .unit = "K",                                              \
        .doc = "temperature of the teeth that follows from the loss of this film, for "            \
               "thermal: " thermal ", instead of the parameter bulk_temperature",                  \
        .dims = "", .flags = FF_OPTIONAL | FF_FEEDBACK, .from = "losses"                           \
    }

const ff_port ehl_inputs[EHL_INPUTS] = {
    CONTACT_AND_OIL("with its own steady film"),
    [EHL_IN_POSITION] = {.name = "surface.position",
                         .unit = "m",
                         .doc =
                             "arc coordinate s along the flank, in equal steps from 0; not wired: "
                             "smooth flanks",
                         .dims = "arc",
                         .flags = FF_OPTIONAL},
    [EHL_IN_HEIGHT_1] = {.name = "surface.height_1",
                         .unit = "m",
                         .doc = "height of flank 1, positive out of the metal",
                         .dims = "arc",
                         .flags = FF_OPTIONAL},
    [EHL_IN_HEIGHT_2] = {.name = "surface.height_2",
                         .unit = "m",
                         .doc = "height of flank 2, positive out of the metal",
                         .dims = "arc",
                         .flags = FF_OPTIONAL},
    [EHL_IN_RQ_1] = {.name = "surface.rq_1",
                     .unit = "m",
                     .doc = "root mean square roughness of flank 1",
                     .dims = "",
                     .flags = FF_OPTIONAL},
    [EHL_IN_RQ_2] = {.name = "surface.rq_2",
                     .unit = "m",
                     .doc = "root mean square roughness of flank 2",
                     .dims = "",
                     .flags = FF_OPTIONAL},
    [EHL_IN_PERIOD] = {.name = "surface.period",
                       .unit = "m",
                       .doc = "length after which the record repeats; 0: flanks are flat outside "
                              "the record",
                       .dims = "",
                       .flags = FF_OPTIONAL},
    [EHL_IN_ORIGIN] = {.name = "surface.origin",
                       .unit = "m",
                       .doc = "arc coordinate of both flanks that is at x = 0 at the first time",
                       .dims = "",
                       .flags = FF_OPTIONAL},
    [EHL_IN_ROUGHNESS] = {.name = "gear.roughness",
                          .unit = "m",
                          .doc = "root mean square roughness of both gears, 0: not known; used "
                                 "only for the lambda ratio, and only without a surface",
                          .dims = "gear",
                          .flags = FF_OPTIONAL},
    [EHL_IN_HEAT] = NUMERICS_HEAT_ROWS(NULL),
    [EHL_IN_HARDNESS] = HARDNESS_ROW,
    [EHL_IN_SHEAR_RATE] = {.name = "rheology.rate",
                           .unit = "",
                           .doc = "shear rate at a point of the film, for thermal: full",
                           .dims = "",
                           .service = FF_RHEOLOGY_2_ID,
                           .flags = FF_OPTIONAL},
    [EHL_IN_ASPERITIES] = ASPERITIES_ROW,
    [EHL_IN_CUTOFF] = {.name = "surface.cutoff",
                       .unit = "m",
                       .doc = "wavelength of the longest waves in the roughness of the flanks; 0: "
                              "length of the contact",
                       .dims = "",
                       .flags = FF_OPTIONAL},
    [EHL_IN_BULK] = BULK_ROW("full"),
    [EHL_IN_DISCRETISATION] = {.name = "discretisation",
                               .unit = "",
                               .doc = "discretisation of another stage, which computes the film at "
                                      "each instant instead of this model's solver; smooth flanks "
                                      "only",
                               .dims = "",
                               .service = FF_FILM_ID,
                               .flags = FF_OPTIONAL},
};

/* The outputs that all models share; `k` is the prefix of their indices. */
#define COMMON_OUTPUTS(k)                                                                          \
    [k##_ROLL_ANGLE] = {.name = "roll_angle",                                                      \
                        .unit = "rad",                                                             \
                        .doc = "roll angle of gear 1; needs a contact with a roll angle",          \
                        .dims = "t"},                                                              \
    [k##_ENGAGEMENT] = {.name = "engagement",                                                      \
                        .unit = "1",                                                               \
                        .doc = "mesh cycle of the motion in which the pair begins; 0 for a "       \
                               "contact without engagements",                                      \
                        .dims = "t"},                                                              \
    [k##_H_CENTRAL] = {.name = "h_central",                                                        \
                       .label = "central film thickness",                                          \
                       .unit = "m",                                                                \
                       .doc = "film thickness at x = 0",                                           \
                       .dims = "t",                                                                \
                       .max = INFINITY},                                                           \
    [k##_LOAD_PER_WIDTH] = {.name = "load_per_width",                                              \
                            .unit = "N/m",                                                         \
                            .doc = "load per width that film and asperities carry",                \
                            .dims = "t"},                                                          \
    [k##_BULK_TEMPERATURE] = {.name = "bulk_temperature",                                          \
                              .unit = "K",                                                         \
                              .doc = "temperature of the teeth before they meet and of the oil "   \
                                     "that enters; needs an oil stage",                            \
                              .dims = "",                                                          \
                              NUMERICS_BULK_QUANTITY},                                             \
    [k##_H_MIN_LOWEST] = {.name = "h_min_lowest",                                                  \
                          .unit = "m",                                                             \
                          .doc = "lowest h_min of all times",                                      \
                          .dims = "",                                                              \
                          .max = INFINITY},                                                        \
    [k##_H_MIN_LOWEST_AT] = {.name = "h_min_lowest_at",                                            \
                             .unit = "rad",                                                        \
                             .doc = "roll angle at which h_min is lowest; needs a contact with a " \
                                    "roll angle",                                                  \
                             .dims = ""},                                                          \
    [k##_P_MAX_HIGHEST] = {.name = "p_max_highest",                                                \
                           .unit = "Pa",                                                           \
                           .doc = "highest p_max of all times",                                    \
                           .dims = "",                                                             \
                           .max = INFINITY},                                                       \
    [k##_LAMBDA_RATIO_LOWEST] = {.name = "lambda_ratio_lowest",                                    \
                                 .unit = "1",                                                      \
                                 .doc = "lowest lambda_ratio of all times",                        \
                                 .dims = "",                                                       \
                                 .max = INFINITY},                                                 \
    [k##_H_MIN_LOWEST_MEAN] = {.name = "h_min_lowest_mean",                                        \
                               .unit = "m",                                                        \
                               .doc = "mean over the engagements of the lowest h_min of each "     \
                                      "engagement",                                                \
                               .dims = "",                                                         \
                               .max = INFINITY},                                                   \
    [k##_H_MIN_LOWEST_SPREAD] = {.name = "h_min_lowest_spread",                                    \
                                 .unit = "m",                                                      \
                                 .doc = "largest minus smallest of the lowest h_min of the "       \
                                        "engagements; 0 with one engagement",                      \
                                 .dims = "",                                                       \
                                 .max = INFINITY},                                                 \
    [k##_ENGAGEMENTS_JUDGED] = {.name = "engagements_judged",                                      \
                                .unit = "1",                                                       \
                                .doc = "number of engagements in the results",                     \
                                .dims = "",                                                        \
                                .max = INFINITY},                                                  \
    [k##_ALPHA_STAR] = {                                                                           \
        .name = "alpha_star",                                                                      \
        .unit = "1/Pa",                                                                            \
        .doc = "film-forming pressure coefficient alpha* of the viscosity law at the oil "         \
               "temperature, 1/int eta0/eta dp; 0: the viscosity does not increase with pressure", \
        .dims = ""}

const ff_port ehl_outputs[EHL_OUTPUTS] = {
    COMMON_OUTPUTS(EHL),
    [EHL_TIME] = {.name = "time",
                  .unit = "s",
                  .doc = "times of the results, one per step",
                  .dims = "t"},
    [EHL_H_MIN] = {.name = "h_min",
                   .unit = "m",
                   .doc = "minimum film thickness (minimum of a parabola through the lowest nodes)",
                   .dims = "t",
                   .max = INFINITY},
    [EHL_P_MAX] =
        {.name = "p_max", .unit = "Pa", .doc = "highest pressure", .dims = "t", .max = INFINITY},
    [EHL_FRICTION_COEFFICIENT] =
        {.name = "friction_coefficient",
         .label = "friction coefficient",
         .unit = "1",
         .doc = "friction coefficient: traction over load, sign of u1 - u2; 0 without load; "
                "rolling resistance is not included",
         .dims = "t",
         .origin = "contact.load_per_width"},
    [EHL_TRACTION] = {.name = "traction",
                      .unit = "N/m",
                      .doc = "friction force per width: shear stress at mid-film over the "
                             "pressurised film, plus boundary friction; sign of u1 - u2",
                      .dims = "t"},
    [EHL_POWER_LOSS] =
        {.name = "power_loss",
         .label = "power loss per width",
         .unit = "W/m",
         .doc = "total power dissipated by the film, per width: sliding, rolling, squeeze and "
                "asperities",
         .dims = "t"},
    [EHL_SLIDING_LOSS] = {.name = "sliding_loss",
                          .unit = "W/m",
                          .doc = "sliding loss: shear stress at mid-film times sliding speed over "
                                 "the pressurised film",
                          .dims = "t"},
    [EHL_ROLLING_LOSS] = {.name = "rolling_loss",
                          .unit = "W/m",
                          .doc = "rolling loss: entrainment speed times the integral of h dp/dx, "
                                 "up to the end of a flooded inlet",
                          .dims = "t"},
    [EHL_SQUEEZE_LOSS] = {.name = "squeeze_loss",
                          .unit = "W/m",
                          .doc = "squeeze loss: dissipation of the pressure flow beyond "
                                 "rolling_loss, since the film changes with time; negative while "
                                 "stored energy is released",
                          .dims = "t"},
    [EHL_ASPERITY_LOSS] = {.name = "asperity_loss",
                           .unit = "W/m",
                           .doc = "boundary friction of asperities in contact times sliding speed",
                           .dims = "t"},
    [EHL_LOAD_ERROR] =
        {.name = "load_error",
         .unit = "1",
         .doc = "|integral of p - load| over the largest load; without load the force of the film, "
                "up to 1 % while flanks meet again",
         .dims = "t"},
    [EHL_LOAD_AHEAD] =
        {.name = "load_ahead",
         .unit = "N/m",
         .doc = "share of the load carried by the oil in front of the domain, if a short inlet "
                "begins with the pressure of a longer inlet",
         .dims = "t"},
    [EHL_MASS_ERROR] = {.name = "mass_error",
                        .unit = "1",
                        .doc = "mass balance: largest value of inflow - outflow - storage between "
                               "the point of highest pressure and any other point, over the flow "
                               "at the point of highest pressure",
                        .dims = "t"},
    [EHL_H_MIN_ERROR] =
        {.name = "h_min_error",
         .unit = "m",
         .doc =
             "estimated error of h_min: 1.5 times the error due to the cells, plus the truncation "
             "of the time steps that the film accumulates. The error due to the cells follows "
             "from the transport of errors (ehl/finite-volume without heat or rest of the oil), "
             "otherwise from a film on half the cells and steps; above 2 % from the last passage "
             "on twice the cells. Between parted flanks it is not known",
         .dims = "t",
         .max = INFINITY},
    [EHL_H_CENTRAL_ERROR] = {.name = "h_central_error",
                             .unit = "m",
                             .doc = "estimated error of h_central, as for h_min_error",
                             .dims = "t",
                             .max = INFINITY},
    [EHL_P_MAX_ERROR] =
        {.name = "p_max_error",
         .unit = "Pa",
         .doc = "estimated error of p_max between smooth flanks: the part of the pressure spike "
                "that the cells may cut off, plus the pressure that corresponds to the film's "
                "error due to the time steps. With 100 instants or more, a part above 5 % is "
                "computed from the film on more cells",
         .dims = "t",
         .max = INFINITY},
    [EHL_ONE_WAY_GAP_ERROR] = {.name = "one_way_gap_error",
                               .unit = "m",
                               .doc = "without load: separation that the force of the film adds to "
                                      "contact.gap, and that the dynamics does not include",
                               .dims = "t"},
    [EHL_ASPERITY_LOAD_SHARE] = {.name = "asperity_load_share",
                                 .unit = "1",
                                 .doc = "share of the load that asperities in contact carry",
                                 .dims = "t",
                                 .max = 1},
    [EHL_CONTACT_RATIO] = {.name = "contact_ratio",
                           .unit = "1",
                           .doc = "length of asperity contact over the Hertz width 2 a of the "
                                  "load",
                           .dims = "t",
                           .max = INFINITY},
    [EHL_TRAPPED_SHARE] = {.name = "trapped_share",
                           .unit = "1",
                           .doc = "share of the load carried by oil between two asperity contacts, "
                                  "from which it cannot leave in a line contact",
                           .dims = "t",
                           .max = 1},
    [EHL_YIELD_SHARE] = {.name = "yield_share",
                         .unit = "1",
                         .doc = "share of the load where p equals asperity_hardness and the metal "
                                "yields",
                         .dims = "t",
                         .max = 1},
    [EHL_PLASTIC_DEPTH_MAX] = {.name = "plastic_depth_max",
                               .unit = "m",
                               .doc = "highest plastic_depth",
                               .dims = "t"},
    [EHL_LAMBDA_RATIO] =
        {.name = "lambda_ratio",
         .label = "film over roughness",
         .unit = "1",
         .doc = "film over the combined roughness sqrt(Rq1^2 + Rq2^2) of both flanks. The film "
                "is h_central, or with rough flanks the mean over the middle half of the Hertz "
                "width; needs a surface, or a gear with its roughness",
         .dims = "t",
         .max = INFINITY},
    [EHL_TEMPERATURE_MAX] = {.name = "temperature_max",
                             .unit = "K",
                             .doc = "highest temperature of the film; needs thermal: full",
                             .dims = "t"},
    [EHL_FLASH_TEMPERATURE] =
        {.name = "flash_temperature",
         .unit = "K",
         .doc = "highest rise of the temperature of a flank under the film over its bulk "
                "temperature; needs thermal: full",
         .dims = "t",
         .flags = FF_DIFFERENCE,
         .max = INFINITY},
    [EHL_SEPARATION] =
        {.name = "separation",
         .unit = "m",
         .doc = "film thickness that acts in series with the teeth: distance of the bodies minus "
                "their distance in a dry contact under the same force, or minus their gap; near "
                "h_central under load, 0 without pressure",
         .dims = "t"},
    [EHL_X] = {.name = "x",
               .unit = "m",
               .doc =
                   "position along the surface, 0 at the line of contact; between rough flanks the "
                   "fields are given at the nearest nodes, at most half a cell away",
               .dims = "x"},
    [EHL_FILM] =
        {.name = "film", .unit = "m", .doc = "film thickness h", .dims = "t x", .max = INFINITY},
    [EHL_PRESSURE] = {.name = "pressure", .unit = "Pa", .doc = "film pressure p", .dims = "t x"},
    [EHL_FILM_FRACTION] = {.name = "film_fraction",
                           .unit = "1",
                           .doc = "fraction of the gap that is filled with oil; below 1 only "
                                  "with cavitation: mass-conserving",
                           .dims = "t x",
                           .max = 1},
    [EHL_ASPERITY_PRESSURE] = {.name = "asperity_pressure",
                               .unit = "Pa",
                               .doc = "pressure that asperities carry",
                               .dims = "t x"},
    [EHL_PLASTIC_DEPTH] = {.name = "plastic_depth",
                           .unit = "m",
                           .doc = "plastic part of the gap of rough flanks where p equals "
                                  "asperity_hardness, at the same instant: no dent remains on a "
                                  "flank",
                           .dims = "t x"},
    [EHL_ROUGHNESS] = {.name = "roughness",
                       .unit = "m",
                       .doc = "sum of the heights of both flanks as they pass through the contact",
                       .dims = "t x"},
    [EHL_TEMPERATURE] = {.name = "temperature",
                         .unit = "K",
                         .doc = "film temperature, averaged across the film; needs thermal: full",
                         .dims = "t x"},
    [EHL_RQ_LEFT_OUT] = {.name = "rq_left_out",
                         .unit = "m",
                         .doc = "root mean square height of the waves that roughness_cutoff "
                                "removes, of both flanks together",
                         .dims = "",
                         .max = INFINITY},
    [EHL_NEWTON_STEPS] = {.name = "newton_steps",
                          .unit = "1",
                          .doc = "total number of Newton steps",
                          .dims = ""},
    [EHL_CONVOLUTIONS] = {.name = "convolutions",
                          .unit = "1",
                          .doc = "total number of deflections computed from a pressure",
                          .dims = ""},
    [EHL_STEPS_CUT] = {.name = "steps_cut",
                       .unit = "1",
                       .doc = "number of time steps that had to be shortened",
                       .dims = ""},
    [EHL_FILM_AT_LANDING] =
        {.name = "film_at_landing",
         .unit = "m",
         .doc = "h_min where flanks meet after they were separated, one value per landing",
         .dims = "landing",
         .max = INFINITY},
    [EHL_FILM_AT_LANDING_ERROR] = {.name = "film_at_landing_error",
                                   .unit = "m",
                                   .doc = "h_min_error at the landings",
                                   .dims = "landing",
                                   .max = INFINITY},
    [EHL_P_MAX_AT_LANDING] = {.name = "p_max_at_landing",
                              .unit = "Pa",
                              .doc = "largest p_max from the landing to the first maximum of the "
                                     "load",
                              .dims = "landing",
                              .max = INFINITY},
    [EHL_P_MAX_AT_LANDING_ERROR] = {.name = "p_max_at_landing_error",
                                    .unit = "Pa",
                                    .doc = "p_max_error at p_max_at_landing",
                                    .dims = "landing",
                                    .max = INFINITY},
};

const ff_port ehl_estimate_inputs[EHL_ESTIMATE_INPUTS] = {
    CONTACT_AND_OIL("anew"),
    [EHL_ESTIMATE_IN_RQ_1] =
        {.name = "surface.rq_1",
         .unit = "m",
         .doc = "heights of flank 1; this model ignores them, but the choice of the film model "
                "uses them",
         .dims = "",
         .flags = FF_OPTIONAL},
    [EHL_ESTIMATE_IN_RQ_2] = {.name = "surface.rq_2",
                              .unit = "m",
                              .doc = "heights of flank 2, used as those of flank 1",
                              .dims = "",
                              .flags = FF_OPTIONAL},
    [EHL_ESTIMATE_IN_ROUGHNESS] =
        {.name = "gear.roughness",
         .unit = "m",
         .doc = "root mean square roughness of both gears, 0: not known; used only for the "
                "lambda ratio, and only without a surface",
         .dims = "gear",
         .flags = FF_OPTIONAL},
    [EHL_ESTIMATE_IN_HEAT] = NUMERICS_HEAT_ROWS(NULL),
    [EHL_ESTIMATE_IN_HARDNESS] = HARDNESS_ROW,
    [EHL_ESTIMATE_IN_ASPERITIES] = ASPERITIES_ROW,
    [EHL_ESTIMATE_IN_BULK] = BULK_ROW("local"),
};

const ff_port ehl_estimate_outputs[EHL_ESTIMATE_OUTPUTS] = {
    COMMON_OUTPUTS(EHL_ESTIMATE),
    [EHL_ESTIMATE_TIME] = {.name = "time", .unit = "s", .doc = "times of the results", .dims = "t"},
    [EHL_ESTIMATE_H_MIN] = {.name = "h_min",
                            .unit = "m",
                            .doc = "minimum film thickness",
                            .dims = "t",
                            .max = INFINITY},
    [EHL_ESTIMATE_P_MAX] = {.name = "p_max",
                            .unit = "Pa",
                            .doc = "Hertz pressure of the load",
                            .dims = "t",
                            .max = INFINITY},
    [EHL_ESTIMATE_FRICTION_COEFFICIENT] =
        {.name = "friction_coefficient",
         .label = "friction coefficient",
         .unit = "1",
         .doc = "friction coefficient: traction over load, sign of u1 - u2; 0 without load",
         .dims = "t",
         .origin = "contact.load_per_width"},
    [EHL_ESTIMATE_TRACTION] =
        {.name = "traction",
         .unit = "N/m",
         .doc = "friction force per width: viscous shear stress over the Hertzian contact, sign "
                "of u1 - u2",
         .dims = "t"},
    [EHL_ESTIMATE_POWER_LOSS] = {.name = "power_loss",
                                 .label = "power loss per width",
                                 .unit = "W/m",
                                 .doc = "power dissipated by the film, per width: sliding and "
                                        "rolling",
                                 .dims = "t"},
    [EHL_ESTIMATE_SLIDING_LOSS] = {.name = "sliding_loss",
                                   .unit = "W/m",
                                   .doc = "traction times sliding speed",
                                   .dims = "t"},
    [EHL_ESTIMATE_ROLLING_LOSS] =
        {.name = "rolling_loss",
         .unit = "W/m",
         .doc = "rolling loss of a flooded inlet, by the formula of Biboulet & Houpert 2010",
         .dims = "t"},
    [EHL_ESTIMATE_SQUEEZE_LOSS] = {.name = "squeeze_loss",
                                   .unit = "W/m",
                                   .doc = "squeeze loss; always 0, since each film is steady",
                                   .dims = "t"},
    [EHL_ESTIMATE_ASPERITY_LOSS] = {.name = "asperity_loss",
                                    .unit = "W/m",
                                    .doc = "boundary friction of statistical asperities times "
                                           "sliding speed; 0 without them",
                                    .dims = "t"},
    [EHL_ESTIMATE_H_MIN_ERROR] =
        {.name = "h_min_error",
         .unit = "m",
         .doc = "error of h_min: its scatter compared with full steady solutions; outside the "
                "range of the model, h_min itself",
         .dims = "t",
         .max = INFINITY},
    [EHL_ESTIMATE_LAMBDA_RATIO] =
        {.name = "lambda_ratio",
         .label = "film over roughness",
         .unit = "1",
         .doc = "film h_central over the combined roughness sqrt(Rq1^2 + Rq2^2) of both flanks; "
                "needs a surface, or a gear with its roughness",
         .dims = "t",
         .max = INFINITY},
    [EHL_ESTIMATE_ASPERITY_LOAD_SHARE] = {.name = "asperity_load_share",
                                          .unit = "1",
                                          .doc =
                                              "share of the load that statistical asperities carry",
                                          .dims = "t",
                                          .max = 1},
    [EHL_ESTIMATE_X] = {.name = "x",
                        .unit = "m",
                        .doc = "position along the surface, 0 at the line of contact",
                        .dims = "x"},
    [EHL_ESTIMATE_FILM] =
        {.name = "film",
         .unit = "m",
         .doc = "film thickness: the estimated thickness in the contact, plus the gap of the dry "
                "contact outside it; without the constriction at the exit",
         .dims = "t x",
         .max = INFINITY},
    [EHL_ESTIMATE_PRESSURE] = {.name = "pressure",
                               .unit = "Pa",
                               .doc = "Hertz pressure",
                               .dims = "t x"},
};

ff_status ehl_read_history(const ff_host *host, const ff_array *in, double light_load,
                           ehl_history *h)
{
    *h = (ehl_history){
        .count = in[EHL_IN_TIME].shape[0],
        .time = in[EHL_IN_TIME].data,
        .radius = in[EHL_IN_RADIUS].data,
        .speed_1 = in[EHL_IN_SPEED_1].data,
        .speed_2 = in[EHL_IN_SPEED_2].data,
        .load = in[EHL_IN_LOAD].data,
        .roll = in[EHL_IN_ROLL].data,
        .gap = in[EHL_IN_GAP].data,
        .engagement = in[EHL_IN_ENGAGEMENT].data,
        .modulus = *in[EHL_IN_MODULUS].data,
        .load_floor = fmax(light_load, 0),
    };
    return ehl_history_check(h, host);
}

void ehl_wire_law(ehl_laws *laws, uint32_t input, const void *service)
{
    if (input == EHL_IN_VISCOSITY)
        laws->viscosity = service;
    else if (input == EHL_IN_DENSITY)
        laws->density = service;
    else if (input == EHL_IN_RHEOLOGY)
        laws->rheology_ambient = service;
    else if (input == EHL_IN_RHEOLOGY_AT_PRESSURE)
        laws->rheology = service;
}
