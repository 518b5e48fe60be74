/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "coupled-motion.h"

#include "coupled-shooting.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A motion that has not settled is called periodic if its estimated distance to a periodic motion
   is below this value. */
static const double nearly_periodic = 1e-3;

/* Smallest relative change of the frequency per cycle in a speed sweep. It is larger than with
   rigid bearings, since a cycle takes more computing time here. */
static const double slowest = 1e-3;

/* Largest distances, in static deflections, within which Newton's method accepts a motion: from the
   end of a speed sweep, and from a state that is still settling. The second bound is small, so that
   the accepted motion is the one to which the state would settle. */
static const double unsettled = 1, settling = 0.1;

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

/* Returns the change of the state over one period, `ago` cycles ago. */
static double change_over(const history *h, int period, int ago)
{
    const double *now = h->state[(h->count - 1 - (size_t)ago) % HISTORY];
    const double *then = h->state[(h->count - 1 - (size_t)ago - (size_t)period) % HISTORY];
    double change = 0;
    for (int i = 0; i < DYNAMICS_TAKEN; i++)
        change = fmax(change, fabs(now[i] - then[i]));
    return change;
}

static double size_of(const history *h)
{
    const double *now = h->state[(h->count - 1) % HISTORY];
    double size = 0;
    for (int i = 0; i < DYNAMICS_TAKEN; i++)
        size = fmax(size, fabs(now[i]));
    return size;
}

/* Finds the shortest period for which the motion is near a periodic one. If the change shrinks
   by mu per period, all further changes sum to 1/(1 - mu) times the last one. mu is at least the
   decay factor of the mesh damping. A change of the size of round-off contains no information
   about mu. */
