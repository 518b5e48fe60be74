/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The atlas of dynamics/shooting: its branches must agree with single motions and with each other,
   and satisfy identities. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static stage *open_atlas(const pair *p, double from, double to, int max_period, int starts)
{
    stage *s = pair_open("dynamics/shooting", p);
    stage_set(s, "atlas.from", from);
    stage_set(s, "atlas.to", to);
    stage_set(s, "max_period", max_period);
    stage_set(s, "search_starts", starts);
    stage_set_text(s, "steps_per_cycle", "256");
    return s;
}

typedef struct table {
    size_t points;
    const double *frequency, *rms, *stable, *branch, *floquet;
} table;

static table read_table(const stage *s)
{
    table t;
    t.frequency = stage_get(s, "atlas_frequency", &t.points);
    t.rms = stage_get(s, "atlas_rms", NULL);
    t.stable = stage_get(s, "atlas_stable", NULL);
    t.branch = stage_get(s, "atlas_branch", NULL);
    t.floquet = stage_get(s, "atlas_floquet_max", NULL);
    return t;
}

/* Returns the point at the middle speed of a branch. */
static size_t central(const table *t, size_t first, size_t last)
{
    double low = t->frequency[first], high = low;
    for (size_t i = first; i < last; i++) {
        low = fmin(low, t->frequency[i]);
        high = fmax(high, t->frequency[i]);
    }
    size_t at = first;
    for (size_t i = first; i < last; i++)
        if (fabs(t->frequency[i] - (low + high) / 2) < fabs(t->frequency[at] - (low + high) / 2))
            at = i;
    return at;
}

/* Solves a single motion in the middle of every branch, and compares its rms and multiplier with
   the branch, and det M and the energy balance with their exact values. */
static void check_branches(const pair *base, const table *t, int max_period, int starts)
{
    size_t checked = 0;
    for (size_t first = 0, last; first < t->points; first = last) {
        for (last = first; last < t->points && t->branch[last] == t->branch[first];)
            last++;
        size_t at = central(t, first, last);
        char name[32];
        int number = (int)t->branch[first];
        snprintf(name, sizeof name, "p%d-%d", number / 1000, number % 1000);
        if (last - first < 6)
            continue;
        pair p = *base;
        p.mesh_frequency = t->frequency[at];
        stage *s = open_atlas(&p, 1300, 3400, max_period, starts);
        stage_set_text(s, "branch", name);
        check_true(name, stage_run(s) == FF_OK);
        check_near("period", stage_scalar(s, "period"), number / 1000, 0);
        check_near("rms of the table", stage_scalar(s, "dte_rms"), t->rms[at], 1e-6);
        check_near("multiplier of the table", stage_scalar(s, "floquet_max"), t->floquet[at], 1e-4);
        check_below("periodicity", stage_quality(s, "periodicity"), 1e-10);
        check_below("determinant", stage_quality(s, "determinant"), 1e-12);
        check_below("energy balance", stage_quality(s, "energy_balance"), 1e-9);
        stage_close(s);
        checked++;
    }
    check_true("a dozen branches at least", checked >= 12);
}

/* At each period doubling of a motion of one mesh cycle, exactly one branch of two mesh cycles must
   end. */
static void check_doublings(const stage *s, const table *t)
{
    size_t count;
    const double *at = stage_get(s, "doubling_frequency", &count);
    const double *of = stage_get(s, "doubling_branch", NULL);
    for (size_t k = 0; k < count; k++) {
        int ends = 0;
        for (size_t i = 0; of[k] < 2000 && i < t->points; i++) {
            int first = i == 0 || t->branch[i - 1] != t->branch[i],
                last = i + 1 == t->points || t->branch[i + 1] != t->branch[i];
            ends += (first || last) && t->branch[i] > 2000 && t->branch[i] < 3000 &&
                    fabs(t->frequency[i] / at[k] - 1) < 1e-9;
        }
        if (of[k] < 2000)
            check_true("one branch of twice the period", ends == 1);
    }
}

