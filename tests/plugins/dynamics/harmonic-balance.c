/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares dynamics/harmonic-balance with states from other solvers, and with integration in
   time. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Runs with all outputs except the atlas. */
static ff_status run_motion(stage *s)
{
    return stage_run_wanted(
        s, "phase dte dte_velocity mesh_force dte_rms dte_mean dte_peak_to_peak tooth_force gap "
           "dynamic_factor_tooth dynamic_factor_mesh contact_loss back_contact natural_frequency "
           "period floquet_max multipliers");
}

static stage *run(const pair *p, const char *model, const char *settings)
{
    stage *s = pair_open(model, p);
    char copy[256], *at = NULL;
    snprintf(copy, sizeof copy, "%s", settings);
    for (char *word = strtok_r(copy, " =", &at); word; word = strtok_r(NULL, " =", &at))
        stage_set_text(s, word, strtok_r(NULL, " =", &at));
    check_true(settings, run_motion(s) == FF_OK);
    return s;
}

typedef struct state {
    double frequency;
    const char *branch;
    double x, v, rms, max, min, trace, det;
} state;

/* States from exact solutions between changes of contact; lengths over b, times in 1/omega_n. */
static const state states[] = {
    {1250, "lower", 1.198731434212, -0.001317327864, 0.050672794, 1.203284948, 1.056575059,
     -1.467587, 0.721861932},
    {1250, "upper", 0.708143483454, 0.135857534234, 0.279404724, 1.470330295, 0.641744455,
     -0.473438, 0.721861932},
    {2085, "lower", 1.074351380398, 0.000997534206, 0.035480264, 1.184768220, 1.074343172,
     -1.764837, 0.822508456},
    {2085, "upper", 0.708039437535, -0.332093688261, 0.434968749, 1.581491607, 0.328294580,
     0.513675, 0.822508456},
    {2375, "lower", 1.072040675418, -0.000504040113, 0.040979614, 1.187142845, 1.072038629,
     -1.187265, 0.842368617},
    {2375, "upper", 0.954737027532, -0.327082501914, 0.318365320, 1.492383334, 0.586197883,
     0.813724, 0.842368617},
    {3240, "lower", 1.255775179528, -0.127595931649, 0.126595617, 1.305320012, 0.950361622,
     1.526132, 0.881842971},
    {3240, "upper", 1.255775179528, -0.127595931649, 0.126595617, 1.305320012, 0.950361622,
     1.526132, 0.881842971},
};

static void check_value(const state *pin, const char *what, double value, double expected,
                        double tolerance)
{
    char name[64];
    snprintf(name, sizeof name, "%g Hz %s %s", pin->frequency, pin->branch, what);
    check_below(name, fabs(value - expected), tolerance);
}

/* Since the force has kinks, the harmonics of s decrease as n^-4; with 80 harmonics, the error is
   80^-3/3 of the kink: 1e-6 in s, and larger by a factor of 80 in the derivative. */
static void check_pinned(const state *pin, const char *settings, double tolerance)
{
    char all[128];
    snprintf(all, sizeof all, "branch=%s steps_per_cycle=2048 %s", pin->branch, settings);
    pair p = pair_trapezoid(pin->frequency);
    stage *s = run(&p, "dynamics/harmonic-balance", all);
    double b = 70e-6, omega = 2 * M_PI * pair_natural_frequency, low = 1e9, high = -1e9;
    size_t count;
    const double *dte = stage_get(s, "dte", &count), *mu = stage_get(s, "multipliers", NULL);
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, dte[i] / b);
        high = fmax(high, dte[i] / b);
    }
    check_value(pin, "x(0)", dte[0] / b, pin->x, tolerance);
    check_value(pin, "v(0)", stage_get(s, "dte_velocity", NULL)[0] / b / omega, pin->v,
                10 * tolerance);
    check_value(pin, "rms", stage_scalar(s, "dte_rms") / b, pin->rms, tolerance);
    check_value(pin, "max", high, pin->max, tolerance);
    check_value(pin, "min", low, pin->min, tolerance);
    check_value(pin, "trace", mu[0] + mu[2], pin->trace, 100 * tolerance);
    check_value(pin, "det", mu[0] * mu[2] - mu[1] * mu[3], pin->det, 1e-8);
    check_near("period", stage_scalar(s, "period"), 1, 0);
    stage_close(s);
}

