/* SPDX-License-Identifier: GPL-3.0-or-later */
/* dynamics/shooting with extreme parameters: it must give finite numbers that satisfy identities,
   or stop with a reason. The host ends the program if a result is not finite. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct scene {
    const char *name;
    double zeta;
    const char *damping;
} scene;

static void set_force(pair *p, double force)
{
    p->line_force = force;
    for (int i = 0; i < PAIR_STATIONS; i++)
        p->tooth_force[i] = force * p->load_share[i];
}

/* Returns the transmission error without load at a phase. */
static double error_at(const pair *p, double phase)
{
    size_t i = 1;
    phase -= floor(phase);
    while (i + 1 < p->phases && p->phase[i] <= phase)
        i++;
    double part = (phase - p->phase[i - 1]) / (p->phase[i] - p->phase[i - 1]);
    return p->error[i - 1] + part * (p->error[i] - p->error[i - 1]);
}

/* Compares the fractions of points without contact, and with contact on the back flanks, with the
   fractions of time: they may differ by a point for each begin or end of contact. */
static void check_shares(const stage *s, const pair *p)
{
    size_t count, ends = 1;
    const double *dte = stage_get(s, "dte", &count), *at = stage_get(s, "phase", NULL);
    double points[2] = {0}, b = p->backlash / 2;
    for (size_t i = 0, last = 9; i + 1 < count; i++) {
        double delta = dte[i] - error_at(p, at[i]);
        size_t where = delta >= b ? 0 : delta > -b ? 1 : 2;
        ends += i > 0 && where != last;
        points[0] += where == 1;
        points[1] += where == 2;
        last = where;
    }
    double within = (double)ends / (double)(count - 1);
    check_below("contact loss, of the series",
                fabs(points[0] / (double)(count - 1) - stage_scalar(s, "contact_loss")), within);
    check_below("back contact, of the series",
                fabs(points[1] / (double)(count - 1) - stage_scalar(s, "back_contact")), within);
}

/* Runs both branches. Periodic motions must repeat themselves, satisfy the identities, and be good
   if stable; other motions must be doubtful. Returns the period of the upper branch. */
static double check_scene(const pair *p, const scene *c)
{
    double period = 0;
    for (int i = 0; i < 2; i++) {
        printf("%s, zeta %g, %s, %g Hz, %s\n", c->name, c->zeta, c->damping, p->mesh_frequency,
               i ? "upper" : "lower");
        stage *s = pair_open("dynamics/shooting", p);
        stage_set(s, "damping_ratio", c->zeta);
        stage_set_text(s, "damping", c->damping);
        stage_set_text(s, "branch", i ? "upper" : "lower");
        stage_set_text(s, "steps_per_cycle", "128");
        stage_set_text(s, "cycles_measured", "8");
        check_true("runs",
                   stage_run_wanted(s, "phase dte dte_rms mesh_force tooth_force gap period "
                                       "multipliers contact_loss back_contact "
                                       "dynamic_factor_tooth") == FF_OK);
        period = stage_scalar(s, "period");
        check_below("energy balance", stage_quality(s, "energy_balance"), 1e-9);
        check_below("determinant", stage_quality(s, "determinant"), 1e-11);
        if (period >= 1)
            check_below("periodicity", stage_quality(s, "periodicity"), 1e-9);
        else
            check_true("is not trusted", stage_verdict(s) != FF_GOOD);
        if (period >= 1)
            check_shares(s, p);
        stage_close(s);
    }
    return period;
}

static void test_damping(void)
{
    const double zetas[] = {0, 1e-4, 0.2, 5}, speeds[] = {900, 2375, 3600, 6000};
    const char *dampings[] = {"always", "contact", "clipped"};
    for (int z = 0; z < 4; z++)
        for (int f = 0; f < 4; f++) {
            pair p = pair_trapezoid(speeds[f]);
            scene c = {"damping", zetas[z], dampings[(z + f) % 3]};
            check_scene(&p, &c);
        }
    /* without damping, the motion in permanent contact is exact */
    pair p = pair_trapezoid(1250);
    scene c = {"undamped", 0, "always"};
    check_true("undamped motion is periodic", check_scene(&p, &c) >= 1);
}

/* A curve with strong curvature within a step: its Taylor series converges more slowly, or not in
   this step. */
static void test_bent(void)
{
    const double speeds[] = {3000, 4000, 4800, 5318, 6500, 8270};
    for (int f = 0; f < 6; f++) {
        pair p = pair_cosine(speeds[f], 0.2, 0, 200);
        stage *s = pair_open("dynamics/shooting", &p);
        check_true("runs", stage_run_wanted(s, "period multipliers") == FF_OK);
        check_below("determinant of a curve", stage_quality(s, "determinant"), 1e-13);
        stage_close(s);
    }
}

