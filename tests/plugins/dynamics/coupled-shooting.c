/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gears on bearings: compares the derivatives of a motion by its start with differences of motions,
   and periodic motions found by Newton's method with integrated motions and with a slow sweep of
   the speed. */
#include "../../../plugins/dynamics/coupled/coupled-shooting.h"
#include "../../../plugins/dynamics/coupled/coupled-motion.h"

#include "check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { N = DYNAMICS_TAKEN };

typedef struct scene {
    const char *name;
    int damping;
    double bearing, half_gap, leap, q, rate; /* leap: of e; q, rate: added to the state at rest */
    int parts, meets;                        /* whether contact is lost; whether the back flanks
                                                touch */
} scene;

/* Makes two levels of stiffness, load fractions that jump when tooth pairs begin or end contact,
   and elastic bearings. */
static void make(const scene *c, dynamics_excitation *mesh, dynamics_coupled *pair)
{
    static const double phase[] = {0, 0.3, 0.6, 0.6, 1}, k[] = {1.2, 1.25, 1.2, 0.7, 0.75};
    static const double cycle[] = {0, 0.6, 0.6, 1, 1, 1.6}, share[] = {0.4, 0.5, 1, 1, 0.5, 0.6};
    const double e[] = {0, 0.1, 0.05, 0.05 + c->leap, 0};
    *mesh = (dynamics_excitation){.zeta = 0.05,
                                  .load = 1,
                                  .half_gap = c->half_gap,
                                  .damping = c->damping,
                                  .stiffness = 1,
                                  .length = 1};
    dynamics_mesh_curves x = {5, phase, k, e};
    check_true("mesh", dynamics_excitation_build(mesh, &x));
    *pair = (dynamics_coupled){.excitation = mesh,
                               .mass = {3, 4},
                               .bearing = {c->bearing, 1.3 * c->bearing},
                               .damper = {0.1, 0.2},
                               .base = 188,
                               .centre = 200,
                               .base_1 = 94,
                               .base_pitch = 11.8};
    pair->line = sqrt(200.0 * 200 - 188.0 * 188);
    pair->angle = atan2(pair->line, pair->base);
    check_true("stiffness", dynamics_coupled_pair_stiffness(pair, 6, cycle, share));
}

/* Computes central differences of the state after a cycle by component k of the start. */
static void difference(dynamics_coupled_run *run, double T, const double *start, int k, double d,
                       double *by_start)
{
    double ends[2][N];
    for (int sign = 0; sign < 2; sign++) {
        double moved[N];
        memcpy(moved, start, sizeof moved);
        moved[k] += sign ? -d : d;
        dynamics_coupled_start(run, T, moved);
        dynamics_coupled_cycle(run, T, NULL);
        memcpy(ends[sign], dynamics_coupled_state(run), sizeof ends[sign]);
    }
    for (int i = 0; i < N; i++)
        by_start[i] = (ends[0][i] - ends[1][i]) / (2 * d);
}

static double distance(double a, double b)
{
    double d = fabs(a - b);
    return isfinite(d) ? d : INFINITY;
}

/* Differences with two step sizes give the error of the differences, of second order. At a kink of
   a tooth pair's stiffness, the derivatives have a jump of slope within a time step, but the motion
   only a kink of slope, for which step control makes the step as short as the square root of its
   tolerance. */
static void test_columns(const scene *c)
{
    static const double T = 7, d = 1e-4, tolerance = 1e-13;
    dynamics_excitation mesh;
    dynamics_coupled pair;
    double start[2 * DYNAMICS_COORDINATES], parted, back, worst = 0, bound = 0;
    make(c, &mesh, &pair);
    dynamics_coupled_rest(&pair, start);
    start[DYNAMICS_Q] += c->q;
    start[DYNAMICS_RATES + DYNAMICS_Q] += c->rate;
    start[DYNAMICS_RATES + DYNAMICS_X1] += 0.05;
    dynamics_coupled_run *run = dynamics_coupled_run_new(&pair, 0.1 * tolerance),
                         *varied = dynamics_coupled_run_new(&pair, tolerance);
    dynamics_coupled_start_varied(varied, T, start);
    check_true("runs", dynamics_coupled_cycle(varied, T, NULL));
    const double *monodromy = dynamics_coupled_monodromy(varied);
    for (int k = 0; k < N; k++) {
        double wide[N], narrow[N];
        difference(run, T, start, k, 2 * d, wide);
        difference(run, T, start, k, d, narrow);
        for (int i = 0; i < N; i++) {
            bound = fmax(bound, fabs(wide[i] - narrow[i]));
            double exact = narrow[i] + (narrow[i] - wide[i]) / 3;
            worst = fmax(worst, distance(monodromy[i * N + k], exact));
        }
    }
    dynamics_coupled_clocks(varied, &parted, &back);
    printf("%s: parted %g, back %g of %g\n", c->name, parted, back, T);
    check_true("is the scene", (parted > 0) == c->parts && (back > 0) == c->meets);
    check_below("error of differences", bound, 0.3 * sqrt(tolerance));
    check_below("derivatives differ", worst, 3 * sqrt(tolerance));
    dynamics_coupled_run_free(run);
    dynamics_coupled_run_free(varied);
    dynamics_coupled_free(&pair);
    dynamics_excitation_free(&mesh);
}

