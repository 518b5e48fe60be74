/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <string.h>

static stage *open_pair(const spur_pair *pair)
{
    stage *s = stage_open("stiffness/potential-energy");
    feed_path(s, pair);
    feed_teeth(s, pair);
    return s;
}

static stage *run_pair(const spur_pair *pair)
{
    stage *s = open_pair(pair);
    check_true("the pair runs", stage_run(s) == FF_OK);
    return s;
}

/* Returns the largest stiffness of a single tooth pair, which equal gears have at the pitch
   point. */
static double single_highest(const stage *s)
{
    size_t n;
    const double *k = stage_get(s, "stiffness", &n), *pairs = stage_get(s, "pairs_in_contact", &n);
    double highest = 0;
    for (size_t i = 0; i < n; i++)
        if (pairs[i] < 1.5)
            highest = fmax(highest, k[i]);
    return highest;
}

/* 50/50 teeth, module 3: compares values with those of an independent program, to their digits. Its
   harmonics come from about 400 samples of a function with jumps of 1.4e8 N/m, so that they are
   uncertain by 1.4e8/400 N/m. */
static void test_reference_pair(void)
{
    static const double row[4][8] = {
        /* root, bore mm; single max, ends, mean, harmonics 1 to 3, N/m */
        {71.25, 20, 2.104e8, 1.498e8, 3.317e8, 7.60e7, 4.79e7, 2.26e7},
        {71.25, 25, 2.346e8, 1.616e8, 3.659e8, 8.27e7, 5.17e7, 2.43e7},
        {70.34, 25, 1.939e8, 1.374e8, 3.049e8, 6.96e7, 4.39e7, 2.08e7},
        {70.34, 35, 2.124e8, 1.464e8, 3.311e8, 7.46e7, 4.68e7, 2.21e7},
    };
    for (int i = 0; i < 4; i++) {
        spur_pair p = spur_pair_make(50, 50, 3e-3, 1, 0, 0);
        p.root[0] = p.root[1] = 1e-3 * row[i][0];
        p.bore[0] = p.bore[1] = 1e-3 * row[i][1];
        p.thickness[0] = p.thickness[1] -= 0.07e-3; /* circular backlash 0.14 mm, half on each
                                                       gear */
        stage *s = run_pair(&p);
        const double *harmonic = stage_get(s, "stiffness_harmonics", NULL);
        double ends = stage_get(s, "load_share", NULL)[0] * stage_get(s, "stiffness", NULL)[0];
        check_near("single pair, highest", single_highest(s), row[i][2], 0.001e8 / row[i][2]);
        check_near("single pair at SAP", ends, row[i][3], 0.001e8 / row[i][3]);
        check_near("mean", stage_scalar(s, "stiffness_mean"), row[i][4], 0.001e8 / row[i][4]);
        for (int n = 0; n < 3; n++)
            check_near("harmonic", harmonic[n], row[i][5 + n], 3.5e5 / row[i][5 + n]);
        check_near("harmonic 4", harmonic[3], 7e5, 3.5 / 7);
        check_below("interpolation", stage_quality(s, "interpolation_error"), 1e-4);
        check_below("quadrature", stage_quality(s, "quadrature_error"), 1e-13);
        check_true("trusted", stage_verdict(s) == FF_GOOD);
        stage_close(s);
    }
}

/* A backlash of 0.14 mm on the reference circle must reduce each tooth thickness by 0.07 mm
   there. */
static void test_backlash_thins_the_teeth(void)
{
    spur_pair p = spur_pair_make(50, 50, 3e-3, 1, 0, 0);
    stage *thick = open_pair(&p);
    const double backlash = 0.14e-3 * cos(M_PI / 9);
    stage_give(thick, "gear.backlash", 0, NULL, &backlash);
    stage_run(thick);
    spur_pair q = p;
    q.thickness[0] = q.thickness[1] -= 0.07e-3;
    stage *thin = run_pair(&q);
    check_near("same mean", stage_scalar(thick, "stiffness_mean"),
               stage_scalar(thin, "stiffness_mean"), 1e-13);
    stage_close(thick);
    stage_close(thin);
}

