/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Synthetic flanks: Rq, spectrum and effect of the seed. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static stage *open_rough(void)
{
    stage *s = stage_open("surface/synthetic");
    stage_set_text(s, "rq", "[0.54 um, 0.53 um]");
    return s;
}

static void run(stage *s)
{
    check_true("runs", stage_run(s) == FF_OK);
}

/* Returns the amplitude of the wave with k periods in the record. */
static double amplitude(const stage *s, const char *output, size_t k)
{
    size_t n;
    const double *z = stage_get(s, output, &n);
    double c = 0, d = 0;
    for (size_t i = 0; i < n; i++) {
        double angle = 2 * M_PI * (double)(k * i % n) / (double)n;
        c += z[i] * cos(angle);
        d += z[i] * sin(angle);
    }
    return 2 * hypot(c, d) / (double)n;
}

static void check_rq(const stage *s, const char *height, double rq)
{
    size_t n;
    const double *z = stage_get(s, height, &n);
    double sum = 0, square = 0;
    for (size_t i = 0; i < n; i++) {
        sum += z[i];
        square += z[i] * z[i];
    }
    check_near("Rq", sqrt(square / (double)n), rq, 1e-12);
    check_below("mean", fabs(sum / (double)n), 1e-20);
}

static void test_rq_is_exact(const char *amplitudes)
{
    static const double rq[] = {0.54e-6, 0.53e-6};
    static const char *const height[] = {"height_1", "height_2"};
    stage *s = open_rough();
    stage_set_text(s, "amplitudes", amplitudes);
    run(s);
    for (int g = 0; g < 2; g++)
        check_rq(s, height[g], rq[g]);
    check_near("rq_1", stage_scalar(s, "rq_1"), rq[0], 1e-15);
    check_true("trusted", stage_verdict(s) == FF_GOOD);
    stage_close(s);
}

static void test_spectrum_follows_the_slope(double slope)
{
    stage *s = open_rough();
    stage_set(s, "spectrum_slope", slope);
    run(s);
    double first = amplitude(s, "height_1", 10); /* length: 10 longest waves */
    check_near("one octave", amplitude(s, "height_1", 20) / first, pow(2, -slope / 2), 1e-9);
    check_near("shortest", amplitude(s, "height_1", 400) / first, pow(40, -slope / 2), 1e-9);
    check_below("longer than the longest", amplitude(s, "height_1", 9), 1e-18);
    check_below("shorter than the shortest", amplitude(s, "height_1", 401), 1e-18);
    stage_close(s);
}

/* The mean of |amplitude|^2 k^slope must be equal in both halves of the band, with 195 waves each:
   their ratio scatters by sqrt(2/195) = 10 %. */
static void test_gaussian_spectrum_holds_on_average(void)
{
    stage *s = open_rough();
    stage_set_text(s, "amplitudes", "gaussian");
    run(s);
    double half[2] = {0};
    for (size_t k = 10; k < 400; k++)
        half[k >= 205] += pow(amplitude(s, "height_1", k) * (double)k, 2);
    check_near("flat over 1/k^2", half[1] / half[0], 1, 0.3);
    check_true("amplitudes scatter",
               fabs(amplitude(s, "height_1", 20) / amplitude(s, "height_1", 10) - 0.5) > 1e-3);
    stage_close(s);
}

static double difference(const stage *a, const stage *b, const char *output)
{
    size_t n;
    const double *x = stage_get(a, output, &n), *y = stage_get(b, output, NULL);
    double worst = 0;
    for (size_t i = 0; i < n; i++)
        worst = fmax(worst, fabs(x[i] - y[i]));
    return worst;
}

static void test_seeds(void)
{
    stage *a = open_rough(), *b = open_rough(), *c = open_rough();
    stage_set_text(a, "seed", "[7, 8]");
    stage_set_text(b, "seed", "[7, 9]");
    stage_set_text(c, "seed", "7");
    run(a);
    run(b);
    run(c);
    check_true("flank 1 keeps", !(difference(a, b, "height_1") > 0));
    check_true("flank 2 changes", difference(a, b, "height_2") > 1e-7);
    check_true("one seed is both", !(difference(a, c, "height_1") > 0));
    size_t n;
    const double *z1 = stage_get(c, "height_1", &n), *z2 = stage_get(c, "height_2", NULL);
    double product = 0;
    for (size_t i = 0; i < n; i++)
        product += z1[i] * z2[i] / (0.54e-6 * 0.53e-6 * (double)n);
    check_below("flanks of one seed do not go together", fabs(product), 0.3);
    stage_close(a);
    stage_close(b);
    stage_close(c);
}

