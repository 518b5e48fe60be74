/* SPDX-License-Identifier: GPL-3.0-or-later */
/* dynamics/time-integration with extreme parameters: it must give finite numbers and a correct
   quality verdict, and end. The host ends the program if a result is not finite. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static stage *run(const pair *p, double zeta, const char *branch, const char *damping)
{
    stage *s = pair_open("dynamics/time-integration", p);
    stage_set(s, "damping_ratio", zeta);
    stage_set_text(s, "branch", branch);
    stage_set_text(s, "damping", damping);
    check_true("runs", stage_run(s) == FF_OK);
    return s;
}

static void set_force(pair *p, double force)
{
    p->line_force = force;
    for (int i = 0; i < PAIR_STATIONS; i++)
        p->tooth_force[i] = force * p->load_share[i];
}

/* Without load and excitation, the flanks must stay at rest. */
static void test_no_load(void)
{
    pair p = pair_trapezoid(2000);
    set_force(&p, 0);
    stage *s = run(&p, 0.01, "upper", "contact");
    check_near("rms", stage_scalar(s, "dte_rms"), 0, 1e-15);
    check_near("tooth force", stage_get(s, "tooth_force", NULL)[3], 0, 0);
    check_near("mesh factor", stage_scalar(s, "dynamic_factor_mesh"), 0, 0);
    stage_close(s);
    for (size_t i = 0; i < p.phases; i++)
        p.error[i] = 5e-6 * sin(2 * M_PI * p.phase[i]);
    s = run(&p, 0.01, "lower", "clipped");
    check_below("the excitation shakes loose", stage_scalar(s, "dte_mean"), p.backlash);
    stage_close(s);
}

/* Under a light load, the teeth hit both flanks. */
static void test_light_load(void)
{
    for (int i = 0; i < 4; i++) {
        pair p = pair_trapezoid(1000 + 600 * i);
        set_force(&p, p.line_force * 3.5e-3);
        for (size_t k = 0; k < p.phases; k++)
            p.error[k] = 20e-6 * sin(2 * M_PI * p.phase[k]);
        stage *s = run(&p, 0.01, "upper", i % 2 ? "clipped" : "contact");
        check_true("touches both flanks", stage_scalar(s, "contact_loss") > 0);
        check_below("energy balance", stage_quality(s, "energy_balance"), 1e-8);
        check_below("determinant", stage_quality(s, "determinant"), 1e-8);
        stage_close(s);
    }
}

static void test_little_damping(void)
{
    pair p = pair_trapezoid(2375);
    stage *s = run(&p, 1e-4, "upper", "always");
    check_below("energy balance", stage_quality(s, "energy_balance"), 1e-8);
    stage_close(s);
    s = run(&p, 0, "lower", "always");
    check_true("never settles and says so", stage_verdict(s) == FF_DOUBTFUL);
    check_near("undamped is aperiodic", stage_scalar(s, "period"), 0, 0);
    check_below("energy balance", stage_quality(s, "energy_balance"), 1e-8);
    check_below("determinant", stage_quality(s, "determinant"), 1e-8);
    stage_close(s);
}

/* More than critical damping, a backlash of a metre, a backlash of an atom's size, a huge force,
   zero stiffness in part of the cycle. */
