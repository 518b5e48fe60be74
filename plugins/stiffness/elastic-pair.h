/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A pair of gears with elastic teeth. Includes the compliance of teeth, fillets and bodies down to
   the rim, by finite elements or as beams; the coupling of neighbouring teeth through the body; and
   the load-dependent approach in the Hertzian contact. */
#ifndef STIFFNESS_ELASTIC_PAIR_H
#define STIFFNESS_ELASTIC_PAIR_H

#include "elements/ring.h"
#include "equilibrium.h"
#include "tooth-beam.h"

/* The data that determine the compliance of a gear. They are compared bytewise, to find gears with
   equal data. */
typedef struct stiffness_body_data {
    stiffness_contour_data contour;
    stiffness_material material;
    double rim_radius;
    size_t elements;
} stiffness_body_data;

typedef struct stiffness_body {
    bool made;
    stiffness_body_data data;
    stiffness_contour contour;
    stiffness_ring ring;
    double
        mesh_error; /* relative change of the compliance at mid-flank with half as many elements */
} stiffness_body;

/* Method for the compliance: finite elements, or beams without coupling of teeth. */
enum { STIFFNESS_FINITE_ELEMENT, STIFFNESS_ANALYTICAL };
enum { STIFFNESS_STRAIN, STIFFNESS_STRESS };

/* The settings for computing the compliance, and the bodies computed so far. */
typedef struct stiffness_elasticity {
    const ff_host *host;
    int64_t elements;   /* number of elements in one sector */
    int32_t compliance; /* STIFFNESS_FINITE_ELEMENT, STIFFNESS_ANALYTICAL */
    int32_t plane;      /* STIFFNESS_STRAIN, STIFFNESS_STRESS */
    int32_t coupling;   /* 1: a loaded tooth moves its neighbours */
    gsl_integration_glfixed_table *rule;
    stiffness_body body[2]; /* cached for later evaluations */
} stiffness_elasticity;

/* The pair during one evaluation. */
typedef struct stiffness_elastic_pair {
    const stiffness_elasticity *model;
    const stiffness_gears *gears;
    const stiffness_body *body[2];
    stiffness_tooth tooth[2];
    double half_space[2]; /* compliance (1 - nu^2)/(pi E b) of each flank as a half space, m/N */
} stiffness_elastic_pair;

/* Computes the missing bodies. Gears with equal data share one body. */
ff_status stiffness_elastic_pair_make(stiffness_elasticity *model, const stiffness_gears *gears,
                                      stiffness_elastic_pair *pair);

/* The `compliance` function of a stiffness_source; `self` is a stiffness_elastic_pair. */
void stiffness_elastic_pair_compliance(const void *self, const stiffness_position *at,
                                       stiffness_contacts *c);

/* Returns the compliance of both teeth at the roll angles of their contact, without the Hertzian
   approach, m/N. */
double stiffness_elastic_pair_teeth(const stiffness_elastic_pair *p, const double roll[2]);
/* Returns the Hertzian approach of this contact, in plane strain or plane stress; `curvature` is
   its equivalent radius, m. */
stiffness_hertz stiffness_elastic_pair_approach(const stiffness_elastic_pair *p,
                                                const double roll[2], double curvature,
                                                bool strain);

#endif
