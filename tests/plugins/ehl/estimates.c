/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Both models without a pressure solution: extremes, contact loss, fields, reversed motion,
   errors. */
#include "check.h"
#include "line.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char everything[] = "time h_min h_central p_max friction_coefficient traction "
                                 "power_loss sliding_loss rolling_loss squeeze_loss "
                                 "asperity_loss h_min_error x film pressure h_min_lowest "
                                 "p_max_highest";

static int all_finite(const line *c, int positive)
{
    char names[sizeof everything];
    strcpy(names, everything);
    for (char *name = strtok(names, " "); name; name = strtok(NULL, " ")) {
        size_t n;
        const double *y = stage_get(c->film, name, &n);
        for (size_t i = 0; i < n; i++)
            if (!isfinite(y[i]) || (positive && name[0] == 'h' && !(y[i] > 0)))
                return 0;
    }
    return 1;
}

static void test_extremes(const char *model)
{
    static const char *const law[] = {"viscosity/roelands", "viscosity/barus",
                                      "viscosity/isoviscous"};
    static const double load[] = {1e-6, 1e-3, 1, 100}, speed[] = {1e-4, 1, 100};
    char text[96];
    for (int l = 0; l < 3; l++)
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 3; k++) {
                line c;
                line_open(&c, model);
                line_oil(&c, law[l], 5.006e-3, l < 2 ? 11.03e-9 : 0);
                line_eyring(&c, 5e6);
                c.load[0] *= load[i];
                c.u1[0] *= 2 * speed[k];
                c.u2[0] = 0;
                snprintf(text, sizeof text, "%s, %s, load x %g, speed x %g", model, law[l], load[i],
                         speed[k]);
                check_true(text, line_run(&c, everything) == FF_OK && all_finite(&c, 1));
                line_close(&c);
            }
}

/* A Newtonian oil is sheared at u_s/h: the traction is u_s/h_c times the integral of eta(p) over
   Hertz's ellipse of half width a = 2 w/(pi p_max), here by the angle whose cosine is x/a. */
static void test_traction(const char *model, double alpha)
{
    enum { ANGLES = 2000 };
    line c;
    line_open(&c, model);
    line_oil(&c, alpha > 0 ? "viscosity/barus" : "viscosity/isoviscous", 5.006e-3, alpha);
    line_incompressible(&c);
    c.u1[0] = 4.5;
    c.u2[0] = 3.5;
    check_true("runs", line_run(&c, everything) == FF_OK);
    double p_max = line_value(&c, "p_max", 0), a = 2 * c.load[0] / (M_PI * p_max), sum = 0;
    for (int i = 0; i < ANGLES; i++) {
        double angle = M_PI * (i + 0.5) / ANGLES;
        sum += 5.006e-3 * exp(alpha * p_max * sin(angle)) * a * sin(angle) * M_PI / ANGLES;
    }
    double traction = sum / line_value(&c, "h_central", 0);
    check_near(model, line_value(&c, "traction", 0), traction, 2e-3);
    check_near("coefficient", line_value(&c, "friction_coefficient", 0), traction / c.load[0],
               2e-3);
    check_near("sliding loss", line_value(&c, "sliding_loss", 0), traction, 2e-3);
    line_close(&c);
}

/* Makes load 1, then 0 with a gap from row 20 to 30, then 1 again; sudden: with two rows at one
   time. */
static void separate(line *c, const char *model, int sudden)
{
    line_open(c, model);
    line_eyring(c, 5e6);
    line_last(c, 51, 1000e-6);
    for (size_t i = 0; i < c->count; i++) {
        double away = fmax(fmax(20 - (double)i, (double)i - 30), 0), share = fmin(away / 5, 1);
        c->load[i] *= sudden ? share > 0 : share;
        c->gap[i] = away > 0 ? 0 : 5e-6 * (1 - pow(((double)i - 25) / 5, 2));
    }
    if (sudden)
        c->time[20] = c->time[19];
}

static void test_loss(const char *model, int sudden, const char *steps)
{
    line c;
    separate(&c, model, sudden);
    stage_set_text(c.film, "steps", steps);
    check_true(model, line_run(&c, everything) == FF_OK);
    check_true("finite and positive through contact loss", all_finite(&c, 1));
    check_true("says so", stage_verdict(c.film) == FF_DOUBTFUL);
    size_t n;
    const double *h = stage_get(c.film, "h_central", &n), *p = stage_get(c.film, "p_max", NULL);
    check_true("the flanks part", h[n / 2] > 4.5e-6 && h[n / 2] < 6e-6);
    check_below("no pressure", p[n / 2], 0);
    check_below("no friction", fabs(line_value(&c, "traction", n / 2)), 0);
    check_near("the film comes back", h[n - 1], h[0], 1e-3);
    line_close(&c);
}