static void test_loads_of_the_pairs_add_up(void)
{
    spur_pair p = spur_pair_make(50, 50, 3e-3, 1, 0, 0);
    stage *s = run_pair(&p);
    size_t n;
    const double *share = stage_get(s, "load_share", &n), *force = stage_get(s, "tooth_force", &n);
    size_t tip = n - 1, low = p.lpstc, high = p.hpstc;
    check_near("leading and trailing pair at the tip", share[low] + share[tip], 1, 1e-13);
    check_near("leading and trailing pair at SAP", share[0] + share[high + 1], 1, 1e-13);
    for (size_t i = low + 1; i <= high; i++)
        check_near("alone between LPSTC and HPSTC", share[i], 1, 1e-14);
    for (size_t i = 0; i < n; i++)
        check_near("force", force[i], share[i] * p.line_force, 1e-14);
    check_true("two pairs share", share[0] > 0.3 && share[low] < 0.7);
    check_below("equilibrium", stage_quality(s, "equilibrium"), 1e-14);
    stage_close(s);
}

static void test_unity_pair_is_symmetric(void)
{
    spur_pair p = spur_pair_make(50, 50, 3e-3, 1, 0, 0);
    stage *s = run_pair(&p);
    size_t n, last = PAIR_STATIONS - 1;
    const double *share = stage_get(s, "load_share", NULL);
    for (size_t i = 0; i <= last; i++)
        check_near("share mirrored", share[i], share[last - i], 1e-12);
    const double *phase = stage_get(s, "phase", &n), *k = stage_get(s, "stiffness", NULL);
    size_t out = 0;
    while (phase[out + 1] > phase[out])
        out++;
    check_near("k when a pair enters and when one leaves", k[0], k[out], 1e-12);
    check_near("the same in single contact", k[n - 1], k[out + 1], 1e-12);
    stage_close(s);
}

static void test_swapped_gears_run_backwards(void)
{
    spur_pair p = spur_pair_make(23, 57, 2e-3, 1, 0.25, -0.1);
    p.modulus[1] = 110e9;
    p.poisson[1] = 0.27;
    spur_pair q = spur_pair_swap(&p);
    stage *a = run_pair(&p), *b = run_pair(&q);
    const double *here = stage_get(a, "load_share", NULL),
                 *there = stage_get(b, "load_share", NULL);
    for (size_t i = 0; i < PAIR_STATIONS; i++)
        check_near("share", here[i], there[PAIR_STATIONS - 1 - i], 1e-11);
    check_near("mean", stage_scalar(a, "stiffness_mean"), stage_scalar(b, "stiffness_mean"), 1e-5);
    check_near("single pair", single_highest(a), single_highest(b), 1e-4);
    stage_close(a);
    stage_close(b);
}

static void test_scaling(void)
{
    spur_pair p = spur_pair_make(23, 57, 2e-3, 1, 0, 0),
              big = spur_pair_make(23, 57, 8e-3, 1, 0, 0);
    spur_pair wide = p;
    wide.width *= 3;
    stage *a = run_pair(&p), *b = run_pair(&big), *c = run_pair(&wide);
    double mean = stage_scalar(a, "stiffness_mean");
    check_near("the module does not matter", stage_scalar(b, "stiffness_mean"), mean, 1e-12);
    check_near("stiffness grows with the face width", stage_scalar(c, "stiffness_mean"), 3 * mean,
               1e-12);
    stage_close(a);
    stage_close(b);
    stage_close(c);
}

static void test_transmission_errors(void)
{
    spur_pair p = spur_pair_make(50, 50, 3e-3, 1, 0, 0);
    stage *s = run_pair(&p);
    size_t n;
    const double *k = stage_get(s, "stiffness", &n);
    const double *loaded = stage_get(s, "loaded_transmission_error", NULL);
    const double *unloaded = stage_get(s, "transmission_error", NULL);
    double worst = 0, largest = 0;
    for (size_t i = 0; i < n; i++) {
        worst = fmax(worst, fabs(loaded[i] * k[i] / p.line_force - 1));
        largest = fmax(largest, fabs(unloaded[i]));
    }
    check_below("e_l = F/k", worst, 1e-14);
    check_below("perfect involutes", largest, 0);
    stage_close(s);
}

