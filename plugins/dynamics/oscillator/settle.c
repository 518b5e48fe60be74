/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "settle.h"

#include "full-contact.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

const double dynamics_longest_cycle = 1e6;

/* Branches with contact loss are found as in an experiment, by a slow sweep of the speed. A falling
   sweep starts above resonance, where contact is never lost, and follows the bent resonance curve.
   A rising sweep stays on the lower branch. The falling sweep starts at `top` times the natural
   frequency, the rising one at `bottom` times the mesh frequency. */
static const double top = 1.4, bottom = 0.7;
/* Numbers of mesh cycles. START_CYCLES: at the start of a sweep; DAMPED_LIMIT, UNDAMPED_LIMIT:
   largest numbers for settling with and without damping; HISTORY: stored. */
enum { START_CYCLES = 50, DAMPED_LIMIT = 20000, UNDAMPED_LIMIT = 1000, HISTORY = 32 };

/* A motion that has not settled is called periodic if its estimated distance to a periodic motion
   is below this value. */
static const double nearly_periodic = 1e-3;

static void start_at_rest(const dynamics_follower *follower, const dynamics_excitation *excitation,
                          double T)
{
    follower->start(follower->self, T, dynamics_rest_deflection(excitation), 0);
}

/* Keeps the relative change of the mesh frequency per cycle well below the damping, so that the
   motion can follow. Below a tenth of the natural frequency the resonances are of high order and
   weak; there the change per time is kept instead. */
/* Returns the number of mesh cycles in one cycle of the excitation; the sweep counts cycles of the
   excitation. */
static double span_of(const dynamics_excitation *excitation)
{
    return fmax(excitation->span, 1);
}

double dynamics_sweep_rate(const dynamics_excitation *excitation, double frequency)
{
    double rate = fmin(fmax(0.1 * excitation->zeta, 1e-4), 1e-3) * span_of(excitation);
    return fmin(rate * fmax(1, 0.1 / (frequency * span_of(excitation))), 0.1);
}

static ff_status stopped(const ff_host *host, double share)
{
    return host->progress(host->ctx, fmin(fmax(share, 0), 1)) ? FF_STOPPED : FF_OK;
}

static int is_unbounded(const dynamics_follower *follower, const dynamics_excitation *excitation)
{
    double x[2];
    follower->state(follower->self, x);
    return dynamics_is_unbounded(excitation, x[0], x[1]);
}

/* At its start the sweep waits for five times the time 1/zeta in which a disturbance decays by a
   factor e. */
size_t dynamics_sweep_start_cycles(const dynamics_excitation *excitation, double T)
{
    double decay = excitation->zeta * T;
    return decay > 5.0 / START_CYCLES ? (size_t)ceil(5 / decay) : START_CYCLES;
}

double dynamics_sweep_from(dynamics_branch branch, const dynamics_excitation *excitation,
                           double frequency)
{
    return branch == DYNAMICS_BRANCH_UPPER ? fmax(top / span_of(excitation), frequency)
                                           : bottom * frequency;
}

/* Sweeps from one frequency to another (both relative to the natural frequency), from the
 * follower's state and after `start` cycles. A motion that grows without bound restarts from rest.
 */
static ff_status sweep(const dynamics_follower *follower, const dynamics_excitation *excitation,
                       const ff_host *host, double from, double to, size_t start)
{
    double frequency = from, way = log(to / from);
    for (size_t i = 0; way < 0 ? frequency > to : frequency < to; i++) {
        if (!follower->cycle(follower->self, 2 * M_PI / frequency))
            return FF_NOCONV;
        if (is_unbounded(follower, excitation))
            start_at_rest(follower, excitation, 2 * M_PI / frequency);
        if (i >= start)
            frequency *= 1 + (way < 0 ? -1 : 1) * dynamics_sweep_rate(excitation, frequency);
        if (i % 256 == 0 && stopped(host, 0.5 * log(frequency / from) / way) != FF_OK)
            return FF_STOPPED;
    }
    return FF_OK;
}

/* Returns four times the number of cycles in which the slowest disturbance, exp(-zeta t), falls
 * below the tolerance. */
size_t dynamics_settle_limit(const dynamics_excitation *excitation, double T, double tolerance)
{
    double decay = excitation->zeta * T;
    if (decay <= 0)
        return UNDAMPED_LIMIT;
    return (size_t)fmin(ceil(-4 * log(tolerance) / decay) + 100, DAMPED_LIMIT);
}

const double dynamics_state_round_off = 4 * DBL_EPSILON;

typedef struct history {
    double delta[HISTORY], rate[HISTORY];
    size_t count;
} history;

static void remember(history *h, const double *x)
{
    h->delta[h->count % HISTORY] = x[0];
    h->rate[h->count % HISTORY] = x[1];
    h->count++;
}

/* Returns the change of the state over one period, `ago` cycles ago. */
static double change_over(const history *h, int period, int ago)
{
    size_t now = (h->count - 1 - (size_t)ago) % HISTORY;
    size_t then = (h->count - 1 - (size_t)ago - (size_t)period) % HISTORY;
    return fmax(fabs(h->delta[now] - h->delta[then]), fabs(h->rate[now] - h->rate[then]));
}

/* Estimates the distance to a periodic motion with the period p. A disturbance that shrinks by the
   factor mu in one period changes the state by 1 - mu times the distance. mu is exp(-zeta p T), its
   value in contact, or the ratio of the last two changes if this ratio is larger. A change of the
   size of round-off contains no information about mu. */
