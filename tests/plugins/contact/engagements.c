/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A motion with a period of several mesh cycles: each of its engagements must become a history. */
#include "../../../plugins/contact/engagements.h"
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST = 4000, LONGEST = 64, POINTS = 200 };

static const char wanted[] = "time roll_angle load_per_width engagement engagements_judged "
                             "mesh_load_mean";

/* Force of each engagement over that of the first. */
static double load[LONGEST * MOST];

static stage *open_train(pair *p, size_t count, const double *factor)
{
    size_t n;
    *p = pair_open();
    pair_stations(p, &n);
    for (size_t k = 0; k < count; k++) {
        pair_share(p, 3000, load + k * n);
        for (size_t i = 0; i < n; i++)
            load[k * n + i] *= factor[k];
    }
    stage_give(p->tooth, "load.tooth_force", 2, (size_t[]){count, n}, load);
    stage_set(p->tooth, "points", POINTS);
    return p->tooth;
}

/* Period 2: tooth pairs carry 1.5 and 0.5 times the load alternately. */
static void check_two(void)
{
    static const double factor[] = {1.5, 0.5}, alike[] = {1, 1};
    pair p, one;
    stage *s = open_train(&p, 2, factor), *alone = open_train(&one, 2, factor);
    stage_set(alone, "engagement", 1);
    if (!check_true("both run", stage_run_wanted(s, wanted) == FF_OK &&
                                    stage_run_wanted(alone, wanted) == FF_OK))
        return;
    size_t n;
    const double *time = stage_get(s, "time", &n), *w = stage_get(s, "load_per_width", NULL);
    const double *number = stage_get(s, "engagement", NULL);
    const double *roll = stage_get(s, "roll_angle", NULL);
    check_near("instants", (double)n, 2 * POINTS, 0);
    check_true("the second begins when the first ends", time[POINTS] == time[POINTS - 1]);
    check_true("at SAP again", roll[POINTS] == roll[0] && roll[n - 1] == roll[POINTS - 1]);
    check_true("numbered", number[0] == 0 && number[POINTS - 1] == 0 && number[POINTS] == 1);
    double off = 0;
    for (size_t i = 0; i < POINTS; i++) {
        off = fmax(off, fabs(w[i] / w[POINTS + i] - 3));
        off = fmax(off, fabs(w[POINTS + i] - stage_get(alone, "load_per_width", NULL)[i]));
    }
    check_below("loads", off, 1e-12);
    check_near("judged", stage_scalar(s, "engagements_judged"), 2, 0);
    /* 1 or 2 pairs are in mesh and share the force */
    double force = 3000;
    check_near("mean load of the mesh", stage_scalar(s, "mesh_load_mean"), force, 1e-3);
    check_near("of one engagement", stage_scalar(alone, "mesh_load_mean"), 0.5 * force, 1e-3);
    check_near("one of two told", stage_scalar(alone, "engagements_judged"), 1, 0);
    double off_all = stage_quality(s, "mesh_load");
    double held = 250 / (12.5 * 3e-3 * cos(20 * M_PI / 180)); /* torque over base radius */
    check_near("against the torque", off_all, fabs(force / held - 1), 1e-3);
    pair_close(&p);
    pair_close(&one);
    /* a motion of period 1 given with period 2 must give the same engagement twice */
    s = open_train(&p, 2, alike);
    alone = open_train(&one, 1, alike);
    check_true("run",
               stage_run_wanted(s, wanted) == FF_OK && stage_run_wanted(alone, wanted) == FF_OK);
    w = stage_get(s, "load_per_width", NULL);
    const double *once = stage_get(alone, "load_per_width", NULL);
    check_true("twice the same", !memcmp(w, once, POINTS * sizeof *w) &&
                                     !memcmp(w + POINTS, once, POINTS * sizeof *w));
    check_near("the same mean", stage_scalar(s, "mesh_load_mean"),
               stage_scalar(alone, "mesh_load_mean"), 1e-14);
    pair_close(&p);
    pair_close(&one);
}

/* Without load, each engagement must have the gap of its own row. */
static void check_gaps(void)
{
    static const double factor[] = {1, 0, 0};
    static double gap[3 * MOST];
    pair p;
    stage *s = open_train(&p, 3, factor);
    size_t n, count;
    pair_stations(&p, &n);
    for (size_t k = 0; k < 3 * n; k++)
        gap[k] = 1e-6 * (double)(k / n) * (1 + (double)(k % n) / (double)n);
    stage_give(s, "load.gap", 2, (size_t[]){3, n}, gap);
    if (check_true("gaps of three engagements", stage_run_wanted(s, "gap engagement") == FF_OK)) {
        const double *apart = stage_get(s, "gap", &count),
                     *number = stage_get(s, "engagement", NULL);
        double off = 0;
        for (size_t i = 0; i < count; i++)
            if (i == 0 || number[i] > number[i - 1])
                off = fmax(off, fabs(apart[i] - 1e-6 * number[i]));
        check_below("each begins with its own", off, 1e-15);
        check_near("the last ends with its own", apart[count - 1], gap[3 * n - 1], 1e-12);
    }
    pair_close(&p);
}

/* A long motion: the engagements must be as many as allowed, in increasing order, none twice, and
   from all parts of the motion. */
static void check_sample(void)
{
    size_t picked[LONGEST];
    for (size_t had = 1; had <= LONGEST; had++)
        for (size_t most = 1; most <= LONGEST; most++) {
            size_t count = contact_engagements_pick(had, most, picked), wrong = 0;
            for (size_t i = 0; i < count; i++) {
                wrong += picked[i] >= had || (i > 0 && picked[i] <= picked[i - 1]);
                double part = (double)had / (double)count;
                wrong += fabs((double)picked[i] - (double)i * part) > part + 1;
            }
            if (count != (had < most ? had : most) || wrong > 0) {
                printf("%zu of %zu\n", most, had);
                check_true("a sample", 0);
            }
        }
    /* if a motion nearly repeats itself after 2, 3 or 4 cycles, each of these cycles must have at
       least half the average number of engagements */
    for (size_t period = 2; period <= 4; period++) {
        size_t met[4] = {0}, count = contact_engagements_pick(LONGEST, 16, picked);
        for (size_t i = 0; i < count; i++)
            met[picked[i] % period]++;
        for (size_t k = 0; k < period; k++)
            check_near("share of a phase", (double)met[k] / 16, 1 / (double)period, 0.55);
    }
}

static void check_cap(void)
{
    double factor[LONGEST];
    pair p;
    for (size_t k = 0; k < LONGEST; k++)
        factor[k] = 1 + 0.01 * (double)k;
    stage *s = open_train(&p, LONGEST, factor);
    check_true("a long motion", stage_run_wanted(s, wanted) == FF_OK);
    check_near("is judged by 16", stage_scalar(s, "engagements_judged"), 16, 0);
    check_near("of 64", stage_quality(s, "engagements"), 16, 0);
    check_near("whose mean is near that of all", stage_scalar(s, "mesh_load_mean"), 3000 * 1.315,
               0.01);
    pair_close(&p);
    s = open_train(&p, LONGEST, factor);
    stage_set(s, "max_engagements", LONGEST);
    check_true("or by all", stage_run_wanted(s, wanted) == FF_OK);
    check_near("with their mean", stage_scalar(s, "mesh_load_mean"), 3000 * 1.315, 1e-3);
    pair_close(&p);
}

int main(void)
{
    check_two();
    check_gaps();
    check_sample();
    check_cap();
    return check_done();
}
