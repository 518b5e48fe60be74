/* SPDX-License-Identifier: GPL-3.0-or-later */
/* dynamics/time-integration: closed forms and invariants. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static stage *run(const pair *p, const char *settings)
{
    stage *s = pair_open("dynamics/time-integration", p);
    char copy[256], *at = NULL;
    snprintf(copy, sizeof copy, "%s", settings);
    for (char *word = strtok_r(copy, " =", &at); word; word = strtok_r(NULL, " =", &at))
        stage_set_text(s, word, strtok_r(NULL, " =", &at));
    check_true(settings, stage_run(s) == FF_OK);
    return s;
}

/* Constant stiffness: no vibration, with the flanks at b + F/k. */
static void test_rest(void)
{
    pair p = pair_cosine(2000, 0, 0, 8);
    stage *s = run(&p, "");
    double rest = p.backlash / 2 + p.line_force / p.stiffness_mean;
    check_near("rest", stage_scalar(s, "dte_mean"), rest, 1e-13);
    check_below("rms at rest", stage_scalar(s, "dte_rms") / rest, 1e-13);
    check_near("force at rest", stage_get(s, "mesh_force", NULL)[7], p.line_force, 1e-11);
    check_near("mesh factor", stage_scalar(s, "dynamic_factor_mesh"), 1, 1e-11);
    check_near("tooth factor", stage_scalar(s, "dynamic_factor_tooth"), 1, 1e-11);
    check_near("natural frequency", stage_scalar(s, "natural_frequency"), pair_natural_frequency,
               1e-12);
    check_near("period", stage_scalar(s, "period"), 1, 0);
    /* eigenvalues of the linear oscillator: -zeta +- i sqrt(1 - zeta^2) */
    double T = 2 * M_PI * pair_natural_frequency / 2000;
    check_near("multiplier", stage_scalar(s, "floquet_max"), exp(-0.01 * T), 1e-8);
    check_near("its angle", stage_get(s, "multipliers", NULL)[0],
               exp(-0.01 * T) * cos(T * sqrt(1 - 1e-4)), 1e-7);
    stage_close(s);
}

/* If a motion is good, every quality line must be within its limit. */
static void test_limits(void)
{
    static const char *const lines[] = {"energy_balance", "determinant", "state_error",
                                        "periodicity", "stability"};
    pair p = pair_trapezoid(2600);
    stage *s = run(&p, "");
    check_true("trusted", pair_is_trusted(s));
    for (int i = 0; i < 5; i++)
        check_below(lines[i], stage_quality(s, lines[i]), stage_quality_limit(s, lines[i]));
    stage_close(s);
}

/* First order in a: delta = F/k (1 - a cos(w t - angle)/sqrt((1 - r^2)^2 + (2 zeta r)^2)). */
static void test_small_stiffness_variation(void)
{
    const double a = 1e-5, ratios[] = {0.4, 0.9, 1.0, 1.7};
    for (int i = 0; i < 4; i++) {
        double r = ratios[i], gain = 1 / hypot(1 - r * r, 2 * 0.01 * r);
        pair p = pair_cosine(r * pair_natural_frequency, a, 0, 512);
        stage *s = run(&p, "tolerance=1e-13 settle_tolerance=1e-11");
        check_near("rms of the linear response", stage_scalar(s, "dte_rms"),
                   p.line_force / p.stiffness_mean * a * gain / sqrt(2), 1e-3);
        check_near("without contact loss", stage_scalar(s, "contact_loss"), 0, 0);
        stage_close(s);
    }
}

/* Constant k: s/e = (1 + 2 i zeta r)/(1 - r^2 + 2 i zeta r). With straight lines, the first
   harmonic of e is smaller by the fraction (2 pi/n)^2/12. */
static void test_displacement_excitation(void)
{
    const double zetas[] = {0.01, 0.3}, ratios[] = {0.5, 1.0, 2.0};
    for (int i = 0; i < 6; i++) {
        double zeta = zetas[i / 3], r = ratios[i % 3];
        pair p = pair_cosine(r * pair_natural_frequency, 0, 1e-7, 1024);
        stage *s = pair_open("dynamics/time-integration", &p);
        stage_set(s, "damping_ratio", zeta);
        check_true("runs", stage_run(s) == FF_OK);
        double gain = hypot(1, 2 * zeta * r) / hypot(1 - r * r, 2 * zeta * r);
        check_near("rms of s", stage_scalar(s, "dte_rms"), 1e-7 * gain / sqrt(2), 2e-5);
        check_near("peak to peak", stage_scalar(s, "dte_peak_to_peak"), 2e-7 * gain, 5e-5);
        check_below("energy balance", stage_quality(s, "energy_balance"), 1e-9);
        stage_close(s);
    }
}