/* Thousands of radians per mesh cycle, where rounding errors of all steps exceed 1e-12. */
static void test_slow(void)
{
    const double speeds[] = {3, 10, 40}, zetas[] = {0.01, 0.05, 0.2};
    for (int f = 0; f < 3; f++)
        for (int z = 0; z < 3; z++) {
            pair p = pair_trapezoid(speeds[f]);
            stage *s = pair_open("dynamics/shooting", &p);
            stage_set(s, "damping_ratio", zetas[z]);
            check_true("runs", stage_run_wanted(s, "period multipliers") == FF_OK);
            check_below("determinant, slow mesh", stage_quality(s, "determinant"), 1e-9);
            check_true("trusted", stage_verdict(s) == FF_GOOD);
            stage_close(s);
        }
}

static void test_torque(void)
{
    const double torques[] = {0.05, 1, 20, 500, 5000}, speeds[] = {1100, 2375, 3240};
    for (int t = 0; t < 5; t++)
        for (int f = 0; f < 3; f++) {
            pair p = pair_trapezoid(speeds[f]);
            set_force(&p, torques[t] / 70.477e-3);
            scene c = {"torque", 0.01, f ? "always" : "contact"};
            check_scene(&p, &c);
        }
    pair p = pair_trapezoid(2000);
    set_force(&p, 0);
    stage *s = pair_open("dynamics/shooting", &p);
    check_true("no torque", stage_run_wanted(s, "dte_rms mesh_force stable_motions") == FF_OK);
    check_near("floats", stage_quality(s, "floating"), 0, 0);
    check_near("rests", stage_scalar(s, "dte_rms") + stage_get(s, "mesh_force", NULL)[0], 0, 0);
    check_near("no motion is isolated", stage_scalar(s, "stable_motions"), 0, 0);
    stage_close(s);
}

/* Numbers of tooth pairs in contact: one, rarely two, two or three; with jumps of stiffness instead
   of ramps. */
static void test_contact_ratio(void)
{
    const double ratios[] = {1.0, 1.2, 2.3}, speeds[] = {1500, 2375};
    for (int r = 0; r < 3; r++)
        for (int f = 0; f < 2; f++) {
            pair p = pair_trapezoid(speeds[f]);
            double more = ratios[r] - floor(ratios[r]), pairs = floor(ratios[r]);
            double phase[] = {0, more, more, 1}, k[4];
            for (int i = 0; i < 4; i++)
                k[i] = 2e8 * (pairs + (i < 2 && more > 0));
            p.phases = 4;
            memcpy(p.phase, phase, sizeof phase);
            memcpy(p.stiffness, k, sizeof k);
            p.stiffness_mean = pair_mean(&p);
            scene c = {"contact ratio", 0.01, "always"};
            check_scene(&p, &c);
        }
}

/* A table of 1000 points, each with a kink, and a table with zero stiffness in part of the
   cycle. */
static void test_tables(void)
{
    pair p = pair_trapezoid(2375);
    p.phases = 1000;
    for (size_t i = 0; i < p.phases; i++) {
        p.phase[i] = (double)i / (double)(p.phases - 1);
        p.stiffness[i] = 3.6e8 * (1 + 0.2 * sin((double)(i * i)) * (i % 3 != 0));
        p.error[i] = 1e-8 * sin((double)(i * 7));
    }
    p.stiffness_mean = pair_mean(&p);
    scene rough = {"1000 knots", 0.01, "always"};
    check_scene(&p, &rough);
    p = pair_trapezoid(1700);
    p.stiffness[2] = p.stiffness[3] = 0;
    p.stiffness_mean = pair_mean(&p);
    scene hole = {"no stiffness for a while", 0.05, "contact"};
    check_scene(&p, &hole);
}

static void test_speeds(void)
{
    const double shares[] = {0.01, 0.02, 0.05, 3, 10};
    for (int i = 0; i < 5; i++) {
        pair p = pair_trapezoid(pair_natural_frequency * shares[i]);
        scene c = {"speed", 0.01, "always"};
        check_scene(&p, &c);
    }
    pair p = pair_trapezoid(pair_natural_frequency * 1e-9);
    stage *s = pair_open("dynamics/shooting", &p);
    check_true("far too slow is refused", stage_run(s) == FF_NOCONV);
    check_true("and says where to go", strstr(stage_why(s), "quasi-static") != NULL);
    stage_close(s);
}

/* A transmission error larger than the static deflection moves the teeth from one flank to the
   other. */
static void test_errors(void)
{
    const double sizes[] = {1e-5, 5e-5, 2e-4};
    const char *dampings[] = {"always", "contact", "clipped"};
    for (int i = 0; i < 3; i++)
        for (int f = 0; f < 2; f++) {
            pair p = pair_cosine(f ? 2600 : 1300, 0.2, sizes[i], 64);
            set_force(&p, 300);
            scene c = {"error", 0.03, dampings[(i + f) % 3]};
            check_scene(&p, &c);
        }
}

