/* SPDX-License-Identifier: GPL-3.0-or-later */
/* dynamics/harmonic-balance against known solutions: Hill's and Mathieu's equations. */
#include "check.h"
#include "pair.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>

/* Runs with all outputs except the atlas. */
static ff_status run_motion(stage *s)
{
    return stage_run_wanted(
        s, "phase dte dte_velocity mesh_force dte_rms dte_mean dte_peak_to_peak tooth_force gap "
           "dynamic_factor_tooth dynamic_factor_mesh contact_loss back_contact natural_frequency "
           "period floquet_max multipliers");
}

static stage *open_pair(const pair *p, double zeta, const char *harmonics)
{
    stage *s = pair_open("dynamics/harmonic-balance", p);
    stage_set(s, "damping_ratio", zeta);
    stage_set_text(s, "harmonics", harmonics);
    return s;
}

static stage *run(const pair *p, double zeta, const char *harmonics)
{
    stage *s = open_pair(p, zeta, harmonics);
    check_true("runs", run_motion(s) == FF_OK);
    if (stage_why(s)[0])
        printf("     %s\n", stage_why(s));
    return s;
}

enum { H = 30, SIZE = 2 * H + 1 };

/* Gauss elimination with pivoting. */
static void solve(double complex a[SIZE][SIZE], double complex x[SIZE])
{
    for (int i = 0; i < SIZE; i++) {
        int best = i;
        for (int k = i; k < SIZE; k++)
            best = cabs(a[k][i]) > cabs(a[best][i]) ? k : best;
        for (int j = 0; j < SIZE; j++) {
            double complex swap = a[i][j];
            a[i][j] = a[best][j];
            a[best][j] = swap;
        }
        double complex swap = x[i];
        x[i] = x[best];
        x[best] = swap;
        for (int k = i + 1; k < SIZE; k++) {
            double complex factor = a[k][i] / a[i][i];
            for (int j = i; j < SIZE; j++)
                a[k][j] -= factor * a[i][j];
            x[k] -= factor * x[i];
        }
    }
    for (int i = SIZE - 1; i >= 0; i--) {
        for (int j = i + 1; j < SIZE; j++)
            x[i] -= a[i][j] * x[j];
        x[i] /= a[i][i];
    }
}

/* Returns harmonic n of a trapezoid with a low level of length 0.245 in the middle (single tooth
   contact) and ramps of 0.04. */
static double trapezoid(int n)
{
    double high = 1 / (0.755 + 0.245 * 0.65), step = 0.35 * high;
    if (n == 0)
        return 1;
    double zone = sin(M_PI * n * 0.245) / (M_PI * n),
           ramp = sin(M_PI * n * 0.04) / (M_PI * n * 0.04);
    return -step * zone * ramp * (n % 2 ? -1 : 1);
}

/* While the flanks touch, u = s - b obeys a linear equation: sum of k_(m-n) u_n and
   (1 - (m w)^2 + 2 i zeta m w) on the diagonal, load in row 0. */
static void test_linear(double frequency, const char *samples)
{
    static double complex a[SIZE][SIZE], u[SIZE];
    pair p = pair_trapezoid(frequency);
    double w = frequency / pair_natural_frequency, unit = p.line_force / p.stiffness_mean;
    for (int m = -H; m <= H; m++) {
        u[m + H] = m == 0;
        for (int n = -H; n <= H; n++)
            a[m + H][n + H] = trapezoid(m - n);
        a[m + H][m + H] += 2 * I * 0.01 * m * w - m * m * w * w;
    }
    solve(a, u);
    stage *s = open_pair(&p, 0.01, "30");
    stage_set_text(s, "samples", samples);
    check_true("runs", run_motion(s) == FF_OK);
    size_t count;
    const double *phase = stage_get(s, "phase", &count), *dte = stage_get(s, "dte", NULL);
    double worst = 0;
    for (size_t i = 0; i < count; i++) {
        double complex sum = 0;
        for (int n = -H; n <= H; n++)
            sum += u[n + H] * cexp(2 * M_PI * I * n * phase[i]);
        worst = fmax(worst, fabs(dte[i] - p.backlash / 2 - unit * creal(sum)) / unit);
    }
    printf("%g Hz, %s samples\n", frequency, samples);
    check_below("difference from Hill's equation over F/k", worst, 1e-12);
    check_near("contact is never lost", stage_scalar(s, "contact_loss"), 0, 0);
    stage_close(s);
}