/* Far below resonance, inertia changes the motion by r^2 only. The straight lines follow each other
   at 5 times the natural frequency. */
static void test_low_frequency(void)
{
    pair p = pair_cosine(pair_natural_frequency / 200, 0.2, -2e-6, 1024);
    double loaded[PAIR_MAX_PHASES];
    for (size_t i = 0; i < p.phases; i++)
        loaded[i] = p.error[i] + p.line_force / p.stiffness[i];
    stage *still = pair_open("dynamics/quasi-static", &p), *s = run(&p, "");
    stage_give_series(still, "stiffness.loaded_transmission_error", p.phases, loaded);
    check_true("quasi-static runs", stage_run(still) == FF_OK);
    const char *names[] = {"dte_rms", "dte_mean", "dte_peak_to_peak", "dynamic_factor_tooth"};
    for (int i = 0; i < 4; i++)
        check_near(names[i], stage_scalar(s, names[i]), stage_scalar(still, names[i]), 3e-4);
    stage_close(s);
    stage_close(still);
}

/* det M must be exp(-2 zeta t), t: time in which the damper acts; the work done must be the energy
   lost. */
static void test_invariants(void)
{
    const char *dampings[] = {"always", "contact", "clipped"};
    for (int i = 0; i < 3; i++) {
        pair p = pair_trapezoid(2375);
        char settings[64];
        snprintf(settings, sizeof settings, "branch=upper damping=%s", dampings[i]);
        stage *s = run(&p, settings);
        double T = 2 * M_PI * pair_natural_frequency / p.mesh_frequency;
        double acts = i ? 1 - stage_scalar(s, "contact_loss") : 1;
        const double *mu = stage_get(s, "multipliers", NULL);
        check_near("determinant", mu[0] * mu[2] - mu[1] * mu[3], exp(-0.02 * T * acts), 1e-8);
        check_below("energy balance", stage_quality(s, "energy_balance"), 1e-9);
        check_true("loses contact", stage_scalar(s, "contact_loss") > 0.5);
        check_near("period", stage_scalar(s, "period"), 1, 0);
        check_true("is trusted", pair_is_trusted(s));
        stage_close(s);
    }
}

/* While the flanks are separated, v' must be F/m, or with damping F/m - 2 zeta omega v. */
static void test_flight(void)
{
    for (int damped = 0; damped < 2; damped++) {
        pair p = pair_trapezoid(2375);
        stage *s = run(&p, damped ? "branch=upper" : "branch=upper damping=contact");
        size_t count, flights = 0;
        const double *phase = stage_get(s, "phase", &count);
        const double *dte = stage_get(s, "dte", NULL), *v = stage_get(s, "dte_velocity", NULL);
        double omega = 2 * M_PI * pair_natural_frequency, worst = 0;
        for (size_t i = 0; i + 1 < count; i++) {
            if (!(dte[i] < 0.5 * p.backlash && dte[i + 1] < 0.5 * p.backlash))
                continue;
            double t = (phase[i + 1] - phase[i]) / p.mesh_frequency, c = 0.02 * omega * damped;
            double a = p.line_force / p.mass - c * v[i];
            double change = damped ? -expm1(-c * t) / c * a : a * t;
            worst = fmax(worst, fabs(v[i + 1] - v[i] - change) / fabs(a * t));
            flights++;
        }
        check_true("flies", flights > 100);
        check_below("error of the flight", worst, 1e-9);
        stage_close(s);
    }
}

/* The forces of both tooth pairs at a phase must add up to the mesh force; if the period is two
   mesh cycles, the second pair is in the row before. */
