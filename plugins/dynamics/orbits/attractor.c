/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "attractor.h"

#include "../oscillator/full-contact.h"

#include <math.h>
#include <string.h>

/* Distances in units of dynamics_state_unit. Newton's method is tried if a state returns to within
   near_return of an earlier state. The orbit found is accepted if the state is within close_enough
   of the orbit. */
static const double near_return = 0.05, close_enough = 2e-2;

/* Smallest damping ratio at which a motion is integrated until it settles. A smaller damping ratio
   is reached by continuation from the motion at this ratio. */
static const double least_damping = 2e-3;

/* Numbers of mesh cycles. BATCH: between the first attempts of Newton's method; HISTORY: stored;
   GROWTH_CYCLES: integrated to measure the growth of a disturbance. */
enum { BATCH = 16, HISTORY = DYNAMICS_PERIOD_MAX + 1, GROWTH_CYCLES = 400 };

/* Looks for a periodic motion near the last states; history[i] is the state i cycles ago. */
static int find_orbit(const dynamics_flow *flow, const dynamics_search *search,
                      double history[HISTORY][2], dynamics_attractor *a)
{
    double unit = dynamics_state_unit(flow->excitation, history[0]);
    for (int p = 1; p <= search->max_period; p++) {
        double d = hypot(history[0][0] - history[p][0], history[0][1] - history[p][1]);
        if (d > near_return * unit)
            continue;
        dynamics_orbit o = {.period = p, .lambda = search->lambda};
        memcpy(o.x, history[0], sizeof o.x);
        double distance;
        if (!dynamics_orbit_solve(flow, dynamics_orbit_accuracy, &o) ||
            !dynamics_orbit_is_stable(&o) ||
            !dynamics_orbit_distance(flow, &o, history[0], &distance) || distance > close_enough)
            continue;
        dynamics_orbit_reduce(flow, &o);
        a->orbit = o;
        a->period = o.period;
        memcpy(a->x, o.x, sizeof a->x);
        return 1;
    }
    return 0;
}

/* Measures the largest Lyapunov exponent: the mean logarithm of the growth of a small disturbance,
 * which is rescaled to 1 after each cycle (Benettin et al. 1980, Meccanica 15, 9-20). */
static void measure_growth(const dynamics_flow *flow, double T, dynamics_attractor *a)
{
    double x[2] = {a->x[0], a->x[1]}, v[2] = {1, 0}, sum = 0;
    int n = 0;
    for (; n < GROWTH_CYCLES; n++) {
        dynamics_state y = dynamics_state_at(x[0], x[1]);
        if (!dynamics_flow_variation(flow, T, &y, NULL))
            break;
        double w[2] = {y.m[0] * v[0] + y.m[1] * v[1], y.m[2] * v[0] + y.m[3] * v[1]};
        double size = hypot(w[0], w[1]);
        if (!(size > 0 && isfinite(size)))
            break;
        sum += log(size);
        v[0] = w[0] / size, v[1] = w[1] / size;
        x[0] = y.delta, x[1] = y.rate;
    }
    a->growth = n > 0 ? sum / n : 0;
}

int dynamics_attract(const dynamics_flow *flow, const dynamics_search *search,
                     dynamics_attractor *a)
{
    double T = dynamics_cycle_duration(search->lambda), history[HISTORY][2] = {{0}};
    size_t next = BATCH, stored = 0;
    dynamics_state y = dynamics_state_at(a->x[0], a->x[1]);
    a->period = DYNAMICS_APERIODIC;
    a->growth = 0;
    for (a->cycles = 0; a->cycles < search->cycles;) {
        if (!dynamics_flow_motion(flow, T, &y, NULL))
            return 0;
        memmove(history[1], history[0], (HISTORY - 1) * sizeof history[0]);
        history[0][0] = a->x[0] = y.delta;
        history[0][1] = a->x[1] = y.rate;
        stored++;
        a->cycles++;
        if (dynamics_is_unbounded(flow->excitation, a->x[0], a->x[1])) {
            a->period = DYNAMICS_UNBOUNDED;
            return 1;
        }
        if (stored < HISTORY || (a->cycles < next && a->cycles < search->cycles))
            continue;
        if (find_orbit(flow, search, history, a))
            return 1;
        next = a->cycles + (a->cycles > 4 * BATCH ? a->cycles / 4 : BATCH);
    }
    if (search->growth)
        measure_growth(flow, T, a);
    return 1;
}