static void test_branches(void)
{
    pair p = pair_trapezoid(2375);
    stage *s = open_atlas(&p, 1300, 3400, 3, 4);
    check_true("runs", stage_run(s) == FF_OK);
    table t = read_table(s);
    for (size_t i = 0; i < t.points; i++) {
        check_true("within the range",
                   t.frequency[i] > 1300 - 1e-6 && t.frequency[i] < 3400 + 1e-6);
        check_true("stable below 1", t.stable[i] == (t.floquet[i] < 1 + 1e-9));
    }
    check_doublings(s, &t);
    check_branches(&p, &t, 3, 4);
    stage_close(s);
}

/* The motions of sweeps upwards and downwards must lie on branches of the atlas. */
static void test_sweeps_are_found(void)
{
    for (int i = 0; i < 2; i++) {
        pair p = pair_trapezoid(2375);
        stage *s = open_atlas(&p, 1300, 3400, 1, 0);
        stage_set_text(s, "branch", i ? "upper" : "lower");
        check_true("runs", stage_run(s) == FF_OK);
        check_true("lies on a branch", stage_quality(s, "atlas_branch") > 1000);
        stage_close(s);
    }
}

/* In the speed range with doubled period, the lower motion must have a period of two mesh cycles,
   and lie on the branch that begins at the end of the range. */
static void test_doubled_window(void)
{
    pair p = pair_trapezoid(2150);
    stage *s = open_atlas(&p, 2000, 2300, 2, 0);
    check_true("runs", stage_run(s) == FF_OK);
    check_near("period", stage_scalar(s, "period"), 2, 0);
    uint32_t rank;
    const size_t *shape = stage_shape(s, "tooth_force", &rank);
    check_true("two engagements", rank == 2 && shape[0] == 2);
    double number = stage_quality(s, "atlas_branch");
    check_true("on a branch of period 2", number > 2000 && number < 3000);
    size_t n;
    const double *doubling = stage_get(s, "doubling_frequency", &n);
    check_true("the window has two edges", n >= 2);
    check_below("lower edge", fabs(doubling[0] - 2113.992), 0.1);
    check_below("upper edge", fabs(doubling[1] - 2191.908), 0.1);
    stage_close(s);
}

/* Finds the point of a branch at a speed with the rms nearest to `rms`, by linear interpolation.
   Returns 1 if there is one. */
static int branch_at(const table *t, double branch, double frequency, double rms, double found[2])
{
    double best = INFINITY;
    for (size_t i = 0; i + 1 < t->points; i++) {
        double a = t->frequency[i] - frequency, b = t->frequency[i + 1] - frequency;
        if (t->branch[i] != branch || t->branch[i + 1] != branch || !(a * b <= 0) || a == b)
            continue;
        double part = a / (a - b), y = t->rms[i] + part * (t->rms[i + 1] - t->rms[i]);
        if (fabs(y - rms) < best) {
            best = fabs(y - rms);
            found[0] = y;
            found[1] = t->floquet[i] + part * (t->floquet[i + 1] - t->floquet[i]);
        }
    }
    return isfinite(best);
}

/* Returns the number of branches found twice, with the same rms and multiplier at the middle
   speed. */
static int twins(const table *t)
{
    int count = 0;
    for (size_t first = 0, last; first < t->points; first = last) {
        for (last = first; last < t->points && t->branch[last] == t->branch[first];)
            last++;
        size_t at = central(t, first, last);
        for (size_t k = 0; k < t->points; k++) {
            double found[2] = {0, 0};
            if (k > 0 && t->branch[k] == t->branch[k - 1])
                continue;
            if (t->branch[k] != t->branch[at] &&
                floor(t->branch[k] / 1000) == floor(t->branch[at] / 1000) &&
                branch_at(t, t->branch[k], t->frequency[at], t->rms[at], found) &&
                fabs(found[0] / t->rms[at] - 1) < 1e-3 &&
                fabs(found[1] / t->floquet[at] - 1) < 1e-2) {
                printf("%g and %g at %g Hz: rms %g %g, multiplier %g %g\n", t->branch[at],
                       t->branch[k], t->frequency[at], t->rms[at], found[0], t->floquet[at],
                       found[1]);
                count++;
            }
        }
    }
    return count;
}

