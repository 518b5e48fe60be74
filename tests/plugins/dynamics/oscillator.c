/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The integrator: energy, reversal in time, grazing contact, and errors for given tolerances. */
#include "check.h"

#include "../../../plugins/dynamics/oscillator/oscillator.h"

#include <math.h>

static const double low_phase[] = {0, 0.1, 0.4, 0.4, 1}, low_k[] = {1, 1.3, 0.7, 0.9, 1};

/* Makes a constant stiffness 1, or the table above with kinks and a jump. */
static dynamics_excitation make_mesh(int table, double zeta, double load, double half_gap)
{
    static const double phase[] = {0, 1}, one[] = {1, 1};
    static const double error[] = {0, 0.2, -0.1, -0.1, 0};
    dynamics_excitation mesh = {
        .zeta = zeta, .load = load, .half_gap = half_gap, .length = 1, .stiffness = 1};
    dynamics_mesh_curves x = {2, phase, one, NULL};
    if (table)
        x = (dynamics_mesh_curves){5, low_phase, low_k, error};
    check_true("memory", dynamics_excitation_build(&mesh, &x));
    return mesh;
}

/* A ball that bounces on a spring: half an oscillation about b + F, then a flight of 2 v/F. After a
   whole number of bounces, it must be at its start, to 1e-12 for each of about 5000 steps. */
static void test_bounces(void)
{
    dynamics_excitation mesh = make_mesh(0, 0, 0.5, 10);
    double v = 1.2; /* speed at the surface, inwards */
    double contact = 2 * (M_PI - atan2(v, 0.5)), flight = 2 * v / 0.5;
    dynamics_oscillator *o = dynamics_oscillator_new(&mesh, 1e-12, 1, DYNAMICS_MOTION);
    dynamics_oscillator_start(o, contact + flight, mesh.half_gap, v);
    double energy = dynamics_oscillator_energy(o);
    for (int i = 0; i < 200; i++)
        dynamics_oscillator_cycle(o, contact + flight, NULL);
    check_below("returns", fabs(dynamics_oscillator_state(o)[DYNAMICS_DELTA] - mesh.half_gap),
                5e-9);
    check_below("energy", fabs(dynamics_oscillator_energy(o) - energy), 5e-9);
    check_near("time in flight", dynamics_oscillator_clocks(o).parted, 200 * flight, 1e-10);
    dynamics_oscillator_free(o);
    dynamics_excitation_free(&mesh);
}

/* An oscillation about b + F with amplitudes near F, which grazes the surface: the flight time is
   proportional to sqrt(excess), so that an error of 1e-11 in the energy acts as an excess. */
static void test_grazing(void)
{
    const double excess[] = {0, 1e-15, 1e-12, 1e-8, 1e-5, -1e-15, -1e-12, -1e-8};
    dynamics_excitation mesh = make_mesh(0, 0, 1, 10);
    for (size_t i = 0; i < sizeof excess / sizeof excess[0]; i++) {
        dynamics_oscillator *o =
            dynamics_oscillator_new(&mesh, 1e-12, 1, DYNAMICS_MOTION_AND_VARIATION);
        dynamics_oscillator_start(o, 5, mesh.half_gap + 2 + excess[i], 0);
        double energy = dynamics_oscillator_energy(o);
        for (int k = 0; k < 20; k++)
            check_true("goes on", dynamics_oscillator_cycle(o, 5, NULL));
        /* v^2 = (1 + x)^2 - 1 at the surface, a flight time of 2 v in each 2 pi */
        double x = fmax(excess[i], 0), flight = 2 * sqrt(x * (2 + x)) * 16;
        check_below("energy", fabs(dynamics_oscillator_energy(o) - energy), 1e-11);
        check_below("time in flight", fabs(dynamics_oscillator_clocks(o).parted - flight),
                    32 * sqrt(2e-11) + 1e-9 * flight);
        check_below("steps", (double)dynamics_oscillator_steps(o), 3000);
        dynamics_oscillator_free(o);
    }
    dynamics_excitation_free(&mesh);
}

/* Without damping, the motion must return to its start if k(t), e(t) and the rate are reversed. */
static void test_reversal(void)
{
    double phase[5], k[5], e[5];
    static const double error[] = {0, 0.2, -0.1, -0.1, 0};
    for (int i = 0; i < 5; i++) {
        phase[i] = 1 - low_phase[4 - i];
        k[i] = low_k[4 - i];
        e[i] = error[4 - i];
    }
    dynamics_excitation there = make_mesh(1, 0, 0.5, 2), back = there;
    dynamics_mesh_curves turned = {5, phase, k, e};
    check_true("memory", dynamics_excitation_build(&back, &turned));
    dynamics_oscillator *o = dynamics_oscillator_new(&there, 1e-13, 1, DYNAMICS_MOTION);
    dynamics_oscillator *r = dynamics_oscillator_new(&back, 1e-13, 1, DYNAMICS_MOTION);
    const double T = 7, slope_before = -0.1 * -1 / 0.6 / 7; /* e' before phase 0 */
    dynamics_oscillator_start(o, T, 3.5, 0.4);
    for (int i = 0; i < 10; i++)
        dynamics_oscillator_cycle(o, T, NULL);
    /* s' is continuous, delta' refers to e' of the piece before the start, which differs */
    const double *y = dynamics_oscillator_state(o);
    double slope_turned = -0.2 / 0.1 / T;
    dynamics_oscillator_start(r, T, y[DYNAMICS_DELTA],
                              -(y[DYNAMICS_RATE] + slope_before) - slope_turned);
    for (int i = 0; i < 10; i++)
        dynamics_oscillator_cycle(r, T, NULL);
    y = dynamics_oscillator_state(r);
    check_true("contact was lost", dynamics_oscillator_clocks(o).parted > 5);
    check_near("back at the start", y[DYNAMICS_DELTA], 3.5, 1e-9);
    check_below("with its rate", fabs(y[DYNAMICS_RATE] + slope_turned + 0.4 + slope_before), 1e-9);
    dynamics_oscillator_free(o);
    dynamics_oscillator_free(r);
    dynamics_excitation_free(&there);
    dynamics_excitation_free(&back);
}

/* The error must decrease with the tolerance, down to the error of the longest step. */
static void test_tolerance(void)
{
    dynamics_excitation mesh = make_mesh(1, 0.05, 0.5, 2);
    double end[5][2];
    const double tolerances[] = {1e-4, 1e-6, 1e-8, 1e-10, 1e-13};
    for (int i = 0; i < 5; i++) {
        dynamics_oscillator *o =
            dynamics_oscillator_new(&mesh, tolerances[i], i == 4 ? 3 : 1, DYNAMICS_MOTION);
        dynamics_oscillator_start(o, 8, 4, 0);
        for (int k = 0; k < 3; k++)
            dynamics_oscillator_cycle(o, 8, NULL);
        end[i][0] = dynamics_oscillator_state(o)[DYNAMICS_DELTA];
        end[i][1] = dynamics_oscillator_state(o)[DYNAMICS_RATE];
        dynamics_oscillator_free(o);
    }
    for (int i = 0; i < 4; i++)
        check_below("error against the tightest",
                    hypot(end[i][0] - end[4][0], end[i][1] - end[4][1]),
                    fmax(30 * tolerances[i], 1e-8));
    dynamics_excitation_free(&mesh);
}

int main(void)
{
    test_bounces();
    test_grazing();
    test_reversal();
    test_tolerance();
    return check_done();
}
