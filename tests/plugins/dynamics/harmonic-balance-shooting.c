/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares dynamics/harmonic-balance with dynamics/shooting, which share no equation solver. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>

static stage *open_model(const char *id, const pair *p, const char *branch)
{
    stage *s = pair_open(id, p);
    stage_set_text(s, "branch", branch);
    return s;
}

/* With a smooth stiffness, the motions must agree to 1e-6 of half the backlash. */
static void test_motion(double frequency, const char *branch, double stiffness_1)
{
    static const char outputs[] = "phase dte dte_rms mesh_force floquet_max multipliers";
    pair p = pair_cosine(frequency, stiffness_1, 0, 256);
    stage *series = open_model("dynamics/harmonic-balance", &p, branch);
    stage *shots = open_model("dynamics/shooting", &p, branch);
    stage_set_text(series, "tolerance", "1e-8");
    check_true("series runs", stage_run_wanted(series, outputs) == FF_OK);
    check_true("shooting runs", stage_run_wanted(shots, outputs) == FF_OK);
    printf("%g Hz, %s\n", frequency, branch);
    double a = stage_get(series, "dte", NULL)[0], z = stage_get(shots, "dte", NULL)[0];
    check_below("s(0) over b", fabs(a - z) / (p.backlash / 2), 1e-6);
    check_near("rms", stage_scalar(series, "dte_rms"), stage_scalar(shots, "dte_rms"), 1e-6);
    const double *mu = stage_get(series, "multipliers", NULL);
    const double *nu = stage_get(shots, "multipliers", NULL);
    check_below("trace", fabs(mu[0] + mu[2] - nu[0] - nu[2]), 1e-5);
    stage_close(series);
    stage_close(shots);
}

/* Returns the rms of the harmonic balance on a branch at a frequency. */
static double rms_at(const pair *base, const char *branch, double frequency)
{
    pair p = *base;
    p.mesh_frequency = frequency;
    stage *s = open_model("dynamics/harmonic-balance", &p, branch);
    check_true("series runs", stage_run_wanted(s, "dte_rms") == FF_OK);
    double rms = stage_scalar(s, "dte_rms");
    stage_close(s);
    return rms;
}

/* The folds at which `lower` jumps with increasing speed, and `upper` with decreasing speed:
   harmonic balance must jump there, too. */
static void test_folds(void)
{
    pair p = pair_trapezoid(2375);
    stage *shots = open_model("dynamics/shooting", &p, "lower");
    size_t count, jumps = 0;
    stage_set_text(shots, "search_speeds", "0");
    stage_set(shots, "atlas.from", 1200);
    stage_set(shots, "atlas.to", 3500);
    check_true("runs", stage_run_wanted(shots, "fold_frequency fold_branch") == FF_OK);
    const double *fold = stage_get(shots, "fold_frequency", &count);
    const double *branch = stage_get(shots, "fold_branch", NULL);
    for (size_t i = 0; i < count; i++) {
        if (branch[i] >= 2000)
            continue; /* a motion of two mesh cycles, which harmonic balance does not have */
        for (int k = 0; k < 2; k++) {
            const char *name = k ? "upper" : "lower";
            double below = rms_at(&p, name, fold[i] - 0.1), above = rms_at(&p, name, fold[i] + 0.1);
            printf("%.2f Hz, %s: %g, %g\n", fold[i], name, below, above);
            if (fabs(above / below - 1) > 0.1)
                jumps++;
        }
    }
    check_true("both jump", jumps >= 2);
    stage_close(shots);
}

int main(void)
{
    test_motion(2375, "upper", 0.2);
    test_motion(2375, "lower", 0.2);
    test_motion(3240, "upper", 0.15);
    test_folds();
    return check_done();
}
