/* SPDX-License-Identifier: GPL-3.0-or-later */
/* dynamics/harmonic-balance with extreme parameters: it must give finite numbers and a correct
   quality verdict, or stop with a reason. The host ends the program if a result is not finite. */
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

static void set_force(pair *p, double force)
{
    p->line_force = force;
    for (int i = 0; i < PAIR_STATIONS; i++)
        p->tooth_force[i] = force * p->load_share[i];
}

/* Number of scenes in which the model finds no motion with a period of one mesh cycle, and the
   largest number allowed: a chaotic rattle, from below and from above, and f_n/1000. */
static int refusals;
static const int known_refusals = 3;

/* Returns the mean mesh force over a cycle minus the load, over the largest force; 0 for a periodic
   motion. */
static double unbalanced(const stage *s, const pair *p)
{
    size_t count;
    const double *f = stage_get(s, "mesh_force", &count), *at = stage_get(s, "phase", NULL);
    double sum = 0, most = p->line_force;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, fabs(f[i]));
    for (size_t i = 0; i + 1 < count; i++)
        sum += (f[i] + f[i + 1]) / 2 * (at[i + 1] - at[i]);
    return most > 0 ? fabs(sum - p->line_force) / most : 0;
}

/* Runs; either there is a motion whose mean force is the load, or a message with the reason. */
static stage *run(const char *what, const pair *p, double zeta, const char *branch)
{
    stage *s = pair_open("dynamics/harmonic-balance", p);
    stage_set(s, "damping_ratio", zeta);
    stage_set_text(s, "branch", branch);
    ff_status status = run_motion(s);
    printf("%s, zeta %g, %s: %s\n", what, zeta, branch,
           status == FF_OK ? "a motion" : stage_why(s));
    check_true("a motion or a reason", status == FF_OK || (status == FF_NOCONV && stage_why(s)[0]));
    if (status == FF_OK) {
        check_below("determinant", stage_quality(s, "determinant"), 1e-9);
        check_below("residual", stage_quality(s, "residual"), 1e-8);
        /* 4e-5 from the trapezium rule at kinks, 7e-4 if the stiffness is 0 in part of the cycle */
        check_below("mean force less the load", unbalanced(s, p), 1e-3);
    }
    refusals += status != FF_OK;
    return s;
}

static void run_both(const char *what, const pair *p, double zeta)
{
    stage_close(run(what, p, zeta, "lower"));
    stage_close(run(what, p, zeta, "upper"));
}

static void test_damping(void)
{
    pair p = pair_trapezoid(2375), slow = pair_trapezoid(1000);
    run_both("2375 Hz", &p, 0);
    stage_close(run("1000 Hz", &slow, 1e-4, "lower"));
    stage_close(run("2375 Hz", &p, 1e-4, "upper"));
    run_both("1000 Hz", &slow, 0.2);
    run_both("2375 Hz", &p, 2);
}

/* Returns the peak-to-peak value of the undamped motion in which the flanks touch only while the
   stiffness is k: after separation at speed v, they touch again after 2 v m/F, and the spring
   reverses the motion in 2 (pi - atan(v w m/F))/w with w = sqrt(k/m). */
static double thrown(const pair *p, double k)
{
    double m = p->mass, fall = p->line_force / m, w = sqrt(k / m), low = 0, high = 1;
    while (high - low > 1e-15) {
        double v = 0.5 * (low + high);
        double cycle = 2 * v / fall + 2 * (M_PI - atan(v * w / fall)) / w;
        *(cycle * p->mesh_frequency < 1 ? &low : &high) = v;
    }
    double rest = p->line_force / k;
    return low * low / (2 * fall) + rest + hypot(rest, low / w);
}

/* Without damping, no motion may be reported as stable. The flanks touch where the stiffness is
   constant, at any time: at each speed, there is a continuous family of motions. */
static void test_no_damping(void)
{
    pair p = pair_trapezoid(2375);
    stage *s = run("undamped", &p, 0, "upper");
    const double *mu = stage_get(s, "multipliers", NULL);
    check_below("determinant is 1", fabs(mu[0] * mu[2] - mu[1] * mu[3] - 1), 1e-9);
    check_true("is doubtful", stage_verdict(s) == FF_DOUBTFUL);
    double exact = thrown(&p, p.stiffness[0]);
    /* both peaks lie up to half a sample from one of 512 samples: A (w/512 f)^2/8 + F/m (1/512
       f)^2/8 */
    check_near("peak to peak", stage_scalar(s, "dte_peak_to_peak") / exact, 1, 2.1e-5);
    stage_close(s);
}

/* Torques of 0.05 and 5000 N m at a base radius of 70.5 mm; no load; a light load with impacts. */
static void test_load(void)
{
    const double forces[] = {0.71, 71000, 1e-6, 1e9};
    for (int i = 0; i < 4; i++) {
        char what[32];
        snprintf(what, sizeof what, "%g N", forces[i]);
        pair p = pair_trapezoid(2375);
        set_force(&p, forces[i]);
        run_both(what, &p, 0.01);
    }
    pair p = pair_trapezoid(1600);
    set_force(&p, 12);
    for (size_t k = 0; k < p.phases; k++)
        p.error[k] = 20e-6 * sin(2 * M_PI * p.phase[k]);
    run_both("rattle", &p, 0.02);
    for (size_t k = 0; k < p.phases; k++)
        p.error[k] = 0;
    set_force(&p, 0);
    stage *s = pair_open("dynamics/harmonic-balance", &p);
    check_true("no load", run_motion(s) == FF_OK);
    check_near("floats", stage_quality(s, "floating"), 0, 0);
    check_below("rests", stage_scalar(s, "dte_rms"), 1e-15);
    check_near("tooth force", stage_get(s, "tooth_force", NULL)[3], 0, 0);
    stage_close(s);
}

