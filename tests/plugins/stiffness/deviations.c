/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flank deviations must have the same effect in all stiffness models. */
#include "chain.h"
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const models[] = {"stiffness/load-distribution", "stiffness/potential-energy",
                                     "stiffness/iso-6336"};
enum { MODELS = 3, LEVELLED = 2 /* the first two models give force levels */ };

static double largest_difference(const double *a, const double *b, size_t n)
{
    double worst = 0;
    for (size_t i = 0; i < n; i++)
        worst = fmax(worst, fabs(a[i] - b[i]));
    return worst;
}

/* A relief of 20 um exceeds the deflection of a single tooth pair. */
static void test_long_relief_unloads_sap(void)
{
    for (int m = 0; m < MODELS; m++) {
        chain c = chain_with(models[m], "250 N m", "gear.tip_relief", "20 um");
        size_t n;
        const double *share = stage_get(c.mesh, "load_share", &n);
        check_true(models[m], !(share[0] > 0) && !(share[n - 1] > 0));
        check_below("forces add up", stage_quality(c.mesh, "equilibrium"), 1e-10);
        check_true("contact is lost inside the path",
                   stage_scalar(c.mesh, "loaded_contact_ratio") < 1.7);
        size_t breaks;
        stage_get(c.mesh, "breakpoints", &breaks);
        check_true("and that is a breakpoint", breaks > 2);
        chain_close(&c);
    }
}

/* Between SAP and LPSTC, the gaps of both pairs differ by A (1 - 2 t) for a linear and for a
   parabolic relief, since (1 - t)^2 - t^2 = 1 - 2 t. */
static void test_line_and_parabola_share_alike(void)
{
    for (int m = 0; m < MODELS; m++) {
        chain a = chain_with(models[m], "250 N m", "gear.tip_relief", "10 um");
        chain b = chain_open(models[m], "250 N m");
        stage_set_text(b.gear, "tip_relief", "10 um");
        stage_set_text(b.gear, "tip_relief_shape", "parabolic");
        chain_run(&b);
        size_t n;
        const double *x = stage_get(a.mesh, "load_share", &n);
        check_below(models[m], largest_difference(x, stage_get(b.mesh, "load_share", NULL), n),
                    2e-7);
        if (m < LEVELLED) { /* load fractions are equal at every force, but transmission errors
                               differ */
            double F = stage_scalar(b.duty, "line_force");
            const double *force = stage_get(a.mesh, "level_tooth_force", &n);
            const double *other = stage_get(b.mesh, "level_tooth_force", NULL);
            check_below("at all levels", largest_difference(force, other, n) / F, 2e-7);
            const double *error = stage_get(a.mesh, "level_error", &n);
            other = stage_get(b.mesh, "level_error", NULL);
            check_true("errors differ", largest_difference(error, other, n) > 1e-6);
        }
        chain_close(&a);
        chain_close(&b);
    }
}

/* Two linear tooth pairs: at each phase, the levels must lie on two lines, k_1 g below the force at
   which the second pair touches, and (k_1 + k_2) g - k_2 gap above it; k_1 + k_2 is the stiffness
   without relief. */
