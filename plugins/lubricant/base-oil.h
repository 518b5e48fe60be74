/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Data of the base oils of standards.h other than viscosity. */
#ifndef LUBRICANT_BASE_OIL_H
#define LUBRICANT_BASE_OIL_H

#include "standards.h"

/* Typical density at 15 degC, kg/m3. */
double lubricant_base_density_15(int base);

/* Conductivity, W/(m K), and heat capacity, J/(kg K), at T, K, with their slopes, for an oil of
   that base and density_15. NaN: no source available. */
double lubricant_base_conductivity(int base, double density_15, double T, double *slope);
double lubricant_base_heat_capacity(int base, double density_15, double T, double *slope);

/* Returns dln(eta)/dp at ambient pressure, 1/Pa, for an oil of that base with the kinematic
   viscosity nu, m2/s, and ln(eta0 / 1 Pa s) = ln_eta0. *slope is its slope over T, from the slopes
   of nu and ln_eta0. */
double lubricant_base_pressure_coefficient(int base, double nu, double ln_eta0, double nu_slope,
                                           double ln_eta0_slope, double *slope);

/* Returns the coefficient of the typical ISO VG 100 oil of that base at T, K, with its slope over
   T. */
double lubricant_base_coefficient(int base, double T, double *slope);

#endif
