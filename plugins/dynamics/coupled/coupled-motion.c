/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "coupled-motion.h"

#include "coupled-shooting.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The distance to a periodic motion up to which a motion that has not settled is called periodic.
 */
static const double nearly_periodic = 1e-3;

/* The least relative change of the frequency per cycle in a sweep: a cycle costs more here than
   with rigid bearings. */
static const double slowest = 1e-3;

enum { HISTORY = 2 * DYNAMICS_LONGEST_PERIOD + 1 };

typedef struct history {
    double state[HISTORY][DYNAMICS_TAKEN];
    size_t count;
} history;

static void remember(history *h, const double *y)
{
    memcpy(h->state[h->count % HISTORY], y, sizeof h->state[0]);
    h->count++;
}

/* The change of the state over one period, as it was `ago` cycles ago. */
static double change_over(const history *h, int period, int ago)
{
    const double *now = h->state[(h->count - 1 - (size_t)ago) % HISTORY];
    const double *then = h->state[(h->count - 1 - (size_t)ago - (size_t)period) % HISTORY];
    double change = 0;
    for (int i = 0; i < DYNAMICS_TAKEN; i++)
        change = fmax(change, fabs(now[i] - then[i]));
    return change;
}

/* Finds the shortest period whose motion is near. If the change shrinks by mu per period, all
   further changes sum up to 1/(1 - mu) of the last one; mu is at least that of the mesh damping. */
static void find_period(const history *h, const dynamics_excitation *excitation,
                        const dynamics_settling *how, dynamics_settled *settled)
{
    settled->distance = INFINITY;
    for (int p = 1; p <= DYNAMICS_LONGEST_PERIOD && h->count > 2 * (size_t)p; p++) {
        double change = change_over(h, p, 0), before = change_over(h, p, p);
        double damped = exp(-excitation->zeta * p * how->T);
        double mu = fmin(fmax(before > 0 ? change / before : 0, damped), 1 - 1e-6);
        double distance = change / (1 - mu);
        int near = distance < how->tolerance || distance < 0.01 * settled->distance;
        if (!near)
            continue;
        settled->distance = distance;
        settled->period = p;
        settled->within = distance < how->tolerance;
        if (settled->within)
            break;
    }
    /* a disturbance that oscillates while it dies out may hide the shorter period: its change over
       a period is at most twice its size */
    for (int p = 1; settled->within && p < settled->period; p++)
        if (change_over(h, p, 0) < 4 * how->tolerance)
            settled->period = p;
}

static int is_unbounded(const double *y, const dynamics_excitation *excitation)
{
    return dynamics_is_unbounded(excitation, y[DYNAMICS_Q], y[DYNAMICS_RATES + DYNAMICS_Q]);
}

static void start_at_rest(dynamics_coupled_run *run, const dynamics_coupled *pair, double T)
{
    double rest[DYNAMICS_TAKEN];
    dynamics_coupled_rest(pair, rest);
    dynamics_coupled_start(run, T, rest);
}

/* Sweeps the speed from one frequency to another, after `start` cycles at the first. Where the
   motion grows without bound it starts from rest again. */
static ff_status sweep(dynamics_coupled_run *run, const dynamics_coupled *pair, const ff_host *host,
                       double from, double to, size_t start)
{
    double frequency = from, way = log(to / from);
    for (size_t i = 0; way < 0 ? frequency > to : frequency < to; i++) {
        if (i % 64 == 0 && host->progress(host->ctx, 0.5 * log(frequency / from) / way))
            return FF_STOPPED;
        if (!dynamics_coupled_cycle(run, 2 * M_PI / frequency, NULL))
            return FF_NOCONV;
        if (is_unbounded(dynamics_coupled_state(run), pair->excitation))
            start_at_rest(run, pair, 2 * M_PI / frequency);
        if (i >= start)
            frequency *= 1 + (way < 0 ? -1 : 1) *
                                 fmax(dynamics_sweep_rate(pair->excitation, frequency), slowest);
    }
    return FF_OK;
}

static ff_status settle_here(dynamics_coupled_run *run, const dynamics_coupled *pair,
                             const dynamics_settling *how, dynamics_coupled_motion *motion)
{
    const double *y = dynamics_coupled_state(run);
    dynamics_settled *settled = &motion->settled;
    history h = {.count = 0};
    remember(&h, y);
    while (settled->cycles < settled->limit && !settled->within) {
        if (settled->cycles % 64 == 0 &&
            how->host->progress(how->host->ctx,
                                0.5 + 0.4 * (double)settled->cycles / (double)settled->limit))
            return FF_STOPPED;
        memcpy(motion->state, y, sizeof motion->state);
        if (!dynamics_coupled_cycle(run, how->T, NULL))
            return FF_NOCONV;
        settled->cycles++;
        if (is_unbounded(y, pair->excitation)) {
            settled->period = DYNAMICS_UNBOUNDED;
            return FF_OK;
        }
        remember(&h, y);
        find_period(&h, pair->excitation, how, settled);
    }
    if (!settled->within && !(settled->distance < nearly_periodic))
        settled->period = DYNAMICS_APERIODIC;
    memcpy(motion->state, y, sizeof motion->state);
    return FF_OK;
}

