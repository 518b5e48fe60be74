/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Compliance of one involute tooth and of the body below it, per unit of normal force, by the
 * potential-energy method (Yang & Lin 1987, Tian 2004) with the foundation of Sainsot, Velex &
 * Duverger 2004. The tooth is a beam whose axis x runs from the gear's centre through the middle of
 * the tooth. Its outline is the true involute down to the base circle and straight and radial
 * from there to the root circle; a root circle above the base circle cuts the involute.
 */
#ifndef FF_STIFFNESS_TOOTH_H
#define FF_STIFFNESS_TOOTH_H

#include <gsl/gsl_integration.h>

/* A section of a symmetric beam: place on the axis, half thickness, dx/dt of the parameter t. */
typedef struct ff_section {
    double x, half, dx;
} ff_section;
typedef ff_section (*ff_outline)(const void *shape, double t);

/* A unit force on the outline at (x, y): its parts across the axis and along it to the root. */
typedef struct ff_load {
    double x, y, across, along;
} ff_load;

/* bending, axial: moduli of elasticity (raised by 1/(1-nu^2) in plane strain); width: of the face
 */
typedef struct ff_beam {
    double bending, axial, shear, width;
} ff_beam;

/* m/N */
typedef struct ff_compliance {
    double bending, shear, axial, foundation;
} ff_compliance;

double ff_compliance_sum(const ff_compliance *c);

/* Adds the strain energy between t0 and t1 to *c, with the nodes of `rule`. */
void ff_beam_add(const ff_beam *beam, ff_outline outline, const void *shape, double t0, double t1,
                 const ff_load *load, const gsl_integration_glfixed_table *rule, ff_compliance *c);
/* The three integrands at one section: d(compliance)/dt. */
void ff_beam_density(const ff_beam *beam, const ff_section *at, const ff_load *load,
                     double density[3]);

/* L*, M*, P*, Q* of Sainsot et al. 2004 for h = root radius/rim radius and the half angle theta
   of the tooth at the root circle. */
typedef struct ff_sainsot {
    double L, M, P, Q;
} ff_sainsot;
ff_sainsot ff_sainsot_at(double h, double theta);

typedef struct ff_tooth {
    double base_radius, root_radius;
    double half_angle;      /* of the tooth at the base circle, by its involutes, rad */
    double root_roll;       /* roll angle where the involute begins */
    double root_half_angle; /* of the tooth at the root circle, rad */
    double body_ratio;      /* h: root radius over rim radius */
    double elastic_modulus, width;
    ff_beam beam;
    ff_sainsot body;
} ff_tooth;

/* radii in m; thickness: arc at the reference circle. Fills in all the rest. */
typedef struct ff_tooth_data {
    double base_radius, root_radius, reference_radius, rim_radius, thickness, width;
    double elastic_modulus, poisson_ratio;
    int plane_strain;
} ff_tooth_data;
void ff_tooth_make(ff_tooth *tooth, const ff_tooth_data *data);

/* Outlines for ff_beam_add: the involute over its roll angle, the radial part over the radius. */
ff_section ff_tooth_involute(const void *tooth, double roll);
ff_section ff_tooth_radial(const void *tooth, double radius);
ff_load ff_tooth_load(const ff_tooth *tooth, double roll);

/* Contact at that roll angle of the tooth's own gear, at or above root_roll. */
ff_compliance ff_tooth_compliance(const ff_tooth *tooth, double roll,
                                  const gsl_integration_glfixed_table *rule);

#endif