static void test_levels_in_closed_form(void)
{
    chain a = chain_with(models[1], "250 N m", "gear.tip_relief", "20 um");
    chain b = chain_open(models[1], "250 N m");
    chain_run(&b);
    size_t levels, n, plain, seen[2] = {0, 0};
    const double *force = stage_get(a.mesh, "force_level", &levels);
    const double *phase = stage_get(a.mesh, "phase", &n),
                 *s = stage_get(a.mesh, "level_error", NULL);
    const double *k = stage_get(a.mesh, "level_stiffness", NULL);
    const double *rigid = stage_get(b.mesh, "stiffness", &plain);
    const double *at = stage_get(b.mesh, "phase", NULL);
    double worst = 0;
    for (size_t i = 0, j = 0; i < n; i++) {
        while (j + 1 < plain && at[j] < phase[i] - 1e-12)
            j++;
        if (fabs(at[j] - phase[i]) > 1e-12 || (j + 1 < plain && at[j + 1] - at[j] < 1e-12))
            continue; /* a breakpoint of the relief, or a change of the number of pairs */
        size_t top = (levels - 1) * n + i, last = 0;
        int both = fabs(k[top] / rigid[j] - 1) < 1e-9;
        for (size_t l = 1; l < levels; l++) {
            size_t here = l * n + i;
            int joined = k[here] > k[i] * (1 + 1e-9);
            double g = s[here] - s[i], gap = s[top] - s[i] - force[levels - 1] / k[top];
            double there = joined ? k[top] * (g - gap) : k[i] * g;
            worst = fmax(worst, fabs(there / force[l] - 1));
            last = joined ? last : l;
        }
        check_true("the stiffness without relief", both || last == levels - 1);
        seen[last + 1 < levels] += last > 0;
    }
    check_below("two lines", worst, 1e-9);
    check_true("both are seen", seen[0] > 10 && seen[1] > 10);
    chain_close(&a);
    chain_close(&b);
}

/* In the middle of double contact, e must be half a linear relief, or a quarter of a parabolic
   relief. */
static void test_unloaded_error_of_relief(void)
{
    for (int m = 0; m < MODELS; m++) {
        chain c = chain_open(models[m], "250 N m");
        stage_set_text(c.gear, "tip_relief", "10 um");
        stage_set_text(c.gear, "tip_relief_shape", m ? "linear" : "parabolic");
        stage_set_text(c.mesh, "points", "400");
        chain_run(&c);
        size_t n;
        const double *e = stage_get(c.mesh, "transmission_error", &n);
        double largest = 0, least = 1;
        for (size_t i = 0; i < n; i++) {
            largest = fmax(largest, e[i]);
            least = fmin(least, e[i]);
        }
        check_near(models[m], largest, m ? 5e-6 : 2.5e-6, 1e-5);
        check_near("no gap in single contact", 1 + least, 1, 0);
        chain_close(&c);
    }
}

static void test_loaded_error(void)
{
    chain c = chain_open(models[0], "250 N m");
    size_t n;
    stage_set_text(c.gear, "tip_relief", "10 um");
    stage_set_text(c.mesh, "definition", "secant");
    chain_run(&c);
    const double *e = stage_get(c.mesh, "transmission_error", &n);
    const double *loaded = stage_get(c.mesh, "loaded_transmission_error", NULL);
    const double *k = stage_get(c.mesh, "stiffness", NULL);
    double worst = 0, high = 0, low = 1;
    for (size_t i = 0; i < n; i++) {
        worst = fmax(worst, fabs((loaded[i] - e[i]) * k[i] / 3547.26 - 1));
        high = fmax(high, loaded[i]);
        low = fmin(low, loaded[i]);
    }
    check_below("k = F/(e_l - e)", worst, 1e-6);
    check_near("its swing", stage_scalar(c.mesh, "transmission_error_peak_to_peak"), high - low,
               1e-12);
    chain_close(&c);
}

/* A constant deviation, a crown with equal effect on both pairs, must only shift e. */
static void test_profile_slope_of_both_gears_cancels(void)
{
    /* the base pitches stay equal: the slope of one flank compensates that of the other */
    chain a = chain_with(models[0], "250 N m", "gear.profile_slope", "[6 um, 6 um]");
    chain b = chain_with(models[0], "250 N m", NULL, NULL);
    size_t n;
    const double *x = stage_get(a.mesh, "load_share", &n);
    check_below("shares", largest_difference(x, stage_get(b.mesh, "load_share", NULL), n), 1e-9);
    chain_close(&a);
    chain_close(&b);
}

/* One tooth of gear 1 and one of gear 2 are thicker: e must be negative while either is in
   contact. */
