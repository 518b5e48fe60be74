/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Oil properties over temperature: slopes, extremes, and published values. */
#include "check.h"
#include "stage.h"

#include <flankfilm/laws.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PROPERTIES = FF_LIQUID_CONDUCTIVITY_BEND + 1, POINTS = 200 };

static const ff_liquid *liquid(stage *oil)
{
    return stage_service(oil, FF_LIQUID_ID);
}

static double property(stage *oil, int32_t what, double T)
{
    const ff_liquid *l = liquid(oil);
    double value;
    l->eval(l->self, what, 1, &T, &value, NULL);
    return value;
}

static stage *open_grade(const char *grade, const char *base)
{
    stage *oil = stage_open("lubricant/grade");
    stage_set_text(oil, "grade", grade);
    stage_set_text(oil, "base", base);
    return oil;
}

static char table_path[] = "/tmp/flankfilm-oil-XXXXXX";

static stage *open_table(const char *text)
{
    FILE *file = fopen(table_path, "w");
    fputs(text, file);
    fclose(file);
    stage *oil = stage_open("lubricant/measured");
    stage_set_text(oil, "file", table_path);
    return oil;
}

/* MIL-L-23699, by P. K. Gupta's correlations. */
static const char mil_l_23699[] =
    "temperature [degC]; viscosity [mPa s]; density [kg/m3]; conductivity [W/(m K)]; "
    "heat_capacity [J/(kg K)]; alpha [1/GPa]\n"
    "20; 57.905; 971.1; 0.1651; 2000; 16.16\n40; 25.601; 957.4; 0.1606; 2000; 14.23\n"
    "60; 13.269; 944.2; 0.1561; 2000; 12.84\n80; 7.771; 931.1; 0.1517; 2000; 11.81\n"
    "100; 5.006; 917.8; 0.1472; 2000; 11.03\n150; 2.244; 884.0; 0.1361; 2000; 9.73\n";

static void slopes_agree(const char *name, stage *oil)
{
    const ff_liquid *l = liquid(oil);
    double worst = 0;
    for (int32_t what = 0; what < PROPERTIES; what++)
        for (int i = 0; i < POINTS; i++) {
            double T = 255 + 0.91 * i, h = 1e-3, slope, value;
            l->eval(l->self, what, 1, &T, &value, &slope);
            double found = (property(oil, what, T + h) - property(oil, what, T - h)) / (2 * h);
            if (!isnan(value))
                worst = fmax(worst, fabs(slope - found) / (fabs(found) + 1e-5 * fabs(value)));
        }
    check_below(name, worst, 1e-4);
}

/* At the end of the oil's temperature range, the slope of the density must not jump. */
static void ends_smoothly(const char *name, stage *oil)
{
    const ff_liquid *l = liquid(oil);
    double T = 600, value, slope, before, steepest = 0;
    l->eval(l->self, FF_LIQUID_RHO0, 1, &T, &value, &slope);
    double first = slope;
    while (T < 800) {
        T += 1;
        before = slope;
        l->eval(l->self, FF_LIQUID_RHO0, 1, &T, &value, &slope);
        steepest = fmax(steepest, fabs(slope - before));
    }
    check_true(name, fabs(slope) <= 0 && first < 0);
    check_below(name, steepest, 0.1 * fabs(first));
}

static void stays_finite_at_extremes(const char *name, stage *oil)
{
    static const double T[] = {-DBL_MAX, -1, 0, 1e-300, 1, 100, 150, 700, 1e4, DBL_MAX};
    const ff_liquid *l = liquid(oil);
    double value[10], slope[10];
    for (int32_t what = 0; what < PROPERTIES; what++) {
        check_true(name, l->eval(l->self, what, 10, T, value, slope) == FF_DOMAIN);
        for (int i = 0; i < 10; i++)
            check_true(name, (isfinite(value[i]) && isfinite(slope[i])) ||
                                 (isnan(value[i]) && isnan(slope[i])));
        check_true(name, what == FF_LIQUID_LN_ETA0 || what == FF_LIQUID_BASE ||
                             !(value[0] <= 0 || value[9] <= 0));
    }
    check_true("an unknown property",
               l->eval(l->self, PROPERTIES, 1, T, value, NULL) == FF_UNSUPPORTED);
}

static void are_smooth_functions(void)
{
    static const char *const bases[] = {"mineral", "PAO", "ester", "PAG"};
    for (int i = 0; i < 4; i++) {
        stage *oil = open_grade(i % 2 ? "ISO VG 32" : "ISO VG 680", bases[i]);
        slopes_agree(bases[i], oil);
        ends_smoothly(bases[i], oil);
        stays_finite_at_extremes(bases[i], oil);
        stage_close(oil);
    }
    stage *table = open_table(mil_l_23699);
    slopes_agree("table", table);
    stays_finite_at_extremes("table", table);
    stage_close(table);
}