/* Isolated branches: the search must find branches that a start from rest does not reach, and none
   twice. */
static void test_search(void)
{
    pair p = pair_trapezoid(2375);
    stage *s = open_atlas(&p, 2000, 3300, 3, 8);
    check_true("runs", stage_run_wanted(s, "atlas_frequency atlas_branch atlas_rms atlas_stable "
                                           "atlas_floquet_max") == FF_OK);
    table t = read_table(s);
    int threes = 0;
    for (size_t i = 0; i < t.points; i++)
        threes += t.branch[i] > 3000;
    check_near("branches that are there twice", twins(&t), 0, 0);
    check_true("finds motions of period 3", threes > 0);
    stage_close(s);
}

/* The number of possibly missed motions that a search with 6 starts reports, and one with 768
   starts. */
static void test_unseen(void)
{
    pair p = pair_trapezoid(2375);
    double unseen[2];
    for (int large = 0; large < 2; large++) {
        stage *s = open_atlas(&p, 2000, 3300, 3, large ? 32 : 2);
        if (!large)
            stage_set(s, "search_speeds", 3);
        check_true("runs", stage_run_wanted(s, "atlas_frequency") == FF_OK);
        unseen[large] = stage_quality(s, "atlas_unseen");
        stage_close(s);
    }
    printf("unseen: %.3g after 6 starts, %.3g after 768\n", unseen[0], unseen[1]);
    check_below("a large search has met nearly all", unseen[1], 0.01);
    check_true("a small one has not, and says so", unseen[0] > 0.1);
}

static void test_names(void)
{
    const char *wrong[] = {"middle", "p0-1", "p7-1", "p1", "p1-", "p1-0", "p1-1x", "P1-1", ""};
    pair p = pair_trapezoid(2375);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        stage *s = pair_open("dynamics/shooting", &p);
        stage_set_text(s, "branch", wrong[i]);
        check_true(wrong[i], stage_ready(s) == FF_INVALID && !strcmp(stage_why_item(s), "branch"));
        stage_close(s);
    }
    const char *absent[] = {"p1-77", "p1-1"}; /* p1-1 begins at 1300 Hz and ends below 2375 Hz */
    for (int i = 0; i < 2; i++) {
        stage *s = open_atlas(&p, 1300, 4000, 1, 0);
        stage_set_text(s, "branch", absent[i]);
        check_true(absent[i], stage_run(s) == FF_INVALID);
        check_true("lists those that are there", strstr(stage_why(s), "there are: p1-") != NULL);
        printf("%s\n", stage_why(s));
        stage_close(s);
    }
    stage *s = open_atlas(&p, 3000, 2000, 1, 0);
    check_true("range", stage_ready(s) == FF_INVALID && !strcmp(stage_why_item(s), "atlas.to"));
    stage_close(s);
}

/* Outputs that are not requested must not be computed. */
static void test_wanted(void)
{
    pair p = pair_trapezoid(2375);
    stage *s = pair_open("dynamics/shooting", &p);
    check_true("runs", stage_run_wanted(s, "dte_rms") == FF_OK);
    check_true("no atlas", !stage_has(s, "atlas_frequency"));
    stage_close(s);
    s = open_atlas(&p, 2000, 3000, 1, 0);
    check_true("runs", stage_run_wanted(s, "fold_frequency") == FF_OK);
    check_true("no motion", !stage_has(s, "dte"));
    stage_close(s);
}

static void test_stop(void)
{
    pair p = pair_trapezoid(2375);
    for (int call = 1; call <= 40; call += 13) {
        stage *s = pair_open("dynamics/shooting", &p);
        stage_stop_at(s, call);
        check_true("stops when told", stage_run(s) == FF_STOPPED);
        stage_close(s);
    }
}

int main(void)
{
    test_branches();
    test_sweeps_are_found();
    test_doubled_window();
    test_search();
    test_unseen();
    test_names();
    test_wanted();
    test_stop();
    return check_done();
}