static void test_gaps(void)
{
    const double gaps[] = {0, 1e-10, 1};
    for (int i = 0; i < 3; i++) {
        pair p = pair_trapezoid(2375);
        p.backlash = gaps[i];
        scene c = {"gap", 0.01, "always"};
        check_scene(&p, &c);
    }
}

/* Without backlash, near twice the natural frequency, the motion grows without limit. */
static void test_unbounded(void)
{
    pair p = pair_cosine(2 * pair_natural_frequency, 0.3, 0, 256);
    p.backlash = 0;
    stage *s = pair_open("dynamics/shooting", &p);
    check_true("runs", stage_run_wanted(s, "period floquet_max dte") == FF_OK);
    check_near("period", stage_scalar(s, "period"), -1, 0);
    check_true("is bad", stage_verdict(s) == FF_BAD);
    check_true("grows", stage_scalar(s, "floquet_max") > 1);
    stage_close(s);
}

/* A motion with impacts that never repeats itself must be reported as aperiodic, whether or not
   other motions exist. */
static void test_aperiodic(const char *model, double damping, double error, double others)
{
    pair p = pair_cosine(1400, 0.25, error, 32);
    set_force(&p, 200);
    stage *s = pair_open(model, &p);
    stage_set(s, "damping_ratio", damping);
    check_true("runs", stage_run_wanted(s, "period dte floquet_max stable_motions") == FF_OK);
    check_near("period", stage_scalar(s, "period"), 0, 0);
    check_near("stable motions", stage_scalar(s, "stable_motions"), others, 0);
    check_true("unstable itself", stage_quality(s, "stability") > 1.2);
    check_true("is doubtful", stage_verdict(s) == FF_DOUBTFUL);
    check_true("disturbances grow", stage_scalar(s, "floquet_max") > 1e6);
    stage_close(s);
}

/* Sweeps upwards and downwards must end in different motions, and stable_motions must be at least
   their number. */
static void test_coexistence(void)
{
    pair p = pair_trapezoid(2375);
    double rms[2], count[2];
    for (int i = 0; i < 2; i++) {
        stage *s = pair_open(i ? "dynamics/shooting" : "dynamics/time-integration", &p);
        stage_set_text(s, "branch", i ? "upper" : "lower");
        check_true("runs", stage_run_wanted(s, "dte_rms stable_motions") == FF_OK);
        rms[i] = stage_scalar(s, "dte_rms");
        count[i] = stage_scalar(s, "stable_motions");
        stage_close(s);
    }
    check_true("the branches differ", rms[1] > 1.5 * rms[0]);
    check_true("several", count[0] >= 2);
    check_near("the same for both models", count[1], count[0], 0);
}

/* Atlases under light and heavy loads, with little and no damping, must end. */
static void test_atlases(void)
{
    const double zetas[] = {0, 1e-4, 0.01, 0.2}, forces[] = {0.7, 3547, 70000};
    for (int z = 0; z < 4; z++)
        for (int f = 0; f < 3; f++) {
            pair p = pair_trapezoid(2375);
            set_force(&p, forces[f]);
            stage *s = pair_open("dynamics/shooting", &p);
            stage_set(s, "damping_ratio", zetas[z]);
            stage_set(s, "atlas.from", 1500);
            stage_set(s, "atlas.to", 4500);
            stage_set(s, "max_period", 2);
            stage_set(s, "search_starts", 1);
            check_true("atlas", stage_run_wanted(s, "atlas_frequency atlas_rms") == FF_OK);
            size_t n;
            stage_get(s, "atlas_frequency", &n);
            printf("zeta %g, force %g: %zu points\n", zetas[z], forces[f], n);
            stage_close(s);
        }
}

static void refuse(const char *item, const pair *p)
{
    stage *s = pair_open("dynamics/shooting", p);
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
    p.mesh_frequency = NAN;
    refuse("operating.mesh_frequency", &p);
    p = good;
    p.stiffness[2] = -1;
    refuse("stiffness.stiffness", &p);
}

int main(void)
{
    test_damping();
    test_slow();
    test_bent();
    test_torque();
    test_contact_ratio();
    test_tables();
    test_speeds();
    test_errors();
    test_gaps();
    test_unbounded();
    for (int i = 0; i < 2; i++) {
        const char *model = i ? "dynamics/time-integration" : "dynamics/shooting";
        test_aperiodic(model, 0.03, 2e-5, 1);
        test_aperiodic(model, 0.1, 4e-5, 0);
    }
    test_coexistence();
    test_atlases();
    test_refused();
    return check_done();
}
