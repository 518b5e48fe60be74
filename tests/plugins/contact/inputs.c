/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wrong inputs, as plugins of other authors for gears or motions could give. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { COUNT = 7 };

/* An entry to replace in one of the arrays below. */
typedef struct fault {
    const char *what, *row;
    int entry;
    double value;
} fault;

static const fault faults[] = {
    {"a roll angle that is not a number", "gear.roll_angle", 2, NAN},
    {"a roll angle that goes back", "gear.roll_angle", 1, 0.9},
    {"a radius of 0", "gear.radius_1", 0, 0},
    {"a negative radius", "gear.radius_2", 6, -1e-3},
    {"an endless gap", "load.gap", 3, INFINITY},
    {"gear 2 without teeth", "gear.teeth", 1, 0},
    {"no face width", "gear.face_width", 0, 0},
    {"a negative modulus", "gear.reduced_modulus", 0, -1},
    {"a gear at rest", "operating.speed", 0, 0},
    {"a speed that is not a number", "operating.speed", 0, NAN},
    {"a force out of all bounds", "load.tooth_force", 3, 1e308},
};

/* Rows in the order of the model's inputs; the load jumps between stations 2 and 3, and 4 and 5. */
static stage *open_tooth(const fault *f)
{
    static const char *const rows[] = {
        "gear.roll_angle", "gear.radius_1", "gear.radius_2",   "load.tooth_force",
        "load.gap",        "gear.teeth",    "gear.face_width", "gear.reduced_modulus",
        "operating.speed"};
    static double data[9][COUNT];
    static const double good[9][COUNT] = {{0.3, 0.35, 0.4, 0.4, 0.5, 0.5, 0.6},
                                          {0.02, 0.022, 0.024, 0.024, 0.03, 0.03, 0.035},
                                          {0.03, 0.028, 0.026, 0.026, 0.02, 0.02, 0.015},
                                          {900, 1000, 1000, 2000, 2000, 1000, 1000},
                                          {0, 0, 0, 0, 0, 0, 0},
                                          {20, 30},
                                          {0.02},
                                          {226e9},
                                          {150}};
    stage *tooth = stage_open("contact/tooth-pair");
    for (int i = 0; i < 9; i++) {
        memcpy(data[i], good[i], sizeof data[i]);
        if (f && !strcmp(f->row, rows[i]))
            data[i][f->entry] = f->value;
        if (i < 6)
            stage_give_series(tooth, rows[i], i < 5 ? COUNT : 2, data[i]);
        else
            stage_give(tooth, rows[i], 0, NULL, data[i]);
    }
    return tooth;
}

static const char wanted[] = "time load_per_width hertz_pressure slide_roll_ratio gap";

static void check_repeats(const char *what, size_t n, const double *roll, ff_status expected)
{
    static const double radius[COUNT] = {1, 1, 1, 1, 1, 1, 1};
    stage *tooth = open_tooth(NULL);
    stage_give_series(tooth, "gear.roll_angle", n, roll);
    stage_give_series(tooth, "gear.radius_1", n, radius);
    stage_give_series(tooth, "gear.radius_2", n, radius);
    stage_give_series(tooth, "load.tooth_force", n, radius);
    stage_give_series(tooth, "load.gap", n, radius);
    check_true(what, stage_run_wanted(tooth, wanted) == expected);
    stage_close(tooth);
}

static uint64_t state = 239443;

/* xorshift64*, uniform in [low, high). */
static double uniform(double low, double high)
{
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    double unit = (double)((state * UINT64_C(2685821657736338717)) >> 11) / 9007199254740992.0;
    return low + (high - low) * unit;
}

/* Runs a random load at random stations. Returns 0 if the history is within the load's bounds, 1 if
   not, -1 if the run fails because of its ramps. */
