/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <string.h>

static stage *open_table(const spur_pair *pair, size_t n, const double *phase, const double *k)
{
    stage *s = stage_open("stiffness/table");
    feed_path(s, pair);
    stage_set_reals(s, "phase", n, phase);
    stage_set_reals(s, "stiffness", n, k);
    return s;
}

static spur_pair unity;

/* Trapezoid of mean 1, with double contact for 0.755 of the cycle, ramps of 0.04, and phase 0 in
   the middle of double contact. */
enum { TRAPEZOID = 6 };
static const double trapezoid_phase[TRAPEZOID] = {0, 0.3575, 0.3975, 0.6025, 0.6425, 1};
static const double two = 1.093793e8, one = 0.710965e8;
static const double trapezoid_k[TRAPEZOID] = {1.093793e8, 1.093793e8, 0.710965e8,
                                              0.710965e8, 1.093793e8, 1.093793e8};

static double trapezoid(double phase)
{
    double from_middle = fabs(phase - 0.5);
    double t = fmin(fmax((from_middle - 0.1025) / 0.04, 0), 1);
    return one + (two - one) * t;
}

static void test_trapezoid(void)
{
    stage *s = open_table(&unity, TRAPEZOID, trapezoid_phase, trapezoid_k);
    check_true("runs", stage_run(s) == FF_OK);
    size_t n, breaks;
    const double *phase = stage_get(s, "phase", &n), *k = stage_get(s, "stiffness", NULL);
    double worst = 0;
    for (size_t i = 0; i < n; i++)
        worst = fmax(worst, fabs(k[i] / trapezoid(phase[i]) - 1));
    check_below("k at all phases", worst, 1e-13);
    const double *at = stage_get(s, "breakpoints", &breaks);
    check_true("the four corners alone", breaks == 4);
    for (size_t i = 0; i < breaks; i++)
        check_near("corner", at[i], trapezoid_phase[i + 1], 0);
    check_near("mean", stage_scalar(s, "stiffness_mean"), two - 0.245 * (two - one), 1e-14);
    const double *harmonic = stage_get(s, "stiffness_harmonics", NULL);
    for (int m = 1; m <= 10; m++) {
        double x = M_PI * m * 0.04, y = M_PI * m * 0.245;
        double exact = 2 * (two - one) * 0.245 * fabs(sin(y) / y * sin(x) / x);
        check_near("harmonic", harmonic[m - 1], exact, 1e-12);
    }
    check_below("straight lines", stage_quality(s, "interpolation_error"), 1e-13);
    stage_close(s);
}

/* A rectangular wave with the lower value from 0.7547 on must keep all jumps. */
static void test_jumps(void)
{
    static const double phase[] = {0, 0.7547, 0.7547, 1}, k[] = {4e8, 4e8, 2e8, 2e8};
    stage *s = open_table(&unity, 4, phase, k);
    stage_set_text(s, "ends", "jump");
    stage_run(s);
    size_t n, breaks;
    const double *at = stage_get(s, "breakpoints", &breaks);
    check_true("two jumps", breaks == 2 && !(at[0] > 0));
    check_near("inner jump", at[1], 0.7547, 0);
    const double *out = stage_get(s, "stiffness", &n);
    check_near("value at 0", out[0], 4e8, 0);
    check_near("value at 1", out[n - 1], 2e8, 0);
    static const double ratio[4] = {0.444, 0.318, 0.156, 0.009};
    const double *harmonic = stage_get(s, "stiffness_harmonics", NULL);
    for (int i = 0; i < 4; i++)
        check_near("harmonic", harmonic[i] / 2e8, ratio[i], 0.001 / ratio[i]);
    check_near("mean", stage_scalar(s, "stiffness_mean"), 2e8 + 0.7547 * 2e8, 1e-14);
    stage_close(s);
}