static void test_hunting(void)
{
    chain c = chain_open(models[1], "250 N m");
    stage_set_text(c.gear, "teeth", "[20, 30]");
    stage_set_text(c.gear, "pitch_error", "[5 um]");
    stage_set_text(c.gear, "pitch_error_2", "[0 um, 0 um, 0 um, 3 um]");
    stage_set_text(c.gear, "backlash", "0.1 mm");
    chain_run(&c);
    check_near("the teeth meet again after 60", stage_scalar(c.mesh, "hunting_period"), 60, 0);
    size_t n, steps;
    const double *e = stage_get(c.mesh, "hunting_transmission_error", &n);
    steps = n / 60;
    check_near("the tooth of gear 1", e[0], -5e-6, 1e-12);
    check_near("again after 20 cycles", e[20 * steps], -5e-6, 1e-12);
    check_near("the tooth of gear 2", e[3 * steps], -3e-6, 1e-12);
    check_near("and after 30", e[33 * steps], -3e-6, 1e-12);
    check_near("no other", 1 + e[10 * steps], 1, 1e-15);
    chain_close(&c);
    c = chain_open(models[1], "250 N m");
    stage_set_text(c.gear, "pitch_error", "[0 um, 5 um]");
    stage_set_text(c.mesh, "mesh_cycle", "1");
    chain_run(&c);
    check_near("the cycle in which it enters", stage_get(c.mesh, "transmission_error", NULL)[5],
               -5e-6, 1e-12);
    check_true("it takes more of the load", stage_get(c.mesh, "load_share", NULL)[0] > 0.5);
    chain_close(&c);
}

static chain open_hunting(const char *model, const char *cycle, const char *error)
{
    chain c = chain_open(model, "250 N m");
    stage_set_text(c.gear, "teeth", "[20, 30]");
    stage_set_text(c.gear, "backlash", "0.1 mm");
    stage_set_text(c.gear, "pitch_error", error);
    stage_set_text(c.gear, "pitch_error_2", "[0 um, 4 um, -3 um, 0 um, 0 um, 0 um, 9 um]");
    stage_set_text(c.mesh, "mesh_cycle", cycle);
    if (model == models[0]) {
        stage_set_text(c.mesh, "compliance", "analytical");
        stage_set_text(c.mesh, "corner_contact", "true");
    }
    chain_run(&c);
    return c;
}

/* Returns the highest Hertz pressure of a pair, from its force at the stations. */
static double highest_pressure(const chain *c, const double *force, size_t n)
{
    const double *r1 = stage_get(c->gear, "radius_1", NULL),
                 *r2 = stage_get(c->gear, "radius_2", NULL);
    double highest = 0, modulus = stage_scalar(c->gear, "reduced_modulus"),
           width = stage_scalar(c->gear, "face_width");
    for (size_t i = 0; i < n; i++) {
        double radius = 1 / (1 / r1[i] + 1 / r2[i]);
        highest = fmax(highest, sqrt(force[i] * modulus / (2 * M_PI * radius * width)));
    }
    return highest;
}

/* Checks that the pressure of each pair is that of its force. Returns the mesh cycle with the
   highest pressure. */
static size_t check_pressures(const chain *all)
{
    uint32_t rank;
    const double *force = stage_get(all->mesh, "tooth_force", NULL),
                 *pressure = stage_get(all->mesh, "hunting_hertz_pressure", NULL);
    size_t n = stage_shape(all->mesh, "tooth_force", &rank)[1],
           worst = (size_t)stage_scalar(all->mesh, "worst_mesh_cycle");
    double off = 0;
    for (size_t k = 0; k < 60; k++) {
        off = fmax(off, fabs(highest_pressure(all, force + k * n, n) / pressure[k] - 1));
        check_true("none is worse than the worst", pressure[k] <= pressure[worst]);
    }
    check_below("their pressures", off, 5e-3);
    return worst;
}

/* Tip corners touch before SAP, so that the contact of a pair begins in the mesh cycle before. */
static void test_pressures_with_corner_contact(void)
{
    chain c = open_hunting(models[0], "all", "[20 um, -20 um, 0 um, -20 um, 20 um]");
    check_pressures(&c);
    chain_close(&c);
}

