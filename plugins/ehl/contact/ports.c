/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ports.h"

#include <flankfilm/film.h>

#include <math.h>

/* The contact and the oil, which all models have. `another`: what another engagement begins with.
 */
#define CONTACT_AND_OIL(another)                                                                   \
    [EHL_IN_TIME] = {"contact.time",                                                               \
                     "s",                                                                          \
                     "times of the history, not decreasing; one: a steady contact",                \
                     "t",                                                                          \
                     NULL,                                                                         \
                     0,                                                                            \
                     NULL},                                                                        \
    [EHL_IN_RADIUS] =                                                                              \
        {"contact.equivalent_radius", "m", "R: 1/R = 1/r1 + 1/r2", "t", NULL, 0, NULL},            \
    [EHL_IN_SPEED_1] = {"contact.speed_1", "m/s", "surface speed u1", "t", NULL, 0, NULL},         \
    [EHL_IN_SPEED_2] = {"contact.speed_2", "m/s", "surface speed u2", "t", NULL, 0, NULL},         \
    [EHL_IN_LOAD] =                                                                                \
        {"contact.load_per_width", "N/m", "normal load; 0: contact lost", "t", NULL, 0, NULL},     \
    [EHL_IN_MODULUS] =                                                                             \
        {"contact.reduced_modulus", "Pa", "E': 2/E' = sum (1 - nu^2)/E", "", NULL, 0, NULL},       \
    [EHL_IN_ROLL] = {"contact.roll_angle", "rad", "roll angle of gear 1", "t", NULL,               \
                     FF_OPTIONAL,          NULL},                                                  \
    [EHL_IN_GAP] = {"contact.gap", "m",  "separation of the flanks where the contact is lost",     \
                    "t",           NULL, FF_OPTIONAL,                                              \
                    NULL},                                                                         \
    [EHL_IN_ENGAGEMENT] = {"contact.engagement",                                                   \
                           "1",                                                                    \
                           "engagement that each time belongs to; another one begins " another,    \
                           "t",                                                                    \
                           NULL,                                                                   \
                           FF_OPTIONAL,                                                            \
                           NULL},                                                                  \
    [EHL_IN_VISCOSITY] = {"viscosity", "", "viscosity of the oil", "", FF_VISCOSITY_ID, 0, NULL},  \
    [EHL_IN_DENSITY] = {"density", "", "density of the oil", "", FF_DENSITY_ID, 0, NULL},          \
    [EHL_IN_RHEOLOGY] =                                                                            \
        {"rheology",  "",  "flow under shear; none: Newtonian", "", FF_RHEOLOGY_ID,                \
         FF_OPTIONAL, NULL},                                                                       \
    [EHL_IN_OIL] = NUMERICS_OIL_ROWS,                                                              \
    NUMERICS_OIL_DENSITY_ROW, [EHL_IN_LIQUID] = {"oil",                                            \
                                                 "",                                               \
                                                 "the oil over temperature; thermal asks for it",  \
                                                 "",                                               \
                                                 FF_LIQUID_ID,                                     \
                                                 FF_OPTIONAL,                                      \
                                                 "lubricant"}