/* A thin oil, whose data end near the lowest viscosity of ASTM D341, at high temperature. */
static void thin_oils_are_what_was_given(void)
{
    stage *oil = open_table("temperature [degC]; kinematic_viscosity [cSt]; density [kg/m3]\n"
                            "40; 2.0; 800\n250; 0.36; 650\n400; 0.22; 540\n");
    check_near("rho0 at 400 degC", property(oil, FF_LIQUID_RHO0, 673.15), 540, 1e-12);
    check_near("eta0 at 400 degC", exp(property(oil, FF_LIQUID_LN_ETA0, 673.15)), 0.22e-6 * 540,
               1e-9);
    stays_finite_at_extremes("a thin oil", oil);
    ends_smoothly("a thin oil", oil);
    stage_close(oil);
}

/* The interpolated curve must go through its points, and near points that are left out. */
static void tables_interpolate(void)
{
    stage *oil = open_table(mil_l_23699);
    check_near("eta0 at 60 degC", exp(property(oil, FF_LIQUID_LN_ETA0, 333.15)), 13.269e-3, 1e-5);
    check_near("rho0 at 60 degC", property(oil, FF_LIQUID_RHO0, 333.15), 944.2, 1e-12);
    check_near("alpha at 60 degC", property(oil, FF_LIQUID_PRESSURE_COEFFICIENT, 333.15), 12.84e-9,
               1e-12);
    check_near("k at 60 degC", property(oil, FF_LIQUID_CONDUCTIVITY, 333.15), 0.1561, 1e-12);
    check_near("eta0 at 120 degC", exp(property(oil, FF_LIQUID_LN_ETA0, 393.15)), 3.477e-3, 2e-3);
    check_near("alpha at 120 degC", property(oil, FF_LIQUID_PRESSURE_COEFFICIENT, 393.15), 10.42e-9,
               5e-3);
    stage_close(oil);
}

/* Data at one temperature must be used at this temperature only. */
static void one_point_serves_its_temperature(void)
{
    stage *oil = stage_open("lubricant/measured");
    stage_set_text(oil, "eta0", "5.006 mPa s");
    stage_set_text(oil, "at", "100 degC");
    stage_set_text(oil, "density", "917.8 kg/m3");
    stage_set_text(oil, "alpha", "11.03 1/GPa");
    check_near("eta0", exp(property(oil, FF_LIQUID_LN_ETA0, 373.15)), 5.006e-3, 1e-12);
    check_near("rho0", property(oil, FF_LIQUID_RHO0, 373.15), 917.8, 1e-12);
    check_near("alpha", property(oil, FF_LIQUID_PRESSURE_COEFFICIENT, 373.15), 11.03e-9, 1e-12);
    check_true("eta0 elsewhere", isnan(property(oil, FF_LIQUID_LN_ETA0, 372)));
    check_true("alpha elsewhere", isnan(property(oil, FF_LIQUID_PRESSURE_COEFFICIENT, 372)));
    check_near("density elsewhere", property(oil, FF_LIQUID_RHO0, 288.15), 974.8, 4e-3);
    stage_close(oil);
}

/* Pressure coefficients by the correlation for the base oil, compared with measured ones:
   viscosities in mPa s and coefficients in 1/GPa at 30, 60 and 100 degC (Stachowiak and Batchelor,
   Engineering Tribology, table 2.3) or 40, 60 and 100 degC (the others). */
static const struct {
    const char *name, *base, *density_15;
    double cold, eta[3], alpha[3];
} measured[] = {
    {"heavy machine oil", "mineral", "890 kg/m3", 30, {153, 34, 9.1}, {23.7, 20.5, 15.8}},
    {"heavy machine oil", "mineral", "890 kg/m3", 30, {250, 50.5, 12.6}, {25.0, 21.3, 17.6}},
    {"cylinder oil", "mineral", "900 kg/m3", 30, {810, 135, 26.8}, {34.0, 28.0, 22.0}},
    {"M100", "mineral", "882 kg/m3", 40, {76.9, 34.28, 9.14}, {20.9, 19.0, 16.3}},
    {"PAO-B", "PAO", "853 kg/m3", 40, {127.0, 48.5, 12.18}, {19.1, 16.6, 13.0}},
    {"PAO100", "PAO", "840 kg/m3", 40, {83.5, 37.0, 10.6}, {15.4, 13.8, 11.3}},
    {"MIL-L-23699", "ester", "975 kg/m3", 40, {25.601, 13.269, 5.006}, {14.23, 12.84, 11.03}},
    {"EO-PO copolymer", "PAG", "1050 kg/m3", 30, {204, 62.5, 22.5}, {17.6, 14.3, 12.2}},
};