/* All pairs of the hunting period must have the forces of the single cycles, and add up to F in
   each. */
static void test_all_cycles(void)
{
    static const char errors[] = "[8 um, -2 um, 0 um, 0 um, 3 um]";
    chain all = open_hunting(models[1], "all", errors);
    uint32_t rank;
    size_t n = stage_shape(all.mesh, "tooth_force", &rank)[1];
    const double *share = stage_get(all.mesh, "load_share", NULL);
    const double *roll = stage_get(all.gear, "roll_angle", NULL);
    check_true("one row for each pair",
               rank == 2 && stage_shape(all.mesh, "tooth_force", &rank)[0] == 60);
    double pitch = 2 * M_PI / 20, sum = 0, off = 0;
    for (size_t k = 0; k < 60; k++)
        for (size_t i = 1; i < n; i++)
            sum += (roll[i] - roll[i - 1]) * (share[k * n + i] + share[k * n + i - 1]) / 2;
    check_near("they bear the force", sum / (60 * pitch), 1, 1e-3);
    size_t worst = check_pressures(&all);
    const double *teeth = stage_get(all.mesh, "worst_teeth", NULL);
    check_true("the teeth that meet then",
               teeth[0] == (double)(worst % 20 + 1) && teeth[1] == (double)(worst % 30 + 1));
    off = 0;
    for (size_t k = 0; k < 60; k += 13) {
        char number[8];
        snprintf(number, sizeof number, "%zu", k);
        chain one = open_hunting(models[1], number, errors);
        const double *alone = stage_get(one.mesh, "load_share", NULL);
        size_t ahead = (k + 59) % 60; /* the pair that entered before is still in mesh */
        for (size_t i = 0; i < n; i++)
            if (roll[i] - roll[0] < 0.999 * pitch)
                off = fmax(off, fabs(alone[i] - share[k * n + i]));
            else if (roll[i] - roll[0] > 1.001 * pitch)
                off = fmax(off, fabs(alone[i] - share[ahead * n + i]));
        chain_close(&one);
    }
    check_below("those of the mesh cycles, one by one", off, 1e-12);
    chain w = open_hunting(models[1], "worst", errors);
    check_near("the worst", stage_get(w.mesh, "load_share", NULL)[0], share[worst * n], 1e-12);
    chain_close(&w);
    chain_close(&all);
}

/* A deviation that all teeth have must not count as an index deviation. */
static void test_equal_deviations_are_none(void)
{
    chain c = chain_open(models[1], "250 N m"), none = chain_open(models[1], "250 N m");
    double same[50];
    size_t n;
    for (int i = 0; i < 50; i++)
        same[i] = 7e-6;
    stage_set_reals(c.gear, "pitch_error", 50, same);
    stage_set_text(c.gear, "backlash", "0.1 mm");
    stage_set_text(none.gear, "backlash", "0.1 mm");
    stage_set_text(c.mesh, "mesh_cycle", "all");
    chain_run(&c);
    chain_run(&none);
    const double *all = stage_get(c.mesh, "load_share", NULL),
                 *one = stage_get(none.mesh, "load_share", &n);
    double off = 0;
    for (size_t k = 0; k < 50; k++)
        off = fmax(off, largest_difference(all + k * n, one, n));
    check_below("every pair as without", off, 1e-9);
    chain_close(&c);
    c = chain_open(models[1], "250 N m");
    stage_set_reals(c.gear, "pitch_error", 50, same);
    stage_set_text(c.gear, "backlash", "0.1 mm");
    chain_run(&c);
    check_near("nothing is excited", stage_quality(c.mesh, "index_excitation"), 1, 1e-6);
    check_below("no pair is worse", stage_quality(c.mesh, "worst_pair"), 1e-9);
    chain_close(&c);
    chain_close(&none);
    c = open_hunting(models[1], "5", "[8 um]");
    double excited = stage_quality(c.mesh, "index_excitation");
    check_true("one tooth excites", excited > 1.5);
    chain_close(&c);
    c = open_hunting(models[1], "worst", "[8 um]");
    check_near("whichever cycle is shown", stage_quality(c.mesh, "index_excitation"), excited, 0);
    check_near("no pair is worse than the worst", 1 + stage_quality(c.mesh, "worst_pair"), 1, 0);
    chain_close(&c);
}

