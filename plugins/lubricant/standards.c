/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "standards.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <stdio.h>

static const double CST = 1e-6; /* m2/s */

/* ISO 3448 mid-points at 40 degC, and the viscosity at 100 degC that gives the viscosity index of
   the base oil by ASTM D2270, all in cSt. The indices are typical values, not those of a particular
   product: 95 for mineral oil, 150 for PAO and ester (esters: 140 to 160), 200 for PAG. One PAG, an
   ethylene-propylene oxide copolymer, has a viscosity of 204, 62.5 and 22.5 mPa s at 30, 60 and 100
   degC (Stachowiak and Batchelor, Engineering Tribology, table 2.3). */
static const struct {
    double nu_40, mineral, synthetic, glycol;
} grades[] = {
    {10, 2.637, 2.903, 3.137},   {15, 3.381, 3.791, 4.170},   {22, 4.254, 4.860, 5.435},
    {32, 5.290, 6.268, 7.214},   {46, 6.644, 8.099, 9.604},   {68, 8.530, 10.85, 13.22},
    {100, 11.07, 14.51, 18.05},  {150, 14.54, 19.59, 24.87},  {220, 18.75, 25.92, 33.63},
    {320, 23.95, 34.07, 44.98},  {460, 30.34, 44.24, 59.21},  {680, 39.06, 58.25, 79.07},
    {1000, 49.86, 76.02, 104.3}, {1500, 64.21, 99.81, 138.2},
};

int64_t lubricant_grade_find(const char *text)
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

double lubricant_grade_nu_40(int64_t grade)
{
    return CST * grades[grade].nu_40;
}

double lubricant_grade_nu_100(int64_t grade, int base)
{
    double nu_100 = grades[grade].synthetic;
    if (base == LUBRICANT_MINERAL)
        nu_100 = grades[grade].mineral;
    else if (base == LUBRICANT_PAG)
        nu_100 = grades[grade].glycol;
    return CST * nu_100;
}

/* Returns the viscosities at 40 degC of the reference oils with index 0 and 100 that have nu_100
 * = Y: ASTM D2270, appendix X2. */
static void references(double Y, double *L, double *H)
{
    static const struct {
        double upto, L[3], H[3];
    } rows[] = {
        {3.8, {1.14673, 1.7576, -0.109}, {0.84155, 1.5521, -0.077}},
        {4.4, {3.38095, -15.4952, 33.196}, {0.78571, 1.7929, -0.183}},
        {5, {2.5, -7.2143, 13.812}, {0.82143, 1.5679, 0.119}},
        {6.4, {0.101, 16.635, -45.469}, {0.04985, 9.1613, -18.557}},
        {7, {3.35714, -23.5643, 78.466}, {0.22619, 7.7369, -16.656}},
        {7.7, {0.01191, 21.475, -72.870}, {0.79762, -0.7321, 14.61}},
        {9, {0.41858, 16.1558, -56.04}, {0.05794, 10.5156, -28.24}},
        {12, {0.88779, 7.5527, -16.6}, {0.26665, 6.7015, -10.81}},
        {15, {0.7672, 10.7972, -38.18}, {0.20073, 8.4658, -22.49}},
        {18, {0.97305, 5.3135, -2.2}, {0.28889, 5.9741, -4.93}},
        {22, {0.97256, 5.25, -0.98}, {0.24504, 7.416, -16.73}},
        {28, {0.91413, 7.4759, -21.82}, {0.20323, 9.1267, -34.23}},
        {40, {0.87031, 9.7157, -50.77}, {0.18411, 10.1015, -46.75}},
        {55, {0.84703, 12.6752, -133.31}, {0.17029, 11.4866, -80.62}},
        {70, {0.85921, 11.1009, -83.19}, {0.1713, 11.368, -76.94}},
        {HUGE_VAL, {0.83531, 14.6731, -216.246}, {0.16841, 11.8493, -96.947}},
    };
    size_t i = 0;
    while (Y > rows[i].upto)
        i++;
    *L = rows[i].L[0] * Y * Y + rows[i].L[1] * Y + rows[i].L[2];
    *H = rows[i].H[0] * Y * Y + rows[i].H[1] * Y + rows[i].H[2];
}

double lubricant_viscosity_index(double nu_40, double nu_100)
{
    double L, H, warm = nu_40 / CST, Y = nu_100 / CST;
    if (!(Y >= 2))
        return NAN;
    references(Y, &L, &H);
    if (warm >= H)
        return 100 * (L - warm) / (L - H);
    return 100 + (pow(H / warm, M_LN10 / log(Y)) - 1) / 0.00715;
}

/* ASTM D341-20, equations 1 and 2. */
double lubricant_d341_ordinate(double nu)
{
    nu /= CST;
    return log10(log10(nu + 0.7 + exp(-1.47 - 1.84 * nu - 0.51 * nu * nu)));
}

/* ASTM D341-20, equation 3: an inverse fit, accurate to 0.1 % below about 5 cSt; above 10 cSt it
   agrees with equation 2. Newton steps on equation 2 follow, so that given data are returned
   unchanged. */
FF_SIMD
void lubricant_d341_nu(size_t n, const double *restrict y, double *restrict nu,
                       double *restrict slope)
{
    const double ln_10 = M_LN10, unit = CST;
    for (size_t k = 0; k < n; k++) {
        double lg_Z = ff_exp(ln_10 * y[k]), Z = ff_exp(ln_10 * lg_Z), z = Z - 0.7, steepness = 1;
        double v = z - ff_exp(-0.7487 - 3.295 * z + 0.6119 * z * z - 0.3193 * z * z * z);
        for (int turn = 0; turn < 3; turn++) {
            double rest = ff_exp(-1.47 - 1.84 * v - 0.51 * v * v);
            double here = 1 - (1.84 + 1.02 * v) * rest; /* dZ/dnu */
            double next = v - (v + 0.7 + rest - Z) / here;
            steepness = v < 10 ? here : steepness;
            v = v < 10 ? next : v;
        }
        nu[k] = unit * v;
        slope[k] = unit * Z * ln_10 * lg_Z * ln_10 / steepness;
    }
}

/* rho = rho15 exp(-a (1 + 0.8 a)), a = 0.6278 (T - 15 degC)/rho15: lubricating oils of 800 to
 * 1164 kg/m3, -18 to 150 degC (ASTM D1250, table 54D). */
FF_SIMD
void lubricant_d1250_density(double density_15, size_t n, const double *restrict T,
                             double *restrict rho, double *restrict slope)
{
    const double per_kelvin = 0.6278 / density_15;
    for (size_t k = 0; k < n; k++) {
        double a = per_kelvin * (T[k] - 288.15);
        rho[k] = density_15 * ff_exp(-a * (1 + 0.8 * a));
        slope[k] = -rho[k] * per_kelvin * (1 + 1.6 * a);
    }
}
