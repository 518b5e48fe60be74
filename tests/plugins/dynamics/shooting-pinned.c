/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares dynamics/shooting, on both branches of the trapezoid, with states from another program:
   Taylor series between located changes of contact, which agreed with the integrators rk8pd and
   CVODE. Lengths over b, times in 1/omega_n; the tolerance is that of the digits below. Also checks
   Abel's identity, the energy balance and the folds. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct state {
    double frequency;
    const char *branch;
    double x, v, rms, max, min, trace;
} state;

static const state states[] = {
    {1250, "lower", 1.198731434212, -0.001317327864, 0.050672794, 1.203284948, 1.056575059,
     -1.467587},
    {1250, "upper", 0.708143483454, 0.135857534234, 0.279404724, 1.470330295, 0.641744455,
     -0.473438},
    {2085, "lower", 1.074351380398, 0.000997534206, 0.035480264, 1.184768220, 1.074343172,
     -1.764837},
    {2085, "upper", 0.708039437535, -0.332093688261, 0.434968749, 1.581491607, 0.328294580,
     0.513675},
    {2375, "lower", 1.072040675418, -0.000504040113, 0.040979614, 1.187142845, 1.072038629,
     -1.187265},
    {2375, "upper", 0.954737027532, -0.327082501914, 0.318365320, 1.492383334, 0.586197883,
     0.813724},
    {3240, "lower", 1.255775179528, -0.127595931649, 0.126595617, 1.305320012, 0.950361622,
     1.526132},
    {3240, "upper", 1.255775179528, -0.127595931649, 0.126595617, 1.305320012, 0.950361622,
     1.526132},
};

static void check_value(const state *pin, const char *what, double value, double expected,
                        double tolerance)
{
    char name[64];
    snprintf(name, sizeof name, "%g Hz %s %s", pin->frequency, pin->branch, what);
    check_below(name, fabs(value - expected), tolerance);
}

static void check_state(const state *pin)
{
    double b = 70e-6, omega = 2 * M_PI * pair_natural_frequency, low = 1e9, high = -1e9;
    pair p = pair_trapezoid(pin->frequency);
    stage *s = pair_open("dynamics/shooting", &p);
    stage_set_text(s, "branch", pin->branch);
    stage_set_text(s, "steps_per_cycle", "2048");
    check_true("runs",
               stage_run_wanted(s, "dte dte_velocity dte_rms dte_harmonics multipliers period") ==
                   FF_OK);
    check_true("is trusted", stage_verdict(s) == FF_GOOD);
    size_t count;
    const double *dte = stage_get(s, "dte", &count), *mu = stage_get(s, "multipliers", NULL);
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, dte[i] / b);
        high = fmax(high, dte[i] / b);
    }
    check_value(pin, "x(0)", dte[0] / b, pin->x, 1e-8);
    check_value(pin, "v(0)", stage_get(s, "dte_velocity", NULL)[0] / b / omega, pin->v, 1e-8);
    check_value(pin, "rms", stage_scalar(s, "dte_rms") / b, pin->rms, 1e-8);
    check_value(pin, "max", high, pin->max, 1e-8);
    check_value(pin, "min", low, pin->min, 1e-8);
    check_value(pin, "trace", mu[0] + mu[2], pin->trace, 1e-6);
    double det = mu[0] * mu[2] - mu[1] * mu[3];
    check_near("det M", det, exp(-0.04 * M_PI * pair_natural_frequency / pin->frequency), 1e-12);
    check_below("det by steps", stage_quality(s, "determinant"), 1e-12);
    check_below("energy balance", stage_quality(s, "energy_balance"), 1e-12);
    check_near("period", stage_scalar(s, "period"), 1, 0);
    /* Parseval; harmonics beyond the 16th are small */
    double power = 0;
    const double *amplitude = stage_get(s, "dte_harmonics", &count);
    for (size_t i = 0; i < count; i++)
        power += amplitude[i] * amplitude[i] / 2;
    check_near("harmonics make up the rms", sqrt(power), stage_scalar(s, "dte_rms"), 1e-6);
    stage_close(s);
}

static int has_near(const double *values, size_t count, double value, double within)
{
    for (size_t i = 0; i < count; i++)
        if (fabs(values[i] - value) <= within)
            return 1;
    return 0;
}

static stage *open_atlas(const pair *p, const char *arc_step)
{
    stage *s = pair_open("dynamics/shooting", p);
    stage_set(s, "atlas.from", 400);
    stage_set(s, "atlas.to", 4500);
    stage_set(s, "max_period", 1);
    stage_set(s, "search_starts", 0);
    stage_set_text(s, "arc_step", arc_step);
    check_true("runs", stage_run_wanted(s, "atlas_frequency atlas_branch fold_frequency "
                                           "doubling_frequency") == FF_OK);
    check_below("no end is lost", stage_quality(s, "atlas_lost_ends"), 0.5);
    return s;
}

/* Compares folds with those of the other program, to its accuracy of 1 Hz, and between two step
   lengths of ratio 4. */
static void test_folds(void)
{
    static const double folds[] = {527, 428,  796, 734,  1034, 544,   1480,
                                   734, 1080, 750, 2848, 1370, 1450.5};
    pair p = pair_trapezoid(2375);
    stage *coarse = open_atlas(&p, "0.08"), *fine = open_atlas(&p, "0.02");
    const char *outputs[] = {"fold_frequency", "doubling_frequency"};
    for (int k = 0; k < 2; k++) {
        size_t a, z;
        const double *f = stage_get(coarse, outputs[k], &a), *g = stage_get(fine, outputs[k], &z);
        check_near("the same number by 4 times shorter steps", (double)a, (double)z, 0);
        for (size_t i = 0; i < a && a == z; i++)
            check_near(outputs[k], f[i], g[i], 1e-7);
        for (size_t i = 0; k == 0 && i < sizeof folds / sizeof folds[0]; i++) {
            char name[32];
            snprintf(name, sizeof name, "fold at %g Hz", folds[i]);
            check_true(name, has_near(g, z, folds[i], 1));
        }
    }
    stage_close(coarse);
    stage_close(fine);
}

/* A stiffness that jumps at phase 0 does work there, at the border of two cycles: the work must
   balance the loss in the damper, with and without separation. */
static void check_jump_at_start(void)
{
    const char *const branches[] = {"lower", "upper"};
    for (int i = 0; i < 2; i++) {
        pair p = pair_trapezoid(2375);
        double phase[] = {0, 0.7, 0.7, 1}, stiffness[] = {4.2e8, 4e8, 2.6e8, 2.8e8};
        p.phases = 4;
        memcpy(p.phase, phase, sizeof phase);
        memcpy(p.stiffness, stiffness, sizeof stiffness);
        p.stiffness_mean = pair_mean(&p);
        stage *s = pair_open("dynamics/shooting", &p);
        stage_set_text(s, "branch", branches[i]);
        check_true("runs", stage_run_wanted(s, "excitation_power damper_loss period") == FF_OK);
        check_near("work of a jump at phase 0", stage_scalar(s, "excitation_power"),
                   stage_scalar(s, "damper_loss"), 1e-9);
        stage_close(s);
    }
}

int main(void)
{
    for (size_t i = 0; i < sizeof states / sizeof states[0]; i++)
        check_state(&states[i]);
    test_folds();
    check_jump_at_start();
    return check_done();
}