/* What a slow sweep of the speed leads to. */
static ff_status settle(dynamics_coupled_run *run, const dynamics_coupled *pair,
                        const dynamics_settling *how, dynamics_coupled_motion *motion)
{
    double frequency = 2 * M_PI / how->T, from = motion->from;
    size_t start = 0;
    if (from > 0) {
        dynamics_coupled_start(run, 2 * M_PI / from, motion->state);
    } else {
        from = dynamics_sweep_from(how->branch, frequency);
        start = dynamics_sweep_start_cycles(pair->excitation, 2 * M_PI / from);
        start_at_rest(run, pair, 2 * M_PI / from);
    }
    ff_status status = sweep(run, pair, how->host, from, frequency, start);
    return status == FF_OK ? settle_here(run, pair, how, motion) : status;
}

/* The motion without separation. FF_NOCONV: there is none that is stable. */
static ff_status shoot_in_contact(dynamics_coupled_run *run, const dynamics_coupled *pair,
                                  const dynamics_settling *how, dynamics_coupled_orbit *orbit)
{
    dynamics_coupled_rest(pair, orbit->state);
    ff_status status = dynamics_coupled_shoot(run, INFINITY, how->tolerance, how->host, orbit);
    return status == FF_OK && !orbit->touches ? FF_NOCONV : status;
}

/* The farthest that a motion is looked for from a state that has yet to settle, in static
   deflections. */
static const double unsettled = 1;

/* Follows a motion to the frequency that is sought. Where the motion ends the speed is swept until
   another is near. FF_NOCONV: none is near the state at that frequency. */
static ff_status follow_and_sweep(dynamics_coupled_run *run, const dynamics_coupled *pair,
                                  const dynamics_settling *how, dynamics_coupled_orbit *orbit)
{
    static const double stretch = 0.03; /* of a sweep, in the logarithm of the frequency */
    double to = 2 * M_PI / how->T;
    ff_status status = dynamics_coupled_follow(run, to, how->host, orbit);
    while (status == FF_NOCONV && orbit->frequency != to) {
        double left = log(to / orbit->frequency);
        double next = fabs(left) > stretch ? orbit->frequency * exp(copysign(stretch, left)) : to;
        dynamics_coupled_start(run, 2 * M_PI / orbit->frequency, orbit->state);
        status = sweep(run, pair, how->host, orbit->frequency, next, 0);
        if (status != FF_OK)
            return status;
        orbit->frequency = next;
        memcpy(orbit->state, dynamics_coupled_state(run), sizeof orbit->state);
        dynamics_coupled_orbit nearby = *orbit;
        status = dynamics_coupled_shoot(run, unsettled, how->tolerance, how->host, &nearby);
        orbit->cycles = nearby.cycles;
        if (status != FF_OK)
            continue;
        *orbit = nearby;
        status = dynamics_coupled_follow(run, to, how->host, orbit);
    }
    return status;
}

/* The motion in which a sweep begins. */
static ff_status begin_sweep(dynamics_coupled_run *run, const dynamics_coupled *pair,
                             const dynamics_settling *how, dynamics_coupled_orbit *orbit)
{
    orbit->frequency = dynamics_sweep_from(how->branch, 2 * M_PI / how->T);
    double T = 2 * M_PI / orbit->frequency;
    ff_status status = shoot_in_contact(run, pair, how, orbit);
    if (status != FF_NOCONV)
        return status;
    size_t cycles = dynamics_sweep_start_cycles(pair->excitation, T);
    start_at_rest(run, pair, T);
    for (size_t i = 0; i < cycles; i++)
        if (!dynamics_coupled_cycle(run, T, NULL))
            return FF_NOCONV;
    memcpy(orbit->state, dynamics_coupled_state(run), sizeof orbit->state);
    return FF_OK;
}

/* Leads to where a sweep of the speed ends, or near it. */
static ff_status approach(const dynamics_coupled *pair, const dynamics_settling *how,
                          const dynamics_coupled_motion *motion, dynamics_coupled_orbit *orbit)
{
    static const double on_the_way = 1e-6; /* error of a step: the end is found more closely */
    dynamics_coupled_run *run =
        dynamics_coupled_run_new(pair, fmax(how->step_tolerance, on_the_way));
    if (!run)
        return FF_NOMEM;
    ff_status status = FF_OK;
    orbit->frequency = motion->from;
    if (motion->from > 0)
        memcpy(orbit->state, motion->state, sizeof orbit->state);
    else
        status = begin_sweep(run, pair, how, orbit);
    if (status == FF_OK)
        status = follow_and_sweep(run, pair, how, orbit);
    dynamics_coupled_run_free(run);
    return status;
}

