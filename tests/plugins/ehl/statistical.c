/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Films between statistical flanks at W 1e-4, U 1e-11, G 4500: compares them with a table by an
   independent solver on 1001 nodes, and with limits in which the film is known. */
#include "check.h"
#include "stage.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double load = 230e3, mean_speed = 1.15; /* N/m, m/s */

typedef struct scene {
    stage *viscosity, *density, *flow, *flanks, *film;
} scene;

static void give(scene *s, double u_1, double u_2)
{
    static const double time[] = {0}, radius[] = {0.01}, width_load[] = {230e3};
    stage_give_series(s->film, "contact.time", 1, time);
    stage_give_series(s->film, "contact.equivalent_radius", 1, radius);
    stage_give_series(s->film, "contact.speed_1", 1, &u_1);
    stage_give_series(s->film, "contact.speed_2", 1, &u_2);
    stage_give_series(s->film, "contact.load_per_width", 1, width_load);
    stage_give_scalar(s->film, "contact.reduced_modulus", 230e9);
}

/* sigma in m; K: the factor of p_a over E'/2 F_5/2; NAN: smooth flanks. */
static scene open_scene(double sigma, double K, int cells)
{
    scene s = {stage_open("viscosity/modulus"), stage_open("density/dowson-higginson"),
               stage_open("rheology/ree-eyring"),
               isnan(K) ? NULL : stage_open("surface/statistical"),
               stage_open("ehl/finite-volume")};
    stage_set(s.viscosity, "eta0", 0.02);
    stage_set(s.viscosity, "a1", 1 / 19.57e-9);
    stage_set(s.viscosity, "b1", 0.03);
    stage_set(s.density, "rho0", 870);
    stage_set(s.flow, "tau0", 6e6);
    stage_link(s.film, "viscosity", s.viscosity);
    stage_link(s.film, "density", s.density);
    stage_link(s.film, "rheology", s.flow);
    stage_set(s.film, "cells", cells);
    stage_set(s.film, "asperity_hardness", 0);
    give(&s, mean_speed, mean_speed);
    if (!s.flanks)
        return s;
    const double rq[] = {0.6 * sigma, 0.8 * sigma}, product = 0.2;
    const double root = K / (16 * sqrt(2) / 15 * 3.14159265358979323846 * product * product);
    stage_set_reals(s.flanks, "rq", 2, rq);
    if (K > 0) {
        stage_set(s.flanks, "summit_product", product);
        stage_set(s.flanks, "summit_slope", root * root);
    } else {
        stage_set(s.flanks, "summit_product", 0);
    }
    stage_link(s.film, "surface", s.flanks);
    return s;
}

static void close_scene(scene *s)
{
    stage_close(s->film);
    if (s->flanks)
        stage_close(s->flanks);
    stage_close(s->flow);
    stage_close(s->density);
    stage_close(s->viscosity);
}

static const char wanted[] = "h_min h_central p_max asperity_load_share traction power_loss "
                             "rolling_loss squeeze_loss asperity_loss";

static double value(const scene *s, const char *output)
{
    return stage_get(s->film, output, NULL)[0];
}

static int run(scene *s)
{
    return stage_run_wanted(s->film, wanted) == FF_OK && stage_verdict(s->film) != FF_BAD;
}

static void test_table(void)
{
    static const struct {
        double K, sigma, share, film;
    } rows[] = {
        {3.7e-3, 0.05e-6, 0, 3.71},      {3.7e-3, 0.2e-6, 0.0544, 0.940},
        {3.7e-3, 0.5e-6, 0.1804, 0.396}, {1.2e-2, 0.2e-6, 0.1627, 0.970},
        {1.2e-2, 0.5e-6, 0.4920, 0.458},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        double share[2], film[2];
        for (int fine = 0; fine < 2; fine++) {
            scene s = open_scene(rows[k].sigma, rows[k].K, fine ? 1024 : 512);
            check_true("found", run(&s));
            share[fine] = value(&s, "asperity_load_share");
            film[fine] = value(&s, "h_central") / rows[k].sigma;
            close_scene(&s);
        }
        check_below("share, off the table", fabs(share[1] - rows[k].share),
                    0.03 * rows[k].share + 1e-4);
        check_near("h_central/sigma", film[1], rows[k].film, 0.03);
        check_below("512 cells off 1024", fabs(share[0] - share[1]), 0.03 * share[1] + 1e-6);
        check_near("and of the film", film[0], film[1], 0.03);
    }
}