/* Without backlash, only the linear motion exists, the same from above and from below. */
static void test_no_backlash(void)
{
    double rms[2];
    pair p = pair_trapezoid(2500);
    p.backlash = 0;
    for (int i = 0; i < 2; i++) {
        stage *s = run("no backlash", &p, 0.01, i ? "upper" : "lower");
        rms[i] = stage_scalar(s, "dte_rms");
        check_near("contact loss", stage_scalar(s, "contact_loss"), 0, 0);
        stage_close(s);
    }
    check_near("same motion", rms[1], rms[0], 1e-12);
    p.backlash = 1;
    run_both("a gap of a metre", &p, 0.01);
    p.backlash = 1e-10;
    run_both("a gap of an atom", &p, 0.01);
}

/* From f_n/100 to 10 f_n and beyond. */
static void test_speed(void)
{
    pair p = pair_trapezoid(pair_natural_frequency / 100);
    stage *s = run("f_n/100", &p, 0.05, "lower");
    check_near("follows the stiffness", stage_get(s, "dte", NULL)[0],
               p.backlash / 2 + p.line_force / p.stiffness[0], 1e-5);
    stage_close(s);
    p = pair_trapezoid(10 * pair_natural_frequency);
    run_both("10 f_n", &p, 0.01);
    p = pair_trapezoid(300 * pair_natural_frequency);
    s = run("300 f_n", &p, 0.05, "upper");
    check_below("hardly moves", stage_scalar(s, "dte_rms"), 1e-10);
    stage_close(s);
    p = pair_trapezoid(pair_natural_frequency * 1e-3);
    s = run("f_n/1000", &p, 0.01, "lower");
    check_true("names the way out", strstr(stage_why(s), "quasi-static") != NULL);
    stage_close(s);
}

/* Jumps of stiffness, and of transmission error by more than the backlash; zero stiffness in part
   of the cycle; a table with a kink at every point. */
static void test_rough_excitation(void)
{
    pair p = pair_trapezoid(1800);
    const double phase[] = {0, 0.4, 0.4, 1}, error[] = {0, 0, 8e-6, 8e-6},
                 k[] = {4e8, 4e8, 3e8, 3e8};
    p.phases = 4;
    memcpy(p.phase, phase, sizeof phase);
    memcpy(p.stiffness, k, sizeof k);
    memcpy(p.error, error, sizeof error);
    p.stiffness_mean = pair_mean(&p);
    run_both("jumps", &p, 0.02);
    p.backlash = 5e-6;
    set_force(&p, 300);
    run_both("jump wider than the gap", &p, 0.02);
    p = pair_trapezoid(2375);
    p.stiffness[2] = p.stiffness[3] = 0;
    p.stiffness_mean = pair_mean(&p);
    run_both("hole", &p, 0.05);
    p = pair_trapezoid(2375);
    p.phases = 1000;
    for (size_t i = 0; i < p.phases; i++) {
        p.phase[i] = (double)i / (double)(p.phases - 1);
        p.stiffness[i] = 3.6e8 * (1 + 0.2 * sin((double)(i * i)) * (i % 3 != 0));
    }
    p.stiffness_mean = pair_mean(&p);
    stage_close(run("rough table", &p, 0.01, "lower"));
}

/* In the unstable range near twice the natural frequency, the motion of one mesh cycle must be
   reported as unstable. */
static void test_unstable(void)
{
    pair p = pair_trapezoid(2180);
    stage *s = run("doubled", &p, 0.01, "lower");
    check_true("unstable", stage_scalar(s, "floquet_max") > 1);
    check_true("says so", stage_verdict(s) == FF_DOUBTFUL);
    stage_close(s);
}

static void test_stop(void)
{
    pair p = pair_trapezoid(2375);
    for (int call = 1; call <= 3; call++) {
        stage *s = pair_open("dynamics/harmonic-balance", &p);
        stage_set_text(s, "branch", "upper");
        stage_stop_at(s, call);
        check_true("stops when told", run_motion(s) == FF_STOPPED);
        stage_close(s);
    }
}

static void refuse(const char *param, const char *value, ff_status status)
{
    pair p = pair_trapezoid(2375);
    stage *s = pair_open("dynamics/harmonic-balance", &p);
    stage_set_text(s, "harmonics", "40");
    stage_set_text(s, param, value);
    check_true(value, run_motion(s) == status && !strcmp(stage_why_item(s), param));
    stage_close(s);
}

static void test_refused(void)
{
    refuse("damping", "contact", FF_UNSUPPORTED);
    refuse("damping", "clipped", FF_UNSUPPORTED);
    refuse("samples", "200", FF_INVALID);
    refuse("samples", "1001", FF_INVALID);
    pair p = pair_trapezoid(2000);
    p.stiffness[2] = NAN;
    stage *s = pair_open("dynamics/harmonic-balance", &p);
    check_true("nan", run_motion(s) == FF_INVALID);
    stage_close(s);
}

int main(void)
{
    test_damping();
    test_no_damping();
    test_load();
    test_no_backlash();
    test_speed();
    test_rough_excitation();
    test_unstable();
    test_stop();
    test_refused();
    check_below("scenes without a motion", refusals, known_refusals);
    return check_done();
}
