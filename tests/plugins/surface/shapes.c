/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares waves and dents with their formulas. */
#include <check.h>
#include <stage.h>

#include <math.h>

static stage *open_wave(const char *flank)
{
    stage *s = stage_open("surface/sinusoidal");
    stage_set_text(s, "amplitude", "0.4 um");
    stage_set_text(s, "wavelength", "50 um");
    stage_set_text(s, "flank", flank);
    check_true("runs", stage_run(s) == FF_OK);
    return s;
}

static double rms(const stage *s, const char *output)
{
    size_t n;
    const double *z = stage_get(s, output, &n);
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += z[i] * z[i];
    return sqrt(sum / (double)n);
}

static void test_wave_repeats_after_one_wavelength(void)
{
    stage *s = open_wave("1");
    size_t n;
    const double *x = stage_get(s, "position", &n), *z = stage_get(s, "height_1", NULL);
    double worst = 0;
    for (size_t i = 0; i < n; i++)
        worst = fmax(worst, fabs(z[i] - 0.4e-6 * cos(2 * M_PI * x[i] / 50e-6)));
    check_below("heights", worst, 1e-20);
    check_near("period", stage_scalar(s, "period"), 50e-6, 1e-12);
    check_near("n dx", (double)n * x[1], 50e-6, 1e-12);
    stage_close(s);
}

static void test_wave_flanks(void)
{
    static const char *const flanks[] = {"1", "2", "both"};
    for (int i = 0; i < 3; i++) {
        stage *s = open_wave(flanks[i]);
        check_near("rq_1", stage_scalar(s, "rq_1"), i == 1 ? 0 : 0.4e-6 / sqrt(2), 1e-12);
        check_near("rq_2", stage_scalar(s, "rq_2"), i == 0 ? 0 : 0.4e-6 / sqrt(2), 1e-12);
        check_near("of the heights", rms(s, "height_1"), stage_scalar(s, "rq_1"), 1e-12);
        check_near("of the heights", rms(s, "height_2"), stage_scalar(s, "rq_2"), 1e-12);
        stage_close(s);
    }
}

static stage *open_dent(const char *shape)
{
    stage *s = stage_open("surface/dent");
    stage_set_text(s, "depth", "2 um");
    stage_set_text(s, "width", "100 um");
    stage_set_text(s, "start", "-600 um");
    stage_set_text(s, "flank", "2");
    stage_set_text(s, "shape", shape);
    check_true("runs", stage_run(s) == FF_OK);
    return s;
}

/* Returns the height at a distance from the point that is at x = start at the first time. */
static double height_at(const stage *s, double distance)
{
    size_t n;
    const double *x = stage_get(s, "position", &n), *z = stage_get(s, "height_2", NULL);
    double at = stage_scalar(s, "origin") - 600e-6 + distance;
    size_t k = (size_t)fmin(fmax(round(at / x[1]), 0), (double)(n - 1));
    return z[k];
}

static void test_dent(const char *shape, double at_half, double at_quarter)
{
    stage *s = open_dent(shape);
    size_t n;
    const double *z = stage_get(s, "height_2", &n);
    check_near("middle", height_at(s, 0), -2e-6, 1e-12);
    check_near("half a width off", height_at(s, 50e-6), at_half, 1e-9);
    check_near("a quarter before", height_at(s, -25e-6), at_quarter, 1e-9);
    check_below("flat at the ends", fmax(fabs(z[0]), fabs(z[n - 1])), 2e-6 * 1.1e-10);
    check_true("flat outside", !(stage_scalar(s, "period") > 0));
    check_true("flank 1 is smooth", !(rms(s, "height_1") > 0));
    check_true("no roughness", !(stage_scalar(s, "rq_2") > 0));
    stage_close(s);
}

int main(void)
{
    test_wave_repeats_after_one_wavelength();
    test_wave_flanks();
    test_dent("cosine", 2e-6 * pow(10, -2.5), 0);
    test_dent("gaussian", -1e-6, -2e-6 * pow(2, -0.25));
    return check_done();
}
