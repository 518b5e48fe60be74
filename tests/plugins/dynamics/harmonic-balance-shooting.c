/* SPDX-License-Identifier: GPL-3.0-or-later */
/* dynamics/harmonic-balance and dynamics/shooting, which share no equation solver, side by side. */
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

/* The motion of a smooth stiffness, to 1e-6 of the half backlash. */
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

/* Period 1 folds and doublings of the trapezoid, one by one. */
static void test_atlas(void)
{
    static const char outputs[] = "fold_frequency fold_branch doubling_frequency doubling_branch";
    pair p = pair_trapezoid(2375);
    stage *model[2] = {open_model("dynamics/harmonic-balance", &p, "lower"),
                       open_model("dynamics/shooting", &p, "lower")};
    stage_set_text(model[1], "search_speeds", "0");
    size_t count[2][2];
    for (int i = 0; i < 2; i++) {
        stage_set(model[i], "atlas.from", 1000);
        stage_set(model[i], "atlas.to", 4500);
        check_true("runs", stage_run_wanted(model[i], outputs) == FF_OK);
    }
    for (int k = 0; k < 2; k++) {
        const double *at[2];
        for (int i = 0; i < 2; i++) {
            at[i] = stage_get(model[i], k ? "doubling_frequency" : "fold_frequency", &count[i][k]);
            const double *branch = stage_get(model[i], k ? "doubling_branch" : "fold_branch", NULL);
            size_t ones = 0;
            while (ones < count[i][k] && branch[ones] < 2000)
                ones++;
            count[i][k] = ones;
        }
        check_near(k ? "doublings" : "folds", (double)count[0][k], (double)count[1][k], 0);
        check_true("there are some", count[0][k] >= 4);
        for (size_t i = 0; i < count[0][k]; i++) {
            double off = INFINITY;
            for (size_t j = 0; j < count[1][k]; j++)
                off = fmin(off, fabs(at[0][i] - at[1][j]));
            check_below("frequency off that of shooting, Hz", off, 0.1);
        }
    }
    stage_close(model[0]);
    stage_close(model[1]);
}

int main(void)
{
    test_motion(2375, "upper", 0.2);
    test_motion(2375, "lower", 0.2);
    test_motion(3240, "upper", 0.15);
    test_atlas();
    return check_done();
}