/* Phase 1 is phase 0: if either is given, both ends must have its value. */
static void test_period_closes(void)
{
    static const double phase[] = {0, 0.5}, k[] = {3e8, 2e8};
    static const double late_phase[] = {0.5, 1}, late_k[] = {2e8, 3e8};
    static const double inner_phase[] = {0.25, 0.75}, inner_k[] = {2.5e8, 2.5e8};
    static const double jump_phase[] = {0, 0, 0.5}, jump_k[] = {4e8, 3e8, 2e8};
    size_t n;
    stage *a = open_table(&unity, 2, phase, k), *b = open_table(&unity, 2, late_phase, late_k);
    stage *c = open_table(&unity, 2, inner_phase, inner_k);
    stage *d = open_table(&unity, 3, jump_phase, jump_k);
    stage_run(a), stage_run(b), stage_run(c), stage_run(d);
    const double *ka = stage_get(a, "stiffness", &n), *kb = stage_get(b, "stiffness", NULL);
    check_true("the same function", !memcmp(ka, kb, n * sizeof *ka));
    check_near("value at 1", ka[n - 1], 3e8, 0);
    const double *kc = stage_get(c, "stiffness", &n);
    check_near("wrapped", kc[0] + kc[n - 1], 5e8, 1e-15);
    const double *kd = stage_get(d, "stiffness", &n);
    check_near("before the jump at 0", kd[n - 1], 4e8, 0);
    check_near("after it", kd[0], 3e8, 0);
    check_true("a constant has no breakpoint", stage_count(c, "breakpoints") == 0);
    stage_close(a), stage_close(b), stage_close(c), stage_close(d);
}

static void test_rigid_share(void)
{
    stage *s = open_table(&unity, TRAPEZOID, trapezoid_phase, trapezoid_k);
    stage_run(s);
    const double *share = stage_get(s, "load_share", NULL);
    const double *force = stage_get(s, "tooth_force", NULL);
    for (size_t i = 0; i < PAIR_STATIONS; i++) {
        int alone = i > unity.lpstc && i <= unity.hpstc;
        check_near("share", share[i], alone ? 1 : 0.5, 0);
        check_near("force", force[i], unity.line_force * share[i], 0);
    }
    check_below("equilibrium", stage_quality(s, "equilibrium"), 1e-15);
    stage_close(s);
}

static double growing(double phase)
{
    return 2e8 * exp(phase);
}

/* Returns the largest error of the output for a smooth function with a jump at 0, given at n + 1
   phases. */
static double smooth_error(int n, const char *interpolation)
{
    double phase[81], k[81], worst = 0;
    for (int i = 0; i <= n; i++) {
        phase[i] = (double)i / n;
        k[i] = growing(phase[i]);
    }
    stage *s = open_table(&unity, (size_t)n + 1, phase, k);
    stage_set_text(s, "ends", "jump");
    stage_set_text(s, "interpolation", interpolation);
    stage_set(s, "points", 2000);
    stage_run(s);
    size_t count;
    const double *at = stage_get(s, "phase", &count), *out = stage_get(s, "stiffness", NULL);
    for (size_t i = 0; i < count; i++)
        worst = fmax(worst, fabs(out[i] / growing(at[i]) - 1));
    stage_close(s);
    return worst;
}

/* Slopes from parabolas have errors of second order, so that the error of the cubic is of third
   order. */
static void test_cubic_converges(void)
{
    double coarse = smooth_error(20, "cubic"), fine = smooth_error(40, "cubic");
    check_near("third order", log2(coarse / fine), 3, 0.05);
    check_below("better than linear", fine, 0.1 * smooth_error(40, "linear"));
}

static void test_cubic_does_not_overshoot(void)
{
    static const double phase[] = {0, 0.2, 0.21, 0.5, 0.6, 0.6, 0.9};
    static const double k[] = {4e8, 4e8, 1e8, 1e8, 1.2e8, 3e8, 4e8};
    stage *s = open_table(&unity, 7, phase, k);
    stage_set_text(s, "interpolation", "cubic");
    stage_run(s);
    size_t n, breaks;
    const double *out = stage_get(s, "stiffness", &n), *at = stage_get(s, "breakpoints", &breaks);
    double low = INFINITY, high = 0;
    for (size_t i = 0; i < n; i++) {
        low = fmin(low, out[i]);
        high = fmax(high, out[i]);
    }
    check_near("lowest", low, 1e8, 1e-14);
    check_near("highest", high, 4e8, 1e-14);
    check_true("the jump alone is a breakpoint", breaks == 1);
    check_near("jump", at[0], 0.6, 0);
    stage_close(s);
}

/* Between two jumps, the slopes at both ends must be those of the parabola through the points
   there. */
