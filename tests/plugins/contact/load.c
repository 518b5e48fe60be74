/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the tooth force becomes a load history: ramps, clipping, gaps, engagements, errors. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST = 4000 };

static const double degree = M_PI / 180;

/* Returns the integral of the load over the roll angle, exact for a load that is linear between
   instants. */
static double integral(const stage *tooth, const char *output)
{
    size_t n;
    const double *x = stage_get(tooth, "roll_angle", &n), *y = stage_get(tooth, output, NULL);
    double sum = 0;
    for (size_t i = 1; i < n; i++)
        sum += (y[i] + y[i - 1]) / 2 * (x[i] - x[i - 1]);
    return sum;
}

/* Checks both jumps of the load of a tooth pair as ramps of a width, or as steps if it is 0. */
static void check_ramp(const char *ramp, double width)
{
    static double load[MOST];
    pair p = pair_open();
    size_t n, inside = 0;
    const double *roll = pair_stations(&p, &n);
    double base_pitch = 360. / 25 * degree, path = roll[n - 1] - roll[0], steepest = 0, wrong = 0;
    if (width == 0)
        width = 1e-6 * path;
    pair_share(&p, 2000, load);
    stage_give_series(p.tooth, "load.tooth_force", n, load);
    stage_set_text(p.tooth, "load_ramp", ramp);
    if (check_true(ramp, stage_run_wanted(p.tooth, pair_dry) == FF_OK)) {
        double exact = (2000 * (2 * base_pitch - path) + 1000 * 2 * (path - base_pitch)) / 0.02;
        check_near("a centred ramp keeps the integral", integral(p.tooth, "load_per_width"), exact,
                   1e-12);
        const double *x = stage_get(p.tooth, "roll_angle", &n);
        const double *t = stage_get(p.tooth, "time", NULL);
        const double *w = stage_get(p.tooth, "load_per_width", NULL);
        double lpstc = stage_scalar(p.gear, "roll_lpstc"), forward = 1;
        for (size_t i = 1; i < n; i++) {
            forward = fmin(forward, t[i] - t[i - 1]);
            steepest = fmax(steepest, (w[i] - w[i - 1]) / (x[i] - x[i - 1]));
            if (fabs(x[i] - lpstc) < width / 2) {
                double ramped = 5e4 * (1.5 + (x[i] - lpstc) / width);
                wrong = fmax(wrong, fabs(w[i] / ramped - 1));
                inside++;
            }
        }
        check_true("time increases", forward > 0);
        check_near("slope of the ramp", steepest, 5e4 / width, 1e-8);
        check_below("linear within the ramp", wrong, 1e-8);
        check_true("instants inside the ramp, but for one of no width",
                   width > 1e-5 * path ? inside > 10 : inside == 0);
    }
    pair_close(&p);
}

/* Returns the largest error of a smooth force with a number of stations, over its maximum, and its
   estimate. */
static double interpolation_error(double stations, double *estimate)
{
    static double load[MOST];
    pair p = pair_open();
    stage_close(p.gear);
    p.gear = stage_open("gear/involute-spur");
    stage_set_text(p.gear, "teeth", "[25, 40]");
    stage_set_text(p.gear, "profile_shift", "[0.3, 0.1]");
    stage_set_text(p.gear, "module", "3 mm");
    stage_set_text(p.gear, "face_width", "20 mm");
    stage_set(p.gear, "stations", stations);
    stage_link(p.duty, "gear", p.gear);
    stage_link(p.tooth, "gear", p.gear);
    stage_run(p.gear);
    size_t n;
    const double *x = pair_stations(&p, &n);
    double worst = 0;
    for (size_t i = 0; i < n; i++)
        load[i] = 3000 + 2000 * cos(60 * x[i]);
    stage_give_series(p.tooth, "load.tooth_force", n, load);
    stage_set(p.tooth, "load_ramp", 0);
    if (check_true("a smooth force runs", stage_run_wanted(p.tooth, pair_dry) == FF_OK)) {
        const double *w = stage_get(p.tooth, "load_per_width", &n);
        x = stage_get(p.tooth, "roll_angle", NULL);
        for (size_t i = 0; i < n; i++)
            worst = fmax(worst, fabs(w[i] * 0.02 - 3000 - 2000 * cos(60 * x[i])) / 5000);
        *estimate = stage_quality(p.tooth, "load_interpolation");
    }
    pair_close(&p);
    return worst;
}

static void check_interpolation(void)
{
    double estimate[2];
    double coarse = interpolation_error(100, &estimate[0]);
    double fine = interpolation_error(200, &estimate[1]);
    check_below("second order between stations", fine, coarse / 3.3);
    check_below("the estimate covers the error, 100 stations", coarse, 1.5 * estimate[0]);
    check_below("the estimate covers the error, 200 stations", fine, 1.5 * estimate[1]);
    check_below("the estimate is not wild", estimate[1], 5 * fine);
}

/* A force that decreases linearly to 0, stays 0, and increases linearly: its end and begin lie
   between stations, and must be instants of the history. */
