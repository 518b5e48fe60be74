/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "coupled-motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_eigen.h>

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

static ff_status sweep(dynamics_coupled_run *run, const dynamics_coupled *pair, const ff_host *host,
                       double from, double to)
{
    double frequency = from, way = log(to / from);
    size_t start = dynamics_sweep_start_cycles(pair->excitation, 2 * M_PI / from);
    start_at_rest(run, pair, 2 * M_PI / from);
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

ff_status dynamics_coupled_settle(dynamics_coupled_run *run, const dynamics_coupled *pair,
                                  const dynamics_settling *how, dynamics_coupled_motion *motion)
{
    double frequency = 2 * M_PI / how->T, from = dynamics_sweep_from(how->branch, frequency);
    motion->settled.limit =
        how->cycles ? how->cycles : dynamics_settle_limit(pair->excitation, how->T, how->tolerance);
    ff_status status = sweep(run, pair, how->host, from, frequency);
    if (from == frequency)
        start_at_rest(run, pair, how->T);
    return status == FF_OK ? settle_here(run, pair, how, motion) : status;
}

/* Multiplies the monodromy by that of one mesh cycle from `state`, found by central differences. */
static int extend_monodromy(dynamics_coupled_run *run, double T, const double *state,
                            double *monodromy)
{
    static const double d = 1e-5;
    double cycle[DYNAMICS_TAKEN][DYNAMICS_TAKEN], old[DYNAMICS_TAKEN * DYNAMICS_TAKEN],
        ends[2][DYNAMICS_TAKEN];
    memcpy(old, monodromy, sizeof old);
    for (int k = 0; k < DYNAMICS_TAKEN; k++) {
        for (int sign = 0; sign < 2; sign++) {
            double start[DYNAMICS_TAKEN];
            memcpy(start, state, sizeof start);
            start[k] += sign ? -d : d;
            dynamics_coupled_start(run, T, start);
            if (!dynamics_coupled_cycle(run, T, NULL))
                return 0;
            memcpy(ends[sign], dynamics_coupled_state(run), sizeof ends[sign]);
        }
        for (int i = 0; i < DYNAMICS_TAKEN; i++)
            cycle[i][k] = (ends[0][i] - ends[1][i]) / (2 * d);
    }
    for (int i = 0; i < DYNAMICS_TAKEN; i++)
        for (int k = 0; k < DYNAMICS_TAKEN; k++) {
            double sum = 0;
            for (int j = 0; j < DYNAMICS_TAKEN; j++)
                sum += cycle[i][j] * old[j * DYNAMICS_TAKEN + k];
            monodromy[i * DYNAMICS_TAKEN + k] = fmin(fmax(sum, -1e100), 1e100);
        }
    return 1;
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
    double fine = fmax(1e-3 * tolerance, 1e-14), kinetic;
    dynamics_coupled_run *run = dynamics_coupled_run_new(pair, tolerance),
                         *probe = dynamics_coupled_run_new(pair, fine);
    ff_status status = FF_NOMEM;
    if (!run || !probe || !dynamics_coupled_record_init(&motion->record, pair, per_cycle, count))
        goto out;
    for (int i = 0; i < DYNAMICS_TAKEN; i++)
        for (int k = 0; k < DYNAMICS_TAKEN; k++)
            motion->monodromy[i * DYNAMICS_TAKEN + k] = i == k;
    dynamics_coupled_start(run, motion->T, motion->state);
    double energy = dynamics_coupled_energy(run, &kinetic);
    status = FF_OK;
    for (size_t i = 0; i < count && status == FF_OK; i++) {
        double state[DYNAMICS_TAKEN];
        memcpy(state, dynamics_coupled_state(run), sizeof state);
        if (host->progress(host->ctx, 0.9 + 0.1 * (double)i / (double)count))
            status = FF_STOPPED;
        else if (!dynamics_coupled_cycle(run, motion->T, &motion->record) ||
                 (i < motion->cycles &&
                  !extend_monodromy(probe, motion->T, state, motion->monodromy)))
            status = FF_NOCONV;
        if (i + 1 == motion->cycles) {
            check_energy(motion, run, energy, pair->excitation->load);
            dynamics_coupled_clocks(run, &motion->parted, &motion->back);
        }
    }
out:
    dynamics_coupled_run_free(run);
    dynamics_coupled_run_free(probe);
    return status;
}

ff_status dynamics_coupled_multipliers(const dynamics_coupled_motion *motion, double *multipliers,
                                       double *largest)
{
    double matrix[DYNAMICS_TAKEN * DYNAMICS_TAKEN];
    memcpy(matrix, motion->monodromy, sizeof matrix);
    gsl_matrix_view view = gsl_matrix_view_array(matrix, DYNAMICS_TAKEN, DYNAMICS_TAKEN);
    gsl_eigen_nonsymm_workspace *work = gsl_eigen_nonsymm_alloc(DYNAMICS_TAKEN);
    gsl_vector_complex *values = gsl_vector_complex_alloc(DYNAMICS_TAKEN);
    ff_status status = work && values ? FF_OK : FF_NOMEM;
    *largest = 0;
    if (status == FF_OK && gsl_eigen_nonsymm(&view.matrix, values, work))
        status = FF_NOCONV;
    for (size_t i = 0; i < DYNAMICS_TAKEN && status == FF_OK; i++) {
        gsl_complex mu = gsl_vector_complex_get(values, i);
        multipliers[2 * i] = GSL_REAL(mu);
        multipliers[2 * i + 1] = GSL_IMAG(mu);
        *largest = fmax(*largest, hypot(GSL_REAL(mu), GSL_IMAG(mu)));
    }
    if (work)
        gsl_eigen_nonsymm_free(work);
    if (values)
        gsl_vector_complex_free(values);
    return status;
}