static void find_period(const history *h, const dynamics_excitation *excitation,
                        const dynamics_settling *how, dynamics_settled *settled)
{
    settled->distance = INFINITY;
    for (int p = 1; p <= DYNAMICS_LONGEST_PERIOD && h->count > 2 * (size_t)p; p++) {
        double change = change_over(h, p, 0), before = change_over(h, p, p);
        double damped = exp(-excitation->zeta * p * how->T);
        int tells = before > 0 && change > dynamics_state_round_off * size_of(h);
        double mu = fmin(fmax(tells ? change / before : 0, damped), 1 - 1e-6);
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
    /* a decaying oscillation may hide a shorter period: its change over one period is at most twice
       its size */
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

/* Sweeps the speed slowly from the speed of the orbit, while the motion is integrated on, whether
   periodic or not. A motion that grows without bound is restarted from rest. */
static ff_status glide(dynamics_coupled_run *run, const dynamics_coupled *pair, const ff_host *host,
                       double to, dynamics_coupled_orbit *orbit)
{
    double frequency = orbit->frequency, way = log(to / frequency);
    dynamics_coupled_start(run, 2 * M_PI / frequency, orbit->state);
    for (size_t i = 0; way < 0 ? frequency > to : frequency < to; i++) {
        if (i % 64 == 0 && host->progress(host->ctx, 0.5 * log(frequency / orbit->frequency) / way))
            return FF_STOPPED;
        if (!dynamics_coupled_cycle(run, 2 * M_PI / frequency, NULL))
            return FF_NOCONV;
        if (is_unbounded(dynamics_coupled_state(run), pair->excitation))
            start_at_rest(run, pair, 2 * M_PI / frequency);
        frequency *= 1 + (way < 0 ? -1 : 1) *
                             fmax(dynamics_sweep_rate(pair->excitation, frequency), slowest);
    }
    orbit->frequency = to;
    memcpy(orbit->state, dynamics_coupled_state(run), sizeof orbit->state);
    return FF_OK;
}

/* Returns the number of cycles after which the motion is closest to its earlier state. A larger
   number is preferred only if the motion is much closer then. */
static int likely_period(const history *h)
{
    int likely = 1;
    for (int p = 2; p <= DYNAMICS_LONGEST_PERIOD && h->count > (size_t)p; p++)
        if (change_over(h, p, 0) < 0.3 * change_over(h, likely, 0))
            likely = p;
    return likely;
}

/* Sets the period of an orbit to the smallest number of cycles after which the state repeats. */
static ff_status shorten(dynamics_coupled_run *run, double tolerance, dynamics_coupled_orbit *orbit)
{
    const double *y = dynamics_coupled_state(run);
    double T = 2 * M_PI / orbit->frequency;
    dynamics_coupled_start(run, T, orbit->state);
    for (int p = 1; p < orbit->period; p++) {
        double change = 0;
        if (!dynamics_coupled_cycle(run, T, NULL))
            return FF_NOCONV;
        for (int i = 0; i < DYNAMICS_TAKEN; i++)
            change = fmax(change, fabs(y[i] - orbit->state[i]));
        if (change < 4 * tolerance)
            orbit->period = p;
    }
    return FF_OK;
}

static void take_orbit(const dynamics_coupled_orbit *orbit, double tolerance,
                       dynamics_coupled_motion *motion)
{
    memcpy(motion->state, orbit->state, sizeof motion->state);
    motion->settled.period = orbit->period;
    motion->settled.within = orbit->distance <= tolerance;
    motion->settled.distance = orbit->distance;
    motion->settled.cycles = orbit->cycles;
}

/* Looks, with a separate integrator, for the periodic motion that this motion approaches. Returns
   FF_NOCONV if none is near enough. */
static ff_status leap_ahead(dynamics_coupled_run *leaper, const dynamics_settling *how, int period,
                            const double *state, dynamics_coupled_motion *motion)
{
    dynamics_coupled_orbit orbit = {
        .frequency = 2 * M_PI / how->T, .period = period, .cycles = motion->settled.cycles};
    memcpy(orbit.state, state, sizeof orbit.state);
    ff_status status = dynamics_coupled_shoot(leaper, settling, how->tolerance, how->host, &orbit);
    if (status == FF_OK)
        status = shorten(leaper, how->tolerance, &orbit);
    if (status == FF_OK)
        take_orbit(&orbit, how->tolerance, motion);
    return status;
}

/* Continues from the motion's state until the motion repeats. `leaper` (NULL: none) occasionally
   tries Newton's method from the current state. Returns FF_NOCONV if the motion repeats but
   Newton's method does not find it. */
static ff_status settle_here(dynamics_coupled_run *run, dynamics_coupled_run *leaper,
                             const dynamics_coupled *pair, const dynamics_settling *how,
                             dynamics_coupled_motion *motion)
{
    const double *y = dynamics_coupled_state(run);
    dynamics_settled *settled = &motion->settled;
    history h = {.count = 0};
    size_t leap = 2 * DYNAMICS_LONGEST_PERIOD;
    dynamics_coupled_start(run, how->T, motion->state);
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
        if (!leaper || (settled->cycles != leap && !settled->within))
            continue;
        int period = settled->within ? settled->period : likely_period(&h);
        ff_status status = leap_ahead(leaper, how, period, y, motion);
        if (status != FF_NOCONV || settled->within)
            return status;
        leap *= 2;
    }
    if (!settled->within && !(settled->distance < nearly_periodic))
        settled->period = DYNAMICS_APERIODIC;
    memcpy(motion->state, y, sizeof motion->state);
    return FF_OK;
}

/* Finds the motion without contact loss. Returns FF_NOCONV if there is no stable one. */
static ff_status shoot_in_contact(dynamics_coupled_run *run, const dynamics_coupled *pair,
                                  const dynamics_settling *how, dynamics_coupled_orbit *orbit)
{
    dynamics_coupled_rest(pair, orbit->state);
    ff_status status = dynamics_coupled_shoot(run, INFINITY, how->tolerance, how->host, orbit);
    return status == FF_OK && !orbit->touches ? FF_NOCONV : status;
}

/* Looks for a periodic motion near the state of the orbit. Leaves the state unchanged if there is
   none. */
static ff_status shoot_nearby(dynamics_coupled_run *run, const dynamics_settling *how,
                              dynamics_coupled_orbit *orbit)
{
    dynamics_coupled_orbit nearby = *orbit;
    ff_status status =
        dynamics_coupled_shoot(run, unsettled, dynamics_coupled_on_the_way, how->host, &nearby);
    orbit->cycles = nearby.cycles;
    if (status == FF_OK)
        *orbit = nearby;
    return status;
}

/* Follows a motion to the requested frequency. If its branch ends, or if the motion is not periodic
   (`before` is FF_NOCONV), the speed is swept until a periodic motion is near. Returns FF_NOCONV if
   none is near the state at the requested frequency. */
static ff_status follow_and_glide(dynamics_coupled_run *run, const dynamics_coupled *pair,
                                  const dynamics_settling *how, ff_status before,
                                  dynamics_coupled_orbit *orbit)
{
    static const double stretch = 0.03; /* length of one sweep, in the logarithm of the frequency */
    double to = 2 * M_PI / how->T;
    ff_status status = before;
    while (status == FF_OK || (status == FF_NOCONV && orbit->frequency != to)) {
        if (status == FF_OK)
            status = dynamics_coupled_follow(run, to, how->host, orbit);
        if (status != FF_NOCONV)
            return status;
        double left = log(to / orbit->frequency);
        double next = fabs(left) > stretch ? orbit->frequency * exp(copysign(stretch, left)) : to;
        status = glide(run, pair, how->host, next, orbit);
        if (status != FF_OK)
            return status;
        status = shoot_nearby(run, how, orbit);
    }
    return status;
}

/* Finds the motion at which a slow change of the speed begins. Returns FF_NOCONV if it is not
   periodic. */
static ff_status begin(dynamics_coupled_run *run, const dynamics_coupled *pair,
                       const dynamics_settling *how, dynamics_coupled_orbit *orbit)
{
    orbit->frequency = dynamics_sweep_from(how->branch, pair->excitation, 2 * M_PI / how->T);
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
    return shoot_nearby(run, how, orbit);
}

/* Follows the motion to the end of a slow change of the speed, or close to it. */
static ff_status approach(dynamics_coupled_run *run, const dynamics_coupled *pair,
                          const dynamics_settling *how, const dynamics_coupled_motion *motion,
                          dynamics_coupled_orbit *orbit)
{
    ff_status status = FF_OK;
    orbit->frequency = motion->from;
    if (motion->from > 0)
        memcpy(orbit->state, motion->state, sizeof orbit->state);
    else
        status = begin(run, pair, how, orbit);
    return follow_and_glide(run, pair, how, status, orbit);
}

/* Finds the motion to which a slow change of the speed leads. `coarse` is an integrator of low
   accuracy for the change of speed. */
static ff_status reach(dynamics_coupled_run *run, dynamics_coupled_run *coarse,
                       const dynamics_coupled *pair, const dynamics_settling *how,
                       dynamics_coupled_motion *motion)
{
    double frequency = 2 * M_PI / how->T;
    dynamics_coupled_orbit orbit = {.frequency = frequency, .period = 1};
    ff_status status = approach(coarse, pair, how, motion, &orbit);
    if (orbit.frequency != frequency || (status != FF_OK && status != FF_NOCONV))
        return status;
    memcpy(motion->state, orbit.state, sizeof motion->state);
    status = dynamics_coupled_shoot(run, unsettled, how->tolerance, how->host, &orbit);
    if (status == FF_OK)
        take_orbit(&orbit, how->tolerance, motion);
    if (status != FF_NOCONV)
        return status;
    status = settle_here(coarse, run, pair, how, motion);
    if (status != FF_NOCONV)
        return status;
    motion->settled = (dynamics_settled){.limit = motion->settled.limit};
    return settle_here(run, NULL, pair, how, motion);
}

ff_status dynamics_coupled_settle(dynamics_coupled_run *run, const dynamics_coupled *pair,
                                  const dynamics_settling *how, dynamics_coupled_motion *motion)
{
    static const double on_the_way =
        1e-5; /* error per step during the sweep; the final motion is solved more accurately */
    dynamics_coupled_orbit orbit = {.frequency = 2 * M_PI / how->T, .period = 1};
    ff_status status = FF_NOCONV;
    motion->settled.limit =
        how->cycles ? how->cycles : dynamics_settle_limit(pair->excitation, how->T, how->tolerance);
    if (how->branch == DYNAMICS_BRANCH_LOWER && !(motion->from > 0))
        status = shoot_in_contact(run, pair, how, &orbit);
    if (status == FF_OK)
        take_orbit(&orbit, how->tolerance, motion);
    if (status != FF_NOCONV)
        return status;
    dynamics_coupled_run *coarse =
        dynamics_coupled_run_new(pair, fmax(how->step_tolerance, on_the_way));
    status = coarse ? reach(run, coarse, pair, how, motion) : FF_NOMEM;
    dynamics_coupled_run_free(coarse);
    return status;
}

/* Computes the monodromy over the shown cycles. Overflow is clipped. */
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
    const double *monodromy = dynamics_coupled_monodromy(run);
    for (int i = 0; i < DYNAMICS_TAKEN * DYNAMICS_TAKEN; i++)
        motion->monodromy[i] = fmin(fmax(monodromy[i], -1e100), 1e100);
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
