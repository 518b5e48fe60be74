/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model.h"

const ff_param ehl_params[EHL_PARAMS] = {
    [EHL_CELLS] = {.name = "cells",
                   .unit = "1",
                   .doc = "cells of the uniform grid from inlet to outlet; the error of the film "
                          "falls with their square (second-order wedge)",
                   .type = FF_INT,
                   .flags = FF_TUNABLE,
                   .preset = "512",
                   .min = 16,
                   .max = 65536},
    [EHL_INLET] = {.name = "inlet",
                   .unit = "1",
                   .doc = "start of the domain in front of the contact, in largest Hertz "
                          "half-widths of the history; auto: a + 10 sqrt(2 R h) of every load, "
                          "and up to 57 under "
                          "light ones",
                   .type = FF_REAL,
                   .flags = FF_MIN_OPEN | FF_TUNABLE,
                   .preset = "auto",
                   .choices = "auto",
                   .min = 0,
                   .max = 1e6,
                   .low = 2,
                   .high = 1e6},
    [EHL_OUTLET] = {.name = "outlet",
                    .unit = "1",
                    .doc = "end of the domain behind the contact, in largest Hertz half-widths; "
                           "auto: a + 2 sqrt(2 R h) of every load; with rough flanks both "
                           "ends at least a + sqrt(8 R Rq); where the entrainment turns round "
                           "both as far as the further",
                    .type = FF_REAL,
                    .flags = FF_MIN_OPEN | FF_TUNABLE,
                    .preset = "auto",
                    .choices = "auto",
                    .min = 0,
                    .max = 1e6,
                    .low = 1.1,
                    .high = 1e6},
    [EHL_STEPS] = {.name = "steps",
                   .unit = "1",
                   .doc = "equal time steps from the first to the last time of the contact, or "
                          "auto: as many as time_tolerance asks for, which land on the kinks of "
                          "the history; a history of one time is solved as steady. With rough "
                          "flanks a step is divided so that the oil moves a cell at most, less "
                          "where they touch",
                   .type = FF_INT,
                   .flags = FF_TUNABLE,
                   .preset = "auto",
                   .choices = "auto",
                   .min = 1,
                   .max = 1e7},
    [EHL_TIME_TOLERANCE] =
        {.name = "time_tolerance",
         .unit = "1",
         .doc = "steps: auto: error of the film, over itself, that the time steps of one passage "
                "through the contact may add up to",
         .type = FF_REAL,
         .flags = FF_TUNABLE,
         .preset = "7e-3",
         .min = 1e-6,
         .max = 1},
    [EHL_TIME_SCHEME] = {.name = "time_scheme",
                         .unit = "",
                         .doc = "squeeze term: backward Euler (first order) or two-step backward "
                                "differentiation (second order)",
                         .type = FF_CHOICE,
                         .preset = "bdf2",
                         .choices = "euler|bdf2"},
    [EHL_WEDGE] = {.name = "wedge",
                   .unit = "",
                   .doc = "order of the upwind wedge term",
                   .type = FF_CHOICE,
                   .preset = "second",
                   .choices = "first|second"},
    [EHL_CAVITATION] = {.name = "cavitation",
                        .unit = "",
                        .doc = "clip: p >= 0, and the film is full where p > 0 (Reynolds' "
                               "condition); mass is not conserved where p = 0. "
                               "mass-conserving: there a share of the gap is filled, and is "
                               "carried along until the film closes again",
                        .type = FF_CHOICE,
                        .preset = "clip",
                        .choices = "clip|mass-conserving"},
    [EHL_TOLERANCE] = {.name = "tolerance",
                       .unit = "1",
                       .doc =
                           "largest last change of pressure over its maximum; the film is then as "
                           "accurate as if the equations were solved exactly, to about this",
                       .type = FF_REAL,
                       .flags = FF_TUNABLE,
                       .preset = "1e-5",
                       .min = 1e-12,
                       .max = 1e-2},
    [EHL_LIGHT_LOAD] = {.name = "light_load",
                        .unit = "N/m",
                        .doc = "none: without load the film is carried on without a load balance; "
                               "or a load per width that stands in for smaller ones",
                        .type = FF_REAL,
                        .flags = FF_MIN_OPEN,
                        .preset = "none",
                        .choices = "none",
                        .min = 0,
                        .max = 1e9},
    [EHL_OIL_CONDUCTIVITY] =
        {.name = "oil_conductivity",
         .unit = "W/(m K)",
         .doc = "thermal conductivity of the oil, for the line inlet_heating of the quality alone; "
                "oils have 0.1 to 0.17",
         .type = FF_REAL,
         .preset = "0.14 W/(m K)",
         .min = 1e-3,
         .max = 1e3},
    [EHL_TEMPERATURE_SLOPE] =
        {.name = "temperature_slope",
         .unit = "1/K",
         .doc = "-d ln(eta)/dT of the oil, for inlet_heating alone; auto: that of the viscosity "
                "law, or 0.03 1/K where it knows no temperature",
         .type = FF_REAL,
         .flags = FF_MIN_OPEN,
         .preset = "auto",
         .choices = "auto",
         .min = 0,
         .max = 10},
    [EHL_CONTACT_FILM] =
        {.name = "contact_film",
         .unit = "nm",
         .doc = "rough flanks: least film; the asperities carry what would press them closer. Two "
                "molecular layers of an oil, 0.5 nm each (Israelachvili 2011)",
         .type = FF_REAL,
         .preset = "1 nm",
         .min = 1e-3,
         .max = 1e3,
         .low = 0.5,
         .high = 10},
    [EHL_BOUNDARY_FRICTION] = {.name = "boundary_friction",
                               .unit = "1",
                               .doc = "friction coefficient of the asperities in contact",
                               .type = FF_REAL,
                               .preset = "0.10",
                               .min = 0,
                               .max = 2,
                               .low = 0.05,
                               .high = 0.2},
    [EHL_ASPERITY_HARDNESS] =
        {.name = "asperity_hardness",
         .unit = "GPa",
         .doc = "rough flanks: highest pressure, of asperities and of the film, at which the metal "
                "yields: hardness of the softer flank, 7 GPa case-hardened (700 HV); 0: elastic at "
                "every pressure",
         .type = FF_REAL,
         .preset = "7 GPa",
         .min = 0,
         .max = 1e3},
    [EHL_VALLEYS] = {.name = "valleys",
                     .unit = "",
                     .doc = "rough flanks: sealed: oil between asperities in contact has no way "
                            "out but through their gaps, as between ridges along the tooth; "
                            "ventilated: it leaks sideways, over valley_length",
                     .type = FF_CHOICE,
                     .preset = "sealed",
                     .choices = "sealed|ventilated"},
    [EHL_VALLEY_LENGTH] =
        {.name = "valley_length",
         .unit = "mm",
         .doc = "valleys: ventilated: length of a valley along the tooth, open at both ends",
         .type = FF_REAL,
         .flags = FF_MIN_OPEN,
         .preset = "0.2 mm",
         .min = 0,
         .max = 1e3},
    [EHL_ROUGHNESS] = {.name = "roughness",
                       .unit = "",
                       .doc = "heights of a wired surface: resolved, as the flanks move; or "
                              "ignored, where the film is many times the roughness",
                       .type = FF_CHOICE,
                       .flags = FF_TUNABLE,
                       .preset = "resolved",
                       .choices = "resolved|ignored"},
};

