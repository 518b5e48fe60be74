/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Viscosity grades by ISO 3448, viscosity index by ASTM D2270, viscosity by D341, density by
   D1250. */
#include "check.h"
#include "stage.h"

#include "../../../plugins/lubricant/standards.h"

#include <flankfilm/laws.h>

#include <math.h>
#include <stdio.h>

static const double CST = 1e-6;

/* The examples of ASTM D2270, procedures A and B. */
static void index_of_the_standard(void)
{
    static const double examples[][3] = {{73.30, 8.86, 92}, {22.83, 5.05, 156}, {53.47, 7.80, 111}};
    for (size_t i = 0; i < 3; i++)
        check_true("index", round(lubricant_viscosity_index(
                                examples[i][0] * CST, examples[i][1] * CST)) == examples[i][2]);
    check_true("below 2 cSt at 100 degC", isnan(lubricant_viscosity_index(5 * CST, 1.9 * CST)));
}

static void grades_are_found_by_name(void)
{
    static const char *const good[] = {"ISO VG 220", "ISO VG220", "VG 220", " ISO  VG 220 "};
    static const char *const bad[] = {"",    "ISO",         "ISO VG",
                                      "220", "ISO VG 220x", "ISO VG 99999999999"};
    for (size_t i = 0; i < 4; i++)
        check_true(good[i],
                   lubricant_grade_find(good[i]) == 8 && lubricant_grade_nu_40(8) == 220 * CST);
    for (size_t i = 0; i < 6; i++)
        check_true("refused", lubricant_grade_find(bad[i]) == -1);
}

static void grades_have_the_index_of_their_base(void)
{
    static const double index[LUBRICANT_BASE_COUNT] = {95, 150, 150, 200};
    for (int64_t grade = 0; grade < 14; grade++)
        for (int base = 0; base < LUBRICANT_BASE_COUNT; base++) {
            double nu_40 = lubricant_grade_nu_40(grade) / CST;
            printf("ISO VG %g, base %d\n", nu_40, base);
            check_near("index",
                       lubricant_viscosity_index(nu_40 * CST, lubricant_grade_nu_100(grade, base)),
                       index[base], 1e-3);
        }
}

static void d341_goes_there_and_back(void)
{
    for (double nu = 0.21; nu < 2e7; nu *= 1.3) {
        double at = lubricant_d341_ordinate(nu * CST), h = 1e-6;
        double y[3] = {at - h, at, at + h}, there[3], slope[3];
        lubricant_d341_nu(3, y, there, slope);
        check_near("nu", there[1], nu * CST, 1e-9);
        check_near("its slope", slope[1], (there[2] - there[0]) / (2 * h), 1e-6);
    }
}

static double property(stage *oil, int32_t what, double T)
{
    const ff_liquid *l = stage_service(oil, FF_LIQUID_ID);
    double value;
    l->eval(l->self, what, 1, &T, &value, NULL);
    return value;
}

static double nu_at(const char *nu_40, const char *nu_100, double T)
{
    stage *oil = stage_open("lubricant/measured");
    stage_set_text(oil, "nu_40", nu_40);
    stage_set_text(oil, "nu_100", nu_100);
    stage_set_text(oil, "density_15", "870 kg/m3");
    double nu = exp(property(oil, FF_LIQUID_LN_ETA0, T)) / property(oil, FF_LIQUID_RHO0, T);
    stage_close(oil);
    return nu / CST;
}

/* A published example: 32 cSt at 40 degC and 5.4 cSt at 100 degC give 8.5 cSt at 80 degC. */
static void d341_example(void)
{
    check_near("nu at 80 degC", nu_at("32 cSt", "5.4 cSt", 353.15), 8.5, 6e-3);
    check_near("nu at 40 degC", nu_at("32 cSt", "5.4 cSt", 313.15), 32, 1e-9);
}

static void grades_have_their_mid_point(void)
{
    static const char *const bases[] = {"mineral", "PAO", "ester", "PAG"};
    static const double grades[] = {32, 46, 68, 100, 150, 220, 320, 460, 680};
    for (size_t i = 0; i < 9; i++)
        for (int base = 0; base < 4; base++) {
            stage *oil = stage_open("lubricant/grade");
            char name[24];
            snprintf(name, sizeof name, "ISO VG %g", grades[i]);
            stage_set_text(oil, "grade", name);
            stage_set_text(oil, "base", bases[base]);
            double rho = property(oil, FF_LIQUID_RHO0, 313.15);
            check_near(name, exp(property(oil, FF_LIQUID_LN_ETA0, 313.15)), grades[i] * CST * rho,
                       1e-12);
            stage_close(oil);
        }
}

/* A grade, and a data sheet with the same values, must give the same oil. */
static void grade_and_data_sheet_agree(void)
{
    stage *grade = stage_open("lubricant/grade"), *sheet = stage_open("lubricant/measured");
    stage_set_text(grade, "grade", "ISO VG 220");
    stage_set_text(sheet, "nu_40", "220 cSt");
    stage_set_text(sheet, "nu_100", "18.75 cSt");
    stage_set_text(sheet, "density_15", "890 kg/m3");
    stage_set_text(sheet, "base", "mineral");
    for (int32_t what = 0; what <= FF_LIQUID_PRESSURE_COEFFICIENT; what++)
        check_near("property", property(grade, what, 353.15), property(sheet, what, 353.15), 1e-13);
    stage_close(grade);
    stage_close(sheet);
}

static void density_falls_with_temperature(void)
{
    const double T[] = {288.15, 349.9, 350, 350.1};
    double rho[4], slope[4];
    lubricant_d1250_density(890, 4, T, rho, slope);
    check_near("at 15 degC", rho[0], 890, 1e-15);
    check_near("expansion at 15 degC", -slope[0] / 890, 0.6278 / 890, 1e-12);
    check_near("its slope", slope[2], (rho[3] - rho[1]) / 0.2, 1e-7);
}

int main(void)
{
    index_of_the_standard();
    grades_are_found_by_name();
    grades_have_the_index_of_their_base();
    d341_goes_there_and_back();
    d341_example();
    grades_have_their_mid_point();
    grade_and_data_sheet_agree();
    density_falls_with_temperature();
    return check_done();
}
