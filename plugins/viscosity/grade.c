/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "grade.h"

#include <math.h>
#include <stdio.h>

static const double CST = 1e-6; /* m2/s */

/* Grade of ISO 3448 and the viscosity at 100 degC that gives the viscosity index of each base by
   ASTM D2270, all in cSt. */
static const struct {
    double nu_40, nu_100[2];
} grades[] = {{10, {2.637, 2.903}},   {15, {3.381, 3.791}},  {22, {4.254, 4.860}},
              {32, {5.290, 6.268}},   {46, {6.644, 8.099}},  {68, {8.530, 10.85}},
              {100, {11.07, 14.51}},  {150, {14.54, 19.59}}, {220, {18.75, 25.92}},
              {320, {23.95, 34.07}},  {460, {30.34, 44.24}}, {680, {39.06, 58.25}},
              {1000, {49.86, 76.02}}, {1500, {64.21, 99.81}}};

int64_t viscosity_grade_find(const char *text)
{
    int number = 0, end = 0;
    if (sscanf(text, " ISO VG %6d %n", &number, &end) != 1 &&
        sscanf(text, " VG %6d %n", &number, &end) != 1)
        return -1;
    for (size_t i = 0; i < sizeof grades / sizeof *grades && !text[end]; i++)
        if (grades[i].nu_40 == number)
            return (int64_t)i;
    return -1;
}

double viscosity_grade_nu_40(int64_t grade)
{
    return CST * grades[grade].nu_40;
}

double viscosity_grade_nu_100(int64_t grade, int64_t base)
{
    return CST * grades[grade].nu_100[base];
}

double viscosity_grade_density_15(int64_t base)
{
    return base == 0 ? 890 : 850;
}

/* lg lg Z with Z = nu + 0.7 + exp(-1.47 - 1.84 nu - 0.51 nu^2), nu in cSt (ASTM D341-20, eqs 1, 2).
 */
static double ordinate(double nu)
{
    nu /= CST;
    return log10(log10(nu + 0.7 + exp(-1.47 - 1.84 * nu - 0.51 * nu * nu)));
}

/* The line lg lg Z = A - B lg T through 40 and 100 degC; Z back to nu by eq. 3 of ASTM D341-20. */
double viscosity_nu_at(double nu_40, double nu_100, double T)
{
    double warm = ordinate(nu_40), hot = ordinate(nu_100);
    double share = log(T / 313.15) / log(373.15 / 313.15);
    double z = pow(10, pow(10, warm + (hot - warm) * share)) - 0.7;
    return CST * (z - exp(-0.7487 - 3.295 * z + 0.6119 * z * z - 0.3193 * z * z * z));
}

/* rho = rho15 exp(-a dT (1 + 0.8 a dT)), a = 0.6278/rho15: lubricating oils, ASTM D1250 (54D). */
double viscosity_density_at(double density_15, double T)
{
    double a = 0.6278 / density_15 * (T - 288.15);
    return density_15 * exp(-a * (1 + 0.8 * a));
}