const ff_port ehl_inputs[EHL_INPUTS] = {
    [EHL_IN_TIME] = {"contact.time", "s",
                     "times of the history, not decreasing; one: a steady contact", "t", NULL, 0,
                     NULL},
    [EHL_IN_RADIUS] = {"contact.equivalent_radius", "m", "R: 1/R = 1/r1 + 1/r2", "t", NULL, 0,
                       NULL},
    [EHL_IN_SPEED_1] = {"contact.speed_1", "m/s", "surface speed u1", "t", NULL, 0, NULL},
    [EHL_IN_SPEED_2] = {"contact.speed_2", "m/s", "surface speed u2", "t", NULL, 0, NULL},
    [EHL_IN_LOAD] = {"contact.load_per_width", "N/m", "normal load; 0: contact lost", "t", NULL, 0,
                     NULL},
    [EHL_IN_MODULUS] = {"contact.reduced_modulus", "Pa", "E': 2/E' = sum (1 - nu^2)/E", "", NULL, 0,
                        NULL},
    [EHL_IN_ROLL] = {"contact.roll_angle", "rad", "roll angle of gear 1", "t", NULL, FF_OPTIONAL,
                     NULL},
    [EHL_IN_GAP] = {"contact.gap", "m", "separation of the flanks where the contact is lost", "t",
                    NULL, FF_OPTIONAL, NULL},
    [EHL_IN_ENGAGEMENT] = {"contact.engagement", "1",
                           "engagement that each time belongs to; another one begins with a "
                           "steady film of its own",
                           "t", NULL, FF_OPTIONAL, NULL},
    [EHL_IN_VISCOSITY] = {"viscosity", "", "viscosity of the oil", "", FF_VISCOSITY_ID, 0, NULL},
    [EHL_IN_DENSITY] = {"density", "", "density of the oil", "", FF_DENSITY_ID, 0, NULL},
    [EHL_IN_RHEOLOGY] = {"rheology", "", "flow under shear; none: Newtonian", "", FF_RHEOLOGY_ID,
                         FF_OPTIONAL, NULL},
    [EHL_IN_POSITION] = {"surface.position", "m",
                         "arc coordinate s, in equal steps from 0; no surface: smooth flanks",
                         "arc", NULL, FF_OPTIONAL, NULL},
    [EHL_IN_HEIGHT_1] = {"surface.height_1", "m", "flank 1, positive out of the metal", "arc", NULL,
                         FF_OPTIONAL, NULL},
    [EHL_IN_HEIGHT_2] = {"surface.height_2", "m", "flank 2, positive out of the metal", "arc", NULL,
                         FF_OPTIONAL, NULL},
    [EHL_IN_RQ_1] = {"surface.rq_1", "m", "root mean square roughness of flank 1", "", NULL,
                     FF_OPTIONAL, NULL},
    [EHL_IN_RQ_2] = {"surface.rq_2", "m", "root mean square roughness of flank 2", "", NULL,
                     FF_OPTIONAL, NULL},
    [EHL_IN_PERIOD] = {"surface.period", "m",
                       "length after which the record repeats; 0: flat outside", "", NULL,
                       FF_OPTIONAL, NULL},
    [EHL_IN_ORIGIN] = {"surface.origin", "m",
                       "arc coordinate of both flanks at x = 0 at the first time", "", NULL,
                       FF_OPTIONAL, NULL},
    [EHL_IN_ROUGHNESS] = {"gear.roughness", "m",
                          "root mean square roughness of both flanks, 0: unknown; for the "
                          "lambda ratio alone, and only without a surface",
                          "gear", NULL, FF_OPTIONAL, NULL},
};

