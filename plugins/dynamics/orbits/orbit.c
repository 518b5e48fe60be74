/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "orbit.h"

#include "../oscillator/multipliers.h"
#include "orbit-film.h"
#include "trajectory.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <string.h>

const double dynamics_orbit_accuracy = 1e-13;
const double dynamics_stable_multiplier = 1 + 1e-9;

double dynamics_cycle_duration(double lambda)
{
    return 2 * M_PI * exp(-lambda);
}

double dynamics_state_unit(const dynamics_excitation *excitation, const double x[2])
{
    double unit = excitation->load + hypot(x[0] - excitation->half_gap, x[1]);
    return fmax(unit, 1e-6 * (1 + excitation->half_gap));
}

dynamics_state dynamics_orbit_start(const dynamics_orbit *o)
{
    return o->films.known ? dynamics_state_in_oil(o->x[0], o->x[1], o->films.film)
                          : dynamics_state_at(o->x[0], o->x[1]);
}

static double rms_of(const dynamics_trajectory *trace, double time)
{
    double mean = trace->sum / time;
    return sqrt(fmax(trace->square / time - mean * mean, 0));
}

int dynamics_orbit_map(const dynamics_flow *flow, dynamics_orbit *orbit)
{
    assert(orbit->period >= 1 && orbit->period <= DYNAMICS_PERIOD_MAX);
    double T = dynamics_cycle_duration(orbit->lambda);
    if (flow->excitation->film)
        dynamics_films_start(flow, T, orbit);
    dynamics_trajectory trace = {.origin = orbit->x[0]};
    dynamics_observer moments = {dynamics_trajectory_observe_moments, &trace};
    dynamics_state y = dynamics_orbit_start(orbit);
    for (int i = 0; i < orbit->period; i++) {
        if (!dynamics_flow_variation(flow, T, &y, orbit->moments ? &moments : NULL))
            return 0;
        double now[2] = {y.delta, y.rate};
        if (dynamics_is_unbounded(flow->excitation, now[0], now[1]))
            return 0;
        if (2 * (i + 1) == orbit->period)
            memcpy(orbit->half, now, sizeof now);
    }
    orbit->end[0] = y.delta;
    orbit->end[1] = y.rate;
    orbit->slope[0] = -T * y.change[0];
    orbit->slope[1] = -T * y.change[1];
    memcpy(orbit->m, y.m, sizeof orbit->m);
    orbit->det = y.det;
    orbit->rms = rms_of(&trace, orbit->period * T);
    if (flow->excitation->film)
        dynamics_films_eliminate(&y, T, orbit);
    return 1;
}

double dynamics_orbit_residual(const dynamics_excitation *excitation, const dynamics_orbit *o)
{
    double miss = hypot(o->end[0] - o->x[0], o->end[1] - o->x[1]);
    if (excitation->film)
        miss = fmax(miss, o->films.miss);
    return miss / dynamics_state_unit(excitation, o->x);
}

/* Solves (M - 1) step = x - end. Returns 0 if M - 1 is singular. */
static int newton_step(const dynamics_orbit *o, double step[2])
{
    double a = o->m[0] - 1, b = o->m[1], c = o->m[2], d = o->m[3] - 1, det = a * d - b * c;
    double r0 = o->x[0] - o->end[0], r1 = o->x[1] - o->end[1];
    if (!(fabs(det) > DBL_EPSILON * (fabs(a * d) + fabs(b * c))))
        return 0;
    step[0] = (d * r0 - b * r1) / det;
    step[1] = (a * r1 - c * r0) / det;
    return isfinite(step[0]) && isfinite(step[1]);
}

int dynamics_orbit_solve(const dynamics_flow *flow, double tolerance, dynamics_orbit *orbit)
{
    enum { MAX_STEPS = 30, MAX_HALVINGS = 8 };
    dynamics_orbit now = *orbit, next;
    double step[2];
    if (!dynamics_orbit_map(flow, &now))
        return 0;
    double residual = dynamics_orbit_residual(flow->excitation, &now);
    for (int i = 0; i < MAX_STEPS && residual > tolerance; i++) {
        if (!newton_step(&now, step))
            return 0;
        double share = 1, after = INFINITY;
        for (int k = 0; k < MAX_HALVINGS; k++, share *= 0.5) {
            next = now;
            next.x[0] += share * step[0];
            next.x[1] += share * step[1];
            after = dynamics_orbit_map(flow, &next)
                        ? dynamics_orbit_residual(flow->excitation, &next)
                        : INFINITY;
            if (after < (1 - 0.25 * share) * residual)
                break;
        }
        if (!(after < residual))
            break; /* no better point was found: the residual is at round-off, or the orbit is
                      lost */
        now = next;
        residual = after;
    }
    *orbit = now;
    return residual <= fmax(tolerance, 1e-11);
}

