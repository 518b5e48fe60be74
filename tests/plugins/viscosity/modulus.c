/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares viscosity/modulus with values computed from its constants, for several grades of oil. */
#include <check.h>
#include <stage.h>

#include <difference.h>

#include <flankfilm/laws.h>

#include <math.h>
#include <string.h>

static const double GPa = 1e9;

typedef struct scene {
    stage *oil, *law;
    const ff_viscosity *v;
} scene;

/* Opens an oil with a base and grade, from which the law gets A and B. */
static scene open_scene(const char *base, const char *grade)
{
    scene s = {stage_open("lubricant/grade"), stage_open("viscosity/modulus"), NULL};
    stage_set_text(s.oil, "grade", grade);
    stage_set_text(s.oil, "base", base);
    stage_link(s.law, "oil", s.oil);
    return s;
}

static scene open_law(const char *base, const char *grade)
{
    scene s = open_scene(base, grade);
    s.v = stage_service(s.law, FF_VISCOSITY_ID);
    return s;
}

static void close_scene(scene *s)
{
    stage_close(s->law);
    stage_close(s->oil);
}

static double rise(const scene *s, double p, double T)
{
    const double none = 0;
    double ln, ambient;
    s->v->eval(s->v->self, 1, &p, &T, &ln, NULL, NULL);
    s->v->eval(s->v->self, 1, &none, &T, &ambient, NULL, NULL);
    return ln - ambient;
}

/* Returns 1/int_0^3GPa eta0/eta dp by Simpson's rule. */
static double film_coefficient(const scene *s, double T)
{
    enum { PARTS = 6000 };
    const double step = 3 * GPa / PARTS;
    double sum = 0;
    for (int i = 0; i <= PARTS; i++)
        sum += (i == 0 || i == PARTS ? 1 : i % 2 ? 4 : 2) * exp(-rise(s, i * step, T));
    return 3 / (sum * step);
}

static void test_table(void)
{
    static const double p[] = {0.2, 0.5, 1, 1.5, 2};
    static const struct {
        const char *base;
        double T, A, B, alpha, ln[5];
    } rows[] = {
        {"mineral", 90, 5.927e7, 0.0323, 15.74, {3.04, 6.63, 10.92, 13.92, 16.14}},
        {"mineral", 120, 6.605e7, 0.0406, 13.85, {2.70, 5.79, 9.37, 11.81, 13.58}},
        {"PAO", 85, 8.238e7, 0.0448, 10.99, {2.19, 4.77, 7.86, 10.03, 11.63}},
        {"PAO", 110, 9.213e7, 0.0507, 9.68, {1.96, 4.26, 7.00, 8.92, 10.34}},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        scene s = open_law(rows[k].base, "ISO VG 100");
        const double T = 273.15 + rows[k].T, none = 0;
        double ln, slope;
        s.v->eval(s.v->self, 1, &none, &T, &ln, &slope, NULL);
        check_near("A", 1 / slope, rows[k].A, 0.5e4 / rows[k].A * 1.01);
        check_near("B", GPa / rise(&s, GPa, T) - 1 / slope, rows[k].B * GPa, 0.5e-4 / rows[k].B);
        check_near("alpha*", film_coefficient(&s, T) * GPa, rows[k].alpha, 0.005 / rows[k].alpha);
        for (int i = 0; i < 5; i++)
            check_near("ln(eta/eta0)", rise(&s, p[i] * GPa, T), rows[k].ln[i],
                       0.005 / rows[k].ln[i] * 1.01);
        close_scene(&s);
    }
}

typedef struct sample {
    const scene *s;
    double p;
} sample;

static double ln_over_T(const void *where, double T)
{
    const sample *at = where;
    double ln;
    at->s->v->eval(at->s->v->self, 1, &at->p, &T, &ln, NULL, NULL);
    return ln;
}

/* With another grade, the slope at ambient pressure must be the pressure coefficient of the oil,
   with B unchanged. */