/* With the number of harmonics chosen by the model, the error must be within the estimate. */
static void test_chosen_harmonics(void)
{
    double before = 1;
    for (int i = 4; i <= 8; i += 2) {
        char settings[64];
        snprintf(settings, sizeof settings, "branch=upper tolerance=1e-%d", i);
        pair p = pair_trapezoid(2375);
        stage *s = run(&p, "dynamics/harmonic-balance", settings);
        double off = fabs(stage_scalar(s, "dte_rms") / 70e-6 - 0.318365320) / 0.1408;
        check_below("error of the rms over its estimate and the digits of the pin", off,
                    stage_quality(s, "state_error") + 5e-9);
        check_below("neglected harmonics", stage_quality(s, "neglected_harmonics"),
                    1.01 * pow(10, -i));
        check_true("the estimate falls", stage_quality(s, "state_error") < before);
        before = stage_quality(s, "state_error");
        stage_close(s);
    }
}

/* The model must use more samples than requested if the harmonics would be aliased. */
static void test_few_samples(void)
{
    pair p = pair_trapezoid(2375);
    stage *few = run(&p, "dynamics/harmonic-balance", "branch=upper tolerance=1e-5 samples=16");
    stage *preset = run(&p, "dynamics/harmonic-balance", "branch=upper tolerance=1e-5");
    check_near("rms", stage_scalar(few, "dte_rms"), stage_scalar(preset, "dte_rms"), 1e-12);
    stage_close(few);
    stage_close(preset);
}

/* Smooth stiffness, linear between 256 points, with and without loss of contact. */
static void test_against_time(double frequency, const char *branch, double stiffness_1,
                              double error_1, int loses_contact)
{
    char settings[128];
    pair p = pair_cosine(frequency, stiffness_1, error_1, 256);
    snprintf(settings, sizeof settings, "branch=%s tolerance=1e-8", branch);
    stage *series = run(&p, "dynamics/harmonic-balance", settings);
    snprintf(settings, sizeof settings, "branch=%s tolerance=1e-11 settle_tolerance=1e-10", branch);
    stage *time = run(&p, "dynamics/time-integration", settings);
    size_t count, other;
    const double *a = stage_get(series, "dte", &count), *z = stage_get(time, "dte", &other);
    const double *f = stage_get(series, "mesh_force", NULL),
                 *g = stage_get(time, "mesh_force", NULL);
    double worst = 0, force = 0, unit = p.backlash / 2;
    for (size_t i = 0; i < count && count == other; i++) {
        worst = fmax(worst, fabs(a[i] - z[i]) / unit);
        force = fmax(force, fabs(f[i] - g[i]) / p.line_force);
    }
    printf("%g Hz, %s\n", frequency, branch);
    check_true("same points", count == other);
    check_below("difference of the motion over b", worst, 1e-6);
    check_below("difference of the force over F", force, 1e-5);
    check_near("rms", stage_scalar(series, "dte_rms"), stage_scalar(time, "dte_rms"), 1e-6);
    check_below("contact loss",
                fabs(stage_scalar(series, "contact_loss") - stage_scalar(time, "contact_loss")),
                1e-6);
    check_below("largest multiplier",
                fabs(stage_scalar(series, "floquet_max") - stage_scalar(time, "floquet_max")),
                1e-5);
    check_true("loses contact", (stage_scalar(series, "contact_loss") > 0.1) == loses_contact);
    check_near("same tooth factor", stage_scalar(series, "dynamic_factor_tooth"),
               stage_scalar(time, "dynamic_factor_tooth"), 1e-5);
    stage_close(series);
    stage_close(time);
}

int main(void)
{
    for (size_t i = 0; i < sizeof states / sizeof states[0]; i++)
        check_pinned(&states[i], "harmonics=80", 1e-5);
    check_pinned(&states[5], "tolerance=1e-8", 1e-8);
    test_chosen_harmonics();
    test_few_samples();
    test_against_time(2375, "lower", 0.2, 0, 0);
    test_against_time(2375, "upper", 0.2, 0, 1);
    test_against_time(2600, "upper", 0.1, -1e-6, 1);
    test_against_time(3240, "lower", 0.15, 0, 1);
    test_against_time(4100, "lower", 0.2, 3e-6, 0);
    return check_done();
}
