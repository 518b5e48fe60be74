/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Viscosity and density of an oil at ambient pressure, from what its data sheet says. */
#ifndef VISCOSITY_GRADE_H
#define VISCOSITY_GRADE_H

#include <stdint.h>

/* Rank of "ISO VG 220" among the grades of ISO 3448 that gear oils come in; -1: no such grade. */
int64_t viscosity_grade_find(const char *text);
#define VISCOSITY_GRADES "ISO VG 10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000 or 1500"

/* Base oils, in this order. Mineral: viscosity index 95; PAO: 150 (typical values). */
#define VISCOSITY_BASES "mineral|PAO"

/* Kinematic viscosity, m2/s, of the grade of that rank at 40 and 100 degC. */
double viscosity_grade_nu_40(int64_t grade);
double viscosity_grade_nu_100(int64_t grade, int64_t base);

/* Density at 15 degC, kg/m3, typical of the base. */
double viscosity_grade_density_15(int64_t base);

/* Kinematic viscosity, m2/s, at T (K) by ASTM D341; infinite or NaN where the line leaves it. */
double viscosity_nu_at(double nu_40, double nu_100, double T);

/* Density, kg/m3, at T (K) by ASTM D1250. */
double viscosity_density_at(double density_15, double T);

#endif
