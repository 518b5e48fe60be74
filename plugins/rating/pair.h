/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs of the ratings from gear, operating point, motion and oil, and quantities along the
 * path of contact that they share. SI; places on the path are radii of curvature of flank 1.
 * Sources: the texts of ISO/TR 13989-1 and -2 and ISO/TR 15144-1 (today ISO/TS 6336-20, -21 and
 * -22) were not read. Formulas and numbers are quoted from a public implementation; where that
 * contradicts itself, the choice is stated. */
#ifndef RATING_PAIR_H
#define RATING_PAIR_H

#include "../numerics/gear-heat.h"

#include <flankfilm/laws.h>

/* The inputs that all ratings have, in the order of their rows. */
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

/* These rows stand between the film of micropitting and the losses of scuffing: micropitting
 * uses the rows from the first on, scuffing those from the second on. */
extern const ff_port rating_inputs[1 + RATING_INPUTS + 1];

typedef struct rating_pair {
    double teeth[2], base[2], pitch[2], tip[2];
    double ratio; /* z2/z1 */
    int back;     /* gear 2 drives; it is gear 0 here, and the flanks are the back flanks */
    int pinion;   /* 0 or 1; a standard gives the pinion index 1, unless the driving gear matters */
    double centre_distance, working_angle, pressure_angle, width, modulus;
    double roughness;     /* Ra, the mean of both flanks */
    double tip_relief[2]; /* 0: none, or unknown */
    double yield;         /* of the weaker flank; NaN: unknown */
    double grade;         /* the coarser of both flanks' classes of ISO 1328-1; 0: unknown */
    double contact[2];    /* B = sqrt(k rho c) of the gears, J/(m2 K s^0.5) */
    double force;         /* along the line of action */
    double omega, oil_temperature, dynamic_factor;
    double line, base_pitch; /* length of the common tangent of the base circles */
    double sap, end;         /* ends of the path of contact */
    double pitch_point, pitch_speed;
    const ff_liquid *oil;
} rating_pair;

/* Thermal data for gears that do not give their own. */
typedef struct rating_heat {
    double conductivity, density, specific_heat;
} rating_heat;

#define RATING_HEAT_ROWS(type)                                                                     \
    FF_QUANTITY_UNLESS("gear.thermal_conductivity", "thermal_conductivity", "W/(m K)", type,       \
                       heat.conductivity, 0, NUMERICS_STEEL_CONDUCTIVITY, NULL, 1e-3, 1e4, 0, 0,   \
                       "of both gears, where they do not tell"),                                   \
        FF_QUANTITY_UNLESS("gear.density", "density", "kg/m3", type, heat.density, 0,              \
                           NUMERICS_STEEL_DENSITY, NULL, 1, 1e5, 0, 0, "likewise"),                \
        FF_QUANTITY_UNLESS("gear.specific_heat", "specific_heat", "J/(kg K)", type,                \
                           heat.specific_heat, 0, NUMERICS_STEEL_HEAT, NULL, 1, 1e5, 0, 0,         \
                           "likewise")

/* Load factors that the user gives. */
typedef struct rating_load {
    double application, face, transverse; /* K_A, K_Hbeta, K_Halpha */
    int64_t grade;                        /* flank tolerance class of ISO 1328-1; below 0: auto */
} rating_load;

/* Reads the inputs. Refuses gears that are not of steel, which `standard` does not cover. */
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
/* Returns the share of the load on unmodified spur teeth, X_Gamma (ISO/TR 13989-1, clause 9.2)
 * and X_Y (ISO/TR 15144-1, formulas 46 to 48): (Q - 2)/15 at both ends of the path, up to 1/3
 * more on the way to single contact, and 1 there. */
double rating_load_share(const rating_pair *p, const rating_load *load, double place);
/* Returns the load per width with all factors, N/m. */
double rating_line_load(const rating_pair *p, const rating_load *load);
/* Returns the addendum contact ratio of a gear. */
double rating_addendum_ratio(const rating_pair *p, int gear);

/* Dynamic viscosity, Pa s, and density, kg/m3, of the oil. */
ff_status rating_oil_at(const ff_host *host, const rating_pair *p, double T, double *viscosity,
                        double *density);

/* Reports that the formulas were not read in the standard itself. */
void rating_report_draft(const ff_host *host, const char *standard, const char *held);

#endif