static void check_ends(double ends_at, double begins_at)
{
    static double load[MOST];
    pair p = pair_open();
    size_t n;
    const double *x = pair_stations(&p, &n);
    const double path = x[n - 1] - x[0], slope = 1e5, ends = x[0] + ends_at * path,
                 begins = x[0] + begins_at * path;
    double worst = 0, nearest[2] = {1, 1};
    for (size_t i = 0; i < n; i++)
        load[i] = slope * fmax(fmax(ends - x[i], x[i] - begins), 0);
    stage_give_series(p.tooth, "load.tooth_force", n, load);
    if (check_true("a load with ends", stage_run_wanted(p.tooth, pair_dry) == FF_OK)) {
        const double *roll = stage_get(p.tooth, "roll_angle", &n),
                     *w = stage_get(p.tooth, "load_per_width", NULL);
        for (size_t i = 0; i < n; i++) {
            double exact = slope * fmax(fmax(ends - roll[i], roll[i] - begins), 0) / 0.02;
            worst = fmax(worst, fabs(w[i] - exact) / (slope * path / 0.02));
            nearest[0] = fmin(nearest[0], fabs(roll[i] - ends) / path);
            nearest[1] = fmin(nearest[1], fabs(roll[i] - begins) / path);
        }
        check_below("the load follows the lines to their ends", worst, 1e-12);
        check_below("an instant at the end", nearest[0], 1e-12);
        check_below("an instant at the begin", nearest[1], 1e-12);
    }
    pair_close(&p);
}

/* A force that is negative in between: there must be no load there, and the given gap, which a
   small force does not end. */
static void check_separation(void)
{
    static double load[MOST], gap[MOST];
    pair p = pair_open();
    size_t n;
    const double *x = pair_stations(&p, &n);
    double middle = (x[0] + x[n - 1]) / 2, path = x[n - 1] - x[0];
    for (size_t i = 0; i < n; i++) {
        load[i] = 1e4 * (fabs(x[i] - middle) - 0.05);
        gap[i] = 1e-4 * (0.06 - fabs(x[i] - middle));
    }
    stage_give_series(p.tooth, "load.tooth_force", n, load);
    stage_give_series(p.tooth, "load.gap", n, gap);
    if (check_true("contact loss runs", stage_run_wanted(p.tooth, pair_dry) == FF_OK)) {
        const double *w = stage_get(p.tooth, "load_per_width", &n);
        const double *g = stage_get(p.tooth, "gap", NULL);
        const double *a = stage_get(p.tooth, "hertz_half_width", NULL);
        int clipped = 0, both = 0, negative = 0;
        double widest = 0;
        for (size_t i = 0; i < n; i++) {
            clipped += w[i] == 0 && a[i] == 0;
            both += w[i] > 0 && g[i] > 0;
            negative += w[i] < 0 || g[i] < 0;
            widest = fmax(widest, g[i]);
        }
        check_near("share without load", clipped / (double)n, 0.1 / path, 5e-3);
        check_near("share with load and gap", both / (double)n, 0.02 / path,
                   2 * path / 0.02 / (double)n); /* an instant at either end */
        check_near("neither is negative", negative, 0, 0);
        check_near("widest gap", widest, 6e-6, 2e-3);
    }
    pair_close(&p);
}

static void check_engagements(void)
{
    static double load[3 * MOST];
    pair p = pair_open();
    size_t n;
    pair_stations(&p, &n);
    for (size_t i = 0; i < 3 * n; i++)
        load[i] = 1000.0 * (double)(1 + i / n);
    stage_give(p.tooth, "load.tooth_force", 2, (size_t[]){3, n}, load);
    stage_set(p.tooth, "engagement", 2);
    check_true("the third engagement runs", stage_run_wanted(p.tooth, pair_dry) == FF_OK);
    check_near("its load", stage_get(p.tooth, "load_per_width", NULL)[0], 3000 / 0.02, 1e-14);
    pair_close(&p);
    p = pair_open();
    stage_give(p.tooth, "load.tooth_force", 2, (size_t[]){3, n}, load);
    stage_set(p.tooth, "engagement", 3);
    check_true("a fourth engagement is refused with the count",
               stage_run_wanted(p.tooth, pair_dry) == FF_INVALID &&
                   !strcmp(stage_why_item(p.tooth), "engagement") &&
                   strstr(stage_why(p.tooth), "has 3"));
    pair_close(&p);
}

static void check_refused(const char *what, const char *param, const char *text, double spoiled,
                          size_t length, const char *item)
{
    static double load[MOST];
    pair p = pair_open();
    size_t n;
    pair_stations(&p, &n);
    pair_share(&p, 2000, load);
    load[5] = spoiled;
    if (param)
        stage_set_text(p.tooth, param, text);
    stage_give_series(p.tooth, "load.tooth_force", length ? length : n, load);
    ff_status status = stage_run_wanted(p.tooth, pair_dry);
    printf("%s: %s\n", what, stage_why(p.tooth));
    check_true(what, status == FF_INVALID && !strcmp(stage_why_item(p.tooth), item));
    pair_close(&p);
}

int main(void)
{
    check_ramp("0.2 deg", 0.2 * degree);
    check_ramp("1.5 deg", 1.5 * degree);
    check_ramp("0 deg", 0);
    check_interpolation();
    check_ends(0.317, 0.633);
    check_ends(0.4, 0.407); /* a few stations without load */
    check_separation();
    check_engagements();
    check_refused("a ramp wider than single contact", "load_ramp", "9 deg", 1000, 0, "load_ramp");
    check_refused("a force that is not a number", NULL, NULL, NAN, 0, "load.tooth_force");
    check_refused("a force without end", NULL, NULL, INFINITY, 0, "load.tooth_force");
    check_refused("a force for other stations", NULL, NULL, 1000, 7, "load.tooth_force");
    return check_done();
}
