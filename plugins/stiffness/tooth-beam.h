/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compliance of one involute tooth and of the body below it, per unit of normal force, by the
   potential-energy method (Yang & Lin 1987, Tian 2004) with the foundation of Sainsot, Velex &
   Duverger 2004. The tooth is a beam whose axis x runs from the gear's centre through the middle of
   the tooth. Its outline is the true involute down to the base circle, and a radial straight line
   from there to the root circle. If the root circle is above the base circle, the involute ends at
   the root circle. */
#ifndef STIFFNESS_TOOTH_BEAM_H
#define STIFFNESS_TOOTH_BEAM_H

#include "gears.h"

#include <gsl/gsl_integration.h>
#include <stdbool.h>

/* A section of a symmetric beam: position on the axis, half thickness, and dx/dt for the outline's
   parameter t. */
typedef struct stiffness_section {
    double x, half, dx;
} stiffness_section;
typedef stiffness_section (*stiffness_outline)(const void *shape, double t);

/* A unit force on the outline at (x, y), with its components across the axis and along it,
 * towards the root. */
typedef struct stiffness_load {
    double x, y, across, along;
} stiffness_load;

/* Elastic moduli for bending and axial load (multiplied by 1/(1-nu^2) in plane strain), and the
   face width. */
typedef struct stiffness_beam {
    double bending, axial, shear, width;
} stiffness_beam;

/* Parts of the compliance, m/N. */
typedef struct stiffness_compliance {
    double bending, shear, axial, foundation;
} stiffness_compliance;

double stiffness_compliance_sum(const stiffness_compliance *c);

/* Adds to *c the strain energy between the parameters t0 and t1, integrated with the nodes of
   `rule`. */
void stiffness_beam_add(const stiffness_beam *beam, stiffness_outline outline, const void *shape,
                        double t0, double t1, const stiffness_load *load,
                        const gsl_integration_glfixed_table *rule, stiffness_compliance *c);
/* Computes the integrands d(compliance)/dt of bending, shear and axial load at one section. */
void stiffness_beam_density(const stiffness_beam *beam, const stiffness_section *at,
                            const stiffness_load *load, double density[3]);

/* L*, M*, P*, Q* of Sainsot et al. 2004 for h = root radius/rim radius and the half angle theta
   of the tooth at the root circle. */
typedef struct stiffness_sainsot {
    double L, M, P, Q;
} stiffness_sainsot;
stiffness_sainsot stiffness_sainsot_at(double h, double theta);

typedef struct stiffness_tooth {
    double base_radius, root_radius;
    double half_angle;      /* half angle of the tooth at the base circle, between its involutes,
                               rad */
    double root_roll;       /* roll angle where the involute begins */
    double root_half_angle; /* half angle of the tooth at the root circle, rad */
    double body_ratio;      /* h: root radius over rim radius */
    double elastic_modulus, width;
    stiffness_beam beam;
    stiffness_sainsot body;
} stiffness_tooth;

/* Input data of stiffness_tooth_make. Radii in m; thickness: arc at the reference circle. */
typedef struct stiffness_tooth_data {
    double base_radius, root_radius, reference_radius, rim_radius, thickness, width;
    double elastic_modulus, poisson_ratio;
    int plane_strain;
} stiffness_tooth_data;
void stiffness_tooth_make(stiffness_tooth *tooth, const stiffness_tooth_data *data);
/* Makes the tooth of gear 0 or 1. */
void stiffness_tooth_of_gear(stiffness_tooth *tooth, const stiffness_gears *gears, int gear,
                             bool plane_strain);

/* Outlines for stiffness_beam_add: the involute over its roll angle, the radial part over the
 * radius. */
stiffness_section stiffness_tooth_involute(const void *tooth, double roll);
stiffness_section stiffness_tooth_radial(const void *tooth, double radius);
stiffness_load stiffness_tooth_load(const stiffness_tooth *tooth, double roll);

/* Returns the compliance for contact at that roll angle of the tooth's own gear, at or above
 * root_roll. */
stiffness_compliance stiffness_tooth_compliance(const stiffness_tooth *tooth, double roll,
                                                const gsl_integration_glfixed_table *rule);

#endif