static void test_rq_of_one_flank_leaves_the_other(void)
{
    stage *a = open_rough(), *b = stage_open("surface/synthetic");
    stage_set_text(b, "rq", "[0.54 um, 0 um]");
    run(a);
    run(b);
    check_true("flank 1", !(difference(a, b, "height_1") > 0));
    check_true("smooth", !(stage_scalar(b, "rq_2") > 0));
    stage_close(a);
    stage_close(b);
}

/* These heights must be equal on every machine. */
static void test_the_same_everywhere(void)
{
    stage *s = open_rough();
    stage_set_text(s, "seed", "[2, 3]");
    run(s);
    const double *z1 = stage_get(s, "height_1", NULL), *z2 = stage_get(s, "height_2", NULL);
    check_near("flank 1", z1[1000], 1.226083515e-06, 1e-9);
    check_near("flank 2", z2[12345], -1.190943509e-06, 1e-9);
    stage_close(s);
}

static void test_record_repeats_after_its_length(void)
{
    stage *s = open_rough();
    stage_set_text(s, "length", "3 mm");
    stage_set_text(s, "longest", "0.3 mm");
    stage_set_text(s, "spacing", "2 um");
    stage_set_text(s, "origin", "12 um");
    run(s);
    size_t n;
    const double *x = stage_get(s, "position", &n);
    check_near("period", stage_scalar(s, "period"), 3e-3, 1e-12);
    check_near("n dx", (double)n * x[1], 3e-3, 1e-12);
    check_below("as fine as asked", x[1], 2e-6);
    check_near("origin", stage_scalar(s, "origin"), 12e-6, 1e-12);
    stage_close(s);
}

static void test_a_single_wave(void)
{
    stage *s = open_rough();
    stage_set_text(s, "shortest", "100 um");
    stage_set_text(s, "longest", "100 um");
    stage_set_text(s, "length", "100 um");
    run(s);
    check_near("amplitude", amplitude(s, "height_1", 1), 0.54e-6 * sqrt(2), 1e-12);
    check_true("is no random surface", stage_verdict(s) == FF_DOUBTFUL);
    stage_close(s);
}

static void test_steepest_spectra(void)
{
    static const double slopes[] = {-10, 10};
    for (int i = 0; i < 2; i++) {
        stage *s = open_rough();
        stage_set_text(s, "shortest", "2 um");
        stage_set_text(s, "longest", "1600 um");
        stage_set(s, "spectrum_slope", slopes[i]);
        run(s);
        check_rq(s, "height_1", 0.54e-6);
        check_rq(s, "height_2", 0.53e-6);
        stage_close(s);
    }
}

static void refuse(const char *param, const char *value, const char *item, const char *sentence)
{
    stage *s = open_rough();
    stage_set_text(s, param, value);
    check_true(sentence, stage_run(s) == FF_INVALID && !strcmp(stage_why_item(s), item) &&
                             strstr(stage_why(s), sentence));
    stage_close(s);
}

static void test_refusals(void)
{
    refuse("shortest", "900 um", "shortest", "must not exceed longest, 800 um");
    refuse("length", "700 um", "length", "at least the longest wavelength");
    refuse("spacing", "6 um", "spacing", "at most 5 um, a quarter of it");
    refuse("spacing", "0.001 um", "length", "at most 262144 are allowed");
    refuse("shortest", "0.01 um", "length", "at most 262144 are allowed");
}

int main(void)
{
    test_rq_is_exact("fixed");
    test_rq_is_exact("gaussian");
    test_spectrum_follows_the_slope(2);
    test_spectrum_follows_the_slope(0);
    test_spectrum_follows_the_slope(3.2);
    test_gaussian_spectrum_holds_on_average();
    test_seeds();
    test_rq_of_one_flank_leaves_the_other();
    test_the_same_everywhere();
    test_record_repeats_after_its_length();
    test_a_single_wave();
    test_steepest_spectra();
    test_refusals();
    return check_done();
}
