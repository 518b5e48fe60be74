/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "../../../plugins/stiffness/cycle.h"

#include "check.h"

#include <math.h>
#include <stdlib.h>

static const stiffness_breakpoint breaks[] = {
    {0, true}, {0.25, true}, {1.0 / 3, false}, {0.7547, true}};

static void test_points(void)
{
    stiffness_cycle cycle;
    stiffness_cycle_make(&cycle, 20, 4, breaks);
    int rising = 1, twice = 0;
    for (size_t i = 1; i < cycle.count; i++) {
        rising &= cycle.phase[i] >= cycle.phase[i - 1];
        twice += !(cycle.phase[i] > cycle.phase[i - 1]);
    }
    check_true("rising", rising);
    check_true("two jumps inside", twice == 2);
    /* 21 uniform points, one of them a jump; and a kink and a jump between them */
    check_true("count", cycle.count == 21 + 1 + 1 + 2);
    check_true("ends", !(cycle.phase[0] > 0) && !(cycle.phase[cycle.count - 1] < 1));
    check_true("first point looks up", stiffness_cycle_side(&cycle, 0) == STIFFNESS_ABOVE);
    check_true("last point looks down",
               stiffness_cycle_side(&cycle, cycle.count - 1) == STIFFNESS_BELOW);
    check_true("before the jump", stiffness_cycle_side(&cycle, 5) == STIFFNESS_BELOW);
    check_true("after the jump", stiffness_cycle_side(&cycle, 6) == STIFFNESS_ABOVE);
    stiffness_cycle_free(&cycle);
}

/* A uniform point that differs from a break only by rounding must not become a separate point. */
static void test_no_slivers(void)
{
    const stiffness_breakpoint near[] = {
        {0.1 + 1e-13, true}, {0.3 - 1e-13, false}, {1 - 1e-12, true}};
    stiffness_cycle cycle;
    stiffness_cycle_make(&cycle, 10, 3, near);
    double shortest = 1;
    for (size_t i = 1; i < cycle.count; i++)
        if (cycle.phase[i] > cycle.phase[i - 1])
            shortest = fmin(shortest, cycle.phase[i] - cycle.phase[i - 1]);
    check_near("shortest step", shortest, 0.1, 1e-9);
    check_true("count", cycle.count == 12);
    stiffness_cycle_free(&cycle);
}

/* Integrates the piecewise linear function times a harmonic from 0 to 1, with Gauss points in each
   piece. */
static void sampled(const stiffness_cycle *cycle, const double *v, int n, double *re, double *im)
{
    static const double node[3] = {-0.7745966692414834, 0, 0.7745966692414834};
    static const double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    *re = *im = 0;
    for (size_t i = 1; i < cycle->count; i++) {
        double h = (cycle->phase[i] - cycle->phase[i - 1]) / 64;
        for (int part = 0; part < 64; part++)
            for (int k = 0; k < 3; k++) {
                double t = (part + 0.5 + node[k] / 2) / 64;
                double phase = cycle->phase[i - 1] + 64 * h * t;
                double value = v[i - 1] + (v[i] - v[i - 1]) * t;
                *re += weight[k] * h * value * cos(2 * M_PI * n * phase);
                *im -= weight[k] * h * value * sin(2 * M_PI * n * phase);
            }
    }
}

static void test_harmonics_of_any_function(void)
{
    stiffness_cycle cycle;
    stiffness_cycle_make(&cycle, 7, 4, breaks);
    double *v = malloc(cycle.count * sizeof *v), re, im;
    unsigned seed = 12345;
    for (size_t i = 0; i < cycle.count; i++) {
        seed = seed * 1103515245u + 12345u;
        v[i] = (double)(seed >> 16 & 0x7fff) / 32768;
    }
    sampled(&cycle, v, 0, &re, &im);
    check_near("mean", stiffness_cycle_mean(&cycle, v), re, 1e-14);
    for (int n = 1; n <= 20; n++) {
        sampled(&cycle, v, n, &re, &im);
        check_near("amplitude", stiffness_cycle_amplitude(&cycle, v, n), 2 * hypot(re, im), 1e-8);
    }
    free(v);
    stiffness_cycle_free(&cycle);
}

/* A rectangular wave must have the amplitudes 2/(n pi) |sin(n pi share)|, with few or many
   points. */
static void test_rectangular_wave(void)
{
    const double share = 0.7547;
    const stiffness_breakpoint end = {share, true};
    for (size_t points = 4; points <= 40000; points *= 100) {
        stiffness_cycle cycle;
        stiffness_cycle_make(&cycle, points, 1, &end);
        double *v = malloc(cycle.count * sizeof *v);
        for (size_t i = 0; i < cycle.count; i++) {
            double phase = cycle.phase[i];
            int side = stiffness_cycle_side(&cycle, i);
            v[i] = phase < share || (phase <= share && side == STIFFNESS_BELOW) ? 1 : 0;
        }
        check_near("mean", stiffness_cycle_mean(&cycle, v), share, 1e-13);
        for (int n = 1; n <= 20; n++)
            check_near("amplitude", stiffness_cycle_amplitude(&cycle, v, n),
                       2 / (n * M_PI) * fabs(sin(n * M_PI * share)), 1e-10);
        free(v);
        stiffness_cycle_free(&cycle);
    }
}

static void test_pairs(void)
{
    check_true("SAP", stiffness_pairs(1.75, 0, STIFFNESS_ABOVE) == 2);
    check_true("before the exit", stiffness_pairs(1.75, 0.75, STIFFNESS_BELOW) == 2);
    check_true("after the exit", stiffness_pairs(1.75, 0.75, STIFFNESS_ABOVE) == 1);
    check_true("before the next entry", stiffness_pairs(1.75, 1, STIFFNESS_BELOW) == 1);
    check_true("contact ratio 1", stiffness_pairs(1, 0, STIFFNESS_ABOVE) == 1 &&
                                      stiffness_pairs(1, 1, STIFFNESS_BELOW) == 1);
    check_true("contact ratio 2", stiffness_pairs(2, 0, STIFFNESS_ABOVE) == 2 &&
                                      stiffness_pairs(2, 1, STIFFNESS_BELOW) == 2);
    check_true("contact ratio 2.4", stiffness_pairs(2.4, 0.3, STIFFNESS_ABOVE) == 3 &&
                                        stiffness_pairs(2.4, 0.4, STIFFNESS_ABOVE) == 2 &&
                                        stiffness_pairs(2.4, 1, STIFFNESS_BELOW) == 2);
}

static void test_phase_of_a_station(void)
{
    check_near("inside", stiffness_phase_of(1.25, STIFFNESS_ABOVE), 0.25, 1e-15);
    check_near("HPSTC from below", stiffness_phase_of(1, STIFFNESS_BELOW), 1, 1e-15);
    check_below("HPSTC from above", stiffness_phase_of(1, STIFFNESS_ABOVE), 0);
    check_below("HPSTC from above, rounded down", stiffness_phase_of(1 - 1e-15, STIFFNESS_ABOVE),
                0);
    check_near("HPSTC from below, rounded up", stiffness_phase_of(1 + 1e-15, STIFFNESS_BELOW), 1,
               1e-15);
}

int main(void)
{
    test_points();
    test_no_slivers();
    test_harmonics_of_any_function();
    test_rectangular_wave();
    test_pairs();
    test_phase_of_a_station();
    return check_done();
}