static void test_cycle(void)
{
    spur_pair p = spur_pair_make(50, 50, 3e-3, 1, 0, 0);
    stage *s = run_pair(&p);
    size_t n, breaks, twice = 0;
    const double *phase = stage_get(s, "phase", &n), *k = stage_get(s, "stiffness", NULL);
    const double *pairs = stage_get(s, "pairs_in_contact", NULL);
    const double *at = stage_get(s, "breakpoints", &breaks);
    check_true("entry and exit", breaks == 2 && !(at[0] > 0));
    check_near("exit", at[1], p.contact_ratio - 1, 1e-14);
    check_true("from 0 to 1", !(phase[0] > 0) && !(phase[n - 1] < 1) && n == 203);
    for (size_t i = 1; i < n; i++)
        if (!(phase[i] > phase[i - 1])) {
            twice++;
            check_near("the jump is the exit", phase[i], at[1], 1e-14);
            check_true("a pair is lost", pairs[i - 1] > 1.5 && pairs[i] < 1.5 && k[i] < k[i - 1]);
        }
    check_true("one jump inside", twice == 1);
    stage_close(s);
}

static void test_high_contact_ratio(void)
{
    spur_pair p = spur_pair_make(60, 60, 3e-3, 1.35, 0, 0);
    stage *s = run_pair(&p);
    check_true("between 2 and 3", p.contact_ratio > 2.1 && p.contact_ratio < 2.9);
    size_t n, breaks;
    const double *phase = stage_get(s, "phase", &n),
                 *pairs = stage_get(s, "pairs_in_contact", NULL);
    const double *at = stage_get(s, "breakpoints", &breaks);
    double worst = 0;
    for (size_t i = 0; i < n; i++) {
        int before = phase[i] < at[1] || (phase[i] <= at[1] && !(phase[i - 1] >= at[1]));
        worst = fmax(worst, fabs(pairs[i] - (before ? 3 : 2)));
    }
    check_near("exit of the third pair", at[1], p.contact_ratio - 2, 1e-13);
    check_below("three pairs, then two", worst, 0);
    check_below("equilibrium", stage_quality(s, "equilibrium"), 1e-14);
    check_true("no pair alone", stage_get(s, "load_share", NULL)[PAIR_STATIONS / 2] < 0.8);
    stage_close(s);
}

/* With straight lines between points, the error of the mean decreases with the square of their
   number. */
static void test_mean_converges(void)
{
    spur_pair p = spur_pair_make(23, 57, 2e-3, 1, 0, 0);
    double mean[4];
    static const double points[4] = {20, 40, 80, 5120};
    for (int i = 0; i < 4; i++) {
        stage *s = open_pair(&p);
        stage_set(s, "points", points[i]);
        stage_run(s);
        mean[i] = stage_scalar(s, "stiffness_mean");
        stage_close(s);
    }
    double order = log2((mean[0] - mean[3]) / (mean[1] - mean[3]));
    check_near("order", order, 2, 0.1);
    check_below("200 points would do", fabs(mean[2] / mean[3] - 1), 1e-4);
}

/* In plane strain, E/(1-nu^2) in bending and compression only must increase the stiffness by less
   than 1/(1-nu^2). */
static void test_plane_strain_is_stiffer(void)
{
    spur_pair p = spur_pair_make(50, 50, 3e-3, 1, 0, 0);
    stage *s = open_pair(&p), *stress = run_pair(&p);
    stage_set_text(s, "plane", "strain");
    stage_run(s);
    double ratio = stage_scalar(s, "stiffness_mean") / stage_scalar(stress, "stiffness_mean");
    check_true("1 < ratio < 1/(1-nu^2)", ratio > 1.001 && ratio < 1 / 0.91);
    stage_close(s);
    stage_close(stress);
}

static void test_rim(void)
{
    spur_pair p = spur_pair_make(50, 50, 3e-3, 1, 0, 0);
    stage *bore = run_pair(&p); /* half the root radius */
    p.bore[0] = p.bore[1] = 0;
    stage *none = run_pair(&p);
    check_near("no bore: half the root radius", stage_scalar(none, "stiffness_mean"),
               stage_scalar(bore, "stiffness_mean"), 1e-13);
    stage *stated = open_pair(&p);
    stage_set(stated, "rim_radius", p.root[0] / 2);
    stage_run(stated);
    check_near("stated", stage_scalar(stated, "stiffness_mean"),
               stage_scalar(bore, "stiffness_mean"), 1e-13);
    stage *shaft = open_pair(&p);
    stage_set(shaft, "rim_radius", p.root[0] / 12);
    check_true("a thin shaft runs", stage_run(shaft) == FF_OK);
    check_true("but is doubted", stage_verdict(shaft) == FF_DOUBTFUL);
    stage *needle = open_pair(&p);
    stage_set_text(needle, "rim_radius", "1 um");
    check_true("so is a needle", stage_run(needle) == FF_OK && stage_verdict(needle) > FF_GOOD);
    check_true("its stiffness stays positive", stage_scalar(needle, "stiffness_mean") > 0);
    stage *mixed = open_pair(&p);
    stage_set_text(mixed, "rim_radius", "[20 mm, 35 mm]");
    check_true("two radii", stage_run(mixed) == FF_OK);
    stage_close(bore);
    stage_close(none);
    stage_close(stated);
    stage_close(shaft);
    stage_close(needle);
    stage_close(mixed);
}