static void test_unloaded_start(const char *model)
{
    line c;
    line_open(&c, model);
    line_last(&c, 5, 200e-6);
    for (size_t i = 0; i < 5; i++)
        c.load[i] *= (double)i / 4;
    stage_set_text(c.film, "steps", "100");
    check_true("begins without load", line_run(&c, everything) == FF_OK && all_finite(&c, 1));
    line_close(&c);
}

/* Surfaces that stop, and the smallest load, which replaces smaller ones. */
static void test_stop(const char *model)
{
    line c;
    separate(&c, model, 0);
    c.u1[40] = c.u2[40] = 0;
    stage_set(c.film, "light_load", 1000);
    check_true("surfaces that stand still", line_run(&c, everything) == FF_OK && all_finite(&c, 1));
    check_true("a load stands in", line_value(&c, "p_max", 25) > 1e7);
    line_close(&c);
}

/* With reversed entrainment, the numbers must be the same and the fields mirrored. */
static void test_mirror(const char *model)
{
    line a, b;
    line_open(&a, model);
    line_open(&b, model);
    b.u1[0] = b.u2[0] = -b.u1[0];
    check_true("runs", line_run(&a, everything) == FF_OK && line_run(&b, everything) == FF_OK);
    size_t n;
    const double *x = stage_get(a.film, "x", &n), *y = stage_get(b.film, "x", NULL);
    const double *h = stage_get(a.film, "film", NULL), *g = stage_get(b.film, "film", NULL);
    double worst = 0;
    for (size_t i = 0; i < n; i++)
        worst = fmax(worst, fmax(fabs(x[i] + y[n - 1 - i]), fabs(h[i] - g[n - 1 - i])));
    check_below("mirrored", worst, 0);
    line_close(&a);
    line_close(&b);
}

/* The Hertzian pressure on the grid must carry the load. */
static void test_fields(const char *model)
{
    line c;
    line_open(&c, model);
    stage_set(c.film, "cells", 2048);
    check_true("runs", line_run(&c, everything) == FF_OK);
    size_t n;
    const double *x = stage_get(c.film, "x", &n), *p = stage_get(c.film, "pressure", NULL);
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += p[i] * (x[1] - x[0]);
    /* the sum has a relative error of order (dx/a)^1.5, because the pressure ends with a square
       root */
    check_near("pressure carries the load", sum, c.load[0], 2e-3);
    size_t centre = 0;
    for (size_t i = 0; i < n; i++)
        centre = fabs(x[i]) < fabs(x[centre]) ? i : centre;
    check_near("film in the middle", stage_get(c.film, "film", NULL)[centre],
               line_value(&c, "h_central", 0), 1e-4);
    line_close(&c);
}

static void refused(line *c, const char *what, const char *item, const char *outputs)
{
    ff_status status = line_run(c, outputs);
    check_true(what, status < 0 && !strcmp(stage_why_item(c->film), item) &&
                         strlen(stage_why(c->film)) > 20);
    line_close(c);
}

static void test_refusals(const char *model)
{
    line c;
    line_open(&c, model);
    c.radius[0] = -1;
    refused(&c, "negative radius", "contact.equivalent_radius", "h_min");
    line_open(&c, model);
    refused(&c, "roll angle of a contact without one", "roll_angle", "roll_angle");
    line_open(&c, model);
    c.load[0] = 0;
    refused(&c, "no load at all", "contact.load_per_width", "h_min");
    line_open(&c, model);
    c.load[0] = 1e308;
    c.radius[0] = 1e30;
    refused(&c, "no finite contact", "contact.load_per_width", "h_min");
}

int main(void)
{
    static const char *const models[] = {"ehl/film-formula", "ehl/inlet-analysis"};
    for (int k = 0; k < 2; k++) {
        test_extremes(models[k]);
        test_traction(models[k], 0);
        test_traction(models[k], 4e-9);
        test_loss(models[k], 0, "auto");
        test_loss(models[k], 0, "1000");
        test_loss(models[k], 1, "auto");
        test_unloaded_start(models[k]);
        test_stop(models[k]);
        test_mirror(models[k]);
        test_fields(models[k]);
        test_refusals(models[k]);
    }
    return check_done();
}