static void test_tooth_force(double frequency, size_t period)
{
    pair p = pair_trapezoid(frequency);
    stage *s = run(&p, "steps_per_cycle=500");
    uint32_t rank;
    const size_t *shape = stage_shape(s, "tooth_force", &rank);
    check_near("period", stage_scalar(s, "period"), (double)period, 0);
    check_true("rank", rank == (period > 1 ? 2 : 1) && shape[0] == (rank > 1 ? period : 11));
    size_t count;
    const double *w = stage_get(s, "tooth_force", NULL), *dmf = stage_get(s, "mesh_force", &count);
    const double *gap = stage_get(s, "gap", NULL), *dte = stage_get(s, "dte", NULL);
    check_near("points", (double)count, 500 * (double)period + 1, 0);
    for (size_t row = 0; row < period; row++) {
        const double *young = &w[row * PAIR_STATIONS];
        const double *old = &w[(row + period - 1) % period * PAIR_STATIONS];
        check_near("two pairs at 0.3", young[1] + old[8], dmf[row * 500 + 150], 1e-6);
        check_near("two pairs at 0.5", young[2] + old[9], dmf[row * 500 + 250], 1e-6);
        check_near("one pair at 0.9", young[5], dmf[row * 500 + 450], 1e-6);
        check_near("pairs at SAP", young[0] + old[7], dmf[row * 500], 1e-6);
        check_near("gap", gap[row * PAIR_STATIONS], fmax(0, p.backlash / 2 - dte[row * 500]), 1e-9);
    }
    stage_close(s);
}

/* A stiffness with jumps: the tooth force must jump where the number of pairs changes. */
static void test_step_stiffness(void)
{
    pair p = pair_trapezoid(4200);
    double phase[] = {0, 0.755, 0.755, 1}, k[] = {1.1, 1.1, 0.7, 0.7};
    p.phases = 4;
    for (size_t i = 0; i < 4; i++) {
        p.phase[i] = phase[i];
        p.stiffness[i] = k[i] * 3.6e8;
    }
    p.stiffness_mean = pair_mean(&p);
    stage *s = run(&p, "");
    const double *w = stage_get(s, "tooth_force", NULL), *dmf = stage_get(s, "mesh_force", NULL);
    const double *at = stage_get(s, "phase", NULL);
    size_t i = 0;
    while (at[i + 1] > at[i])
        i++;
    check_near("a jump stands twice", at[i], 0.755, 1e-12);
    check_near("before the jump", w[3] / p.load_share[3], dmf[i], 1e-9);
    check_near("after the jump", w[4] / p.load_share[4], dmf[i + 1], 1e-9);
    check_near("at SAP", w[0] / p.load_share[0], dmf[0], 1e-9);
    check_true("it is a jump", fabs(dmf[i] - dmf[i + 1]) > 0.05 * p.line_force);
    check_below("energy balance", stage_quality(s, "energy_balance"), 1e-9);
    check_below("determinant", stage_quality(s, "determinant"), 1e-9);
    stage_close(s);
}

/* Without backlash, the system is linear: twice the force must give twice the motion. */
static void test_no_backlash(void)
{
    double rms[2];
    for (int i = 0; i < 2; i++) {
        pair p = pair_trapezoid(2500);
        p.backlash = 0;
        p.line_force *= 1 + i;
        stage *s = run(&p, i ? "branch=upper damping=clipped" : "");
        rms[i] = stage_scalar(s, "dte_rms");
        check_near("contact loss", stage_scalar(s, "contact_loss"), 0, 0);
        stage_close(s);
    }
    check_near("linear in the force", rms[1] / rms[0], 2, 1e-7);
}

static void test_clipped(void)
{
    pair p = pair_trapezoid(2375);
    stage *s = run(&p, "branch=upper damping=clipped");
    size_t count, stations;
    const double *dmf = stage_get(s, "mesh_force", &count);
    const double *w = stage_get(s, "tooth_force", &stations);
    double low = 0;
    for (size_t i = 0; i < count; i++)
        low = fmin(low, dmf[i]);
    for (size_t i = 0; i < stations; i++)
        low = fmin(low, w[i]);
    check_near("lowest force", low, 0, 0);
    stage_close(s);
}

static void test_mass_or_frequency(void)
{
    pair p = pair_trapezoid(2085), heavy = p;
    heavy.mass *= 3;
    stage *a = run(&p, ""), *b = run(&heavy, "natural_frequency=3242Hz");
    check_near("same motion", stage_scalar(b, "dte_rms"), stage_scalar(a, "dte_rms"), 1e-9);
    stage_close(a);
    stage_close(b);
}

int main(void)
{
    test_rest();
    test_limits();
    test_small_stiffness_variation();
    test_displacement_excitation();
    test_low_frequency();
    test_invariants();
    test_flight();
    test_tooth_force(2375, 1);
    test_tooth_force(2180, 2);
    test_step_stiffness();
    test_no_backlash();
    test_clipped();
    test_mass_or_frequency();
    return check_done();
}