const ff_port ehl_outputs[EHL_OUTPUTS] = {
    [EHL_TIME] = {"time", "s", "times of the results: those of the steps", "t", NULL, 0, NULL},
    [EHL_ROLL_ANGLE] = {"roll_angle", "rad", "roll angle of gear 1; needs a contact that has one",
                        "t", NULL, 0, NULL},
    [EHL_ENGAGEMENT] = {"engagement", "1",
                        "mesh cycle of the motion in which the pair begins; 0 without one", "t",
                        NULL, 0, NULL},
    [EHL_H_MIN] = {"h_min", "m", "least film thickness (parabola through the lowest nodes)", "t",
                   NULL, 0, NULL},
    [EHL_H_CENTRAL] = {"h_central", "m", "film thickness at x = 0", "t", NULL, 0, NULL},
    [EHL_P_MAX] = {"p_max", "Pa", "highest pressure", "t", NULL, 0, NULL},
    [EHL_FRICTION_COEFFICIENT] = {"friction_coefficient", "1",
                                  "traction over load, sign of u1 - u2; 0 without load; rolling "
                                  "is not in it",
                                  "t", NULL, 0, NULL},
    [EHL_TRACTION] = {"traction", "N/m",
                      "shear stress at mid-film over the pressurised film, and boundary "
                      "friction; sign of u1 - u2",
                      "t", NULL, 0, NULL},
    [EHL_POWER_LOSS] = {"power_loss", "W/m",
                        "all that the film dissipates, per width: sliding, rolling, squeeze and "
                        "asperities",
                        "t", NULL, 0, NULL},
    [EHL_SLIDING_LOSS] = {"sliding_loss", "W/m",
                          "shear stress at mid-film times sliding speed over the pressurised "
                          "film",
                          "t", NULL, 0, NULL},
    [EHL_ROLLING_LOSS] = {"rolling_loss", "W/m",
                          "entrainment speed times the integral of h dp/dx, to the end of a "
                          "flooded inlet",
                          "t", NULL, 0, NULL},
    [EHL_SQUEEZE_LOSS] = {"squeeze_loss", "W/m",
                          "what the pressure flow dissipates beyond rolling_loss, as the film "
                          "changes with time; negative where it gives back",
                          "t", NULL, 0, NULL},
    [EHL_ASPERITY_LOSS] = {"asperity_loss", "W/m",
                           "boundary friction of asperities in contact times sliding speed", "t",
                           NULL, 0, NULL},
    [EHL_LOAD_ERROR] = {"load_error", "1",
                        "|integral of p - load| over the largest load; without load this is the "
                        "force of the film, up to 1 % while it lands",
                        "t", NULL, 0, NULL},
    [EHL_MASS_ERROR] = {"mass_error", "1",
                        "inflow - outflow - storage between the highest pressure and any other "
                        "place, over the flow there",
                        "t", NULL, 0, NULL},
    [EHL_H_MIN_ERROR] =
        {"h_min_error", "m",
         "estimate of the error of h_min: (0.16 + 0.0063 L^2)/n^2 of it (first-order wedge: "
         "(0.4 + 0.012 L)/n) with n cells over the inlet's pressure rise and Moes' L, plus the "
         "truncation of the time steps, which the film "
         "gathers on its way through the contact",
         "t", NULL, 0, NULL},
    [EHL_H_CENTRAL_ERROR] =
        {"h_central_error", "m",
         "estimate of the error of h_central: (0.2 + 0.05 L)/n^2 of it (first-order wedge: "
         "(0.4 + 0.02 L)/n), n and L as for h_min_error, plus the truncation that the film at "
         "x = 0 has gathered",
         "t", NULL, 0, NULL},
    [EHL_ONE_WAY_GAP_ERROR] =
        {"one_way_gap_error", "m",
         "without load: how much further than contact.gap the force of the film keeps the flanks "
         "apart, which the dynamics does not know",
         "t", NULL, 0, NULL},
    [EHL_ASPERITY_LOAD_SHARE] = {"asperity_load_share", "1",
                                 "share of the load that asperities in contact carry", "t", NULL, 0,
                                 NULL},
    [EHL_CONTACT_RATIO] = {"contact_ratio", "1",
                           "length in contact over the Hertz width 2 a of the load", "t", NULL, 0,
                           NULL},
    [EHL_TRAPPED_SHARE] = {"trapped_share", "1",
                           "share of the load that oil between two contacts carries, which has "
                           "no way out of a line contact",
                           "t", NULL, 0, NULL},
    [EHL_YIELD_SHARE] = {"yield_share", "1",
                         "share of the load where p is asperity_hardness and the metal yields", "t",
                         NULL, 0, NULL},
    [EHL_PLASTIC_DEPTH_MAX] = {"plastic_depth_max", "m", "highest plastic_depth", "t", NULL, 0,
                               NULL},
    [EHL_LAMBDA_RATIO] =
        {"lambda_ratio", "1",
         "film over the roughness sqrt(Rq1^2 + Rq2^2) of both flanks: h_central, with "
         "rough flanks the mean over the middle half of the Hertz width; needs a "
         "surface, or a gear with its roughness",
         "t", NULL, 0, NULL},
    [EHL_X] = {"x", "m",
               "position along the surface, 0 at the line of contact; with rough flanks the fields "
               "are those of the nodes nearest to it, half a cell away at most",
               "x", NULL, 0, NULL},
    [EHL_FILM] = {"film", "m", "film thickness h", "t x", NULL, 0, NULL},
    [EHL_PRESSURE] = {"pressure", "Pa", "film pressure p", "t x", NULL, 0, NULL},
    [EHL_FILM_FRACTION] = {"film_fraction", "1",
                           "share of the gap that is filled; below 1 only with "
                           "cavitation: mass-conserving",
                           "t x", NULL, 0, NULL},
    [EHL_ASPERITY_PRESSURE] = {"asperity_pressure", "Pa", "pressure that asperities carry", "t x",
                               NULL, 0, NULL},
    [EHL_PLASTIC_DEPTH] = {"plastic_depth", "m",
                           "plastic part of the gap of rough flanks where p is "
                           "asperity_hardness; of the instant: no dent stays on a flank",
                           "t x", NULL, 0, NULL},
    [EHL_H_MIN_LOWEST] = {"h_min_lowest", "m", "lowest h_min of all times", "", NULL, 0, NULL},
    [EHL_H_MIN_LOWEST_AT] = {"h_min_lowest_at", "rad",
                             "roll angle of it; needs a contact that has one", "", NULL, 0, NULL},
    [EHL_H_MIN_LOWEST_MEAN] = {"h_min_lowest_mean", "m",
                               "mean over the engagements of the lowest h_min of each", "", NULL, 0,
                               NULL},
    [EHL_H_MIN_LOWEST_SPREAD] = {"h_min_lowest_spread", "m",
                                 "highest less lowest of them; 0 with one engagement", "", NULL, 0,
                                 NULL},
    [EHL_ENGAGEMENTS_JUDGED] = {"engagements_judged", "1", "engagements that the results are of",
                                "", NULL, 0, NULL},
    [EHL_P_MAX_HIGHEST] = {"p_max_highest", "Pa", "highest pressure of all times", "", NULL, 0,
                           NULL},
    [EHL_LAMBDA_RATIO_LOWEST] = {"lambda_ratio_lowest", "1", "lowest lambda_ratio of all times", "",
                                 NULL, 0, NULL},
    [EHL_NEWTON_STEPS] = {"newton_steps", "1", "Newton steps in all", "", NULL, 0, NULL},
    [EHL_CONVOLUTIONS] = {"convolutions", "1", "deflections of a pressure in all", "", NULL, 0,
                          NULL},
    [EHL_STEPS_CUT] = {"steps_cut", "1", "time steps that had to be cut", "", NULL, 0, NULL},
};
