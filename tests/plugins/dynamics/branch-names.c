/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares motions requested by name with the atlas of the same pair: 0.1 Hz from each fold that
   ends a stable part of a branch, the name must find the branch on one side and fail on the other.
   `upper` must end at a fold and report it. stable_motions must be at least the number of stable
   motions in the atlas. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_POINTS = 40000, MOST_FOLDS = 64, SPEEDS = 7 };

static const double off = 0.1; /* Hz */

typedef struct atlas {
    size_t points, folds;
    double frequency[MOST_POINTS], stable[MOST_POINTS], branch[MOST_POINTS];
    double fold[MOST_FOLDS], fold_branch[MOST_FOLDS];
} atlas;

static stage *open_model(const pair *p)
{
    stage *s = pair_open("dynamics/shooting", p);
    stage_set(s, "atlas.from", 1100);
    stage_set(s, "atlas.to", 3600);
    stage_set(s, "max_period", 2);
    stage_set(s, "search_starts", 4);
    stage_set_text(s, "steps_per_cycle", "64");
    stage_set_text(s, "known_motions", "atlas");
    return s;
}

static void copy(const stage *s, const char *output, double *to, size_t most, size_t *count)
{
    const double *from = stage_get(s, output, count);
    check_true("room", *count <= most);
    memcpy(to, from, *count * sizeof *to);
}

static void read_atlas(const pair *p, atlas *a)
{
    stage *s = open_model(p);
    check_true("atlas", stage_run_wanted(s, "atlas_frequency atlas_stable atlas_branch "
                                            "fold_frequency fold_branch") == FF_OK);
    copy(s, "atlas_frequency", a->frequency, MOST_POINTS, &a->points);
    copy(s, "atlas_stable", a->stable, MOST_POINTS, &a->points);
    copy(s, "atlas_branch", a->branch, MOST_POINTS, &a->points);
    copy(s, "fold_frequency", a->fold, MOST_FOLDS, &a->folds);
    copy(s, "fold_branch", a->fold_branch, MOST_FOLDS, &a->folds);
    stage_close(s);
}

/* Finds the number of the branch that is stable next to a fold. Returns 1 if the branch lies at
   higher speeds than the fold, -1 if at lower speeds, 0 if there is none. */
static int stable_side(const atlas *a, double fold, double *number)
{
    for (size_t i = 0; i < a->points; i++) {
        int ends = fabs(a->frequency[i] / fold - 1) < 1e-9;
        for (int way = -1; ends && way <= 1; way += 2) {
            size_t next = i + (size_t)way;
            if (next >= a->points || a->branch[next] != a->branch[i] || !(a->stable[next] > 0) ||
                a->frequency[next] == a->frequency[i])
                continue;
            *number = a->branch[next];
            return a->frequency[next] > fold ? 1 : -1;
        }
    }
    return 0;
}

static void check_folds(const pair *base, const atlas *a, int *checked)
{
    for (size_t k = 0; k < a->folds; k++) {
        double number;
        int side = stable_side(a, a->fold[k], &number);
        for (int inside = 0; side && inside < 2; inside++) {
            pair p = *base;
            char name[40];
            p.mesh_frequency = a->fold[k] + (inside ? 1 : -1) * side * off;
            snprintf(name, sizeof name, "p%d-%d", (int)number / 1000, (int)number % 1000);
            stage *s = open_model(&p);
            stage_set_text(s, "branch", name);
            int status = stage_run_wanted(s, "dte_rms floquet_max");
            if (inside)
                check_true("inside its fold the name leads to the stable motion",
                           status == FF_OK && stage_scalar(s, "floquet_max") < 1);
            else
                check_true("outside it says where it runs",
                           status < 0 && strstr(stage_why(s), "runs from"));
            stage_close(s);
            ++*checked;
        }
    }
}