const ff_port ehl_inputs[EHL_INPUTS] = {
    CONTACT_AND_OIL("with a steady film of its own"),
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
    [EHL_IN_SHEAR_RATE] = {"rheology.rate", "",
                           "shear rate at a point of the film, for thermal: full", "",
                           FF_RHEOLOGY_2_ID, FF_OPTIONAL, NULL},
    [EHL_IN_BULK] = {"bulk.bulk_temperature", "K",
                     "temperature of the teeth by the loss that this film has, for thermal: full, "
                     "in place of the parameter bulk_temperature",
                     "", NULL, FF_OPTIONAL | FF_FEEDBACK, "losses"},
    [EHL_IN_DISCRETISATION] = {"discretisation", "",
                               "solves the film of each instant in place of this model's own "
                               "solver; smooth flanks",
                               "", FF_FILM_ID, FF_OPTIONAL, NULL},
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
         "truncation of the time steps and of the cells that the film gathers on its way through "
         "the contact; above 2 % what twice the cells make of the last passage",
         "t", NULL, 0, NULL},
    [EHL_H_CENTRAL_ERROR] =
        {"h_central_error", "m",
         "estimate of the error of h_central: (0.2 + 0.05 L)/n^2 of it (first-order wedge: "
         "(0.4 + 0.02 L)/n), n and L as for h_min_error, plus the truncation that the film at "
         "x = 0 has gathered; above 2 % by the cells as h_min_error",
         "t", NULL, 0, NULL},
    [EHL_P_MAX_ERROR] =
        {"p_max_error", "Pa",
         "estimate of the error of p_max, of smooth flanks: what the cells may cut off the spike, "
         "from 100 instants on by its film on more cells where that is above 5 %, plus the "
         "pressure of what the time steps leave out of the film",
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
    [EHL_TEMPERATURE_MAX] = {"temperature_max", "K",
                             "highest temperature of the film; needs thermal: full", "t", NULL, 0,
                             NULL},
    [EHL_FLASH_TEMPERATURE] = {"flash_temperature", "K",
                               "highest rise of a flank over its bulk temperature, under the film; "
                               "needs thermal: full",
                               "t", NULL, 0, NULL},
    [EHL_SEPARATION] = {"separation", "m",
                        "how much further apart the film keeps the bodies than their gap and a "
                        "dry contact under the force of the film would: its thickness as a spring "
                        "in series sees it, near h_central under load, 0 without pressure",
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
    [EHL_ROUGHNESS] = {"roughness", "m",
                       "heights of both flanks together, on their way through the contact", "t x",
                       NULL, 0, NULL},
    [EHL_TEMPERATURE] = {"temperature", "K",
                         "temperature, mean across the film; needs thermal: full", "t x", NULL, 0,
                         NULL},
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
    [EHL_ALPHA_STAR] = {"alpha_star", "1/Pa",
                        "film-forming pressure coefficient of the law with its oil, 1/int eta0/eta "
                        "dp; 0: the viscosity does not rise",
                        "", NULL, 0, NULL},
};

const ff_port ehl_estimate_inputs[EHL_ESTIMATE_INPUTS] = {
    CONTACT_AND_OIL("anew"),
    [EHL_ESTIMATE_IN_RQ_1] = {"surface.rq_1", "m",
                              "roughness of flank 1; the film stays smooth, but where the program "
                              "chooses the model it knows of it",
                              "", NULL, FF_OPTIONAL, NULL},
    [EHL_ESTIMATE_IN_RQ_2] = {"surface.rq_2", "m", "the same of flank 2", "", NULL, FF_OPTIONAL,
                              NULL},
    [EHL_ESTIMATE_IN_ROUGHNESS] = {"gear.roughness", "m",
                                   "root mean square roughness of both flanks, 0: unknown; for the "
                                   "lambda ratio alone, and only without a surface",
                                   "gear", NULL, FF_OPTIONAL, NULL},
};

const ff_port ehl_estimate_outputs[EHL_ESTIMATE_OUTPUTS] = {
    [EHL_ESTIMATE_TIME] = {"time", "s", "times of the results", "t", NULL, 0, NULL},
    [EHL_ESTIMATE_ROLL_ANGLE] = {"roll_angle", "rad",
                                 "roll angle of gear 1; needs a contact that has one", "t", NULL, 0,
                                 NULL},
    [EHL_ESTIMATE_ENGAGEMENT] = {"engagement", "1",
                                 "mesh cycle of the motion in which the pair begins; 0 without one",
                                 "t", NULL, 0, NULL},
    [EHL_ESTIMATE_H_MIN] = {"h_min", "m", "least film thickness", "t", NULL, 0, NULL},
    [EHL_ESTIMATE_H_CENTRAL] = {"h_central", "m", "film thickness at x = 0", "t", NULL, 0, NULL},
    [EHL_ESTIMATE_P_MAX] = {"p_max", "Pa", "Hertz pressure of the load", "t", NULL, 0, NULL},
    [EHL_ESTIMATE_FRICTION_COEFFICIENT] = {"friction_coefficient", "1",
                                           "traction over load, sign of u1 - u2; 0 without load",
                                           "t", NULL, 0, NULL},
    [EHL_ESTIMATE_TRACTION] = {"traction", "N/m",
                               "viscous shear stress over the Hertzian contact, sign of u1 - u2",
                               "t", NULL, 0, NULL},
    [EHL_ESTIMATE_POWER_LOSS] = {"power_loss", "W/m", "sliding and rolling loss, per width", "t",
                                 NULL, 0, NULL},
    [EHL_ESTIMATE_SLIDING_LOSS] = {"sliding_loss", "W/m", "traction times sliding speed", "t", NULL,
                                   0, NULL},
    [EHL_ESTIMATE_ROLLING_LOSS] = {"rolling_loss", "W/m",
                                   "of a flooded inlet, by the formula of Biboulet & Houpert 2010",
                                   "t", NULL, 0, NULL},
    [EHL_ESTIMATE_SQUEEZE_LOSS] = {"squeeze_loss", "W/m", "0: each film is steady", "t", NULL, 0,
                                   NULL},
    [EHL_ESTIMATE_ASPERITY_LOSS] = {"asperity_loss", "W/m", "0: the flanks are smooth", "t", NULL,
                                    0, NULL},
    [EHL_ESTIMATE_H_MIN_ERROR] = {"h_min_error", "m",
                                  "scatter of h_min against full steady solutions; the whole of it "
                                  "outside the range of the model",
                                  "t", NULL, 0, NULL},
    [EHL_ESTIMATE_LAMBDA_RATIO] = {"lambda_ratio", "1",
                                   "film over the roughness sqrt(Rq1^2 + Rq2^2) of both flanks: "
                                   "h_central; needs a surface, or a gear with its roughness",
                                   "t", NULL, 0, NULL},
    [EHL_ESTIMATE_X] = {"x", "m", "position along the surface, 0 at the line of contact", "x", NULL,
                        0, NULL},
    [EHL_ESTIMATE_FILM] =
        {"film", "m",
         "film thickness: in the contact as estimated, outside it with the gap of "
         "the dry contact added; without the constriction of the exit",
         "t x", NULL, 0, NULL},
    [EHL_ESTIMATE_PRESSURE] = {"pressure", "Pa", "Hertz pressure", "t x", NULL, 0, NULL},
    [EHL_ESTIMATE_H_MIN_LOWEST] = {"h_min_lowest", "m", "lowest h_min of all times", "", NULL, 0,
                                   NULL},
    [EHL_ESTIMATE_H_MIN_LOWEST_AT] = {"h_min_lowest_at", "rad",
                                      "roll angle of it; needs a contact that has one", "", NULL, 0,
                                      NULL},
    [EHL_ESTIMATE_P_MAX_HIGHEST] = {"p_max_highest", "Pa", "highest pressure of all times", "",
                                    NULL, 0, NULL},
    [EHL_ESTIMATE_LAMBDA_RATIO_LOWEST] = {"lambda_ratio_lowest", "1",
                                          "lowest lambda_ratio of all times", "", NULL, 0, NULL},
    [EHL_ESTIMATE_H_MIN_LOWEST_MEAN] = {"h_min_lowest_mean", "m",
                                        "mean over the engagements of the lowest h_min of each", "",
                                        NULL, 0, NULL},
    [EHL_ESTIMATE_H_MIN_LOWEST_SPREAD] = {"h_min_lowest_spread", "m",
                                          "highest less lowest of them; 0 with one engagement", "",
                                          NULL, 0, NULL},
    [EHL_ESTIMATE_ENGAGEMENTS_JUDGED] = {"engagements_judged", "1",
                                         "engagements that the results are of", "", NULL, 0, NULL},
    [EHL_ESTIMATE_ALPHA_STAR] =
        {"alpha_star", "1/Pa",
         "film-forming pressure coefficient of the law with its oil, 1/int eta0/eta "
         "dp; 0: the viscosity does not rise",
         "", NULL, 0, NULL},
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
        laws->rheology = service;
}
