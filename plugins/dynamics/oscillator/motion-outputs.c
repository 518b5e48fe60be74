/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of the outputs of a motion. */
#include "motion.h"

#include <math.h>

const ff_port dynamics_motion_outputs[DYNAMICS_POWER_OUTPUT_COUNT] = {
    [DYNAMICS_OUT_PHASE] =
        {.name = "phase",
         .unit = "1",
         .label = "mesh cycle",
         .doc = "mesh cycles since the entering pair was at SAP; a repeated value marks a jump "
                "of the excitation",
         .dims = "cycle"},
    [DYNAMICS_OUT_DTE] =
        {.name = "dte",
         .label = "dynamic transmission error",
         .unit = "m",
         .doc = "dynamic transmission error s; zero is the middle of the backlash, so that the "
                "values in contact include half the backlash",
         .dims = "cycle"},
    [DYNAMICS_OUT_DTE_VELOCITY] = {.name = "dte_velocity",
                                   .unit = "m/s",
                                   .doc = "rate of the dynamic transmission error",
                                   .dims = "cycle"},
    [DYNAMICS_OUT_MESH_FORCE] = {.name = "mesh_force",
                                 .unit = "N",
                                 .doc = "dynamic mesh force DMF of spring and damper; with "
                                        "squeeze: series, the force of the oil alone while the "
                                        "flanks are separated",
                                 .dims = "cycle"},
    [DYNAMICS_OUT_DTE_RMS] = {.name = "dte_rms",
                              .label = "rms of the transmission error",
                              .unit = "m",
                              .doc = "root mean square of the alternating part of the dynamic "
                                     "transmission error s",
                              .dims = "",
                              .max = INFINITY},
    [DYNAMICS_OUT_DTE_MEAN] = {.name = "dte_mean",
                               .unit = "m",
                               .doc = "mean of the dynamic transmission error s",
                               .dims = ""},
    [DYNAMICS_OUT_DTE_PEAK_TO_PEAK] = {.name = "dte_peak_to_peak",
                                       .unit = "m",
                                       .doc = "largest minus smallest dynamic transmission error "
                                              "s",
                                       .dims = "",
                                       .max = INFINITY},
    [DYNAMICS_OUT_TOOTH_FORCE] =
        {.name = "tooth_force",
         .unit = "N",
         .doc = "dynamic tooth force W_s DMF/F on the flanks that carry the mean load, not clipped "
                "at 0; one row per engagement if the period is several mesh cycles",
         .dims = "engagement? gear.station"},
    [DYNAMICS_OUT_GAP] = {.name = "gap",
                          .unit = "m",
                          .doc = "separation of the driving flanks; 0 in contact. With squeeze: "
                                 "series, the film thickness beyond handover_film, including the "
                                 "deflection that the film causes",
                          .dims = "engagement? gear.station"},
    [DYNAMICS_OUT_DYNAMIC_FACTOR_TOOTH] =
        {.name = "dynamic_factor_tooth",
         .unit = "1",
         .doc = "largest dynamic tooth force over largest quasi-static tooth force",
         .dims = ""},
    [DYNAMICS_OUT_DYNAMIC_FACTOR_MESH] = {.name = "dynamic_factor_mesh",
                                          .unit = "1",
                                          .doc = "largest mesh force over the static mesh force",
                                          .dims = ""},
    [DYNAMICS_OUT_CONTACT_LOSS] = {.name = "contact_loss",
                                   .unit = "1",
                                   .doc = "share of the time in which no flanks touch",
                                   .dims = "",
                                   .max = 1},
    [DYNAMICS_OUT_BACK_CONTACT] = {.name = "back_contact",
                                   .unit = "1",
                                   .doc = "share of the time with contact on the back flanks",
                                   .dims = "",
                                   .max = 1},
    [DYNAMICS_OUT_NATURAL_FREQUENCY] = {.name = "natural_frequency",
                                        .unit = "Hz",
                                        .doc = "natural frequency of small vibrations at the mean "
                                               "of the wired stiffness: the tangent dF/d(e_l) or "
                                               "the secant F/(e_l - e), by its parameter "
                                               "definition",
                                        .dims = "",
                                        .max = INFINITY},
    [DYNAMICS_OUT_PERIOD] =
        {.name = "period",
         .unit = "1",
         .doc = "period of the motion in mesh cycles; 0: aperiodic, -1: grows without bound",
         .dims = ""},
    [DYNAMICS_OUT_FLOQUET_MAX] =
        {.name = "floquet_max",
         .unit = "1",
         .doc = "largest modulus of the Floquet multipliers; the motion is stable if it is below "
                "1",
         .dims = ""},
    [DYNAMICS_OUT_MULTIPLIERS] =
        {.name = "multipliers",
         .unit = "1",
         .doc = "Floquet multipliers (real and imaginary part): factors by which disturbances grow "
                "over the motion shown",
         .dims = "multiplier part"},
    [DYNAMICS_OUT_DTE_HARMONICS] = {.name = "dte_harmonics",
                                    .unit = "m",
                                    .doc =
                                        "amplitudes of the dynamic transmission error s at 1, 2, "
                                        "3 ... times the mesh frequency",
                                    .dims = "harmonic"},
    [DYNAMICS_OUT_LANDING_TIME] =
        {.name = "landing_time",
         .unit = "s",
         .doc = "times at which the driving flanks meet again after contact loss, since the start "
                "of the motion shown; empty: no contact loss",
         .dims = "landing"},
    [DYNAMICS_OUT_LANDING_SPEED] = {.name = "landing_speed",
                                    .unit = "m/s",
                                    .doc = "speeds of approach of the flanks at landing_time",
                                    .dims = "landing"},
    [DYNAMICS_OUT_BACK_TOOTH_FORCE] =
        {.name = "back_tooth_force",
         .unit = "N",
         .doc =
             "dynamic tooth force on the back flanks, opposite to those that carry the mean load, "
             "above 0 in contact; back flanks meet from the tip of gear 1 to its root",
         .dims = "engagement? gear.station"},
    [DYNAMICS_OUT_BACK_GAP] = {.name = "back_gap",
                               .unit = "m",
                               .doc = "separation of the back flanks; 0 in contact",
                               .dims = "engagement? gear.station"},
    [DYNAMICS_OUT_BACK_FORCE_MEAN] =
        {.name = "back_force_mean",
         .unit = "N",
         .doc = "mean mesh force of the back flanks; 0 if the motion uses no separate curves for "
                "them, tooth_force then contains their force as a negative force",
         .dims = "",
         .max = INFINITY},
    [DYNAMICS_OUT_STABLE_MOTIONS] =
        {.name = "stable_motions",
         .unit = "1",
         .doc = "number of different stable motions at this speed, with periods of at most 6 mesh "
                "cycles, found from both branches and 16 other starts and, with known_motions: "
                "atlas, in the atlas",
         .dims = "",
         .max = INFINITY},
    [DYNAMICS_OUT_ATLAS_FREQUENCY] =
        {.name = "atlas_frequency",
         .unit = "Hz",
         .doc = "mesh frequencies of all periodic motions, along their branches",
         .dims = "point"},
    [DYNAMICS_OUT_ATLAS_RMS] = {.name = "atlas_rms",
                                .unit = "m",
                                .doc = "root mean square of the alternating part of the "
                                       "transmission error at each atlas point",
                                .dims = "point"},
    [DYNAMICS_OUT_ATLAS_STABLE] = {.name = "atlas_stable",
                                   .unit = "1",
                                   .doc = "stability of each atlas point; 1: disturbances decay, "
                                          "0: they grow",
                                   .dims = "point"},
    [DYNAMICS_OUT_ATLAS_BRANCH] =
        {.name = "atlas_branch",
         .unit = "1",
         .doc = "branch of each atlas point: 1000 times the period plus n, for branch "
                "p<period>-<n>",
         .dims = "point"},
    [DYNAMICS_OUT_ATLAS_FLOQUET_MAX] = {.name = "atlas_floquet_max",
                                        .unit = "1",
                                        .doc = "largest modulus of the Floquet multipliers at "
                                               "each atlas point",
                                        .dims = "point"},
    [DYNAMICS_OUT_FOLD_FREQUENCY] = {.name = "fold_frequency",
                                     .unit = "Hz",
                                     .doc = "mesh frequencies of folds, where two branches meet "
                                            "and end",
                                     .dims = "fold"},
    [DYNAMICS_OUT_FOLD_BRANCH] = {.name = "fold_branch",
                                  .unit = "1",
                                  .doc = "first of the two branches that meet at each fold",
                                  .dims = "fold"},
    [DYNAMICS_OUT_DOUBLING_FREQUENCY] = {.name = "doubling_frequency",
                                         .unit = "Hz",
                                         .doc = "mesh frequencies at which the period doubles",
                                         .dims = "doubling"},
    [DYNAMICS_OUT_DAMPER_LOSS] = {.name = "damper_loss",
                                  .unit = "W",
                                  .doc = "mean power dissipated by the damper",
                                  .dims = ""},
    [DYNAMICS_OUT_SQUEEZE_LOSS] = {.name = "squeeze_loss",
                                   .unit = "W",
                                   .doc = "mean power dissipated by the oil between separated "
                                          "flanks",
                                   .dims = ""},
    [DYNAMICS_OUT_EXCITATION_POWER] =
        {.name = "excitation_power",
         .unit = "W",
         .doc =
             "mean power supplied by the prescribed changes of stiffness and transmission error; "
             "film_power is not included",
         .dims = ""},
    [DYNAMICS_OUT_TORQUE_POWER] =
        {.name = "torque_power",
         .unit = "W",
         .doc = "mean power that the torques spend on friction and rolling resistance at the "
                "mean speeds of the gears; 0 without a film wired back",
         .dims = ""},
    [DYNAMICS_OUT_FRICTION_WORK] =
        {.name = "friction_work",
         .unit = "W",
         .doc = "mean power that friction and rolling resistance take from the vibration; 0 "
                "without a film wired back",
         .dims = ""},
    [DYNAMICS_OUT_FILM_POWER] =
        {.name = "film_power",
         .unit = "W",
         .doc = "mean power supplied by the changing thickness of the loaded film; 0 without a "
                "film wired back",
         .dims = ""},
    [DYNAMICS_OUT_DOUBLING_BRANCH] = {.name = "doubling_branch",
                                      .unit = "1",
                                      .doc = "branch of the shorter period at each period "
                                             "doubling",
                                      .dims = "doubling"},
};