static void expect_refusal(const char *what, stage *s, const char *item, const char *word)
{
    check_true(what, stage_run(s) < 0);
    check_true(item, !strcmp(stage_why_item(s), item));
    check_true(word, strstr(stage_why(s), word) != NULL);
    stage_close(s);
}

static void test_refusals(void)
{
    spur_pair good = spur_pair_make(50, 50, 3e-3, 1, 0, 0), p = good;
    p.thickness[1] = 0.3e-3;
    expect_refusal("pointed", open_pair(&p), "gear.tooth_thickness", "gear 2");
    p = good;
    p.root[0] = 0.074;
    expect_refusal("no flank at SAP", open_pair(&p), "gear.root_radius", "involute begins");
    p = good;
    p.bore[1] = 0.08;
    expect_refusal("no rim", open_pair(&p), "gear.bore_radius", "gear 2");
    p = good;
    p.roll_tip = p.roll_sap + 0.9 * p.pitch;
    expect_refusal("contact ratio below 1", open_pair(&p), "gear.roll_tip", "0.9");
    p = good;
    p.line_force = NAN;
    expect_refusal("no force", open_pair(&p), "operating.line_force", "finite");
    p = good;
    p.modulus[1] = 0;
    expect_refusal("no elasticity", open_pair(&p), "gear.elastic_modulus", "gear 2");
    p = good;
    p.poisson[0] = 0.7;
    expect_refusal("Poisson's ratio", open_pair(&p), "gear.poisson_ratio", "0.7");
    p = good;
    p.roll[3] = p.roll[1];
    expect_refusal("falling stations", open_pair(&p), "gear.roll_angle", "number 4");
    p = good;
    stage *s = open_pair(&p);
    stage_set_text(s, "rim_radius", "72 mm");
    expect_refusal("rim outside the root", s, "rim_radius", "root radius");
    p = good;
    s = open_pair(&p);
    const double backlash = 0.02;
    stage_give(s, "gear.backlash", 0, NULL, &backlash);
    expect_refusal("too much backlash", s, "gear.backlash", "no tooth");
}

static void test_no_load(void)
{
    spur_pair p = spur_pair_make(50, 50, 3e-3, 1, 0, 0);
    p.line_force = 0;
    stage *s = run_pair(&p);
    check_true("forces vanish", !(stage_get(s, "tooth_force", NULL)[5] > 0));
    check_true("errors vanish", !(stage_get(s, "loaded_transmission_error", NULL)[5] > 0));
    check_true("stiffness stays", stage_scalar(s, "stiffness_mean") > 3e8);
    stage_close(s);
}

static void test_only_what_is_wanted(void)
{
    spur_pair p = spur_pair_make(50, 50, 3e-3, 1, 0, 0);
    stage *s = open_pair(&p);
    check_true("runs", stage_run_wanted(s, "stiffness_mean") == FF_OK);
    check_true("the mean alone", stage_has(s, "stiffness_mean") && !stage_has(s, "tooth_force"));
    stage_close(s);
    s = open_pair(&p);
    stage_stop_at(s, 1);
    check_true("stops on request", stage_run(s) == FF_STOPPED);
    stage_close(s);
}

int main(void)
{
    test_reference_pair();
    test_backlash_thins_the_teeth();
    test_loads_of_the_pairs_add_up();
    test_unity_pair_is_symmetric();
    test_swapped_gears_run_backwards();
    test_scaling();
    test_transmission_errors();
    test_cycle();
    test_high_contact_ratio();
    test_mean_converges();
    test_plane_strain_is_stiffer();
    test_rim();
    test_refusals();
    test_no_load();
    test_only_what_is_wanted();
    return check_done();
}