static int go_on(void *self, double share)
{
    (void)self, (void)share;
    return 0;
}

/* Integration from rest must reach the motion that Newton's method found, and this motion must
   repeat itself. */
static void test_shooting(void)
{
    static const ff_host host = {.progress = go_on};
    const scene c = {"shooting", DYNAMICS_DAMPING_ALWAYS, 3, 7, 0.02, 0, 0, 0, 0};
    dynamics_excitation mesh;
    dynamics_coupled pair;
    dynamics_coupled_orbit orbit = {.frequency = 2 * M_PI / 7, .period = 1};
    double rest[2 * DYNAMICS_COORDINATES], worst = 0;
    make(&c, &mesh, &pair);
    dynamics_coupled_rest(&pair, rest);
    memcpy(orbit.state, rest, sizeof orbit.state);
    dynamics_coupled_run *run = dynamics_coupled_run_new(&pair, 1e-11),
                         *varied = dynamics_coupled_run_new(&pair, 1e-11);
    check_true("is found", dynamics_coupled_shoot(varied, INFINITY, 1e-9, &host, &orbit) == FF_OK);
    check_below("corrections", (double)orbit.cycles, 6);
    dynamics_coupled_start(run, 7, rest);
    for (int i = 0; i < 150; i++)
        dynamics_coupled_cycle(run, 7, NULL);
    for (int i = 0; i < N; i++)
        worst = fmax(worst, distance(dynamics_coupled_state(run)[i], orbit.state[i]));
    check_below("rest settles elsewhere", worst, 1e-8);
    dynamics_coupled_orbit there = orbit, straight = orbit;
    check_true("is followed",
               dynamics_coupled_follow(varied, 1.2 * orbit.frequency, &host, &there) == FF_OK);
    check_true("is found there", dynamics_coupled_shoot(varied, 1, 1e-9, &host, &there) == FF_OK);
    straight.frequency = there.frequency;
    check_true("is found from rest",
               dynamics_coupled_shoot(varied, INFINITY, 1e-9, &host, &straight) == FF_OK);
    for (int i = 0; i < N; i++)
        worst = fmax(worst, distance(there.state[i], straight.state[i]));
    check_below("the way makes a difference", worst, 1e-8);
    dynamics_coupled_run_free(run);
    dynamics_coupled_run_free(varied);
    dynamics_coupled_free(&pair);
    dynamics_excitation_free(&mesh);
}

/* Integrates from rest while the speed changes slowly to the requested one, then until the motion
   has settled. Returns the change over the last `period` cycles; `state` is then the motion at
   phase 0. */
static double sweep_and_settle(dynamics_coupled_run *run, const dynamics_coupled *pair, double from,
                               double to, int period, double *state)
{
    static const double rate = 1e-3;
    enum { START = 150, SETTLE = 600 };
    const double *y = dynamics_coupled_state(run);
    double rest[2 * DYNAMICS_COORDINATES], frequency = from, change = 0;
    dynamics_coupled_rest(pair, rest);
    dynamics_coupled_start(run, 2 * M_PI / from, rest);
    for (int i = 0; i < START; i++)
        dynamics_coupled_cycle(run, 2 * M_PI / from, NULL);
    for (; to < from ? frequency > to : frequency < to; frequency *= 1 + (to < from ? -rate : rate))
        dynamics_coupled_cycle(run, 2 * M_PI / frequency, NULL);
    for (int i = 0; i < SETTLE; i++) {
        if (i + period == SETTLE)
            memcpy(state, y, N * sizeof *state);
        dynamics_coupled_cycle(run, 2 * M_PI / to, NULL);
    }
    for (int i = 0; i < N; i++)
        change = fmax(change, distance(y[i], state[i]));
    return change;
}

/* Returns the distance of a state from the nearest state of a motion. */
static double distance_from_motion(dynamics_coupled_run *run, double T, int period,
                                   const double *start, const double *state)
{
    double nearest = INFINITY;
    dynamics_coupled_start(run, T, start);
    for (int i = 0; i < period; i++) {
        double worst = 0;
        for (int k = 0; k < N; k++)
            worst = fmax(worst, distance(dynamics_coupled_state(run)[k], state[k]));
        nearest = fmin(nearest, worst);
        dynamics_coupled_cycle(run, T, NULL);
    }
    return nearest;
}