static void test_cubic_keeps_jumps(void)
{
    static const double phase[] = {0, 0.25, 0.5, 0.75, 1};
    double k[5];
    for (int i = 0; i < 5; i++)
        k[i] = 2e8 + 1e8 * phase[i] * (1 + phase[i]);
    stage *s = open_table(&unity, 5, phase, k);
    stage_set_text(s, "ends", "jump");
    stage_set_text(s, "interpolation", "cubic");
    stage_set(s, "points", 100);
    stage_run(s);
    size_t n;
    const double *at = stage_get(s, "phase", &n), *out = stage_get(s, "stiffness", NULL);
    double worst = 0;
    for (size_t i = 0; i < n; i++)
        worst = fmax(worst, fabs(out[i] / (2e8 + 1e8 * at[i] * (1 + at[i])) - 1));
    check_below("a monotone parabola is exact", worst, 1e-14);
    stage_close(s);
}

static void expect_refusal(size_t n, const double *phase, const double *k, const char *item,
                           const char *word)
{
    stage *s = open_table(&unity, n, phase, k);
    check_true(word, stage_ready(s) < 0 && strstr(stage_why(s), word) &&
                         !strcmp(stage_why_item(s), item));
    stage_close(s);
}

/* The parameter must refuse the values when they are set. */
static void expect_limit(const char *param, const double *values, const char *word)
{
    stage *s = stage_open("stiffness/table");
    check_true(word, ff_instance_set_reals(s, param, values, 3) == FF_INVALID &&
                         strstr(stage_why(s), word) && !strcmp(stage_why_item(s), param));
    stage_close(s);
}

static void test_refusals(void)
{
    static const double good[] = {0, 0.5, 0.75}, k[] = {1e8, 2e8, 3e8};
    static const double falls[] = {0, 0.5, 0.4}, beyond[] = {0, 0.5, 1.25};
    static const double thrice[] = {0.5, 0.5, 0.5}, close[] = {0, 0.5, 0.5 + 1e-12};
    static const double ends[] = {0, 0, 1}, closed[] = {0, 0.5, 1}, negative[] = {1e8, -2e8, 3e8};
    static const double unknown[] = {0, NAN, 0.5}, none[] = {1e8, NAN, 3e8};
    expect_limit("phase", falls, "must not decrease");
    expect_limit("phase", beyond, "1.25 is too large");
    expect_refusal(3, thrice, k, "phase", "at most twice");
    expect_refusal(3, close, k, "phase", "closer than 1e-9");
    expect_refusal(3, ends, k, "phase", "phase 1 is phase 0");
    expect_limit("phase", unknown, "nan");
    expect_refusal(3, closed, k, "stiffness", "value 3: the stiffness is not periodic");
    expect_limit("stiffness", negative, "too small");
    expect_limit("stiffness", none, "nan");
    stage *s = stage_open("stiffness/table");
    feed_path(s, &unity);
    stage_set_reals(s, "phase", 3, good);
    check_true("stiffness missing", stage_ready(s) < 0 && !strcmp(stage_why_item(s), "stiffness"));
    stage_close(s);
    s = stage_open("stiffness/table");
    feed_path(s, &unity);
    stage_set_reals(s, "phase", 3, good);
    stage_set_reals(s, "stiffness", 2, k);
    check_true("lengths", stage_ready(s) < 0 && strstr(stage_why(s), "2 values for 3 phases"));
    stage_close(s);
    s = open_table(&unity, 3, good, k);
    stage_set_text(s, "load_share", "file");
    check_true("share", stage_ready(s) < 0 && !strcmp(stage_why_item(s), "load_share"));
    stage_close(s);
}

static void test_one_value(void)
{
    static const double phase[] = {0.3}, k[] = {3e8};
    static const char *const ways[] = {"linear", "cubic"};
    for (int i = 0; i < 2; i++) {
        stage *s = open_table(&unity, 1, phase, k);
        stage_set_text(s, "interpolation", ways[i]);
        stage_run(s);
        check_near("constant", stage_scalar(s, "stiffness_mean"), 3e8, 1e-15);
        check_below("no harmonics", stage_get(s, "stiffness_harmonics", NULL)[0] / 3e8, 1e-13);
        stage_close(s);
    }
}

enum { SAMPLES = 401 };

/* A smooth wave of one corner and one jump under noise of 1 %. */
static double wave(double phase)
{
    return phase < 0.6 ? 3e8 + 5e7 * sin(3 * phase) : 2e8 + 1e8 * fabs(phase - 0.8);
}