double dynamics_fold_test(const dynamics_orbit *o)
{
    return o->films.known ? dynamics_films_test(o, 1) : 1 - (o->m[0] + o->m[3]) + o->det;
}

double dynamics_doubling_test(const dynamics_orbit *o)
{
    return o->films.known ? dynamics_films_test(o, -1) : 1 + (o->m[0] + o->m[3]) + o->det;
}

double dynamics_largest_multiplier(const dynamics_orbit *o)
{
    double half = 0.5 * (o->m[0] + o->m[3]), d = half * half - o->det, all[8];
    if (o->films.known)
        return dynamics_films_multipliers(o->films.m, all);
    return d < 0 ? sqrt(o->det) : fabs(half) + sqrt(d);
}

int dynamics_orbit_is_stable(const dynamics_orbit *orbit)
{
    return dynamics_largest_multiplier(orbit) < dynamics_stable_multiplier;
}

int dynamics_orbit_distance(const dynamics_flow *flow, const dynamics_orbit *orbit,
                            const double other[2], double *distance)
{
    double unit = dynamics_state_unit(flow->excitation, orbit->x),
           T = dynamics_cycle_duration(orbit->lambda);
    dynamics_state y = dynamics_state_at(other[0], other[1]);
    *distance = INFINITY;
    for (int i = 0; i < orbit->period; i++) {
        double d = hypot(y.delta - orbit->x[0], y.rate - orbit->x[1]) / unit;
        *distance = fmin(*distance, d);
        if (i + 1 < orbit->period && !dynamics_flow_motion(flow, T, &y, NULL))
            return 0;
    }
    return 1;
}

void dynamics_orbit_order(const dynamics_flow *flow, dynamics_orbit *orbit)
{
    const double T = dynamics_cycle_duration(orbit->lambda);
    dynamics_state y = dynamics_orbit_start(orbit), first = y;
    for (int i = 1; i < orbit->period; i++) {
        if (!dynamics_flow_motion(flow, T, &y, NULL))
            return;
        if (y.delta > first.delta)
            first = y;
    }
    dynamics_orbit moved = *orbit;
    moved.x[0] = first.delta;
    moved.x[1] = first.rate;
    memcpy(moved.films.film, first.oil.film, sizeof moved.films.film);
    if (dynamics_orbit_solve(flow, dynamics_orbit_accuracy, &moved))
        *orbit = moved;
}

int dynamics_orbit_rms(const dynamics_flow *flow, const dynamics_orbit *orbit, double *rms)
{
    dynamics_trajectory trace = {.origin = orbit->x[0]};
    dynamics_observer observer = {dynamics_trajectory_observe_moments, &trace};
    dynamics_state y = dynamics_orbit_start(orbit);
    double T = dynamics_cycle_duration(orbit->lambda);
    for (int i = 0; i < orbit->period; i++)
        if (!dynamics_flow_motion(flow, T, &y, &observer))
            return 0;
    *rms = rms_of(&trace, orbit->period * T);
    return 1;
}

void dynamics_orbit_reduce(const dynamics_flow *flow, dynamics_orbit *o)
{
    for (int q = 1; q < o->period; q++) {
        if (o->period % q != 0)
            continue;
        dynamics_orbit shorter = *o;
        shorter.period = q;
        if (dynamics_orbit_map(flow, &shorter) &&
            dynamics_orbit_residual(flow->excitation, &shorter) < 1e-6) {
            /* Newton's method stops early where a film begins to follow its flank at phase 0 */
            dynamics_orbit exact = shorter;
            *o = dynamics_orbit_solve(flow, dynamics_orbit_accuracy, &exact) ? exact : shorter;
            return;
        }
    }
}
