/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hertz pressure and width, and Moes' parameters, of a constant line contact. */
#include <check.h>
#include <stage.h>

#include <flankfilm/viscosity.h>

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* Opens the viscosity law of the tables: 5.006 mPa s, 11.03 1/GPa. */
static stage *open_oil(void)
{
    stage *oil = stage_open("viscosity/barus");
    stage_set_text(oil, "eta0", "5.006 mPa s");
    stage_set_text(oil, "alpha", "11.03 1/GPa");
    return oil;
}

static stage *open_contact(double radius, double speed, double load)
{
    stage *contact = stage_open("contact/constant");
    stage_set(contact, "radius", radius);
    stage_set(contact, "entrainment_speed", speed);
    stage_set(contact, "load_per_width", load);
    return contact;
}

static void check_printed(const char *what, double value, double printed, double last)
{
    check_near(what, value, printed, 0.51 * last / printed);
}

/* Li & Kahraman's gear contact: SAP and pitch point, three speeds. */
static void check_gear_contacts(void)
{
    static const struct {
        double radius, speed, load, a, p, M, L; /* p to the digits printed */
    } rows[] = {
        {11.649e-3, 4.0293, 59.1e3, 88.0, 0.428, 5.73, 4.94},
        {12.826e-3, 4.0293, 177.363e3, 160.0, 0.7059, 16.39, 4.82},
        {12.826e-3, 6.7209, 177.363e3, 160.0, 0.7059, 12.69, 5.48},
        {12.826e-3, 7.6557, 177.363e3, 160.0, 0.7059, 11.89, 5.66},
    };
    stage *oil = open_oil();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        stage *contact = open_contact(rows[i].radius, rows[i].speed, rows[i].load);
        stage_link(contact, "viscosity", oil);
        if (check_true("runs", stage_run(contact) == FF_OK)) {
            check_printed("half width, um", 1e6 * stage_scalar(contact, "hertz_half_width"),
                          rows[i].a, 0.1);
            check_printed("Hertz pressure, GPa", 1e-9 * stage_scalar(contact, "hertz_pressure"),
                          rows[i].p, i == 0 ? 1e-3 : 1e-4);
            check_printed("Moes M", stage_scalar(contact, "moes_M"), rows[i].M, 0.01);
            check_printed("Moes L", stage_scalar(contact, "moes_L"), rows[i].L, 0.01);
        }
        stage_close(contact);
    }
    stage_close(oil);
}

/* Radii, speeds and modulus given in either of two ways must give the same contact. */
static void check_two_ways(void)
{
    static const char *const same[] = {"equivalent_radius", "entrainment_speed", "sliding_speed",
                                       "slide_roll_ratio",  "load_per_width",    "hertz_half_width",
                                       "hertz_pressure",    "reduced_modulus"};
    stage *one = open_contact(12e-3, 4, 1e5), *other = stage_open("contact/constant");
    stage_set(one, "slide_roll_ratio", 0.5);
    stage_set(one, "reduced_modulus", 2 / (0.91 / 206e9 + 0.96 / 70e9));
    stage_set(other, "radius_1", 20e-3);
    stage_set(other, "radius_2", 30e-3);
    stage_set(other, "speed_1", 5);
    stage_set(other, "speed_2", 3);
    stage_set(other, "load_per_width", 1e5);
    stage_set_reals(other, "elastic_modulus", 2, (double[]){206e9, 70e9});
    stage_set_reals(other, "poisson_ratio", 2, (double[]){0.3, 0.2});
    char wanted[256] = "";
    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++)
        snprintf(wanted + strlen(wanted), sizeof wanted - strlen(wanted), "%s ", same[i]);
    if (check_true("both run", stage_run_wanted(one, wanted) == FF_OK &&
                                   stage_run_wanted(other, wanted) == FF_OK))
        for (size_t i = 0; i < sizeof same / sizeof same[0]; i++)
            check_near(same[i], stage_scalar(one, same[i]), stage_scalar(other, same[i]), 1e-14);
    stage_close(one);
    stage_close(other);
}