static stage *open_noisy(const spur_pair *pair, double noise)
{
    static double phase[SAMPLES + 1], k[SAMPLES + 1];
    unsigned random = 1;
    for (int i = 0; i <= SAMPLES; i++) {
        int step = i > 240 ? i - 1 : i; /* phase 0.6 has two values */
        phase[i] = step / 400.0;
        random = random * 1103515245u + 12345u;
        double uniform = (random >> 16 & 0x7fff) / 16383.5 - 1;
        k[i] = (i == 240 ? 3e8 + 5e7 * sin(1.8) : wave(phase[i])) * (1 + noise * uniform);
    }
    stage *s = open_table(pair, SAMPLES + 1, phase, k);
    stage_set_text(s, "interpolation", "fitted");
    stage_set_text(s, "corners", "[0.8]");
    stage_set_text(s, "ends", "jump");
    return s;
}

static void test_fit(void)
{
    stage *clean = open_noisy(&unity, 0), *noisy = open_noisy(&unity, 0.01);
    stage_set_text(clean, "tolerance", "0.0001");
    stage_set_text(noisy, "tolerance", "0.05");
    check_true("run", stage_run(clean) == FF_OK && stage_run(noisy) == FF_OK);
    size_t n, breaks;
    const double *phase = stage_get(clean, "phase", &n), *a = stage_get(clean, "stiffness", NULL),
                 *b = stage_get(noisy, "stiffness", NULL);
    double exact = 0, smoothed = 0;
    for (size_t i = 1; i + 1 < n; i++)
        if (fabs(phase[i] - 0.6) > 1e-9) {
            exact = fmax(exact, fabs(a[i] / wave(phase[i]) - 1));
            smoothed = fmax(smoothed, fabs(b[i] / wave(phase[i]) - 1));
        }
    check_below("without noise", exact, 1e-4);
    check_below("less noise than in the samples", smoothed, 0.006);
    check_below("within the tolerance", stage_quality(noisy, "fit_error"), 0.05);
    const double *at = stage_get(clean, "breakpoints", &breaks);
    check_true("0, the jump and the corner", breaks == 3 && at[1] > 0.59 && at[2] > 0.79);
    stage_close(clean);
    stage_close(noisy);
}

/* The fit of a cubic must be the cubic, also between samples; a smoothing weight of 1e-4 changes it
   by 1e-8. */
static void test_fit_of_a_cubic(void)
{
    double phase[9], k[9], worst = 0;
    for (int i = 0; i < 9; i++) {
        double x = phase[i] = i / 8.0;
        k[i] = 3e8 * (1 + x * (0.5 - x * (0.7 - 0.4 * x)));
    }
    stage *s = open_table(&unity, 9, phase, k);
    stage_set_text(s, "ends", "jump");
    stage_set_text(s, "interpolation", "fitted");
    stage_set(s, "points", 500);
    check_true("runs", stage_run(s) == FF_OK);
    size_t n;
    const double *at = stage_get(s, "phase", &n), *out = stage_get(s, "stiffness", NULL);
    for (size_t i = 0; i < n; i++) {
        double x = at[i];
        worst = fmax(worst, fabs(out[i] / 3e8 - (1 + x * (0.5 - x * (0.7 - 0.4 * x)))));
    }
    check_below("the cubic", worst, 1e-7);
    stage_close(s);
}

static void test_fit_that_misses(void)
{
    stage *s = open_noisy(&unity, 0.1);
    check_true("runs", stage_run(s) == FF_OK);
    check_true("and says so",
               stage_verdict(s) == FF_DOUBTFUL && stage_quality(s, "fit_error") > 0.01);
    stage_close(s);
    s = open_noisy(&unity, 0);
    stage_set_text(s, "corners", "[0.8001]");
    check_true("a corner beside the samples",
               stage_run(s) == FF_INVALID && !strcmp(stage_why_item(s), "corners"));
    stage_close(s);
}

int main(void)
{
    unity = spur_pair_make(50, 50, 3e-3, 1, 0, 0);
    test_trapezoid();
    test_jumps();
    test_period_closes();
    test_rigid_share();
    test_cubic_converges();
    test_cubic_does_not_overshoot();
    test_cubic_keeps_jumps();
    test_refusals();
    test_one_value();
    test_fit();
    test_fit_of_a_cubic();
    test_fit_that_misses();
    return check_done();
}