static double distance_to(const history *h, const dynamics_excitation *excitation, double T,
                          int period)
{
    size_t now = (h->count - 1) % HISTORY;
    double change = change_over(h, period, 0), before = change_over(h, period, period);
    double size = fmax(fabs(h->delta[now]), fabs(h->rate[now]));
    double mu = exp(-excitation->zeta * period * T);
    if (before > 0 && change > dynamics_state_round_off * size)
        mu = fmax(mu, change / before);
    if (excitation->zeta > 0)
        mu = fmin(mu, 1 - 1e-6);
    return change == 0 ? 0 : change / fmax(1 - mu, DBL_EPSILON);
}

/* Finds the shortest period within the tolerance, or else the period that fits best. A decaying
   disturbance may nearly repeat after some cycles, so a period is accepted only if the change over
   every shorter period is far larger. */
static void find_period(const history *h, const dynamics_excitation *excitation,
                        const dynamics_settling *how, dynamics_settled *result)
{
    double shorter = INFINITY;
    result->distance = INFINITY;
    for (int p = 1; p <= DYNAMICS_LONGEST_PERIOD && 2 * (size_t)p < h->count && !result->within;
         p++) {
        double distance = distance_to(h, excitation, how->T, p);
        if (p == 1 || shorter > 100 * fmax(distance, how->tolerance)) {
            result->within = distance <= how->tolerance;
            result->distance = distance;
            result->period = p;
        }
        shorter = fmin(shorter, change_over(h, p, 0));
    }
}

/* Returns how many cycles lead to the state of phase 0 with the largest delta, at which a periodic
   motion is to start however long it took to settle. */
static int cycles_to_first(const history *h, int period)
{
    int first = 0;
    for (int ago = 1; ago < period; ago++) {
        const size_t at = (h->count - 1 - (size_t)ago) % HISTORY,
                     best = (h->count - 1 - (size_t)first) % HISTORY;
        first = h->delta[at] > h->delta[best] ? ago : first;
    }
    return first > 0 ? period - first : 0;
}

static ff_status settle_here(const dynamics_follower *follower,
                             const dynamics_excitation *excitation, const dynamics_settling *how,
                             dynamics_settled *result)
{
    double x[2];
    history h = {.count = 0};
    follower->state(follower->self, x);
    remember(&h, x);
    while (result->cycles < result->limit && !result->within) {
        result->delta = x[0];
        result->rate = x[1];
        if (!follower->cycle(follower->self, how->T))
            return FF_NOCONV;
        result->cycles++;
        if (is_unbounded(follower, excitation)) {
            result->period = DYNAMICS_UNBOUNDED;
            return FF_OK;
        }
        follower->state(follower->self, x);
        remember(&h, x);
        find_period(&h, excitation, how, result);
        double share = (double)result->cycles / (double)result->limit;
        if (result->cycles % 256 == 0 && stopped(how->host, 0.5 + 0.4 * share) != FF_OK)
            return FF_STOPPED;
    }
    if (!result->within && !(result->distance < nearly_periodic))
        result->period = DYNAMICS_APERIODIC;
    for (int k = result->within ? cycles_to_first(&h, result->period) : 0; k > 0; k--)
        if (!follower->cycle(follower->self, how->T))
            return FF_NOCONV;
    follower->state(follower->self, x);
    result->delta = x[0];
    result->rate = x[1];
    return FF_OK;
}

ff_status dynamics_settle(const dynamics_follower *follower, const dynamics_excitation *excitation,
                          const dynamics_settling *how, dynamics_settled *result)
{
    *result = (dynamics_settled){
        .limit =
            how->cycles ? how->cycles : dynamics_settle_limit(excitation, how->T, how->tolerance),
    };
    ff_status status = stopped(how->host, 0);
    if (status != FF_OK)
        return status;
    double frequency = 2 * M_PI / how->T,
           from = dynamics_sweep_from(how->branch, excitation, frequency);
    double delta, rate;
    ff_status contact = FF_NOCONV;
    if (how->from <= 0 && how->branch == DYNAMICS_BRANCH_LOWER)
        contact = dynamics_full_contact(excitation, how->T, how->step_tolerance, &delta, &rate);
    if (contact == FF_NOMEM)
        return contact;
    if (how->from > 0) {
        follower->start(follower->self, 2 * M_PI / how->from, how->start[0], how->start[1]);
        status = sweep(follower, excitation, how->host, how->from, frequency, 0);
    } else if (contact == FF_OK) {
        follower->start(follower->self, how->T, delta, rate);
    } else {
        start_at_rest(follower, excitation, 2 * M_PI / from);
        status = sweep(follower, excitation, how->host, from, frequency,
                       dynamics_sweep_start_cycles(excitation, 2 * M_PI / from));
    }
    return status == FF_OK ? settle_here(follower, excitation, how, result) : status;
}

const double dynamics_chaotic_disturbance = 1e6;

void dynamics_chaos_line(double growth, const ff_host *host)
{
    char text[160];
    snprintf(text, sizeof text,
             "aperiodic: a small disturbance grows by a factor of %.3g per mesh cycle, so the "
             "motion never repeats",
             growth);
    host->quality(host->ctx, "stability", growth, 1, FF_DOUBTFUL, text);
}

void dynamics_periodicity_line(const dynamics_settled *settled, double tolerance,
                               const char *aperiodic, const ff_host *host)
{
    int32_t verdict = settled->within ? FF_GOOD : FF_DOUBTFUL;
    const char *text =
        settled->within ? NULL : "the motion is nearly periodic but has not settled yet";
    if (settled->period == DYNAMICS_APERIODIC)
        text = aperiodic;
    if (settled->period == DYNAMICS_UNBOUNDED) {
        verdict = FF_BAD;
        text = "the motion grows without bound; shown is the mesh cycle before it exceeded 1000 "
               "times the sum of half backlash and static deflection";
    }
    host->quality(host->ctx, "periodicity", fmin(settled->distance, 1e300), tolerance, verdict,
                  text);
}
