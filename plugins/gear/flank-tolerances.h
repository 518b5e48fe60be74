/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flank tolerances of an accuracy class of ISO 1328-1:1995. */
#ifndef GEAR_FLANK_TOLERANCES_H
#define GEAR_FLANK_TOLERANCES_H

#include <flankfilm/plugin.h>

/* f_pt, F_p, f_f_alpha, f_H_alpha and F_alpha, m. */
typedef struct gear_tolerances {
    double single_pitch, total_pitch, profile_form, profile_slope, profile;
} gear_tolerances;

/* Computes the tolerances of a gear. Refuses, at the parameter `quality`, a gear outside the ranges
   of the standard: modules of 0.5 to 70 mm and reference diameters of 5 to 10000 mm. */
ff_status gear_tolerances_of(const ff_host *host, int gear, double quality, double module,
                             double reference_diameter, gear_tolerances *t);

#endif
