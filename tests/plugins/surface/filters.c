/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Gaussian filter and the detrending of measured flanks. */
#include "trace-file.h"

#include <check.h>
#include <stage.h>

#include <math.h>
#include <unistd.h>

enum { N = 4000 };

static double position[N], height[N];

/* Opens a trace of 4 mm, for the settings of the test. */
static stage *open_trace(char path[PATH_ROOM])
{
    for (int i = 0; i < N; i++)
        position[i] = 1e-6 * i;
    write_trace(path, N, position, height);
    stage *s = stage_open("surface/measured");
    stage_set_text(s, "file_1", path);
    stage_set_text(s, "detrend", "none");
    stage_set_text(s, "extend", "flat");
    return s;
}

static const double *run(stage *s, const char *path)
{
    check_true("runs", stage_run(s) == FF_OK);
    unlink(path);
    size_t n;
    const double *z = stage_get(s, "height_1", &n);
    check_true("as long as the file", n == N);
    return z;
}

/* Returns the amplitude ratio of a filtered wave, from the middle of the record. */
static double share_of_wave(double wavelength, const char *cutoff, const char *value)
{
    char path[PATH_ROOM];
    for (int i = 0; i < N; i++)
        height[i] = 1e-6 * cos(2 * M_PI * (i - N / 2) * 1e-6 / wavelength);
    stage *s = open_trace(path);
    stage_set_text(s, cutoff, value);
    double share = run(s, path)[N / 2] / 1e-6;
    stage_close(s);
    return share;
}

static void test_half_of_a_wave_passes_at_the_cutoff(void)
{
    check_near("long", share_of_wave(400e-6, "cutoff_long", "400 um"), 0.5, 1e-5);
    check_near("short", share_of_wave(50e-6, "cutoff_short", "50 um"), 0.5, 1e-5);
    check_near("short, few points", share_of_wave(5e-6, "cutoff_short", "5 um"), 0.5, 1e-4);
}

/* exp(-pi (alpha cutoff/wavelength)^2) = 2^-(cutoff/wavelength)^2 */
static void test_transmission_away_from_the_cutoff(void)
{
    check_near("half", share_of_wave(200e-6, "cutoff_long", "400 um"), 1 - 1.0 / 16, 1e-5);
    check_near("double", share_of_wave(800e-6, "cutoff_long", "400 um"), 1 - pow(2, -0.25), 1e-5);
    check_near("shorter", share_of_wave(25e-6, "cutoff_short", "50 um"), 1.0 / 16, 1e-5);
}

static void test_filter_keeps_the_mean(void)
{
    char path[PATH_ROOM];
    double before = 0, after = 0;
    for (int i = 0; i < N; i++)
        before += height[i] = 1e-6 * (exp(-i / 300.0) + sin(i * 0.037));
    stage *s = open_trace(path);
    stage_set_text(s, "cutoff_short", "700 um");
    const double *z = run(s, path);
    for (int i = 0; i < N; i++)
        after += z[i];
    check_near("mean", after, before, 1e-11);
    stage_close(s);
}

static void test_filter_keeps_a_constant_to_the_ends(void)
{
    char path[PATH_ROOM];
    double worst = 0;
    for (int i = 0; i < N; i++)
        height[i] = 3e-6;
    stage *s = open_trace(path);
    stage_set_text(s, "cutoff_short", "1000 um");
    const double *z = run(s, path);
    for (int i = 0; i < N; i++)
        worst = fmax(worst, fabs(z[i] - 3e-6));
    check_below("departure", worst, 1e-18);
    stage_close(s);
}

/* Removal of a polynomial must leave nothing of a polynomial of this order. */
static void test_detrend(const char *order, int degree, double left)
{
    char path[PATH_ROOM];
    double worst = 0;
    for (int i = 0; i < N; i++)
        height[i] = 1e-5 * (1 + pow(i / (double)N, degree));
    stage *s = open_trace(path);
    stage_set_text(s, "detrend", order);
    const double *z = run(s, path);
    for (int i = 0; i < N; i++)
        worst = fmax(worst, fabs(z[i]));
    if (left > 0)
        check_near(order, worst, left, 1e-3);
    else
        check_below(order, worst, 1e-17);
    stage_close(s);
}

int main(void)
{
    test_half_of_a_wave_passes_at_the_cutoff();
    test_transmission_away_from_the_cutoff();
    test_filter_keeps_the_mean();
    test_filter_keeps_a_constant_to_the_ends();
    test_detrend("linear", 1, 0);
    test_detrend("5", 5, 0);
    test_detrend("mean", 1, 0.5e-5);
    test_detrend("linear", 2, 1e-5 / 6); /* x^2 - x + 1/6 at the ends */
    return check_done();
}