/* Constant stiffness: no vibration, and Floquet multipliers exp(-zeta T +- i T sqrt(1 -
   zeta^2)). */
static void test_rest(void)
{
    pair p = pair_cosine(2000, 0, 0, 8);
    stage *s = run(&p, 0.01, "auto");
    double T = 2 * M_PI * pair_natural_frequency / 2000;
    double rest = p.backlash / 2 + p.line_force / p.stiffness_mean;
    const double *mu = stage_get(s, "multipliers", NULL);
    check_near("rest", stage_scalar(s, "dte_mean"), rest, 1e-13);
    check_below("rms at rest", stage_scalar(s, "dte_rms") / rest, 1e-13);
    check_near("multiplier", stage_scalar(s, "floquet_max"), exp(-0.01 * T), 1e-12);
    check_near("its angle", mu[0], exp(-0.01 * T) * cos(T * sqrt(1 - 1e-4)), 1e-12);
    check_near("mesh factor", stage_scalar(s, "dynamic_factor_mesh"), 1, 1e-12);
    stage_close(s);
}

/* Constant k and a triangle of e: s_n/e_n = (1 + 2 i zeta n w)/(1 - n^2 w^2 + 2 i zeta n w), with
   e_n = 4 a/(pi n)^2 for odd n. */
static void test_displacement_excitation(void)
{
    const double ratios[] = {0.33, 0.5, 1.0, 2.0}, zetas[] = {0.01, 0.3}, height = 1e-7;
    for (int i = 0; i < 8; i++) {
        double w = ratios[i / 2], zeta = zetas[i % 2], square = 0;
        pair p = pair_cosine(w * pair_natural_frequency, 0, height, 2);
        for (int n = 1; n <= H; n += 2) {
            double complex damper = 2 * I * zeta * n * w;
            double gain = cabs((1 + damper) / (1 - n * n * w * w + damper));
            square += 0.5 * pow(8 / (M_PI * M_PI * n * n) * height * gain, 2);
        }
        stage *s = run(&p, zeta, "30");
        size_t count;
        const double *dte = stage_get(s, "dte", &count);
        double mean = 0, sum = 0;
        for (size_t k = 0; k + 1 < count; k++)
            mean += dte[k] / (double)(count - 1);
        for (size_t k = 0; k + 1 < count; k++)
            sum += (dte[k] - mean) * (dte[k] - mean) / (double)(count - 1);
        check_near("rms of s", sqrt(sum), sqrt(square), 1e-9);
        stage_close(s);
    }
}

/* Makes the pair of x'' + (a - 2 q cos 2t) x = 0 with 2t as mesh phase: w = 2/sqrt(a), k = 1 + 2
   q/a cos, with enough points for linear interpolation. */
static pair mathieu(double a, double q)
{
    pair p = pair_cosine(2 / sqrt(a) * pair_natural_frequency, 2 * q / a, 0, 400);
    p.backlash = 0;
    return p;
}

static double trace_at(double a, double q)
{
    pair p = mathieu(a, q);
    stage *s = run(&p, 0, "24");
    const double *mu = stage_get(s, "multipliers", NULL);
    double trace = mu[0] + mu[2];
    stage_close(s);
    return trace;
}

/* Returns the distance from `a` at which the trace becomes -2 or 2, by a parabola through three
   values. */
