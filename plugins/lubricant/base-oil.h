/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is known of the base oils of standards.h beyond their viscosity. */
#ifndef LUBRICANT_BASE_OIL_H
#define LUBRICANT_BASE_OIL_H

#include "standards.h"

/* Typical density at 15 degC, kg/m3. */
double lubricant_base_density_15(int base);

/*
 * Functions of T, K, for an oil of that base and density_15: W/(m K) and J/(kg K), with their
 * slope. NaN: no source is known.
 */
double lubricant_base_conductivity(int base, double density_15, double T, double *slope);
double lubricant_base_heat_capacity(int base, double density_15, double T, double *slope);

/* dln(eta)/dp at ambient pressure, 1/Pa, of an oil of that base whose kinematic viscosity is nu,
   m2/s, and ln(eta0 / 1 Pa s) is ln_eta0; and its slope, from the slopes of both. */
double lubricant_base_pressure_coefficient(int base, double nu, double ln_eta0, double nu_slope,
                                           double ln_eta0_slope, double *slope);

/* The same of the typical ISO VG 100 oil of that base at T, K, and its slope over T. */
double lubricant_base_coefficient(int base, double T, double *slope);

#endif
