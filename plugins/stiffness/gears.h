/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The two gears, for models that compute the compliance of their teeth. */
#ifndef STIFFNESS_GEARS_H
#define STIFFNESS_GEARS_H

#include "path-inputs.h"

#include <flankfilm/plugin.h>

/* Lengths in m, angles in rad, elastic_modulus in Pa. */
typedef struct stiffness_gear {
    double teeth;
    double base_radius, reference_radius, root_radius;
    double rim_radius;     /* the body inside this radius is rigid */
    double thickness;      /* arc at the reference circle */
    double full_thickness; /* thickness from the profile shift alone */
    double tool_tip;       /* tip radius of the rack, in modules */
    double elastic_modulus, poisson_ratio;
    double roll_low, roll_tip; /* roll angles of lowest contact and tip on its own flank */
} stiffness_gear;

typedef struct stiffness_gears {
    stiffness_gear gear[2];
    double width;
    double tangent_length; /* length of the common tangent of the base circles */
    double roll_sap, pitch, contact_ratio;
} stiffness_gears;

/* Reads and checks the input rows from STIFFNESS_IN_BASE on. `rim`: the rim radii given by the
   user. If `rim` is empty, a rim radius is the bore radius, or half of the root radius for a gear
   without a bore. */
ff_status stiffness_gears_read(const ff_host *host, const ff_array *in, const stiffness_path *e,
                               const ff_reals *rim, stiffness_gears *gears);

#endif