/* Finds the end of `upper`, from a far lower speed, and checks it on both sides of the end. */
static void check_upper(const pair *base, const atlas *a, double low)
{
    pair p = *base;
    double end, nearest = INFINITY, rms[3];
    p.mesh_frequency = low;
    stage *s = open_model(&p);
    stage_set_text(s, "branch", "upper");
    check_true("runs", stage_run_wanted(s, "dte_rms") == FF_OK);
    end = low * (1 + stage_quality(s, "branch_end"));
    stage_close(s);
    for (size_t k = 0; k < a->folds; k++)
        nearest = fmin(nearest, fabs(a->fold[k] - end));
    check_below("upper ends at a fold, Hz", nearest, 0.02);
    for (int i = 0; i < 3; i++) {
        p.mesh_frequency = end + off * (i == 0 ? 10 : i == 1 ? 1 : -1);
        s = open_model(&p);
        stage_set_text(s, "branch", "upper");
        check_true("runs", stage_run_wanted(s, "dte_rms") == FF_OK);
        rms[i] = stage_scalar(s, "dte_rms");
        check_true("says when it has ended", stage_has_quality(s, "branch_end") == (i == 2));
        stage_close(s);
    }
    check_near("on the branch inside", rms[1], rms[0], 0.03);
    check_true("not outside", fabs(rms[2] / rms[1] - 1) > 0.1);
}

/* Returns the number of stable motions in the atlas at a speed. */
static int count_stable(const atlas *a, double speed)
{
    int count = 0;
    for (size_t i = 1; i < a->points; i++) {
        double from = a->frequency[i - 1], to = a->frequency[i];
        count += a->branch[i] == a->branch[i - 1] && a->stable[i] > 0 && a->stable[i - 1] > 0 &&
                 ((from <= speed) != (to <= speed));
    }
    return count;
}

static void check_counts(const pair *base, const atlas *a)
{
    for (int i = 0; i < SPEEDS; i++) {
        pair p = *base;
        p.mesh_frequency = 1217 + 311.3 * i;
        stage *s = open_model(&p);
        check_true("runs", stage_run_wanted(s, "stable_motions atlas_frequency") == FF_OK);
        double known = stage_scalar(s, "stable_motions");
        int of_atlas = count_stable(a, p.mesh_frequency);
        printf("     %.1f Hz: %g stable motions, %d in the atlas\n", p.mesh_frequency, known,
               of_atlas);
        check_true("no fewer than the atlas", known >= of_atlas);
        stage_close(s);
    }
}

/* The motion `largest` must have the largest rms of all stable motions. `largest` and
   stable_motions must not depend on whether the atlas is requested. If the atlas has more stable
   motions than are counted, the run must report it. */
static void check_largest(const pair *base, int *told)
{
    double rms[4], known[2];
    static const char *const names[] = {"lower", "upper", "largest", "largest"};
    for (int i = 0; i < 4; i++) {
        stage *s = open_model(base);
        if (i >= 2)
            stage_set_text(s, "known_motions", "starts");
        stage_set_text(s, "branch", names[i]);
        check_true("runs", stage_run_wanted(s, i == 3   ? "dte_rms stable_motions atlas_rms"
                                               : i == 2 ? "dte_rms stable_motions"
                                                        : "dte_rms") == FF_OK);
        rms[i] = stage_scalar(s, "dte_rms");
        if (i >= 2)
            known[i - 2] = stage_scalar(s, "stable_motions");
        *told += i == 3 && stage_has_quality(s, "uncounted_motions");
        stage_close(s);
    }
    check_true("largest", rms[2] >= rms[0] * (1 - 1e-9) && rms[2] >= rms[1] * (1 - 1e-9));
    check_true("the same beside an atlas", rms[3] == rms[2] && known[1] == known[0]);
}

int main(void)
{
    static atlas a;
    int checked = 0, told = 0;
    for (int i = 0; i < 3; i++) {
        pair p = i == 0   ? pair_trapezoid(2375)
                 : i == 1 ? pair_cosine(2375, 0.15, 0, 200)
                          : pair_cosine(2375, 0.05, 3e-6, 200);
        read_atlas(&p, &a);
        check_folds(&p, &a, &checked);
        check_counts(&p, &a);
        p.mesh_frequency = 2050;
        check_largest(&p, &told);
        if (i == 0)
            check_upper(&p, &a, 1150);
    }
    check_true("more in an atlas than is counted is told", told > 0);
    check_true("folds were looked at", checked > 8);
    return check_done();
}
