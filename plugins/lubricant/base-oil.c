/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base-oil.h"

#include <math.h>

/* The straight line value + slope (T - at); NaN: no source available. */
typedef struct line {
    double value, slope, at;
} line;

static const struct {
    /* Typical values of gear oils; PAG ranges from 990 to 1100 kg/m3 by its chemistry. */
    double density_15;
    line conductivity, heat_capacity;
    /* alpha = s nu^t, 1/GPa with nu in cSt, is the mean of dln(eta)/dp over the first 0.2 GPa:
     * P. W. Gold, A. Schmidt, H. Dicke, J. Loos, C. Assmann 2001, J. Synth. Lubr. 18, 51-79, as
     * later work on gear losses quotes it. That work does not state the range of the fit. */
    double s, t;
} bases[LUBRICANT_BASE_COUNT] = {
    /* Thermal data follow from the density, see lubricant_base_conductivity. */
    [LUBRICANT_MINERAL] = {890, {NAN, 0, 0}, {NAN, 0, 0}, 9.904, 0.1390},
    /* PAO-B, 22 to 107 degC: R. Larsson, P. O. Larsson, E. Eriksson, M. Sjoberg, E. Hoglund 2000,
       Proc. IMechE J 214, 17-27. */
    [LUBRICANT_PAO] = {850, {0.154, 0, 0}, {2080, 1.352, 295.15}, 7.382, 0.1335},
    /* MIL-L-23699, a polyol ester of 5 cSt at 100 degC, -40 to 150 degC: P. K. Gupta 1984, Advanced
       Dynamics of Rolling Elements. */
    [LUBRICANT_ESTER] = {975, {0.14868, -2.2275e-4, 366.67}, {2000, 0, 0}, 6.605, 0.1360},
    [LUBRICANT_PAG] = {1050, {NAN, 0, 0}, {NAN, 0, 0}, 5.489, 0.1485},
};

double lubricant_base_density_15(int base)
{
    return bases[base].density_15;
}

static double on_line(line l, double T, double *slope)
{
    *slope = isnan(l.value) ? NAN : l.slope;
    return l.value + l.slope * (T - l.at);
}

/* Density relative to water of 15 degC. */
static double relative(double density_15)
{
    return density_15 / 999.1;
}

/* Conductivity of petroleum oils, accurate to 10 % from 0 to 150 degC: k = 0.1172 (1 - 0.00054
   t)/s, with t in degC and the relative density s (C. S. Cragoe 1929, Bureau of Standards Misc.
   Publ. 97). */
double lubricant_base_conductivity(int base, double density_15, double T, double *slope)
{
    if (base != LUBRICANT_MINERAL)
        return on_line(bases[base].conductivity, T, slope);
    double k = 0.1172 / relative(density_15);
    return on_line((line){k, -0.00054 * k, 273.15}, T, slope);
}

/* Specific heat of petroleum oils, accurate to 4 % from 0 to 200 degC: c = (0.388 + 0.00045
   t)/sqrt(s) Btu/(lb degF), with t in degF (Cragoe 1929; 1 Btu/(lb degF) is 4186.8 J/(kg K)). */
double lubricant_base_heat_capacity(int base, double density_15, double T, double *slope)
{
    if (base != LUBRICANT_MINERAL)
        return on_line(bases[base].heat_capacity, T, slope);
    double c = 4186.8 / sqrt(relative(density_15));
    return on_line((line){0.4024 * c, 0.00081 * c, 273.15}, T, slope);
}

/* Converts Gold's mean m over P = 0.2 GPa to the slope at ambient pressure by the law of C. J. A.
   Roelands: ln(eta/eta0) = L ((1 + p/p0)^z - 1), L = ln(eta0) + 9.67, p0 = 196 MPa. The exponent
   with this mean is z = ln(1 + m P/L)/ln(1 + P/p0), and the slope at p = 0 is z L/p0. */
double lubricant_base_pressure_coefficient(int base, double nu, double ln_eta0, double nu_slope,
                                           double ln_eta0_slope, double *slope)
{
    const double P = 0.2e9, p0 = 0.196e9, L = ln_eta0 + 9.67;
    double mean = 1e-9 * bases[base].s * pow(nu / 1e-6, bases[base].t);
    double rise = mean * P / L, scale = 1 / (p0 * log(1 + P / p0));
    double rise_slope = rise * (bases[base].t * nu_slope / nu - ln_eta0_slope / L);
    *slope = scale * (ln_eta0_slope * log1p(rise) + L * rise_slope / (1 + rise));
    return scale * L * log1p(rise);
}

double lubricant_base_coefficient(int base, double T, double *slope)
{
    const int64_t grade = lubricant_grade_find("ISO VG 100");
    const double cold = log(313.15), hot = log(373.15);
    const double y_cold = lubricant_d341_ordinate(lubricant_grade_nu_40(grade));
    const double y_hot = lubricant_d341_ordinate(lubricant_grade_nu_100(grade, base));
    const double by_ln_T = (y_hot - y_cold) / (hot - cold), y = y_cold + by_ln_T * (log(T) - cold);
    double nu, nu_slope, rho, rho_slope;
    lubricant_d341_nu(1, &y, &nu, &nu_slope);
    nu_slope *= by_ln_T / T;
    lubricant_d1250_density(lubricant_base_density_15(base), 1, &T, &rho, &rho_slope);
    return lubricant_base_pressure_coefficient(base, nu, log(nu * rho), nu_slope,
                                               nu_slope / nu + rho_slope / rho, slope);
}