static void test_limits(void)
{
    scene smooth = open_scene(0, NAN, 256), none = open_scene(0.2e-6, 0, 256);
    scene fine = open_scene(0.01e-6, 3.7e-3, 256);
    check_true("found", run(&smooth) && run(&none) && run(&fine));
    for (const char *name = wanted; *name; name += strcspn(name, " "), name += strspn(name, " ")) {
        char one[40];
        snprintf(one, sizeof one, "%.*s", (int)strcspn(name, " "), name);
        check_true("K 0: the smooth film to the last digit",
                   !(fabs(value(&none, one) - value(&smooth, one)) > 0));
        check_near("sigma to 0", value(&fine, one), value(&smooth, one), 1e-7);
    }
    close_scene(&smooth);
    close_scene(&none);
    close_scene(&fine);
}

/* The lower the speed, the more load the asperities must carry, finally all of it, with Hertz's
   pressure. */
static void test_speeds(void)
{
    const double hertz = sqrt(load * 230e9 / (2 * 3.14159265358979323846 * 0.01));
    double before = -1;
    for (double u = 10 * mean_speed; u > 5e-4 * mean_speed; u /= 10) {
        scene s = open_scene(0.05e-6, 0.0375, 256);
        give(&s, u, u);
        check_true("found", run(&s));
        double share = value(&s, "asperity_load_share");
        check_true("falls with the speed", share >= before);
        if (u < 0.02 * mean_speed) {
            check_true("nearly dry", share > (u < 2e-3 * mean_speed ? 0.99 : 0.95));
            check_near("Hertz", value(&s, "p_max"), hertz, 0.02);
        }
        before = share;
        close_scene(&s);
    }
}

/* Friction computed here, reversed motion, and the work of the entrainment against the
   dissipation. */
static void test_sliding(void)
{
    double traction[3], share = 0;
    for (int k = 0; k < 3; k++) {
        scene s = open_scene(0.5e-6, 1.2e-2, 512);
        give(&s, k < 2 ? 1.3 : -1, k < 2 ? 1 : -1.3);
        stage_set(s.film, "boundary_friction", k == 0 ? 0 : 0.065);
        check_true("found", run(&s));
        traction[k] = value(&s, "traction");
        share = value(&s, "asperity_load_share");
        check_near("asperity_loss", value(&s, "asperity_loss"),
                   k == 0 ? 0 : 0.065 * share * load * 0.3, 1e-9);
        check_below("work of the entrainment off the dissipation of the pressure flow",
                    fabs(value(&s, "squeeze_loss")) / value(&s, "rolling_loss"), 0.03);
        close_scene(&s);
    }
    check_near("mu_b p_a", traction[1] - traction[0], 0.065 * share * load, 1e-9);
    check_near("turned round", traction[2], traction[1], 1e-6);
}

/* Soft summits must carry less load, and no pressure above their hardness. */
static void test_hardness(void)
{
    double share[2];
    for (int soft = 0; soft < 2; soft++) {
        scene s = open_scene(0.5e-6, 1.2e-2, 256);
        stage_set(s.film, "asperity_hardness", soft ? 1e9 : 0);
        check_true("found",
                   stage_run_wanted(s.film, "asperity_pressure asperity_load_share") == FF_OK);
        size_t count;
        const double *p = stage_get(s.film, "asperity_pressure", &count);
        double most = 0;
        for (size_t i = 0; i < count; i++)
            most = fmax(most, p[i]);
        check_true("held", !soft || most < 1e9);
        share[soft] = value(&s, "asperity_load_share");
        close_scene(&s);
    }
    check_true("less", share[1] < 0.95 * share[0]);
}

static void test_refusals(void)
{
    scene s = open_scene(0.2e-6, 3.7e-3, 64);
    stage_set_text(s.film, "cavitation", "mass-conserving");
    check_true("no mass in cavities",
               stage_ready(s.film) < 0 && !strcmp(stage_why_item(s.film), "cavitation"));
    close_scene(&s);
    s = open_scene(0.2e-6, 3.7e-3, 64);
    check_true("nothing touches at one place or another",
               stage_run_wanted(s.film, "contact_ratio") == FF_UNSUPPORTED &&
                   strstr(stage_why(s.film), "statistics"));
    close_scene(&s);
    s = open_scene(0.2e-6, 3.7e-3, 64);
    scene other = s;
    other.film = stage_open("ehl/dense-newton");
    give(&other, 1, 1);
    stage_link(other.film, "viscosity", s.viscosity);
    stage_link(other.film, "density", s.density);
    stage_link(other.film, "surface", s.flanks);
    check_true("other solvers", stage_ready(other.film) == FF_UNSUPPORTED &&
                                    strstr(stage_why(other.film), "ehl/finite-volume"));
    stage_close(other.film);
    close_scene(&s);
}

int main(void)
{
    test_table();
    test_limits();
    test_speeds();
    test_sliding();
    test_hardness();
    test_refusals();
    return check_done();
}