static void test_sizes(void)
{
    const struct {
        double zeta, backlash, force, hole;
    } cases[] = {{5, 1.4e-4, 3500, 0},   {0.01, 1, 3500, 0},      {0.01, 1e-10, 3500, 0},
                 {0.01, 1.4e-4, 1e9, 0}, {0.05, 1.4e-4, 3500, 1}, {0.01, 1.4e-4, 1e-6, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        pair p = pair_trapezoid(2375);
        p.backlash = cases[i].backlash;
        set_force(&p, cases[i].force);
        if (cases[i].hole > 0) {
            p.stiffness[2] = p.stiffness[3] = 0;
            p.stiffness_mean = pair_mean(&p);
        }
        stage *s = run(&p, cases[i].zeta, "upper", "always");
        check_below("energy balance", stage_quality(s, "energy_balance"), 1e-8);
        check_below("determinant", stage_quality(s, "determinant"), 1e-8);
        stage_close(s);
    }
}

/* At very high speed, only the mean stiffness must matter; at very low speed, the motion must be
   the static deflection. */
static void test_speeds(void)
{
    pair p = pair_trapezoid(pair_natural_frequency * 300);
    stage *s = run(&p, 0.05, "lower", "always");
    check_near("fast", stage_scalar(s, "dte_mean"),
               p.backlash / 2 + p.line_force / p.stiffness_mean, 1e-4);
    check_below("fast: rms", stage_scalar(s, "dte_rms"), 1e-10);
    stage_close(s);
    p = pair_trapezoid(pair_natural_frequency / 3000);
    s = run(&p, 0.01, "upper", "always");
    check_near("slow", stage_get(s, "dte", NULL)[0], p.backlash / 2 + p.line_force / p.stiffness[0],
               1e-9);
    stage_close(s);
    p = pair_trapezoid(pair_natural_frequency * 1e-9);
    s = pair_open("dynamics/time-integration", &p);
    check_true("far too slow is refused", stage_run(s) == FF_NOCONV);
    check_true("and says where", strstr(stage_why(s), "quasi-static") != NULL);
    stage_close(s);
}

/* Without backlash, near twice the natural frequency, the motion grows without limit. */
static void test_unbounded(void)
{
    pair p = pair_cosine(2 * pair_natural_frequency, 0.3, 0, 256);
    p.backlash = 0;
    stage *s = run(&p, 0.01, "lower", "always");
    check_near("period", stage_scalar(s, "period"), -1, 0);
    check_true("is bad", stage_verdict(s) == FF_BAD);
    check_true("grows", stage_scalar(s, "floquet_max") > 1);
    stage_close(s);
    p = pair_cosine(2 * pair_natural_frequency, 0.03, 0, 256);
    p.backlash = 0;
    s = run(&p, 0.01, "lower", "always");
    check_near("below the threshold 4 zeta it stays bounded", stage_scalar(s, "period"), 1, 0);
    stage_close(s);
}

/* A stiffness table with a kink at every point. */
static void test_rough_table(void)
{
    pair p = pair_trapezoid(2375);
    p.phases = 1000;
    for (size_t i = 0; i < p.phases; i++) {
        p.phase[i] = (double)i / (double)(p.phases - 1);
        p.stiffness[i] = 3.6e8 * (1 + 0.2 * sin((double)(i * i)) * (i % 3 != 0));
        p.error[i] = 1e-8 * sin((double)(i * 7));
    }
    p.stiffness_mean = pair_mean(&p);
    stage *s = run(&p, 0.01, "lower", "always");
    check_below("energy balance", stage_quality(s, "energy_balance"), 1e-8);
    check_below("determinant", stage_quality(s, "determinant"), 1e-8);
    stage_close(s);
}

/* A pitch error larger than the backlash moves the teeth from one flank to the other. */
static void test_jump_of_error(void)
{
    const char *dampings[] = {"always", "contact", "clipped"};
    for (int i = 0; i < 3; i++) {
        pair p = pair_trapezoid(1800);
        double phase[] = {0, 0.4, 0.4, 1}, error[] = {0, 0, 8e-6, 8e-6}, k[] = {4e8, 4e8, 3e8, 3e8};
        p.phases = 4;
        p.backlash = 5e-6;
        memcpy(p.phase, phase, sizeof phase);
        memcpy(p.stiffness, k, sizeof k);
        memcpy(p.error, error, sizeof error);
        p.stiffness_mean = pair_mean(&p);
        set_force(&p, 300);
        stage *s = run(&p, 0.02, "lower", dampings[i]);
        check_true("touches both flanks", stage_scalar(s, "back_contact") > 0);
        check_below("energy balance", stage_quality(s, "energy_balance"), 1e-8);
        check_below("determinant", stage_quality(s, "determinant"), 1e-8);
        stage_close(s);
    }
}

static void test_stop(void)
{
    pair p = pair_trapezoid(2375);
    for (int call = 1; call <= 3; call++) {
        stage *s = pair_open("dynamics/time-integration", &p);
        stage_set_text(s, "branch", "upper");
        stage_stop_at(s, call);
        check_true("stops when told", stage_run(s) == FF_STOPPED);
        stage_close(s);
    }
}

static void refuse(const char *item, const pair *p)
{
    stage *s = pair_open("dynamics/time-integration", p);
    check_true(item,
               stage_run(s) == FF_INVALID && !strcmp(stage_why_item(s), item) && stage_why(s)[0]);
    stage_close(s);
}

static void test_refused(void)
{
    pair good = pair_trapezoid(2000), p = good;
    set_force(&p, NAN);
    refuse("operating.line_force", &p);
    p = good;
    p.mesh_frequency = 0;
    refuse("operating.mesh_frequency", &p);
    p.mesh_frequency = NAN;
    refuse("operating.mesh_frequency", &p);
    p = good;
    p.backlash = -1e-6;
    refuse("gear.backlash", &p);
    p = good;
    p.mass = -1;
    refuse("gear.equivalent_mass", &p);
    p = good;
    p.stiffness_mean = 0;
    refuse("stiffness.stiffness_mean", &p);
    p = good;
    p.stiffness[2] = -1;
    refuse("stiffness.stiffness", &p);
    p.stiffness[2] = INFINITY;
    refuse("stiffness.stiffness", &p);
    p = good;
    p.phase[5] = 0.9;
    refuse("stiffness.phase", &p);
    p = good;
    p.phase[2] = 0.1;
    refuse("stiffness.phase", &p);
    p.phases = 1;
    refuse("stiffness.phase", &p);
    p = good;
    p.roll[3] = 0;
    refuse("gear.roll_angle", &p);
    p.roll[3] = 1e9;
    refuse("gear.roll_angle", &p);
}

int main(void)
{
    test_no_load();
    test_light_load();
    test_little_damping();
    test_sizes();
    test_speeds();
    test_unbounded();
    test_rough_table();
    test_jump_of_error();
    test_stop();
    test_refused();
    return check_done();
}