/* With only both moduli given, Poisson's ratio must be that of steel, 0.3. */
static void check_preset_ratio(void)
{
    stage *s = open_contact(12e-3, 4, 1e5);
    stage_set_reals(s, "elastic_modulus", 2, (double[]){206e9, 70e9});
    if (check_true("moduli alone", stage_run_wanted(s, "reduced_modulus") == FF_OK))
        check_near("with 0.3", stage_scalar(s, "reduced_modulus"), 2 / (0.91 / 206e9 + 0.91 / 70e9),
                   1e-14);
    stage_close(s);
}

static void check_duration(void)
{
    stage *contact = open_contact(12e-3, 4, 1e5);
    stage_set(contact, "duration", 0.01);
    size_t n = 0;
    if (check_true("a duration runs", stage_run_wanted(contact, "time gap") == FF_OK)) {
        const double *time = stage_get(contact, "time", &n);
        check_true("from 0 to the duration", n == 2 && time[0] == 0 && time[1] == 0.01);
    }
    stage_close(contact);
}

static void check_refused(const char *set[4][2], const char *item)
{
    stage *contact = stage_open("contact/constant");
    stage_set(contact, "load_per_width", 1e5);
    for (int i = 0; i < 4 && set[i][0]; i++)
        stage_set_text(contact, set[i][0], set[i][1]);
    ff_status status = stage_ready(contact);
    printf("%s\n", stage_why(contact));
    check_true(item, status == FF_INVALID && !strcmp(stage_why_item(contact), item));
    stage_close(contact);
}

static void check_refusals(void)
{
    check_refused((const char *[4][2]){{"radius_1", "20 mm"}, {"entrainment_speed", "1 m/s"}},
                  "radius_1");
    check_refused((const char *[4][2]){{"radius", "20 mm"},
                                       {"radius_2", "20 mm"},
                                       {"entrainment_speed", "1 m/s"}},
                  "radius_2");
    check_refused((const char *[4][2]){{"radius", "20 mm"}, {"speed_1", "1 m/s"}}, "speed_1");
    check_refused((const char *[4][2]){{"radius", "20 mm"},
                                       {"speed_1", "1 m/s"},
                                       {"speed_2", "2 m/s"},
                                       {"slide_roll_ratio", "0.1"}},
                  "slide_roll_ratio");
    check_refused(
        (const char *[4][2]){{"radius", "20 mm"}, {"speed_1", "1 m/s"}, {"speed_2", "-1 m/s"}},
        "speed_1");
    check_refused((const char *[4][2]){{"radius", "20 mm"},
                                       {"entrainment_speed", "1 m/s"},
                                       {"poisson_ratio", "0.3"}},
                  "poisson_ratio");
    stage *contact = open_contact(12e-3, 4, 1e5);
    check_true("Moes numbers need an oil",
               stage_run(contact) == FF_INVALID && !strcmp(stage_why_item(contact), "viscosity"));
    stage_close(contact);
}

/* Since Roelands' ln eta is not linear in pressure, alpha* is not the slope at 0; computes 1/alpha*
   by the midpoint rule. */
static void check_film_coefficient(void)
{
    enum { POINTS = 400000 };
    static double p[POINTS], ln_eta[POINTS];
    stage *oil = stage_open("viscosity/roelands");
    stage_set_text(oil, "eta0", "10 mPa s");
    stage_set_text(oil, "z", "0.6");
    const ff_viscosity *law = stage_service(oil, FF_VISCOSITY_ID);
    double width = 4e9 / POINTS, sum = 0;
    for (int i = 0; i < POINTS; i++)
        p[i] = (i + 0.5) * width;
    law->eval(law->self, POINTS, p, NULL, ln_eta, NULL, NULL);
    for (int i = 0; i < POINTS; i++)
        sum += width * exp(log(10e-3) - ln_eta[i]);
    stage *contact = open_contact(12e-3, 4, 1e5);
    stage_link(contact, "viscosity", oil);
    if (check_true("runs", stage_run(contact) == FF_OK)) {
        double E = stage_scalar(contact, "reduced_modulus");
        double U = 10e-3 * 4 / (E * 12e-3);
        check_near("alpha* of Roelands, 1/GPa",
                   1e9 * stage_scalar(contact, "moes_L") / (E * pow(2 * U, 0.25)), 1e9 / sum, 1e-8);
    }
    stage_close(contact);
    stage_close(oil);
}

int main(void)
{
    check_gear_contacts();
    check_film_coefficient();
    check_two_ways();
    check_preset_ratio();
    check_duration();
    check_refusals();
    return check_done();
}
