/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Deflection: compares the kernel with quadrature and the FFT with the double sum, and checks
   Hertz's pressure. */
#include "check.h"

#include "../../../plugins/ehl/equations/deflection.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;
static const double modulus = 226.4e9;

/* Returns the integral of ln|x| over [low, low + dx] by composite Gauss rules, with intervals that
   decrease towards the singularity. */
static double log_quadrature(double low, double dx)
{
    static const double node[3] = {-0.7745966692414834, 0, 0.7745966692414834};
    static const double weight[3] = {5. / 9, 8. / 9, 5. / 9};
    double sum = 0, from = low, to = low + dx;
    for (int level = 0; level < 60; level++) { /* halves towards `low` */
        double middle = level < 59 ? (from + to) / 2 : from, half = (to - middle) / 2;
        for (int part = 0; part < 32; part++)
            for (int k = 0; k < 3; k++) {
                double x = middle + half * (2 * part + 1 + node[k]) / 32;
                sum += weight[k] * half / 32 * log(fabs(x));
            }
        to = middle;
    }
    return sum;
}

static void test_kernel(void)
{
    enum { COUNT = 1200 };
    double d[COUNT], dx = 1e-6, worst = 0;
    ehl_kernel_fill(COUNT, dx, modulus, 1, d);
    double self = -4 / (pi * modulus) * 2 * log_quadrature(0, dx / 2);
    check_near("effect of a cell on itself", d[0], self, 1e-12);
    static const size_t far[] = {1, 2, 7, 50, 999, 1000, 1199};
    for (size_t k = 0; k < sizeof far / sizeof far[0]; k++) {
        double exact = -4 / (pi * modulus) * log_quadrature(((double)far[k] - 0.5) * dx, dx);
        worst = fmax(worst, fabs(d[far[k]] / exact - 1));
    }
    check_below("effect of a cell on others against quadrature", worst, 1e-12);
}

static void test_fft(size_t nodes)
{
    double *d = malloc(4 * nodes * sizeof *d), *p = d + nodes, *fft = d + 2 * nodes,
           *sum = d + 3 * nodes, worst = 0, most = 0;
    ehl_kernel_fill(nodes, 1e-6, modulus, 1e-4, d);
    srand(7);
    for (size_t i = 0; i < nodes; i++)
        p[i] = i > 0 && i + 1 < nodes ? 1e9 * rand() / RAND_MAX : 0;
    ehl_fft *f = ehl_fft_create(nodes, d);
    ehl_fft_apply(f, p, fft);
    ehl_kernel_direct(nodes, d, p, sum);
    for (size_t i = 0; i < nodes; i++) {
        worst = fmax(worst, fabs(fft[i] - sum[i]));
        most = fmax(most, fabs(sum[i]));
    }
    check_below("FFT against the double sum", worst / most, 1e-12);
    ehl_fft_destroy(f);
    free(d);
}

/* Hertz's pressure deforms the parabola x^2/(2 R) to a flat inside the contact (Johnson 1985, 4.2).
   Returns the deviation from the flat, over the deflection a^2/(2 R). */
static double hertz_flatness(size_t nodes)
{
    double *d = malloc(3 * nodes * sizeof *d), *p = d + nodes, *v = d + 2 * nodes;
    double radius = 0.0128, a = 1.6e-4, peak = modulus * a / (4 * radius);
    double dx = 4 * a / (double)(nodes - 1), low = HUGE_VAL, high = -HUGE_VAL;
    ehl_kernel_fill(nodes, dx, modulus, a, d);
    for (size_t i = 0; i < nodes; i++) {
        double x = -2 * a + (double)i * dx;
        p[i] = fabs(x) < a ? peak * sqrt(1 - x * x / (a * a)) : 0;
    }
    ehl_kernel_direct(nodes, d, p, v);
    for (size_t i = 0; i < nodes; i++) {
        double x = -2 * a + (double)i * dx, h = v[i] + x * x / (2 * radius);
        if (fabs(x) < 0.9 * a) {
            low = fmin(low, h);
            high = fmax(high, h);
        }
    }
    free(d);
    return (high - low) / (a * a / (2 * radius));
}

int main(void)
{
    test_kernel();
    test_fft(33);
    test_fft(514); /* a length with large prime factors */
    test_fft(1025);
    check_below("flat under Hertz's pressure", hertz_flatness(2049), 2e-4);
    check_below("flatter on a finer grid", hertz_flatness(2049) / hertz_flatness(513), 0.3);
    return check_done();
}
