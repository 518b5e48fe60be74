/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measured flanks: resampling, directions, lengths, and continuation beyond the record. */
#include "trace-file.h"

#include <check.h>
#include <stage.h>

#include <math.h>
#include <unistd.h>

enum { N = 300 };

/* Writes a trace of n points, equally or unequally spaced, with heights without symmetry. */
static void write_rough(char path[PATH_ROOM], size_t n, double uneven)
{
    double position[N], height[N];
    for (size_t i = 0; i < n; i++) {
        double at = (double)i + uneven * sin(1.7 * (double)i);
        position[i] = 5e-6 + 2e-6 * at;
        height[i] = 1e-6 * (sin(0.05 * at) + 0.3 * cos(0.173 * at));
    }
    write_trace(path, n, position, height);
}

static stage *open_rough(char path[PATH_ROOM], const char *extend, double uneven)
{
    write_rough(path, N, uneven);
    stage *s = stage_open("surface/measured");
    stage_set_text(s, "file_1", path);
    stage_set_text(s, "detrend", "none");
    stage_set_text(s, "extend", extend);
    return s;
}

static void run(stage *s)
{
    check_true("runs", stage_run(s) == FF_OK);
}

static void test_even_points_are_kept(void)
{
    char path[PATH_ROOM];
    stage *s = open_rough(path, "periodic", 0);
    run(s);
    size_t n;
    const double *x = stage_get(s, "position", &n), *z = stage_get(s, "height_1", NULL);
    double worst = 0;
    for (size_t i = 0; i < n; i++) {
        double at = (double)i;
        worst = fmax(worst, fabs(z[i] - 1e-6 * (sin(0.05 * at) + 0.3 * cos(0.173 * at))));
    }
    check_true("all points", n == N);
    check_below("heights", worst, 1e-20);
    check_near("spacing", x[1] - x[0], 2e-6, 1e-9);
    check_near("period", stage_scalar(s, "period"), 2e-6 * N, 1e-9);
    check_true("smooth flank 2", !(stage_scalar(s, "rq_2") > 0));
    stage_close(s);
    unlink(path);
}

static void test_mirror_image_follows(void)
{
    char path[PATH_ROOM];
    stage *s = open_rough(path, "mirror", 0);
    run(s);
    size_t n;
    const double *z = stage_get(s, "height_1", &n);
    double worst = 0;
    for (size_t i = 0; i < n; i++)
        worst = fmax(worst, fabs(z[i] - z[n - 1 - i]));
    check_true("twice as long", n == 2 * N);
    check_true("symmetric", !(worst > 0));
    check_near("period", stage_scalar(s, "period"), 4e-6 * N, 1e-9);
    check_true("no step at the seam", !(stage_quality(s, "seam") > 0));
    stage_close(s);
    unlink(path);
}

static void test_flat_outside(void)
{
    char path[PATH_ROOM];
    stage *s = open_rough(path, "flat", 0);
    run(s);
    check_true("no period", !(stage_scalar(s, "period") > 0));
    check_true("the step at the ends is told", stage_quality(s, "seam") > 2);
    check_true("and doubted", stage_verdict(s) == FF_DOUBTFUL);
    stage_close(s);
    unlink(path);
}

/* The integral of the file, by the trapezoidal rule, must be that of the record's heights, with
   half cells at both ends. */
static void test_resampling_keeps_the_integral(void)
{
    char path[PATH_ROOM];
    double before = 0, after = 0;
    for (size_t i = 0; i + 1 < N; i++) {
        double z[2], x[2];
        for (size_t k = 0; k < 2; k++) {
            double at = (double)(i + k) + 0.4 * sin(1.7 * (double)(i + k));
            x[k] = 2e-6 * at;
            z[k] = 1e-6 * (sin(0.05 * at) + 0.3 * cos(0.173 * at));
        }
        before += (x[1] - x[0]) * (z[0] + z[1]) / 2;
    }
    stage *s = open_rough(path, "flat", 0.4);
    run(s);
    size_t n;
    const double *x = stage_get(s, "position", &n), *z = stage_get(s, "height_1", NULL);
    for (size_t i = 0; i < n; i++)
        after += x[1] * z[i] * (i == 0 || i + 1 == n ? 0.5 : 1);
    check_near("integral", after, before, 1e-9);
    check_below("departure told", stage_quality(s, "resampling_1"), 0.05);
    stage_close(s);
    unlink(path);
}

static void test_coarse_spacing_is_doubted(void)
{
    char path[PATH_ROOM];
    stage *s = open_rough(path, "mirror", 0);
    stage_set_text(s, "spacing", "50 um");
    run(s);
    check_true("doubtful", stage_verdict(s) == FF_DOUBTFUL);
    stage_close(s);
    unlink(path);
}

static void test_reversed(void)
{
    char path[PATH_ROOM];
    stage *a = open_rough(path, "flat", 0);
    stage *b = stage_open("surface/measured");
    stage_set_text(b, "file_1", path);
    stage_set_text(b, "file_2", path);
    stage_set_text(b, "detrend", "none");
    stage_set_text(b, "extend", "flat");
    stage_set_text(b, "direction_2", "reversed");
    run(a);
    run(b);
    const double *z = stage_get(a, "height_1", NULL), *z1 = stage_get(b, "height_1", NULL);
    const double *z2 = stage_get(b, "height_2", NULL);
    double worst = 0;
    for (size_t i = 0; i < N; i++)
        worst = fmax(worst, fabs(z[i] - z1[i]) + fabs(z[i] - z2[N - 1 - i]));
    check_true("flank 2 alone", !(worst > 0));
    stage_close(a);
    stage_close(b);
    unlink(path);
}

static void test_records_of_two_lengths(void)
{
    char path[PATH_ROOM], shorter[PATH_ROOM];
    stage *s = open_rough(path, "periodic", 0);
    write_rough(shorter, 200, 0);
    stage_set_text(s, "file_2", shorter);
    stage_set_text(s, "origin", "30 um");
    run(s);
    size_t n;
    stage_get(s, "height_1", &n);
    check_true("the shorter", n == 200);
    check_near("origin", stage_scalar(s, "origin"), 30e-6, 1e-12);
    stage_close(s);
    unlink(path);
    unlink(shorter);
}

int main(void)
{
    test_even_points_are_kept();
    test_mirror_image_follows();
    test_flat_outside();
    test_resampling_keeps_the_integral();
    test_coarse_spacing_is_doubted();
    test_reversed();
    test_records_of_two_lengths();
    return check_done();
}
