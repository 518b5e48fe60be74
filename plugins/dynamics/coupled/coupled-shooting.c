/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "coupled-shooting.h"

#include <math.h>
#include <string.h>

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_linalg.h>

/* Newton's method fails if a correction exceeds this share of the previous one. */
static const double contraction = 0.25;
enum { MAX_CORRECTIONS = 12 };

/* Corrections below this value (in static deflections) that no longer shrink are integration
   errors. */
static const double round_off = 1e-5;

/* A disturbance certainly decays if the largest multiplier is at most this value. Multipliers are
   accurate to about 1e-7, and without damping all are 1. */
static const double surely_stable = 1 - 1e-6;

/* Step lengths in the logarithm of the frequency. The longest step is 3 zeta, the width of a
   resonance, at the usual damping. Where a step would have to be shorter than `shortest`, the speed
   is swept instead. A motion found during the continuation is rejected if it is farther than `near`
   (in static deflections) from the extrapolation of the last three motions. */
static const double longest = 0.03, shortest = 4e-3, near = 0.2;
const double dynamics_coupled_on_the_way = 1e-2;

ff_status dynamics_coupled_multipliers(const double *monodromy, double *multipliers,
                                       double *largest)
{
    double matrix[DYNAMICS_TAKEN * DYNAMICS_TAKEN];
    memcpy(matrix, monodromy, sizeof matrix);
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

/* Converts the residual of a start state after one cycle to its correction d: (1 - M) d = residual.
   Returns 0 if 1 - M is singular. */
static int find_correction(const double *monodromy, double *miss)
{
    double matrix[DYNAMICS_TAKEN * DYNAMICS_TAKEN];
    for (int i = 0; i < DYNAMICS_TAKEN; i++)
        for (int k = 0; k < DYNAMICS_TAKEN; k++) {
            double m = monodromy[i * DYNAMICS_TAKEN + k];
            if (!isfinite(m))
                return 0;
            matrix[i * DYNAMICS_TAKEN + k] = (i == k) - m;
        }
    gsl_matrix_view a = gsl_matrix_view_array(matrix, DYNAMICS_TAKEN, DYNAMICS_TAKEN);
    gsl_vector_view x = gsl_vector_view_array(miss, DYNAMICS_TAKEN);
    return gsl_linalg_HH_svx(&a.matrix, &x.vector) == GSL_SUCCESS;
}

/* Corrects the start state once. Returns FF_NOCONV if there is no correction. */
static ff_status correct(dynamics_coupled_run *run, dynamics_coupled_orbit *orbit)
{
    double T = 2 * M_PI / orbit->frequency, miss[DYNAMICS_TAKEN], parted, back;
    dynamics_coupled_start_varied(run, T, orbit->state);
    for (int i = 0; i < orbit->period; i++, orbit->cycles++)
        if (!dynamics_coupled_cycle(run, T, NULL))
            return FF_NOCONV;
    for (int i = 0; i < DYNAMICS_TAKEN; i++)
        miss[i] = dynamics_coupled_state(run)[i] - orbit->state[i];
    if (!find_correction(dynamics_coupled_monodromy(run), miss))
        return FF_NOCONV;
    orbit->distance = 0;
    for (int i = 0; i < DYNAMICS_TAKEN; i++) {
        if (!isfinite(miss[i]))
            return FF_NOCONV;
        orbit->state[i] += miss[i];
        orbit->distance = fmax(orbit->distance, fabs(miss[i]));
    }
    dynamics_coupled_clocks(run, &parted, &back);
    orbit->touches = parted == 0 && back == 0;
    return FF_OK;
}

ff_status dynamics_coupled_shoot(dynamics_coupled_run *run, double far, double tolerance,
                                 const ff_host *host, dynamics_coupled_orbit *orbit)
{
    double last = far / contraction, start[DYNAMICS_TAKEN], multipliers[2 * DYNAMICS_TAKEN];
    memcpy(start, orbit->state, sizeof start);
    orbit->largest = 0;
    for (int n = 0; n < MAX_CORRECTIONS; n++) {
        if (host->progress(host->ctx, 0))
            return FF_STOPPED;
        double before = orbit->distance;
        if (correct(run, orbit) != FF_OK)
            return FF_NOCONV;
        int ends = n > 0 && fmax(before, orbit->distance) < round_off &&
                   orbit->distance > contraction * before;
        if (!ends && !(orbit->distance <= contraction * last))
            return FF_NOCONV;
        last = orbit->distance;
        for (int i = 0; i < DYNAMICS_TAKEN; i++)
            if (fabs(orbit->state[i] - start[i]) > far)
                return FF_NOCONV;
        if (orbit->distance > tolerance && !ends)
            continue;
        ff_status status = dynamics_coupled_multipliers(dynamics_coupled_monodromy(run),
                                                        multipliers, &orbit->largest);
        return status == FF_OK && !(orbit->largest < surely_stable) ? FF_NOCONV : status;
    }
    return FF_NOCONV;
}

/* The last three motions of a branch, newest first. */
typedef struct trail {
    double at[3], state[3][DYNAMICS_TAKEN]; /* logarithms of the frequency, and states */
    int count;
} trail;

static void add_to_trail(trail *t, const dynamics_coupled_orbit *orbit)
{
    for (int i = 2; i > 0; i--) {
        t->at[i] = t->at[i - 1];
        memcpy(t->state[i], t->state[i - 1], sizeof t->state[i]);
    }
    t->at[0] = log(orbit->frequency);
    memcpy(t->state[0], orbit->state, sizeof t->state[0]);
    t->count += t->count < 3;
}

/* Extrapolates the last three motions by Lagrange's polynomial. */
static void predict(const trail *t, double at, double *state)
{
    memset(state, 0, sizeof t->state[0]);
    for (int i = 0; i < t->count; i++) {
        double weight = 1;
        for (int k = 0; k < t->count; k++)
            weight *= k == i ? 1 : (at - t->at[k]) / (t->at[i] - t->at[k]);
        for (int j = 0; j < DYNAMICS_TAKEN; j++)
            state[j] += weight * t->state[i][j];
    }
}

/* Begins a trail at a motion. A second point next to it follows from the derivative d of the start
   state with respect to the logarithm of the frequency: (1 - M) d is the derivative of the end
   state at a fixed start. Returns 0 if the derivative cannot be computed. */
static int begin_trail(dynamics_coupled_run *run, dynamics_coupled_orbit *orbit, trail *t)
{
    static const double aside = 1e-4; /* difference in the logarithm of the frequency */
    dynamics_coupled_orbit moved = *orbit;
    double at_end[DYNAMICS_TAKEN], T = 2 * M_PI / orbit->frequency;
    moved.cycles = 0;
    add_to_trail(t, orbit);
    if (correct(run, &moved) != FF_OK)
        return 0;
    for (int i = 0; i < DYNAMICS_TAKEN; i++)
        at_end[i] = -dynamics_coupled_state(run)[i];
    double monodromy[DYNAMICS_TAKEN * DYNAMICS_TAKEN];
    memcpy(monodromy, dynamics_coupled_monodromy(run), sizeof monodromy);
    orbit->cycles += moved.cycles + (size_t)orbit->period;
    dynamics_coupled_start(run, T * exp(-aside), orbit->state);
    for (int i = 0; i < orbit->period; i++)
        if (!dynamics_coupled_cycle(run, T * exp(-aside), NULL))
            return 0;
    for (int i = 0; i < DYNAMICS_TAKEN; i++)
        at_end[i] += dynamics_coupled_state(run)[i];
    if (!find_correction(monodromy, at_end))
        return 0;
    t->count = 2;
    t->at[1] = t->at[0] - aside;
    for (int i = 0; i < DYNAMICS_TAKEN; i++)
        t->state[1][i] = t->state[0][i] - at_end[i];
    return 1;
}

ff_status dynamics_coupled_follow(dynamics_coupled_run *run, double to, const ff_host *host,
                                  dynamics_coupled_orbit *orbit)
{
    double step = longest;
    trail behind = {.count = 0};
    if (orbit->frequency != to && !begin_trail(run, orbit, &behind))
        return FF_NOCONV;
    while (orbit->frequency != to) {
        double left = log(to / orbit->frequency);
        double way = fabs(left) <= step ? left : copysign(step, left);
        dynamics_coupled_orbit next = *orbit;
        next.frequency = way == left ? to : orbit->frequency * exp(way);
        predict(&behind, log(next.frequency), next.state);
        ff_status status =
            dynamics_coupled_shoot(run, near, dynamics_coupled_on_the_way, host, &next);
        orbit->cycles = next.cycles;
        if (status == FF_NOCONV && step > shortest) {
            step /= 2;
            continue;
        }
        if (status != FF_OK)
            return status;
        *orbit = next;
        add_to_trail(&behind, orbit);
        step = fmin(1.5 * step, longest);
    }
    return FF_OK;
}