static void pressure_coefficients_are_those_measured(void)
{
    for (size_t i = 0; i < sizeof measured / sizeof *measured; i++) {
        double t[3] = {measured[i].cold, 60, 100};
        char text[256] = "temperature [degC]; viscosity [mPa s]\n";
        for (int k = 0; k < 3; k++)
            snprintf(text + strlen(text), sizeof text - strlen(text), "%g; %g\n", t[k],
                     measured[i].eta[k]);
        stage *oil = open_table(text);
        stage_set_text(oil, "density_15", measured[i].density_15);
        stage_set_text(oil, "base", measured[i].base);
        printf("%s\n", measured[i].name);
        for (int k = 0; k < 3; k++)
            check_near("alpha", 1e9 * property(oil, FF_LIQUID_PRESSURE_COEFFICIENT, 273.15 + t[k]),
                       measured[i].alpha[k], 0.18);
        stage_close(oil);
    }
}

/* The default values for each base oil, from their sources again: alpha = s nu^t in 1/GPa (Gold and
   others 2001), heat capacity of PAO-B (Larsson and others 2000) and of MIL-L-23699 (Gupta
   1984). */
static void bases_are_those_of_their_sources(void)
{
    static const struct {
        const char *name;
        double density, s, t, conductivity, heat; /* at 15 degC and at 40 degC; 0: by the density */
    } bases[] = {{"mineral", 890, 9.904, 0.1390, 0, 0},
                 {"PAO", 850, 7.382, 0.1335, 0.154, 2080 + 1.352 * (313.15 - 295.15)},
                 {"ester", 975, 6.605, 0.1360, 0.14868 - 2.2275e-4 * (313.15 - 366.67), 2000},
                 {"PAG", 1050, 5.489, 0.1485, 0, 0}};
    for (size_t i = 0; i < sizeof bases / sizeof bases[0]; i++) {
        stage *oil = open_grade("ISO VG 150", bases[i].name);
        printf("%s\n", bases[i].name);
        check_near("density", property(oil, FF_LIQUID_RHO0, 288.15), bases[i].density, 1e-12);
        /* mean slope of Roelands' law over the first 0.2 GPa */
        double L = property(oil, FF_LIQUID_LN_ETA0, 313.15) + 9.67;
        double z = property(oil, FF_LIQUID_PRESSURE_COEFFICIENT, 313.15) * 196e6 / L;
        check_near("mean alpha", 1e9 * L * (pow(1 + 0.2 / 0.196, z) - 1) / 0.2e9,
                   bases[i].s * pow(150, bases[i].t), 1e-10);
        if (bases[i].heat > 0) {
            check_near("conductivity", property(oil, FF_LIQUID_CONDUCTIVITY, 313.15),
                       bases[i].conductivity, 1e-12);
            check_near("heat capacity", property(oil, FF_LIQUID_HEAT_CAPACITY, 313.15),
                       bases[i].heat, 1e-12);
        }
        stage_close(oil);
    }
}

/* An alpha measured at one temperature must scale the correlation for the base oil. */
static void alpha_follows_its_base(void)
{
    stage *plain = open_grade("ISO VG 100", "PAO"), *given = open_grade("ISO VG 100", "PAO");
    stage_set_text(given, "alpha", "14 1/GPa");
    stage_set_text(given, "alpha_at", "40 degC");
    double ratio = 14e-9 / property(plain, FF_LIQUID_PRESSURE_COEFFICIENT, 313.15);
    for (double T = 300; T < 400; T += 25)
        check_near("alpha", property(given, FF_LIQUID_PRESSURE_COEFFICIENT, T),
                   ratio * property(plain, FF_LIQUID_PRESSURE_COEFFICIENT, T), 1e-13);
    stage_close(plain);
    stage_close(given);
}

/* C. S. Cragoe 1929: 0.1172 (1 - 0.00054 t)/s W/(m K), (0.388 + 0.00045 t)/sqrt(s) Btu/(lb degF).
 */
static void mineral_oil_conducts_as_cragoe_says(void)
{
    stage *oil = stage_open("lubricant/grade");
    stage_set_text(oil, "grade", "ISO VG 100");
    stage_set_text(oil, "density_15", "999.1 kg/m3");
    check_near("at 0 degC", property(oil, FF_LIQUID_CONDUCTIVITY, 273.15), 0.1172, 1e-12);
    check_near("at 100 degC", property(oil, FF_LIQUID_CONDUCTIVITY, 373.15), 0.1172 * 0.946, 1e-12);
    check_near("at 212 degF", property(oil, FF_LIQUID_HEAT_CAPACITY, 373.15), 4186.8 * 0.4834,
               1e-12);
    stage_close(oil);
}

int main(void)
{
    int file = mkstemp(table_path);
    are_smooth_functions();
    tables_interpolate();
    thin_oils_are_what_was_given();
    one_point_serves_its_temperature();
    pressure_coefficients_are_those_measured();
    bases_are_those_of_their_sources();
    alpha_follows_its_base();
    mineral_oil_conducts_as_cragoe_says();
    close(file);
    unlink(table_path);
    return check_done();
}