/* Performs the sweep of settle.c with the exact steps of flow.h. */
static ff_status sweep(const dynamics_flow *flow, double from, double to, size_t start,
                       const ff_host *host, double x[2])
{
    const dynamics_excitation *excitation = flow->excitation;
    double f = from, rest[2] = {dynamics_rest_deflection(excitation), 0};
    for (size_t i = 0; from > to ? f > to : f < to; i++) {
        dynamics_state y = dynamics_state_at(x[0], x[1]);
        if (!dynamics_flow_motion(flow, 2 * M_PI / f, &y, NULL))
            return FF_NOCONV;
        x[0] = y.delta, x[1] = y.rate;
        if (dynamics_is_unbounded(excitation, x[0], x[1]))
            memcpy(x, rest, sizeof rest);
        if (i >= start)
            f *= 1 + (from > to ? -1 : 1) * dynamics_sweep_rate(excitation, f);
        if (i % 256 == 0 &&
            host->progress(host->ctx, fmin(0.3 * log(f / from) / log(to / from), 1)))
            return FF_STOPPED;
    }
    return FF_OK;
}

/* Finds the stable motion whose flanks never separate. Returns FF_NOCONV if there is none. */
static ff_status find_full_contact(const dynamics_flow *flow, double lambda, dynamics_attractor *a)
{
    double T = dynamics_cycle_duration(lambda);
    a->orbit = (dynamics_orbit){.period = 1, .lambda = lambda};
    ff_status status =
        dynamics_full_contact(flow->excitation, T, 1e-8, &a->orbit.x[0], &a->orbit.x[1]);
    if (status != FF_OK)
        return status;
    if (!dynamics_orbit_solve(flow, dynamics_orbit_accuracy, &a->orbit))
        return FF_NOCONV;
    a->period = 1;
    memcpy(a->x, a->orbit.x, sizeof a->x);
    return FF_OK;
}

/* Continues a periodic motion from the damping of `excitation` down to `zeta` by Newton's method.
   Returns 0 if the motion is lost. */
static int lower_damping(dynamics_flow *flow, dynamics_excitation *excitation, double zeta,
                         dynamics_orbit *orbit)
{
    static const double shortest = 1e-4;
    double high = excitation->zeta, share = 1, step = 0.25;
    while (share > 0) {
        dynamics_orbit next = *orbit;
        double distance = INFINITY, to = fmax(share - step, 0);
        excitation->zeta = zeta + to * (high - zeta);
        if (dynamics_orbit_solve(flow, dynamics_orbit_accuracy, &next))
            distance = hypot(next.x[0] - orbit->x[0], next.x[1] - orbit->x[1]) /
                       dynamics_state_unit(excitation, orbit->x);
        if (distance < 0.2) {
            *orbit = next;
            share = to;
        } else if ((step *= 0.5) < shortest) {
            return 0;
        }
    }
    return 1;
}

/* Returns the distance between two orbits at phase 0, relative to their size. */
static double distance_of(const dynamics_excitation *excitation, const dynamics_orbit *a,
                          const dynamics_orbit *b)
{
    return hypot(b->x[0] - a->x[0], b->x[1] - a->x[1]) / dynamics_state_unit(excitation, a->x);
}

/* Continues a stable motion to the speed `lambda` by Newton's method. Returns 0 if the branch ends
   or becomes unstable before. `orbit` is then the last stable motion; the speed at which the branch
   ends is located to within `share` of the remaining change of speed. */
static int follow_speed(const dynamics_flow *flow, double lambda, double share,
                        dynamics_orbit *orbit)
{
    static const double longest = 0.02, shortest = 1e-6, near = 0.1;
    double step = longest;
    while (orbit->lambda != lambda) {
        dynamics_orbit next = *orbit;
        double left = lambda - orbit->lambda;
        next.lambda = fabs(left) <= step ? lambda : orbit->lambda + copysign(step, left);
        if (dynamics_orbit_solve(flow, dynamics_orbit_accuracy, &next) &&
            dynamics_orbit_is_stable(&next) && distance_of(flow->excitation, orbit, &next) < near) {
            *orbit = next;
            step = fmin(1.5 * step, longest);
        } else if ((step *= 0.5) < fmax(shortest, share * fabs(left))) {
            return 0;
        }
    }
    return 1;
}

static void take_orbit(const dynamics_flow *flow, dynamics_orbit *orbit, dynamics_attractor *a)
{
    dynamics_orbit_reduce(flow, orbit);
    a->orbit = *orbit;
    a->period = orbit->period;
    memcpy(a->x, orbit->x, sizeof a->x);
}

/* Returns the number of cycles in which a motion must come near enough to a periodic motion for
   Newton's method, while the speed is still changing. Without this limit an aperiodic motion would
   use up all cycles of the search at each intermediate speed. */
static size_t cycles_on_the_way(const dynamics_flow *flow, const dynamics_search *search,
                                double lambda)
{
    size_t enough = dynamics_sweep_start_cycles(flow->excitation, dynamics_cycle_duration(lambda));
    return enough < search->cycles ? enough : search->cycles;
}

/* Changes the speed slowly from `from` to the speed of the search. A periodic motion is continued
   to the end of its branch. There the speed is swept over a short range, and the motion settles
   again. If there is oil between the flanks, the speed is swept over the whole range, since one
   Newton solution of such a motion costs more than hundreds of its cycles. */