static void test_measured_profile(void)
{
    char path[] = "/tmp/flankfilm-profile-XXXXXX";
    int descriptor = mkstemp(path);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "w");
    if (!file) {
        check_true("temporary file", 0);
        return;
    }
    /* the linear relief of 10 um from HPSTC, as points */
    fprintf(file, "gear, roll_angle [deg], deviation [um]\n");
    for (int gear = 1; gear <= 2; gear++)
        fprintf(file, "%d, 14, 0\n%d, 21.7368, 0\n%d, 27.1708, -10\n", gear, gear, gear);
    fclose(file);
    chain a = chain_with(models[0], "250 N m", "gear.profile_file", path);
    chain b = chain_with(models[0], "250 N m", "gear.tip_relief", "10 um");
    size_t n;
    const double *x = stage_get(a.mesh, "load_share", &n);
    check_below("shares", largest_difference(x, stage_get(b.mesh, "load_share", NULL), n), 1e-4);
    chain_close(&a);
    chain_close(&b);
    unlink(path);
}

/* A kink in the profile of either flank must be a breakpoint of e in single contact. */
static void test_corner_of_a_profile_is_a_breakpoint(void)
{
    for (int gear = 0; gear < 2; gear++) {
        spur_pair p = spur_pair_make(40, 60, 3e-3, 1, 0, 0);
        double length = (p.base[0] + p.base[1]) * tan(p.working_angle), age = 0.86;
        double at[2] = {p.roll_sap + age * p.pitch};
        at[1] = (length - p.base[0] * at[0]) / p.base[1];
        const double roll[2][3] = {{0, at[0], 1}, {0, at[1], 1}};
        double profile[2][3] = {{0}};
        profile[gear][2] = -20e-6;
        stage *s = stage_open(models[1]);
        feed_path(s, &p);
        feed_teeth(s, &p);
        stage_give(s, "gear.profile_roll", 2, (const size_t[]){2, 3}, roll[0]);
        stage_give(s, "gear.profile_deviation", 2, (const size_t[]){2, 3}, profile[0]);
        check_true("runs", stage_run(s) == FF_OK);
        size_t n;
        const double *phase = stage_get(s, "breakpoints", &n);
        double nearest = 1;
        for (size_t i = 0; i < n; i++)
            nearest = fmin(nearest, fabs(phase[i] - age));
        check_below(gear ? "corner of gear 2" : "corner of gear 1", nearest, 1e-12);
        stage_close(s);
    }
}

static void test_one_index_deviation_for_each_tooth(void)
{
    static const double index[] = {5e-6, 0, 0};
    static const char *const rows[] = {"gear.pitch_deviation_1", "gear.pitch_deviation_2"};
    for (int gear = 0; gear < 2; gear++) {
        spur_pair p = spur_pair_make(40, 60, 3e-3, 1, 0, 0);
        stage *s = stage_open(models[1]);
        feed_path(s, &p);
        feed_teeth(s, &p);
        stage_give_series(s, rows[gear], 3, index);
        check_true("three for a whole gear",
                   stage_run(s) == FF_INVALID && !strcmp(stage_why_item(s), rows[gear]));
        stage_close(s);
    }
}

int main(void)
{
    test_long_relief_unloads_sap();
    test_levels_in_closed_form();
    test_line_and_parabola_share_alike();
    test_unloaded_error_of_relief();
    test_loaded_error();
    test_profile_slope_of_both_gears_cancels();
    test_hunting();
    test_all_cycles();
    test_pressures_with_corner_contact();
    test_equal_deviations_are_none();
    test_measured_profile();
    test_corner_of_a_profile_is_a_breakpoint();
    test_one_index_deviation_for_each_tooth();
    return check_done();
}