static void test_grades(void)
{
    const double T = 353.15;
    scene vg = open_law("mineral", "ISO VG 100"), other = open_law("mineral", "ISO VG 32");
    const ff_liquid *a = stage_service(vg.oil, FF_LIQUID_ID);
    const ff_liquid *b = stage_service(other.oil, FF_LIQUID_ID);
    double one = 0, two = 0;
    a->eval(a->self, FF_LIQUID_PRESSURE_COEFFICIENT, 1, &T, &one, NULL);
    b->eval(b->self, FF_LIQUID_PRESSURE_COEFFICIENT, 1, &T, &two, NULL);
    const double A = 0.4 * GPa / rise(&vg, 0.4 * GPa, T),
                 A_2 = 0.4 * GPa / rise(&other, 0.4 * GPa, T);
    const double B = (-0.0682 + 2.768e-4 * T) * 0.4 * GPa;
    check_true("thinner oils rise less", two < 0.97 * one);
    check_near("A", (A_2 - B) / (A - B), one / two, 1e-6);
    const double at = 322.6, p = 0.7 * GPa; /* between nodes of the scale */
    const sample where = {&other, p};
    double ln, slope;
    other.v->eval(other.v->self, 1, &p, &at, &ln, NULL, &slope);
    check_near("slope over T", slope, difference(ln_over_T, &where, at, 0.2), 1e-7);
    close_scene(&vg);
    close_scene(&other);
}

static void refuse(const char *what, const char *const set[][2], const char *item)
{
    stage *s = stage_open("viscosity/modulus");
    stage_set_text(s, "eta0", "10 mPa s");
    for (int i = 0; set[i][0]; i++)
        stage_set_text(s, set[i][0], set[i][1]);
    check_true(what, stage_ready(s) == FF_INVALID && !strcmp(stage_why_item(s), item) &&
                         strlen(stage_why(s)) > 20);
    stage_close(s);
}

static void test_refusals(void)
{
    scene s = open_scene("ester", "ISO VG 100");
    check_true("an ester", stage_ready(s.law) == FF_INVALID &&
                               strstr(stage_why(s.law), "this oil has another base") != NULL);
    close_scene(&s);
    s = open_scene("PAO", "ISO VG 68");
    stage_set_text(s.law, "base", "naphthenic");
    check_true("another base", stage_ready(s.law) == FF_INVALID);
    close_scene(&s);
    refuse("nothing given", (const char *const[][2]){{NULL, NULL}}, "base");
    refuse("two bases", (const char *const[][2]){{"base", "PAO"}, {"a1", "60 MPa"}, {NULL, NULL}},
           "base");
    refuse("B alone", (const char *const[][2]){{"b1", "0.03"}, {NULL, NULL}}, "a1");
    refuse("A below 0", (const char *const[][2]){{"a1", "-60 MPa"}, {NULL, NULL}}, "a1");
    refuse("A + B p below 0",
           (const char *const[][2]){{"a1", "60 MPa"}, {"b1", "-0.0062"}, {NULL, NULL}}, "a1");
}

/* A + B p, with the scale factor of the grade, must be above 0 at any temperature and pressure. */
static void test_range_of_grades(void)
{
    static const char *const grades[] = {"ISO VG 10", "ISO VG 100", "ISO VG 1000"};
    for (int k = 0; k < 6; k++) {
        scene s = open_law(k < 3 ? "mineral" : "PAO", grades[k % 3]);
        const double p[] = {9.9 * GPa};
        double least = INFINITY, most = 0;
        for (double T = 150; T <= 700; T += 0.5) {
            double up = rise(&s, p[0], T);
            least = fmin(least, up);
            most = fmax(most, up);
        }
        check_true("rises at every temperature", least > 0);
        check_below("and within 20 times what it does at ambient pressure", most, 20 * 9.9 / 0.02);
        close_scene(&s);
    }
}

/* Beyond the measured range, the law is extrapolated and must report it. */
static void test_extrapolation(void)
{
    static const double p[] = {1 * GPa, 1.05 * GPa, 0.5 * GPa, 0.5 * GPa};
    static const double T[] = {373.15, 330, 383.15, 293.15};
    scene s = open_law("PAO", "ISO VG 150");
    stage *own = stage_open("viscosity/modulus");
    stage_set_text(own, "eta0", "10 mPa s");
    stage_set_text(own, "a1", "60 MPa");
    const ff_viscosity *v = stage_service(own, FF_VISCOSITY_ID);
    double ln, by_T;
    for (int i = 0; i < 4; i++) {
        ff_status expected = i == 0 ? FF_OK : FF_DOMAIN;
        check_true("one temperature",
                   s.v->eval(s.v->self, 1, &p[i], &T[i], &ln, NULL, NULL) == expected);
        check_true("with slopes",
                   s.v->eval(s.v->self, 1, &p[i], &T[i], &ln, NULL, &by_T) == expected);
        check_true("constants of the user's own",
                   v->eval(v->self, 1, &p[i], &T[i], &ln, NULL, NULL) == FF_OK);
    }
    stage_close(own);
    close_scene(&s);
}

int main(void)
{
    test_table();
    test_grades();
    test_range_of_grades();
    test_extrapolation();
    test_refusals();
    return check_done();
}
