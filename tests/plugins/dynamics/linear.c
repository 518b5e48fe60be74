/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The linear oscillator behind a static deflection of straight lines, against its Fourier series.
 */
#include "../../../plugins/dynamics/linear-pair.h"

#include "check.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>

enum { HARMONICS = 4000 };

/* Coefficient n of exp(2 pi i n phase) of the straight lines: by parts, over each of them. */
static double complex coefficient(const dynamics_linear_pair *l, int n)
{
    double complex sum = 0, a = -2 * M_PI * I * n;
    for (size_t i = 1; i < l->count; i++) {
        double low = l->phase[i - 1], high = l->phase[i];
        if (!(high > low))
            continue;
        double slope = (l->deflection[i] - l->deflection[i - 1]) / (high - low);
        double complex end = cexp(a * high), start = cexp(a * low);
        sum += (l->deflection[i] * end - l->deflection[i - 1] * start) / a;
        sum -= slope * (end - start) / (a * a);
    }
    return sum;
}

/* What the midpoint rule misses of the mean of s_0^2: (rise/parts)^2/12, in parts of 0.3 rad. */
static double missed(const dynamics_linear_pair *l)
{
    double sum = 0;
    for (size_t i = 1; i < l->count; i++) {
        double length = l->phase[i] - l->phase[i - 1];
        double parts = ceil(length * 2 * M_PI / l->frequency / 0.3);
        if (length > 0)
            sum += length * pow((l->deflection[i] - l->deflection[i - 1]) / parts, 2) / 12;
    }
    return sum;
}

/* Parseval over the series of s_0, of s = s_0/(1 - w^2 + 2 i zeta w), and of s - s_0. Of s
   itself, which is smooth, the midpoint rule misses 0.3^2/24. */
static void check_response(const char *what, const dynamics_linear_pair *l)
{
    static const double rule = 0.3 * 0.3 / 24;
    double square[3] = {0}, missing = missed(l);
    for (int n = 1; n <= HARMONICS; n++) {
        double w = n * l->frequency;
        double complex c = coefficient(l, n), s = c / (1 - w * w + 2 * I * l->zeta * w);
        const double complex part[3] = {c, s, s - c};
        for (int k = 0; k < 3; k++)
            square[k] += 2 * pow(cabs(part[k]), 2);
    }
    dynamics_linear_pair_response m = dynamics_linear_pair_motion(l);
    printf("%s, frequency %g, damping %g\n", what, l->frequency, l->zeta);
    check_near("rms of s_0", m.rms_static, sqrt(square[0] - missing), 1e-4);
    check_near("rms of s", m.rms_total, sqrt(square[1]), rule);
    check_near("rms of s - s_0", m.rms, sqrt(square[2]), rule + missing / (2 * square[2]));
}

static void test_against_the_series(void)
{
    static const double phase[] = {0, 0.2, 0.5, 0.5, 0.8, 1}, jump[] = {3, 1, 2, 5, 4, 3},
                        kink[] = {0, 2, 1, 1, -1, 0};
    static const double frequency[] = {0.03, 0.31, 0.9, 1, 2.7}, zeta[] = {0.01, 0.2, 0.7};
    for (int f = 0; f < 5; f++)
        for (int z = 0; z < 3; z++) {
            dynamics_linear_pair l = {6, phase, jump, frequency[f], zeta[z]};
            check_response("a jump", &l);
            l.deflection = kink;
            check_response("kinks", &l);
        }
}

/* Far above its natural frequency the mass stands still at the mean of s_0, far below s is s_0. */
static void test_limits(void)
{
    static const double phase[] = {0, 0.25, 1}, wave[] = {1, 2, 1};
    dynamics_linear_pair l = {3, phase, wave, 1000, 0.05};
    dynamics_linear_pair_response m = dynamics_linear_pair_motion(&l);
    check_below("fast: stands still", m.swing_total, 1e-5);
    check_near("fast: highest of s - s_0", m.highest, 0.5, 1e-5);
    check_near("fast: lowest of s - s_0", m.lowest, -0.5, 1e-5);
    check_near("swing of s_0", m.swing_static, 1, 1e-12);
    l.frequency = 1e-4;
    l.zeta = 0.7;
    m = dynamics_linear_pair_motion(&l);
    check_near("slow: follows", m.swing_total, 1, 1e-3);
    check_below("slow: no distance", m.highest - m.lowest, 2e-3);
}

static void test_nothing_moves(void)
{
    static const double phase[] = {0, 1}, flat[] = {4, 4};
    dynamics_linear_pair l = {2, phase, flat, 0.5, 0};
    dynamics_linear_pair_response m = dynamics_linear_pair_motion(&l);
    check_below("constant", fmax(fmax(m.highest, -m.lowest), m.rms_total), 0);
}

int main(void)
{
    test_against_the_series();
    test_limits();
    test_nothing_moves();
    return check_done();
}
