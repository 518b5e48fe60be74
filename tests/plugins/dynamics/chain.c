/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeps in which each speed starts from the motion of the speed before: upwards, the motion must
   stay on the lower branch, downwards on the upper branch, and leave it at the fold of the
   atlas. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST = 8 };

static const char *const models[] = {"dynamics/shooting", "dynamics/harmonic-balance",
                                     "dynamics/time-integration"};
/* Hz, distance from the fold: arc length and Newton's method follow a branch to its end;
   integration in time loses it earlier, where its basin of attraction becomes narrow. */
static const double reach[] = {0.05, 0.05, 5};

/* Computes the rms of the motion at each speed; the first is on the given branch. */
static void walk(const char *model, const char *branch, const double *speed, int count, double *rms)
{
    pair pairs[MOST];
    stage *last = NULL;
    for (int i = 0; i < count; i++) {
        pairs[i] = pair_trapezoid(speed[i]);
        stage *s = pair_open(model, &pairs[i]);
        stage_set_text(s, "branch", i ? "lower" : branch);
        stage_ready(s);
        check_true("a state is handed on", !last || stage_carry(s, last));
        check_true(model, stage_run_wanted(s, "dte_rms") == FF_OK);
        rms[i] = stage_scalar(s, "dte_rms");
        stage_close(last);
        last = s;
    }
    stage_close(last);
}

/* Returns the speed, Hz, at which the atlas's branch of the motion that a model finds at `speed`
   ends. */
static double find_fold(double speed, const char *branch_name)
{
    double expected, best = INFINITY, own = 0, end = speed;
    int lower = !strcmp(branch_name, "lower");
    walk("dynamics/shooting", branch_name, &speed, 1, &expected);
    pair p = pair_trapezoid(speed);
    stage *s = pair_open("dynamics/shooting", &p);
    stage_set(s, "atlas.from", 1300);
    stage_set(s, "atlas.to", 3400);
    stage_set(s, "max_period", 1);
    stage_set(s, "search_starts", 0);
    check_true("atlas", stage_run(s) == FF_OK);
    size_t count;
    const double *f = stage_get(s, "atlas_frequency", &count);
    const double *rms = stage_get(s, "atlas_rms", NULL);
    const double *branch = stage_get(s, "atlas_branch", NULL);
    for (size_t i = 0; i < count; i++) {
        double off = fabs(rms[i] / expected - 1) + fabs(f[i] / speed - 1);
        own = off < best ? branch[i] : own;
        best = fmin(best, off);
    }
    for (size_t i = 0; i < count; i++)
        if (branch[i] == own)
            end = lower ? fmax(end, f[i]) : fmin(end, f[i]);
    stage_close(s);
    return end;
}

static void test_down(void)
{
    double fold = find_fold(1600, "upper");
    check_near("the fold of the upper branch", fold, 1450.5, 1e-3);
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        double rms[4], speed[4] = {1700, 1600, fold + reach[i], fold - reach[i]};
        walk(models[i], "upper", speed, 4, rms);
        check_true("keeps to the upper branch", rms[2] > rms[1] && rms[1] > rms[0]);
        check_true("falls at the fold", rms[3] < 0.5 * rms[2]);
    }
}

static void test_up(void)
{
    double fold = find_fold(2700, "lower");
    check_near("the fold of the lower branch", fold, 2848, 1e-3);
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        double rms[4], speed[4] = {2600, 2700, fold - reach[i], fold + reach[i]};
        walk(models[i], "lower", speed, 4, rms);
        check_true("keeps to the lower branch", rms[2] > rms[1] && rms[1] > rms[0]);
        check_true("leaps at the fold", rms[3] > 1.5 * rms[2]);
    }
}

/* At one speed, the sweeps up and down must give the known states of both branches. */
static void test_hysteresis(void)
{
    static const double up[] = {2300, 2340, 2375}, down[] = {3400, 3000, 2600, 2375};
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        double rms[4];
        walk(models[i], "lower", up, 3, rms);
        check_near("up", rms[2], 0.040979614 * 70e-6, 1e-6);
        walk(models[i], "upper", down, 4, rms);
        check_near("down", rms[3], 0.318365320 * 70e-6, 1e-6);
    }
}

/* The lower motion has a period of two mesh cycles between 2117 and 2248 Hz, and of one mesh cycle
   above. */
static void test_doubling(void)
{
    static const double speed[] = {2090, 2150, 2200, 2260};
    double rms[4], alone[1];
    walk("dynamics/shooting", "lower", speed, 4, rms);
    walk("dynamics/shooting", "lower", speed + 1, 1, alone);
    check_near("doubled", rms[1], alone[0], 1e-9);
    walk("dynamics/shooting", "lower", speed + 3, 1, alone);
    check_near("single again", rms[3], alone[0], 1e-9);
}

/* If the state comes from another kind of model, a model must start without it. */
static void test_foreign_state(void)
{
    pair high = pair_trapezoid(2500), low = pair_trapezoid(2375);
    stage *from = pair_open("dynamics/harmonic-balance", &high);
    stage *to = pair_open("dynamics/shooting", &low);
    stage_set_text(from, "branch", "upper");
    check_true("runs", stage_run_wanted(from, "dte_rms") == FF_OK);
    stage_ready(to);
    stage_carry(to, from);
    check_true("runs", stage_run_wanted(to, "dte_rms") == FF_OK);
    check_near("alone", stage_scalar(to, "dte_rms"), 0.040979614 * 70e-6, 1e-6);
    stage_close(from);
    stage_close(to);
}

int main(void)
{
    test_down();
    test_up();
    test_hysteresis();
    test_doubling();
    test_foreign_state();
    return check_done();
}