/* A motion that must be found, compared with the slow sweep. */
typedef struct reached {
    const char *name;
    dynamics_branch branch;
    double from; /* frequency of the motion to start from; 0: none */
    double frequency;
    int period;
    double least_parted; /* smallest fraction of the time without contact */
} reached;

static void reach(dynamics_coupled_run *run, const dynamics_coupled *pair, const reached *r,
                  double frequency, dynamics_coupled_motion *motion)
{
    static const ff_host host = {.progress = go_on};
    dynamics_settling how = {.branch = r->branch,
                             .T = 2 * M_PI / frequency,
                             .tolerance = 1e-6,
                             .step_tolerance = 1e-8,
                             .host = &host};
    motion->T = how.T;
    motion->settled = (dynamics_settled){0};
    check_true("is reached", dynamics_coupled_settle(run, pair, &how, motion) == FF_OK);
}

static void test_twin(const reached *r)
{
    const scene c = {r->name, DYNAMICS_DAMPING_ALWAYS, 3, 5, 0.02, 0, 0, 0, 0};
    dynamics_excitation mesh;
    dynamics_coupled pair;
    dynamics_coupled_motion motion = {0};
    double state[N], parted, back, T = 2 * M_PI / r->frequency;
    printf("%s\n", r->name);
    make(&c, &mesh, &pair);
    mesh.zeta = 0.02;
    dynamics_coupled_run *run = dynamics_coupled_run_new(&pair, 1e-8);
    if (r->from > 0) {
        reach(run, &pair, r, r->from, &motion);
        motion.from = r->from;
    }
    reach(run, &pair, r, r->frequency, &motion);
    check_near("period", motion.settled.period, r->period, 0);
    double begin = r->branch == DYNAMICS_BRANCH_UPPER ? 1.4 : 0.7 * r->frequency;
    double change = sweep_and_settle(run, &pair, begin, r->frequency, r->period, state);
    check_below("the twin settles", change, 1e-7);
    check_below("the twin is elsewhere",
                distance_from_motion(run, T, r->period, motion.state, state), 1e-7);
    dynamics_coupled_clocks(run, &parted, &back);
    check_true("contact is lost", parted > r->least_parted * r->period * T);
    dynamics_coupled_run_free(run);
    dynamics_coupled_free(&pair);
    dynamics_excitation_free(&mesh);
}

int main(void)
{
    static const reached motions[] = {
        {"lower, hardly parts", DYNAMICS_BRANCH_LOWER, 0, 0.375, 1, 0.03},
        {"lower, period 2", DYNAMICS_BRANCH_LOWER, 0, 0.45, 2, 0.06},
        {"upper, behind jumps", DYNAMICS_BRANCH_UPPER, 0, 0.6, 1, 0.3},
        {"upper, handed on", DYNAMICS_BRANCH_UPPER, 0.675, 0.625, 1, 0.3},
        {"lower, behind chaos", DYNAMICS_BRANCH_LOWER, 0, 1.5, 1, 0.2},
    };
    static const scene scenes[] = {
        {"in contact", DYNAMICS_DAMPING_ALWAYS, 3, 7, 0, 0, 0, 0, 0},
        {"parts", DYNAMICS_DAMPING_ALWAYS, 3, 7, 0, -1.5, -0.5, 1, 0},
        {"parts, damped in contact", DYNAMICS_DAMPING_CONTACT, 3, 7, 0, -1.5, -0.5, 1, 0},
        {"parts, clipped", DYNAMICS_DAMPING_CLIPPED, 3, 7, 0, 0.3, -2, 1, 0},
        {"meets its back flanks", DYNAMICS_DAMPING_CONTACT, 3, 0.3, 0, -1, -1.5, 1, 1},
        {"e jumps", DYNAMICS_DAMPING_ALWAYS, 3, 7, 0.3, 0, 0, 0, 0},
        {"e jumps in the gap", DYNAMICS_DAMPING_ALWAYS, 3, 7, 0.3, 2.5, 0.5, 1, 0},
        {"e jumps on the back flanks", DYNAMICS_DAMPING_ALWAYS, 3, 4, 0.3, -1, -5, 1, 1},
        {"bearings softer than the mesh", DYNAMICS_DAMPING_ALWAYS, 0.3, 7, 0.1, 1, 0, 0, 0},
    };
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        test_columns(&scenes[i]);
    test_shooting();
    for (size_t i = 0; i < sizeof motions / sizeof motions[0]; i++)
        test_twin(&motions[i]);
    return check_done();
}
