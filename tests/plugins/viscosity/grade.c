/* SPDX-License-Identifier: GPL-3.0-or-later */
/* eta0 from a grade or from two kinematic viscosities. */
#include "check.h"
#include "stage.h"

#include "../../../plugins/viscosity/grade.h"

#include <flankfilm/viscosity.h>

#include <math.h>
#include <stdio.h>

static const double CST = 1e-6;

/* Viscosities of 0 and 100 index that share nu_100 = Y with the oil: ASTM D2270, appendix X2. */
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

/* Viscosity index by ASTM D2270, procedures A (up to 100) and B. */
static double viscosity_index(double nu_40, double nu_100)
{
    double L, H;
    references(nu_100, &L, &H);
    if (nu_40 >= H)
        return 100 * (L - nu_40) / (L - H);
    double N = log(H / nu_40) / log(nu_100);
    return 100 + (pow(10, N) - 1) / 0.00715;
}

static void grades_are_found_by_name(void)
{
    static const char *const good[] = {"ISO VG 220", "ISO VG220", "VG 220", " ISO  VG 220 "};
    static const char *const bad[] = {"",    "ISO",         "ISO VG",
                                      "220", "ISO VG 220x", "ISO VG 99999999999"};
    for (size_t i = 0; i < 4; i++)
        check_true(good[i],
                   viscosity_grade_find(good[i]) == 8 && viscosity_grade_nu_40(8) == 220 * CST);
    for (size_t i = 0; i < 6; i++)
        check_true("refused", viscosity_grade_find(bad[i]) == -1);
}

static void grades_have_their_index(void)
{
    for (int64_t grade = 0; grade < 14; grade++) {
        double nu_40 = viscosity_grade_nu_40(grade) / CST;
        printf("ISO VG %g\n", nu_40);
        check_near("  mineral", viscosity_index(nu_40, viscosity_grade_nu_100(grade, 0) / CST), 95,
                   1e-3);
        check_near("  PAO", viscosity_index(nu_40, viscosity_grade_nu_100(grade, 1) / CST), 150,
                   1e-3);
    }
}

/* The line goes through both given points and back. Below some 5 cSt the inverse that D341 prints
   is a fit, good to 0.1 %. */
static void d341_round_trip(void)
{
    static const double pairs[][3] = {
        {220, 18.75, 1e-12}, {10, 2.637, 1e-3}, {1500, 64.21, 1e-12}, {46, 8.0, 1e-7}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        double warm = pairs[i][0] * CST, hot = pairs[i][1] * CST, tolerance = pairs[i][2];
        check_near("nu at 40 degC", viscosity_nu_at(warm, hot, 313.15), warm, 1e-6);
        check_near("nu at 100 degC", viscosity_nu_at(warm, hot, 373.15), hot, tolerance);
        double a = viscosity_nu_at(warm, hot, 303.15), b = viscosity_nu_at(warm, hot, 343.15);
        double share = log(313.15 / 303.15) / log(343.15 / 303.15);
        double za = log(log(a / CST + 0.7)), zb = log(log(b / CST + 0.7));
        double nu = exp(exp(za + (zb - za) * share)) - 0.7;
        check_near("nu at 40 degC by way of 30 and 70 degC", nu * CST, warm, 1e-3);
    }
}

/* A published worked case: 32 cSt at 40 and 5.4 cSt at 100 degC give 8.5 cSt at 80 degC. */
static void d341_example(void)
{
    check_near("nu at 80 degC", viscosity_nu_at(32e-6, 5.4e-6, 353.15) / CST, 8.5, 6e-3);
}

static double eta0(const char *const set[][2])
{
    stage *s = stage_open("viscosity/isoviscous");
    for (int i = 0; set[i][0]; i++)
        stage_set_text(s, set[i][0], set[i][1]);
    const ff_viscosity *v = stage_service(s, FF_VISCOSITY_ID);
    double p = 0, ln_eta;
    v->eval(v->self, 1, &p, NULL, &ln_eta, NULL, NULL);
    stage_close(s);
    return exp(ln_eta);
}

static void law_uses_the_grade(void)
{
    double at_40 = eta0((const char *const[][2]){
        {"grade", "ISO VG 220"}, {"temperature", "40 degC"}, {NULL, NULL}});
    check_near("ISO VG 220 at 40 degC", at_40, 220e-6 * viscosity_density_at(890, 313.15), 1e-12);
    double grade = eta0((const char *const[][2]){
        {"grade", "ISO VG 220"}, {"temperature", "80 degC"}, {NULL, NULL}});
    double sheet = eta0((const char *const[][2]){{"nu_40", "220 cSt"},
                                                 {"nu_100", "18.75 cSt"},
                                                 {"density_15", "890 kg/m3"},
                                                 {"temperature", "80 degC"},
                                                 {NULL, NULL}});
    check_near("grade and data sheet agree", grade, sheet, 1e-13);
    double pao = eta0((const char *const[][2]){
        {"grade", "ISO VG 220"}, {"base", "PAO"}, {"temperature", "80 degC"}, {NULL, NULL}});
    check_true("a PAO is thicker at 80 degC", pao > 1.1 * grade);
}

static void density_falls_with_temperature(void)
{
    check_near("at 15 degC", viscosity_density_at(890, 288.15), 890, 1e-15);
    double slope = (viscosity_density_at(890, 289.15) - viscosity_density_at(890, 287.15)) / 2;
    check_near("expansion at 15 degC", -slope / 890, 0.6278 / 890, 1e-5);
}

int main(void)
{
    grades_are_found_by_name();
    grades_have_their_index();
    d341_round_trip();
    d341_example();
    law_uses_the_grade();
    density_falls_with_temperature();
    return check_done();
}
