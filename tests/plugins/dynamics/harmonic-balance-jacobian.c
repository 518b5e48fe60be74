/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares the analytic Jacobian of harmonic balance with differences of the residual. */
#include "../../../plugins/dynamics/series/harmonics.h"

#include "check.h"

#include <math.h>
#include <stdlib.h>

enum { H = 7, SIZE = 2 * H + 1 };

static dynamics_excitation make_mesh(double half_gap)
{
    static const double phase[] = {0, 0.3, 0.3, 0.7, 1}, k[] = {1.2, 1.1, 0.8, 0.7, 1.0},
                        e[] = {0, 0.3, -0.2, 0.1, 0};
    dynamics_excitation mesh = {
        .zeta = 0.03, .load = 1, .half_gap = half_gap, .stiffness = 1, .length = 1};
    dynamics_mesh_curves x = {5, phase, k, e};
    check_true("mesh", dynamics_excitation_build(&mesh, &x));
    return mesh;
}

/* Makes a motion that loses contact, and touches both flanks if the gap is small. */
static void make_motion(double *x)
{
    for (int i = 0; i < SIZE; i++)
        x[i] = cos(3.0 * i) / (1 + 0.3 * i);
    x[0] = 0.4;
    x[1] = 2;
}

static void test_jacobian(double half_gap)
{
    const double w = 0.83, d = 1e-5;
    double x[SIZE], plus[SIZE], minus[SIZE], r[SIZE], after_w[SIZE], jacobian[SIZE * SIZE];
    dynamics_excitation mesh = make_mesh(half_gap);
    dynamics_harmonics *b = dynamics_harmonics_new(&mesh, H, 512);
    double worst = 0, worst_w = 0;
    make_motion(x);
    dynamics_harmonics_residual(b, w, x, r, after_w, jacobian, SIZE);
    for (int n = 0; n < SIZE; n++) {
        double keep = x[n];
        x[n] = keep + d;
        dynamics_harmonics_residual(b, w, x, plus, NULL, NULL, 0);
        x[n] = keep - d;
        dynamics_harmonics_residual(b, w, x, minus, NULL, NULL, 0);
        x[n] = keep;
        for (int m = 0; m < SIZE; m++)
            worst = fmax(worst, fabs((plus[m] - minus[m]) / (2 * d) - jacobian[n * SIZE + m]));
    }
    dynamics_harmonics_residual(b, w * exp(d), x, plus, NULL, NULL, 0);
    dynamics_harmonics_residual(b, w * exp(-d), x, minus, NULL, NULL, 0);
    for (int m = 0; m < SIZE; m++)
        worst_w = fmax(worst_w, fabs((plus[m] - minus[m]) / (2 * d) - after_w[m]));
    /* d times the second derivative, which is of order samples/10 where an edge nears a sample */
    check_below("error of the Jacobian", worst, 1e-5);
    check_below("error of the derivative after the speed", worst_w, 1e-7);
    dynamics_harmonics_free(b);
    dynamics_excitation_free(&mesh);
}

/* The harmonics of a series' samples must be those of the series. */
static void test_analyse(void)
{
    double x[SIZE], back[SIZE], s[64], slope, worst = 0;
    dynamics_excitation mesh = make_mesh(0);
    dynamics_harmonics *b = dynamics_harmonics_new(&mesh, H, 64);
    make_motion(x);
    for (int i = 0; i < 64; i++)
        dynamics_fourier_at(x, H, 2 * M_PI * i / 64, &s[i], &slope);
    dynamics_harmonics_analyse(b, s, back);
    for (int i = 0; i < SIZE; i++)
        worst = fmax(worst, fabs(back[i] - x[i]));
    check_below("series from samples", worst, 1e-14);
    dynamics_harmonics_free(b);
    dynamics_excitation_free(&mesh);
}

/* The mean force with constant stiffness k = 1 at s = b + cos theta must be 1/pi, in spite of the
   kinks. The trapezium rule would have an error of second order in the step. */
static void test_edges(void)
{
    static const double phase[] = {0, 1}, k[] = {1, 1};
    double error[2];
    for (int i = 0; i < 2; i++) {
        double x[SIZE] = {3, 1 / sqrt(2), 1 / sqrt(2)}, r[SIZE];
        dynamics_excitation mesh = {.load = 0, .half_gap = 3, .stiffness = 1, .length = 1};
        dynamics_mesh_curves constant = {2, phase, k, NULL};
        check_true("mesh", dynamics_excitation_build(&mesh, &constant));
        dynamics_harmonics *b = dynamics_harmonics_new(&mesh, H, i ? 800 : 100);
        dynamics_harmonics_residual(b, 1, x, r, NULL, NULL, 0);
        error[i] = fabs(r[0] - 1 / M_PI);
        dynamics_harmonics_free(b);
        dynamics_excitation_free(&mesh);
    }
    check_below("error of the mean force by 100 samples", error[0], 1e-6);
    check_below("by 800", error[1], error[0] / 100);
}

int main(void)
{
    test_jacobian(0);
    test_jacobian(0.5);
    test_jacobian(100);
    test_analyse();
    test_edges();
    return check_done();
}
