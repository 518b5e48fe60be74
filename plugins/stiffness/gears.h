/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The two gears, for sources that compute the compliance of their teeth. */
#ifndef FF_STIFFNESS_GEARS_H
#define FF_STIFFNESS_GEARS_H

#include "deviations.h"
#include "mesh.h"

/* The input rows of such a source: path of contact, deviations, gears. */
enum {
    FF_IN_BASE = FF_PATH_INPUTS,
    FF_IN_REFERENCE,
    FF_IN_ROOT,
    FF_IN_BORE,
    FF_IN_THICKNESS,
    FF_IN_ANGLE,
    FF_IN_WIDTH,
    FF_IN_MODULUS,
    FF_IN_POISSON,
    FF_IN_BACKLASH,
    FF_GEAR_INPUTS
};
extern const ff_port ff_gear_inputs[FF_GEAR_INPUTS];

typedef struct ff_gear {
    double teeth;
    double base_radius, reference_radius, root_radius;
    double rim_radius;     /* inside which the body is rigid */
    double thickness;      /* arc at the reference circle, backlash deducted */
    double full_thickness; /* backlash not deducted */
    double elastic_modulus, poisson_ratio;
    double roll_low, roll_tip; /* own roll angles of its lowest contact and of its tip */
} ff_gear;

typedef struct ff_gears {
    ff_gear gear[2];
    double width;
    double tangent_length; /* between the base circles' points of tangency */
    double roll_sap, pitch, contact_ratio;
} ff_gears;

/* Rim radii that the user states; count 0: bore, or half the root radius without a bore. */
typedef struct ff_rim {
    size_t count;
    double radius[2];
} ff_rim;

/* The parameter rim_radius: one value or two. */
ff_status ff_rim_set(const ff_host *host, const ff_value *value, ff_rim *rim);

/* Reads and checks the rows from FF_IN_BASE on. */
ff_status ff_gears_read(const ff_host *host, const ff_array *in, const ff_engagement *e,
                        const ff_rim *rim, ff_gears *gears);

/* Contact of a pair of that age on the line of action: roll angle of gear 0 or 1. */
double ff_gears_roll(const ff_gears *g, int gear, double age);
/* Radius of curvature of the contact there. */
double ff_gears_curvature(const ff_gears *g, double age);

/* Contact of a pair of any age, perfect flanks: roll angles and the gap along the line of action.
   Before SAP and after the tip one tooth's tip corner meets the other's flank off the line of
   action. False: it meets no flank. */
bool ff_gears_contact(const ff_gears *g, double age, double roll[2], double *gap);

#endif
