/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs of the ratings from gear, operating point, motion and oil, and shared quantities along the
   path of contact. In SI; a place on the path is the radius of curvature of flank 1. The texts of
   ISO/TR 13989-1 and -2 and ISO/TR 15144-1 (today ISO/TS 6336-20, -21 and -22) were not available.
   Formulas and numbers are quoted from a public implementation; where this implementation
   contradicts itself, a comment states the choice made here. */
#ifndef RATING_PAIR_H
#define RATING_PAIR_H

#include "../numerics/gear-heat.h"

#include <flankfilm/laws.h>

/* The inputs common to all ratings, in the order of their rows. */
enum {
    RATING_IN_TEETH,
    RATING_IN_PINION,
    RATING_IN_BASE,
    RATING_IN_PITCH,
    RATING_IN_TIP,
    RATING_IN_DISTANCE,
    RATING_IN_ANGLE,
    RATING_IN_PRESSURE_ANGLE,
    RATING_IN_WIDTH,
    RATING_IN_MODULUS,
    RATING_IN_ROUGHNESS,
    RATING_IN_PROFILE,
    RATING_IN_BACK_PROFILE,
    RATING_IN_YIELD,
    RATING_IN_CLASS,
    RATING_IN_MODULI,
    RATING_IN_HEAT, /* three rows */
    RATING_IN_HEAT_LAST = RATING_IN_HEAT + NUMERICS_HEAT_INPUTS - 1,
    RATING_IN_FORCE,
    RATING_IN_SPEED,
    RATING_IN_OIL_TEMPERATURE,
    RATING_IN_DYNAMIC_FACTOR,
    RATING_IN_OIL,
    RATING_INPUTS
};

/* The rows: the film thickness for micropitting, the common inputs, and the contact temperature for
   scuffing. Micropitting omits the last row, scuffing the first. */
extern const ff_port rating_inputs[1 + RATING_INPUTS + 1];

typedef struct rating_pair {
    double teeth[2], base[2], pitch[2], tip[2];
    double ratio; /* z2/z1 */
    int back;     /* whether gear 2 drives; index 0 then means gear 2, and the flanks are the back
                     flanks */
    int pinion;   /* index of the pinion; a standard gives it index 1, unless a formula depends
                     on the driving gear */
    double centre_distance, working_angle, pressure_angle, width, modulus;
    double roughness;     /* Ra, mean of both flanks */
    double tip_relief[2]; /* 0: none, or unknown */
    double yield;         /* yield strength of the weaker flank; NaN: unknown */
    double grade;         /* the coarser of both flanks' classes of ISO 1328-1; 0: unknown */
    double contact[2];    /* B = sqrt(k rho c) of the gears, J/(m2 K s^0.5) */
    double force;         /* force along the line of action */
    double omega, oil_temperature, dynamic_factor;
    double line, base_pitch; /* length of the common tangent of the base circles */
    double sap, end;         /* places of the ends of the path of contact */
    double pitch_point, pitch_speed;
    const ff_liquid *oil;
} rating_pair;

/* Thermal data used if the gears give none. */
typedef struct rating_heat {
    double conductivity, density, specific_heat;
} rating_heat;

#define RATING_HEAT_ROWS(type)                                                                     \
    FF_QUANTITY_UNLESS("gear.thermal_conductivity", "thermal_conductivity", "W/(m K)", type,       \
                       heat.conductivity, 0, NUMERICS_STEEL_CONDUCTIVITY, NULL, 1e-3, 1e4, 0, 0,   \
                       "thermal conductivity of both gears, if the gear stage gives none"),        \
        FF_QUANTITY_UNLESS("gear.density", "density", "kg/m3", type, heat.density, 0,              \
                           NUMERICS_STEEL_DENSITY, NULL, 1, 1e5, 0, 0, "likewise"),                \
        FF_QUANTITY_UNLESS("gear.specific_heat", "specific_heat", "J/(kg K)", type,                \
                           heat.specific_heat, 0, NUMERICS_STEEL_HEAT, NULL, 1, 1e5, 0, 0,         \
                           "likewise")

/* Load factors given by the user. */
typedef struct rating_load {
    double application, face, transverse; /* K_A, K_Hbeta, K_Halpha */
    int64_t grade;                        /* flank tolerance class of ISO 1328-1; negative: auto */
} rating_load;

/* Reads the inputs. Refuses gears that are not of steel, since `standard` does not cover them. */
ff_status rating_pair_read(const ff_host *host, const char *standard, const ff_array *in,
                           const rating_heat *heat, const ff_liquid *oil, rating_pair *p);

/* Returns the flank tolerance class for a rating: the given one, that of the gears, or 6. */
double rating_grade(const rating_pair *p, const rating_load *load);

/* Returns the roll angle of gear 1 at a place on the path. */
double rating_roll(const rating_pair *p, double place);
/* Returns the relative radius of curvature at a place on the path. */
double rating_radius(const rating_pair *p, double place);
/* Returns the surface speed of flank `gear` at a place on the path. */
double rating_speed(const rating_pair *p, int gear, double place);
/* Returns the load share of a pair of unmodified spur teeth, X_Gamma (ISO/TR 13989-1, clause 9.2)
   and X_Y (ISO/TR 15144-1, formulas 46 to 48). With the tolerance class Q it is (Q - 2)/15 at both
   ends of the path, rises by up to 1/3 towards single contact, and is 1 in single contact. */
double rating_load_share(const rating_pair *p, const rating_load *load, double place);
/* Returns the load per width with all factors, N/m. */
double rating_line_load(const rating_pair *p, const rating_load *load);
/* Returns the addendum contact ratio of a gear. */
double rating_addendum_ratio(const rating_pair *p, int gear);

/* Evaluates dynamic viscosity, Pa s, and density, kg/m3, of the oil. */
ff_status rating_oil_at(const ff_host *host, const rating_pair *p, double T, double *viscosity,
                        double *density);

/* Reports that the text of the standard was not available. `held` names the results with which the
   formulas were compared. */
void rating_report_draft(const ff_host *host, const char *standard, const char *held);

#endif