/* What `settle` leads to, by Newton's method where the motion repeats itself after a cycle. */
static ff_status shoot(dynamics_coupled_run *run, const dynamics_coupled *pair,
                       const dynamics_settling *how, dynamics_coupled_motion *motion)
{
    double frequency = 2 * M_PI / how->T;
    dynamics_coupled_orbit orbit = {.frequency = frequency};
    ff_status status = FF_NOCONV;
    if (how->branch == DYNAMICS_BRANCH_LOWER && !(motion->from > 0))
        status = shoot_in_contact(run, pair, how, &orbit);
    if (status == FF_NOCONV) {
        status = approach(pair, how, motion, &orbit);
        if (orbit.frequency != frequency || (status != FF_OK && status != FF_NOCONV))
            return status;
        memcpy(motion->state, orbit.state, sizeof motion->state);
        status = dynamics_coupled_shoot(run, unsettled, how->tolerance, how->host, &orbit);
    }
    if (status == FF_NOCONV) {
        dynamics_coupled_start(run, how->T, motion->state);
        return settle_here(run, pair, how, motion);
    }
    memcpy(motion->state, orbit.state, sizeof motion->state);
    motion->settled.period = 1;
    motion->settled.within = orbit.distance <= how->tolerance;
    motion->settled.distance = orbit.distance;
    motion->settled.cycles = orbit.cycles;
    return status;
}

ff_status dynamics_coupled_settle(dynamics_coupled_run *run, const dynamics_coupled *pair,
                                  const dynamics_settling *how, dynamics_coupled_motion *motion)
{
    motion->settled.limit =
        how->cycles ? how->cycles : dynamics_settle_limit(pair->excitation, how->T, how->tolerance);
    return how->cycles ? settle(run, pair, how, motion) : shoot(run, pair, how, motion);
}

/* The monodromy over the cycles that are shown; what overflows is cut off. */
static ff_status find_monodromy(dynamics_coupled_motion *motion, const dynamics_coupled *pair,
                                double tolerance)
{
    dynamics_coupled_run *run = dynamics_coupled_run_new(pair, tolerance);
    if (!run)
        return FF_NOMEM;
    ff_status status = FF_OK;
    dynamics_coupled_start_varied(run, motion->T, motion->state);
    for (size_t i = 0; i < motion->cycles && status == FF_OK; i++)
        status = dynamics_coupled_cycle(run, motion->T, NULL) ? FF_OK : FF_NOCONV;
    const double *columns = dynamics_coupled_columns(run);
    for (int i = 0; i < DYNAMICS_TAKEN; i++)
        for (int k = 0; k < DYNAMICS_TAKEN; k++)
            motion->monodromy[i * DYNAMICS_TAKEN + k] =
                fmin(fmax(columns[k * DYNAMICS_TAKEN + i], -1e100), 1e100);
    dynamics_coupled_run_free(run);
    return status;
}

static void check_energy(dynamics_coupled_motion *motion, const dynamics_coupled_run *run,
                         double at_start, double load)
{
    double kinetic, energy = dynamics_coupled_energy(run, &kinetic);
    double unit = kinetic + fabs(at_start) + fabs(energy) + 0.5 * load * load;
    motion->energy_error = unit > 0 ? fabs(energy - at_start) / unit : 0;
}

ff_status dynamics_coupled_motion_record(dynamics_coupled_motion *motion,
                                         const dynamics_coupled *pair,
                                         const dynamics_inputs *inputs, double tolerance,
                                         size_t per_cycle, const ff_host *host)
{
    double last = (inputs->roll_angle[inputs->stations - 1] - inputs->roll_sap) / inputs->pitch;
    size_t tail = (size_t)ceil(fmax(last, 0) + 1e-9), count = motion->cycles + tail;
    double kinetic;
    dynamics_coupled_run *run = dynamics_coupled_run_new(pair, tolerance);
    ff_status status = find_monodromy(motion, pair, tolerance);
    if (!run || !dynamics_coupled_record_init(&motion->record, pair, per_cycle, count))
        status = FF_NOMEM;
    if (status != FF_OK)
        goto out;
    dynamics_coupled_start(run, motion->T, motion->state);
    double energy = dynamics_coupled_energy(run, &kinetic);
    for (size_t i = 0; i < count && status == FF_OK; i++) {
        if (host->progress(host->ctx, 0.9 + 0.1 * (double)i / (double)count))
            status = FF_STOPPED;
        else if (!dynamics_coupled_cycle(run, motion->T, &motion->record))
            status = FF_NOCONV;
        if (i + 1 == motion->cycles) {
            check_energy(motion, run, energy, pair->excitation->load);
            dynamics_coupled_clocks(run, &motion->parted, &motion->back);
        }
    }
out:
    dynamics_coupled_run_free(run);
    return status;
}