static int run_random(void)
{
    enum { MOST = 60 };
    static double roll[MOST], radius[MOST], force[MOST], gap[MOST];
    size_t n = (size_t)uniform(2, MOST), points = (size_t)uniform(130, 400), count;
    double top = 0, largest = 0, at = uniform(0, 1), coarse = exp(uniform(-9, 0));
    for (size_t i = 0; i < n; i++) {
        at += i == n - 1 || uniform(0, 1) < 0.8 ? coarse * uniform(1e-3, 1) : 0;
        roll[i] = at;
        radius[i] = uniform(1e-3, 1);
        force[i] = uniform(-1, 1) * exp(uniform(-20, 20));
        gap[i] = uniform(-1e-4, 1e-4);
        top = fmax(top, force[i]);
        largest = fmax(largest, fabs(force[i])); /* rounding errors are relative to the neighbouring
                                                    forces */
    }
    stage *tooth = open_tooth(NULL);
    stage_give_series(tooth, "gear.roll_angle", n, roll);
    stage_give_series(tooth, "gear.radius_1", n, radius);
    stage_give_series(tooth, "gear.radius_2", n, radius);
    stage_give_series(tooth, "load.tooth_force", n, force);
    stage_give_series(tooth, "load.gap", n, gap);
    stage_set(tooth, "points", (double)points);
    stage_set(tooth, "load_ramp", uniform(0, 1) < 0.5 ? 0 : coarse * uniform(0, 0.01));
    ff_status status = stage_run_wanted(tooth, wanted);
    int verdict = status == FF_INVALID && !strcmp(stage_why_item(tooth), "load_ramp") ? -1 : 1;
    if (status == FF_OK) {
        const double *t = stage_get(tooth, "time", &count), *g = stage_get(tooth, "gap", NULL);
        const double *w = stage_get(tooth, "load_per_width", NULL);
        verdict = count != points;
        for (size_t i = 0; i < count; i++)
            if (w[i] < 0 || w[i] * 0.02 > top + 2e-15 * largest || g[i] < 0 || g[i] > 1e-4 ||
                (i > 0 && !(t[i] > t[i - 1])))
                verdict = 1;
    }
    stage_close(tooth);
    return verdict;
}

static void check_random(void)
{
    int good = 0, wrong = 0;
    for (int i = 0; i < 5000; i++) {
        int verdict = run_random();
        good += verdict == 0;
        wrong += verdict > 0;
    }
    printf("%d of 5000 random loads ran\n", good);
    check_true("most random loads run", good > 2500);
    check_near("random loads that overshoot or stand still", wrong, 0, 0);
}

int main(void)
{
    check_random();
    stage *tooth = open_tooth(NULL);
    check_true("coarse stations by hand run", stage_run_wanted(tooth, wanted) == FF_OK);
    check_near("first load", stage_get(tooth, "load_per_width", NULL)[0], 900 / 0.02, 1e-14);
    stage_close(tooth);
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; i++) {
        tooth = open_tooth(&faults[i]);
        ff_status status = stage_run_wanted(tooth, wanted);
        printf("%s: %s\n", faults[i].what, stage_why(tooth));
        check_true(faults[i].what, status == FF_INVALID && strlen(stage_why(tooth)) > 20);
        stage_close(tooth);
    }
    check_repeats("three stations at one angle", 7, (double[]){0.1, 0.2, 0.2, 0.2, 0.3, 0.4, 0.5},
                  FF_OK);
    check_repeats("jumps at both ends", 6, (double[]){0.1, 0.1, 0.2, 0.3, 0.4, 0.4}, FF_OK);
    check_repeats("two stations", 2, (double[]){0.1, 0.4}, FF_OK);
    check_repeats("all stations at one angle", 4, (double[]){0.2, 0.2, 0.2, 0.2}, FF_INVALID);
    check_repeats("one station", 1, (double[]){0.2}, FF_INVALID);
    check_repeats("no station", 0, (double[]){0.2}, FF_INVALID);
    return check_done();
}