static double off_boundary(double a, double q, double trace)
{
    const double at[3] = {-1e-3, 1e-3, 2e-3};
    double y[3], root = 0;
    for (int i = 0; i < 3; i++)
        y[i] = trace_at(a + at[i], q) - trace;
    double slope = (y[1] - y[0]) / (at[1] - at[0]);
    double bend = ((y[2] - y[1]) / (at[2] - at[1]) - slope) / (at[2] - at[0]);
    for (int i = 0; i < 50; i++)
        root = at[0] - (y[0] + bend * (root - at[0]) * (root - at[1])) / slope;
    return fabs(root);
}

/* Characteristic values of Mathieu's equation, known to 1e-6. At those with period pi, no forced
   motion exists, only near them. */
static void test_mathieu(void)
{
    check_below("b1(0.1)", off_boundary(0.898766, 0.1, -2), 1e-6);
    check_below("a1(0.1)", off_boundary(1.098734, 0.1, -2), 1e-6);
    check_below("a1(0.5)", off_boundary(1.466767, 0.5, -2), 1e-6);
    check_below("b2(0.5)", off_boundary(3.979189, 0.5, 2), 1e-6);
    check_below("a2(0.5)", off_boundary(4.100901, 0.5, 2), 1e-6);
    check_below("b2(1)", off_boundary(3.917025, 1, 2), 1e-6);
    check_below("a2(1)", off_boundary(4.371301, 1, 2), 1e-6);
}

/* Principal instability with damping ratio 0.01: a disturbance must grow within [from, to]. */
static void test_damped_tongue(void)
{
    const double tongues[][3] = {
        {0.05, 1.98482, 2.01482}, {0.1, 1.95377, 2.04541}, {0.2, 1.90077, 2.09657}};
    const double chord = M_PI / 400; /* gives the interpolated stiffness the exact first harmonic */
    for (int i = 0; i < 3; i++)
        for (int side = 0; side < 2; side++)
            for (int inside = 0; inside < 2; inside++) {
                double step = (side == inside ? -1 : 1) * 1e-5;
                double w = tongues[i][1 + side] + step;
                pair p = pair_cosine(w * pair_natural_frequency,
                                     tongues[i][0] / pow(sin(chord) / chord, 2), 0, 400);
                p.backlash = 0;
                stage *s = run(&p, 0.01, "24");
                check_true("grows inside only", (stage_scalar(s, "floquet_max") > 1) == inside);
                check_near("is called unbounded", stage_scalar(s, "period"), inside ? -1 : 1, 0);
                check_true("and bad", (stage_verdict(s) == FF_BAD) == inside);
                stage_close(s);
            }
}

/* The backbone curve of free vibration: contact with amplitude A F/k, then separation, omega T = 2
   (pi - acos(1/A)) + 2 sqrt(A^2 - 1). The peaks are A + 1 above and (A^2 - 1)/2 below the edge of
   the gap, in F/k. The excitation is a thousandth of F/k, with hardly any damping. */
static void test_backbone(void)
{
    const double amplitudes[] = {1.5, 3, 5};
    for (int i = 0; i < 3; i++) {
        double A = amplitudes[i], T = 2 * (M_PI - acos(1 / A)) + 2 * sqrt(A * A - 1);
        pair p = pair_cosine(2 * M_PI / T * pair_natural_frequency, 0, 1e-8, 2);
        stage *s = open_pair(&p, 1e-5, "auto");
        stage_set_text(s, "branch", "upper");
        check_true("runs", run_motion(s) == FF_OK);
        check_near("peak to peak", stage_scalar(s, "dte_peak_to_peak"),
                   (A + 1 + (A * A - 1) / 2) * p.line_force / p.stiffness_mean, 1e-3);
        stage_close(s);
    }
}

int main(void)
{
    test_rest();
    test_linear(2375, "256");
    test_linear(2375, "4096");
    test_linear(4000, "256");
    test_linear(1250, "1024");
    test_displacement_excitation();
    test_mathieu();
    test_damped_tongue();
    test_backbone();
    return check_done();
}
