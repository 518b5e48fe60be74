/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The points of a mesh cycle, and means and harmonics over it. */
#include "cycle.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

bool stiffness_cycle_make(stiffness_cycle *cycle, size_t points, size_t count,
                          const stiffness_breakpoint *breaks)
{
    double *phase = malloc((points + 1 + 2 * count) * sizeof *phase);
    if (!phase)
        return false;
    size_t n = 0, i = 1, b = 0;
    phase[n++] = 0;
    while (b < count && breaks[b].phase <= STIFFNESS_PHASE_TOLERANCE)
        b++;
    while (i < points || b < count) {
        double uniform = i < points ? (double)i / (double)points : INFINITY;
        double broken = b < count ? breaks[b].phase : INFINITY;
        if (uniform < broken - STIFFNESS_PHASE_TOLERANCE) {
            phase[n++] = uniform;
            i++;
            continue;
        }
        if (uniform <= broken + STIFFNESS_PHASE_TOLERANCE)
            i++;
        if (broken < 1 - STIFFNESS_PHASE_TOLERANCE) {
            phase[n++] = broken;
            if (breaks[b].jump)
                phase[n++] = broken;
        }
        b++;
    }
    phase[n++] = 1;
    *cycle = (stiffness_cycle){n, phase};
    return true;
}

void stiffness_cycle_free(stiffness_cycle *cycle)
{
    free(cycle->phase);
    *cycle = (stiffness_cycle){0, NULL};
}

int stiffness_cycle_side(const stiffness_cycle *cycle, size_t i)
{
    bool last = i + 1 == cycle->count;
    return last || !(cycle->phase[i] < cycle->phase[i + 1]) ? STIFFNESS_BELOW : STIFFNESS_ABOVE;
}

double stiffness_cycle_mean(const stiffness_cycle *cycle, const double *value)
{
    assert(cycle->count >= 2);
    double sum = 0;
    for (size_t i = 1; i < cycle->count; i++)
        sum += (cycle->phase[i] - cycle->phase[i - 1]) * (value[i] + value[i - 1]) / 2;
    return sum;
}

/* Spherical Bessel function j1(x) = (sin x - x cos x)/x^2, by its series for small x, where the
 * terms cancel. */
static double bessel_j1(double x)
{
    double q = x * x;
    if (q < 0.01)
        return x / 3 * (1 - q / 10 * (1 - q / 28 * (1 - q / 54 * (1 - q / 88))));
    return (sin(x) - x * cos(x)) / q;
}

/* A linear piece of length L with middle m, mean v and rise d contributes, with x = pi n L,
 * exp(-2 pi i n m) L [v sin(x)/x - i d/2 j1(x)]. */
double stiffness_cycle_amplitude(const stiffness_cycle *cycle, const double *value, int n)
{
    double re = 0, im = 0;
    for (size_t i = 1; i < cycle->count; i++) {
        double length = cycle->phase[i] - cycle->phase[i - 1];
        if (!(length > 0))
            continue;
        double middle = (cycle->phase[i] + cycle->phase[i - 1]) / 2;
        double x = M_PI * n * length;
        double even = length * (value[i] + value[i - 1]) / 2 * sin(x) / x;
        double odd = length * (value[i] - value[i - 1]) / 2 * bessel_j1(x);
        double c = cos(2 * M_PI * n * middle), s = sin(2 * M_PI * n * middle);
        re += c * even - s * odd;
        im -= s * even + c * odd;
    }
    return 2 * hypot(re, im);
}

bool stiffness_touches(double contact_ratio, double age, int side)
{
    if (side == STIFFNESS_ABOVE)
        return age >= -STIFFNESS_PHASE_TOLERANCE && age < contact_ratio - STIFFNESS_PHASE_TOLERANCE;
    return age > STIFFNESS_PHASE_TOLERANCE && age <= contact_ratio + STIFFNESS_PHASE_TOLERANCE;
}

size_t stiffness_pairs(double contact_ratio, double phase, int side)
{
    size_t count = 0;
    for (double age = phase; age <= contact_ratio + 1; age += 1)
        count += stiffness_touches(contact_ratio, age, side);
    return count;
}

double stiffness_phase_of(double age, int side)
{
    double phase = age - floor(age);
    if (side == STIFFNESS_ABOVE && phase >= 1 - STIFFNESS_PHASE_TOLERANCE)
        return 0;
    if (side == STIFFNESS_BELOW && phase <= STIFFNESS_PHASE_TOLERANCE)
        return 1;
    return phase;
}
