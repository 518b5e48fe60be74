/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Every periodic motion of the pair of Li & Kahraman 2011 from 400 to 4500 Hz by dynamics/shooting:
 * once with the trapezoid of tests/plugins/dynamics/pair.c, once with the stiffness of
 * stiffness/potential-energy in 200 straight lines. And motions of the pair on bearings of 1e9 N/m
 * by dynamics/coupled, with contact kept and lost. Prints process CPU seconds, the least of three
 * runs, so that other jobs on the machine do not count.
 *
 *   meson test -C build --benchmark dynamics --verbose
 */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

static const char *const atlas_outputs = "atlas_frequency atlas_rms atlas_stable atlas_branch "
                                         "atlas_floquet_max fold_frequency doubling_frequency";

typedef struct gears {
    stage *gear, *duty, *mesh;
} gears;

static gears open_gears(void)
{
    gears g = {stage_open("gear/involute-spur"), stage_open("operating/steady"),
               stage_open("stiffness/potential-energy")};
    const double teeth[2] = {50, 50}, inertia[2] = {7.8e-3, 7.8e-3};
    stage_set_reals(g.gear, "teeth", 2, teeth);
    stage_set_reals(g.gear, "inertia", 2, inertia);
    stage_set_text(g.gear, "module", "3 mm");
    stage_set_text(g.gear, "face_width", "20 mm");
    stage_set_text(g.gear, "backlash", "0.14 mm");
    stage_set_text(g.duty, "torque", "250 N m");
    stage_set_text(g.duty, "mesh_frequency", "2375 Hz");
    stage_link(g.duty, "gear", g.gear);
    stage_link(g.mesh, "gear", g.gear);
    stage_link(g.mesh, "operating", g.duty);
    return g;
}

static void close_gears(gears *g)
{
    stage_close(g->mesh);
    stage_close(g->duty);
    stage_close(g->gear);
}

static void measure(const char *title, const pair *p, const gears *g, int max_period, int starts)
{
    double least = INFINITY;
    size_t points = 0, folds = 0, doublings = 0;
    for (int i = 0; i < 3; i++) {
        stage *s = p ? pair_open("dynamics/shooting", p) : stage_open("dynamics/shooting");
        if (!p) {
            stage_link(s, "gear", g->gear);
            stage_link(s, "operating", g->duty);
            stage_link(s, "stiffness", g->mesh);
            stage_set(s, "natural_frequency", 3242);
            stage_run(g->mesh);
        }
        stage_set(s, "atlas.from", 400);
        stage_set(s, "atlas.to", 4500);
        stage_set(s, "max_period", max_period);
        stage_set(s, "search_starts", starts);
        clock_t start = clock();
        ff_status status = stage_run_wanted(s, atlas_outputs);
        least = fmin(least, (double)(clock() - start) / CLOCKS_PER_SEC);
        check_true(title, status == FF_OK);
        stage_get(s, "atlas_frequency", &points);
        stage_get(s, "fold_frequency", &folds);
        stage_get(s, "doubling_frequency", &doublings);
        stage_close(s);
    }
    printf("%-52s %7.3f s  %5zu points  %5.1f us each  %3zu folds  %3zu doublings\n", title, least,
           points, 1e6 * least / (double)points, folds, doublings);
}

static void measure_coupled(const char *title, double frequency, const char *branch)
{
    static const double mass[2] = {2.7, 2.7}, base_radius[2] = {0.070477, 0.070477}, centre = 0.15;
    double least = INFINITY, cycles = 0;
    pair p = pair_trapezoid(frequency);
    for (int i = 0; i < 3; i++) {
        stage *s = pair_open("dynamics/coupled", &p);
        stage_give_series(s, "gear.base_radius", 2, base_radius);
        stage_give_scalar(s, "gear.centre_distance", centre);
        stage_give_series(s, "gear.mass", 2, mass);
        stage_set(s, "bearing_stiffness", 1e9);
        stage_set_text(s, "branch", branch);
        clock_t start = clock();
        check_true(title, stage_run(s) == FF_OK);
        least = fmin(least, (double)(clock() - start) / CLOCKS_PER_SEC);
        cycles = stage_quality(s, "settled_cycles");
        stage_close(s);
    }
    printf("%-52s %7.3f s  %5.0f cycles\n", title, least, cycles);
}

int main(void)
{
    pair p = pair_trapezoid(2375);
    gears g = open_gears();
    measure("trapezoid, period 1", &p, NULL, 1, 0);
    measure("trapezoid, period 1, with search", &p, NULL, 1, 16);
    measure("trapezoid, periods 1 to 6, with search", &p, NULL, 6, 16);
    measure("potential energy, 200 lines, period 1", NULL, &g, 1, 0);
    measure("potential energy, 200 lines, period 1, with search", NULL, &g, 1, 16);
    measure("potential energy, 200 lines, periods 1 to 6", NULL, &g, 6, 16);
    close_gears(&g);
    measure_coupled("on bearings, 1250 Hz, contact kept", 1250, "lower");
    measure_coupled("on bearings, 1700 Hz, contact lost", 1700, "upper");
    measure_coupled("on bearings, 2085 Hz, contact lost", 2085, "lower");
    measure_coupled("on bearings, 2375 Hz, contact lost", 2375, "upper");
    return check_done();
}