static ff_status change_speed(const dynamics_flow *flow, double from, const dynamics_search *search,
                              const ff_host *host, dynamics_attractor *a)
{
    int follows = !flow->excitation->film;
    double stretch = follows ? 0.03 : INFINITY; /* length of one sweep, in lambda */
    /* Before a slow speed is reached, dozens of branches may end. The first end is located exactly,
       since it is reported; the other ends are located roughly. */
    static const double nearly = 0.01;
    dynamics_search here = *search;
    here.growth = 0;
    for (double lambda = from;;) {
        if (host->progress(host->ctx, 0.3))
            return FF_STOPPED;
        if (follows && a->period > 0) {
            dynamics_orbit orbit = a->orbit;
            int arrives = follow_speed(flow, search->lambda, a->ends ? nearly : 0, &orbit);
            if (arrives) {
                take_orbit(flow, &orbit, a);
                return FF_OK;
            }
            lambda = orbit.lambda;
            if (!a->ends++)
                a->ended = lambda;
            memcpy(a->x, orbit.x, sizeof a->x);
        }
        double left = search->lambda - lambda;
        double next = fabs(left) > stretch ? lambda + copysign(stretch, left) : search->lambda;
        ff_status status = sweep(flow, exp(lambda), exp(next), 0, host, a->x);
        if (status != FF_OK)
            return status;
        lambda = here.lambda = next;
        if (lambda == search->lambda)
            return dynamics_attract(flow, search, a) ? FF_OK : FF_NOCONV;
        here.cycles = cycles_on_the_way(flow, search, lambda);
        if (!dynamics_attract(flow, &here, a))
            return FF_NOCONV;
        if (a->period == DYNAMICS_UNBOUNDED) {
            a->x[0] = dynamics_rest_deflection(flow->excitation);
            a->x[1] = 0;
        }
    }
}

/* The start of a change of speed. */
typedef struct way {
    double from;       /* lambda */
    int seeks_contact; /* 1: accept a stable motion without contact loss */
    int settles;       /* 1: the motion settles at `from` before the speed changes */
} way;

/* Finds the motion at the speed of the search, starting from a->x. */
static ff_status lead(const dynamics_flow *flow, const way *w, const dynamics_search *search,
                      const ff_host *host, dynamics_attractor *a)
{
    dynamics_excitation excitation = *flow->excitation;
    dynamics_flow damped = {
        .excitation = &excitation, .free_until = flow->free_until, .radau = flow->radau};
    double zeta = excitation.zeta;
    excitation.zeta = fmax(zeta, least_damping);
    if (host->progress(host->ctx, 0))
        return FF_STOPPED;
    ff_status status = w->seeks_contact ? find_full_contact(&damped, search->lambda, a) : FF_NOCONV;
    if (status == FF_NOCONV) {
        dynamics_search start = *search;
        start.lambda = w->from;
        start.growth = 0;
        start.cycles = cycles_on_the_way(&damped, search, w->from);
        a->period = DYNAMICS_APERIODIC;
        status = !w->settles || dynamics_attract(&damped, &start, a) ? FF_OK : FF_NOCONV;
        if (status == FF_OK)
            status = change_speed(&damped, w->from, search, host, a);
    }
    if (status != FF_OK || excitation.zeta == zeta || a->period < 1)
        return status;
    if (!lower_damping(&damped, &excitation, zeta, &a->orbit))
        a->period = DYNAMICS_APERIODIC;
    memcpy(a->x, a->orbit.x, sizeof a->x);
    return FF_OK;
}

ff_status dynamics_attract_branch(const dynamics_flow *flow, dynamics_branch branch,
                                  const dynamics_search *search, const ff_host *host,
                                  dynamics_attractor *a)
{
    way w = {.from = log(dynamics_sweep_from(branch, flow->excitation, exp(search->lambda))),
             .seeks_contact = branch == DYNAMICS_BRANCH_LOWER,
             .settles = 1};
    a->x[0] = dynamics_rest_deflection(flow->excitation);
    a->x[1] = 0;
    return lead(flow, &w, search, host, a);
}

ff_status dynamics_attract_from(const dynamics_flow *flow, const dynamics_orbit *from,
                                const dynamics_search *search, const ff_host *host,
                                dynamics_attractor *a)
{
    dynamics_orbit orbit = *from;
    way w = {.from = from->lambda};
    if (host->progress(host->ctx, 0))
        return FF_STOPPED;
    if (from->period > 0 && dynamics_orbit_solve(flow, dynamics_orbit_accuracy, &orbit) &&
        dynamics_orbit_is_stable(&orbit) && distance_of(flow->excitation, from, &orbit) < 0.5) {
        if (follow_speed(flow, search->lambda, 0, &orbit)) {
            take_orbit(flow, &orbit, a);
            return FF_OK;
        }
        a->ends = 1;
        a->ended = w.from = orbit.lambda;
    } else {
        orbit = *from;
    }
    memcpy(a->x, orbit.x, sizeof a->x);
    return lead(flow, &w, search, host, a);
}
