/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Standards for oils: viscosity grades; viscosity and density as functions of temperature. */
#ifndef LUBRICANT_STANDARDS_H
#define LUBRICANT_STANDARDS_H

#include <flankfilm/laws.h>

#include <stddef.h>
#include <stdint.h>

/* Returns the index of "ISO VG 220" among the gear oil grades of ISO 3448; -1: no such grade. */
int64_t lubricant_grade_find(const char *text);
#define LUBRICANT_GRADE_NAMES                                                                      \
    "ISO VG 10|ISO VG 15|ISO VG 22|ISO VG 32|ISO VG 46|ISO VG 68|ISO VG 100|ISO VG 150|ISO VG "    \
    "220|"                                                                                         \
    "ISO VG 320|ISO VG 460|ISO VG 680|ISO VG 1000|ISO VG 1500"
#define LUBRICANT_GRADES "ISO VG 10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000 or 1500"

/* The base oils, in the order of LUBRICANT_BASES. */
enum {
    LUBRICANT_MINERAL = FF_BASE_MINERAL,
    LUBRICANT_PAO = FF_BASE_PAO,
    LUBRICANT_ESTER = FF_BASE_ESTER,
    LUBRICANT_PAG = FF_BASE_PAG,
    LUBRICANT_BASE_COUNT
};
#define LUBRICANT_BASES "mineral|PAO|ester|PAG"

/* Kinematic viscosity, m2/s, at 40 and 100 degC of the grade with that index. */
double lubricant_grade_nu_40(int64_t grade);
double lubricant_grade_nu_100(int64_t grade, int base);

/* Returns the viscosity index by ASTM D2270; NaN below 2 cSt at 100 degC, where it is not
 * defined. */
double lubricant_viscosity_index(double nu_40, double nu_100);
#define LUBRICANT_LEAST_INDEX (-100.0) /* minimum: polyphenyl ethers have about -70 */
#define LUBRICANT_MOST_INDEX  400.0    /* maximum: glycols and oils with improvers have up to 300 */

/* ASTM D341: y = lg lg Z with Z = nu + 0.7 + exp(-1.47 - 1.84 nu - 0.51 nu^2), nu in cSt. y is a
   straight line over lg T, valid from 0.21 to 2e7 cSt. */
double lubricant_d341_ordinate(double nu); /* nu in m2/s */
/* Returns nu, m2/s, at n ordinates, and its slope over the ordinate. */
void lubricant_d341_nu(size_t n, const double *y, double *nu, double *slope);
#define LUBRICANT_D341_LEAST 0.21e-6 /* m2/s */
#define LUBRICANT_D341_MOST  20.0

/* Density, kg/m3, at n temperatures (K) by ASTM D1250, and its slope. */
void lubricant_d1250_density(double density_15, size_t n, const double *T, double *rho,
                             double *slope);

#endif
