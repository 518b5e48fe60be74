/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The atlas of dynamics/harmonic-balance: the curves from both ends of the range. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>

static const char atlas_outputs[] =
    "atlas_frequency atlas_rms atlas_stable atlas_branch atlas_floquet_max fold_frequency "
    "fold_branch doubling_frequency doubling_branch";

static double nearest(const double *list, size_t count, double value)
{
    double best = INFINITY;
    for (size_t i = 0; i < count; i++)
        best = fabs(list[i] - value) < fabs(best - value) ? list[i] : best;
    return best;
}

/* All folds that exact pieces with located events have, given within about 1 Hz, and no other. */
static void test_folds(void)
{
    const double pinned[] = {527, 796, 734, 1034, 544, 1480, 734, 1080, 750, 2848, 1370, 1450.5};
    pair p = pair_trapezoid(2375);
    stage *s = pair_open("dynamics/harmonic-balance", &p);
    stage_set(s, "atlas.from", 500);
    stage_set(s, "atlas.to", 4500);
    check_true("runs", stage_run_wanted(s, atlas_outputs) == FF_OK);
    size_t folds, points;
    const double *fold = stage_get(s, "fold_frequency", &folds);
    const double *at = stage_get(s, "atlas_frequency", &points);
    const double *rms = stage_get(s, "atlas_rms", NULL);
    const double *stable = stage_get(s, "atlas_stable", NULL);
    check_near("folds", (double)folds, 12, 0);
    for (size_t i = 0; i < sizeof pinned / sizeof pinned[0]; i++)
        check_below("fold off its pin, Hz", fabs(nearest(fold, folds, pinned[i]) - pinned[i]), 1);
    double upper = 0, lower = 0, target[2] = {0.318 * 70e-6, 0.041 * 70e-6};
    for (size_t i = 0; i < points; i++)
        if (fabs(at[i] - 2375) < 60 && stable[i] > 0) {
            upper = fabs(rms[i] - target[0]) < fabs(upper - target[0]) ? rms[i] : upper;
            lower = fabs(rms[i] - target[1]) < fabs(lower - target[1]) ? rms[i] : lower;
        }
    check_near("upper branch near 2375 Hz", upper, target[0], 0.1);
    check_near("lower branch near 2375 Hz", lower, target[1], 0.1);
    stage_close(s);
}

/* The multiplier of the motion that never loses contact passes -1 at both ends of its doubling,
   2113.99 and 2191.91 Hz by exact pieces. */
static void test_doubling(void)
{
    pair p = pair_trapezoid(2375);
    stage *s = pair_open("dynamics/harmonic-balance", &p);
    stage_set(s, "atlas.from", 1900);
    stage_set(s, "atlas.to", 2600);
    check_true("runs", stage_run_wanted(s, atlas_outputs) == FF_OK);
    size_t count;
    const double *at = stage_get(s, "doubling_frequency", &count);
    check_below("start of the window", fabs(nearest(at, count, 2113.99) - 2113.99), 0.02);
    check_below("end of the window", fabs(nearest(at, count, 2191.91) - 2191.91), 0.02);
    stage_close(s);
}

static void test_refused(void)
{
    pair p = pair_trapezoid(2375);
    stage *s = pair_open("dynamics/harmonic-balance", &p);
    stage_set(s, "atlas.from", 3000);
    stage_set(s, "atlas.to", 2000);
    check_true("an empty range", stage_run_wanted(s, "atlas_rms") == FF_INVALID);
    stage_close(s);
    s = pair_open("dynamics/harmonic-balance", &p);
    stage_set(s, "atlas.from", 10);
    check_true("too slow", stage_run_wanted(s, "atlas_rms") == FF_INVALID);
    stage_close(s);
    s = pair_open("dynamics/harmonic-balance", &p);
    stage_stop_at(s, 3);
    check_true("stops when told", stage_run_wanted(s, "atlas_rms") == FF_STOPPED);
    stage_close(s);
}

int main(void)
{
    test_folds();
    test_doubling();
    test_refused();
    return check_done();
}
