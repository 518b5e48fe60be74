/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "continuation.h"

#include "../oscillator/full-contact.h"
#include "../oscillator/oscillator.h"
#include "../oscillator/settle.h"
#include "branch-path.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Mesh over natural frequency below which the branch is not followed: it would take no end of steps
   past the many narrow resonances there, so that the motion is sought at the frequency itself. */
static const double direct = 0.1;

/* Points of a branch, jumps on the way, and jumps at the end of it after which the branch is given
 * up. */
enum { MAX_POINTS = 20000, MAX_JUMPS = 60, MAX_JUMPS_HERE = 8 };

/* Behind a fold the frequency changes by this share, so that every jump leads nearer to the end. */
static const double leap = 2e-4;

typedef dynamics_branch_path path;

static ff_status fail_because(dynamics_continuation_result *result, const char *why)
{
    result->why = why;
    return FF_NOCONV;
}

/* The state of the motion at phase 0, before the node that may lie there. */
static void state_of_series(const path *p, double w, double *delta, double *rate)
{
    const dynamics_excitation *excitation = p->request->excitation;
    const dynamics_piece *last = &excitation->pieces[excitation->count - 1];
    double s, slope;
    dynamics_fourier_at(p->z, p->request->harmonics, 0, &s, &slope);
    *delta = s - dynamics_piece_value(last->e, last->degree, last->length);
    *rate = w * (slope - dynamics_piece_slope(last->e, last->degree, last->length) / (2 * M_PI));
}

static void read_samples(const path *p, const dynamics_record *record)
{
    double n = (double)record->per_cycle;
    for (size_t i = 0; i < record->count; i++) {
        double at = record->samples[i].phase * n;
        size_t number = (size_t)round(at);
        if (fabs(at - round(at)) < 1e-6 && number < record->per_cycle)
            p->time[number] = record->samples[i].s;
    }
}

static size_t settling_cycles(const dynamics_excitation *excitation, double w)
{
    double decay = excitation->zeta * 2 * M_PI / w;
    return decay > 0 ? (size_t)fmin(fmax(ceil(15 / decay), 50), 2000) : 400;
}

/* Integrates from (delta, rate), which become the state at the end, and makes the last mesh cycle a
   guess of the series. FF_NOCONV: the motion grows without bound, or takes too many steps. */
static ff_status guess_in_time(path *p, double w, double *delta, double *rate)
{
    const dynamics_excitation *excitation = p->request->excitation;
    double T = 2 * M_PI / w, cap = dynamics_amplitude_cap(excitation);
    dynamics_record record = {0};
    dynamics_oscillator *o = dynamics_oscillator_new(excitation, 1e-7, 1, DYNAMICS_MOTION);
    int there = o && dynamics_record_init(&record, excitation, dynamics_harmonics_samples(p->b), 1);
    int good = there;
    if (there) {
        const double *y = dynamics_oscillator_state(o);
        dynamics_oscillator_start(o, T, *delta, *rate);
        for (size_t i = settling_cycles(excitation, w); i-- > 0 && good;)
            good = dynamics_oscillator_cycle(o, T, i ? NULL : &record) &&
                   fabs(y[DYNAMICS_DELTA]) < cap;
        *delta = y[DYNAMICS_DELTA];
        *rate = y[DYNAMICS_RATE];
    }
    if (good) {
        read_samples(p, &record);
        dynamics_harmonics_analyse(p->b, p->time, p->z);
    }
    dynamics_record_free(&record);
    dynamics_oscillator_free(o);
    return good ? FF_OK : there ? FF_NOCONV : FF_NOMEM;
}

/* Whether Newton's method finds a motion near the guess p->z, which it replaces. */
static int solve_near_guess(path *p, double w)
{
    size_t harmonics = p->request->harmonics;
    double step, size = dynamics_fourier_rms(p->z, harmonics) + 0.1 * p->request->excitation->load;
    memcpy(p->next, p->z, p->n * sizeof *p->z);
    if (dynamics_harmonics_solve(p->b, w, p->next, &step) != DYNAMICS_NEWTON_DONE)
        return 0;
    for (size_t i = 0; i < p->n; i++)
        p->rhs[i] = p->next[i] - p->z[i];
    if (!(dynamics_fourier_rms(p->rhs, harmonics) < 0.5 * size))
        return 0;
    memcpy(p->z, p->next, p->n * sizeof *p->z);
    return 1;
}

/* Finds, from a start state, a periodic motion at frequency w or a little further on the way. */
static ff_status settle_near(path *p, double w, double delta, double rate,
                             dynamics_continuation_result *result)
{
    const dynamics_continuation_request *request = p->request;
    double far = p->direction * log(request->w);
    for (int n = 0, here = 0; n < MAX_JUMPS && here < MAX_JUMPS_HERE; n++) {
        if (p->direction * log(w) >= far - 1e-12) {
            w = request->w;
            here++;
        }
        if (request->host->progress(request->host->ctx, 0.5))
            return FF_STOPPED;
        ff_status status = guess_in_time(p, w, &delta, &rate);
        if (status == FF_NOMEM)
            return status;
        if (status != FF_OK)
            break;
        p->z[p->n] = log(w);
        if (solve_near_guess(p, w))
            return FF_OK;
        w *= exp(p->direction * leap * (1 + n / 4));
    }
    return fail_because(result,
                        "the sweep leads to a motion that does not repeat itself after one mesh "
                        "cycle, or that grows without bound");
}

/* Solves for the motion without loss of contact, the only one at small excitation; 0: there is
 * none. */
static int start_in_contact(path *p, double w)
{
    const dynamics_excitation *excitation = p->request->excitation;
    double step, s, slope;
    memset(p->z, 0, p->n * sizeof *p->z);
    p->z[0] = excitation->half_gap + excitation->load + 1e-9;
    if ((excitation->load <= 0 && excitation->half_gap > 0) ||
        dynamics_harmonics_solve(p->b, w, p->z, &step) != DYNAMICS_NEWTON_DONE)
        return 0;
    for (size_t i = 0; i < 1024 && excitation->half_gap > 0; i++) {
        double phase = (double)i / 1024;
        const dynamics_piece *piece = dynamics_excitation_piece(excitation, phase, 0);
        dynamics_fourier_at(p->z, p->request->harmonics, 2 * M_PI * phase, &s, &slope);
        if (s - dynamics_piece_value(piece->e, piece->degree, phase - piece->start) <=
            excitation->half_gap)
            return 0;
    }
    p->z[p->n] = log(w);
    return 1;
}

static ff_status start_branch(path *p, double w, dynamics_continuation_result *result)
{
    if (start_in_contact(p, w))
        return FF_OK;
    return settle_near(p, w, dynamics_rest_deflection(p->request->excitation), 0, result);
}

/* Jumps to another branch at the fold that lies between the last point and the next. */
static ff_status jump_at_fold(path *p, dynamics_continuation_result *result)
{
    double fold = p->direction * fmax(p->direction * p->z[p->n], p->direction * p->next[p->n]);
    double w = exp(fold + p->direction * leap), delta, rate;
    state_of_series(p, w, &delta, &rate);
    result->folds++;
    return settle_near(p, w, delta, rate, result);
}

static ff_status follow_branch(path *p, double end, dynamics_continuation_result *result)
{
    const ff_host *host = p->request->host;
    double from = p->z[p->n];
    if (from != end && !dynamics_branch_path_begin(p))
        return fail_because(result,
                            "the branch has no direction: the equations are singular there");
    while (p->direction * (end - p->z[p->n]) > 1e-13) {
        if (++result->points > MAX_POINTS)
            return fail_because(result, "the branch has more than 20000 points on the way");
        if (host->progress(host->ctx, 0.5 * fmin(fmax((p->z[p->n] - from) / (end - from), 0), 1)))
            return FF_STOPPED;
        if (!dynamics_branch_path_step(p))
            return fail_because(result, "the branch cannot be followed: no step is short enough");
        if (dynamics_fourier_rms(p->next, p->request->harmonics) >
            dynamics_amplitude_cap(p->request->excitation))
            return fail_because(result, "the branch grows without bound");
        if (p->direction * (p->next[p->n] - end) >= 0) {
            if (dynamics_branch_path_end(p, end))
                return FF_OK;
            if (!dynamics_branch_path_shorten(p))
                return fail_because(result, "the branch turns back at this very mesh frequency");
            continue;
        }
        if (p->direction * p->row[p->n] > 0) {
            dynamics_branch_path_accept(p);
            continue;
        }
        ff_status status = jump_at_fold(p, result);
        if (status != FF_OK)
            return status;
        if (p->direction * (end - p->z[p->n]) > 1e-13 && !dynamics_branch_path_begin(p))
            return fail_because(result,
                                "the branch has no direction: the equations are singular there");
    }
    return FF_OK;
}

/* Sweeps to the frequency of the request, or to `direct` and from there settles at the frequency
 * itself. */
static ff_status sweep_to_speed(path *p, dynamics_continuation_result *result)
{
    const dynamics_continuation_request *request = p->request;
    double w = request->w, end = request->from_above ? fmax(w, direct) : w;
    double from = request->from_above
                      ? dynamics_sweep_from(DYNAMICS_BRANCH_UPPER, w)
                      : fmin(w, fmax(dynamics_sweep_from(DYNAMICS_BRANCH_LOWER, w), direct));
    ff_status status = start_branch(p, from, result);
    if (status == FF_OK)
        status = follow_branch(p, log(end), result);
    if (status == FF_OK && end != w && !start_in_contact(p, w)) {
        double delta, rate;
        state_of_series(p, w, &delta, &rate);
        status = settle_near(p, w, delta, rate, result);
    }
    return status;
}

/* Without load and error nothing moves, and the driving flanks rest where they touch; 0: something
 * moves. */
static int solve_at_rest(path *p)
{
    const dynamics_excitation *excitation = p->request->excitation;
    for (size_t i = 0; i < excitation->count; i++)
        for (int k = 0; k <= excitation->pieces[i].degree; k++)
            if (excitation->load != 0 || excitation->pieces[i].e[k] != 0)
                return 0;
    memset(p->z, 0, p->n * sizeof *p->z);
    p->z[0] = excitation->half_gap;
    return 1;
}

/* The lower branch is the motion without separation where there is a stable one; FF_NOCONV: there
   is none. */
static ff_status solve_in_full_contact(path *p)
{
    double delta, rate, w = p->request->w;
    if (p->request->from_above)
        return FF_NOCONV;
    ff_status status =
        dynamics_full_contact(p->request->excitation, 2 * M_PI / w, 1e-9, &delta, &rate);
    return status != FF_OK ? status : start_in_contact(p, w) ? FF_OK : FF_NOCONV;
}

ff_status dynamics_continuation_follow(const dynamics_continuation_request *request,
                                       dynamics_continuation_result *result)
{
    path p;
    ff_status status = FF_NOMEM;
    *result = (dynamics_continuation_result){0};
    if (!dynamics_branch_path_init(&p, request))
        goto out;
    p.direction = request->from_above ? -1 : 1;
    if (solve_at_rest(&p))
        status = FF_OK;
    else if (request->excitation->half_gap == 0) /* a linear system has one motion */
        status =
            start_in_contact(&p, request->w)
                ? FF_OK
                : fail_because(result, "a linear system without damping has none at resonance");
    else if ((status = solve_in_full_contact(&p)) == FF_NOCONV)
        status = sweep_to_speed(&p, result);
    if (status == FF_NOCONV && !request->from_above && start_in_contact(&p, request->w)) {
        result->lost = 1;
        status = FF_OK;
    }
    if (status == FF_OK) {
        result->x = p.z;
        p.z = NULL;
    }
out:
    dynamics_branch_path_free(&p);
    return status;
}

ff_status dynamics_continuation_from(const dynamics_continuation_request *request,
                                     const dynamics_continuation_start *from,
                                     dynamics_continuation_result *result)
{
    path p;
    ff_status status = FF_NOMEM;
    double delta, rate;
    *result = (dynamics_continuation_result){0};
    if (!dynamics_branch_path_init(&p, request))
        goto out;
    if (request->excitation->half_gap == 0 || solve_at_rest(&p)) { /* there is but one motion */
        dynamics_branch_path_free(&p);
        return dynamics_continuation_follow(request, result);
    }
    p.direction = request->w < from->w ? -1 : 1;
    dynamics_fourier_resize(from->x, from->harmonics, p.z, request->harmonics);
    p.z[p.n] = log(from->w);
    status = solve_near_guess(&p, from->w) ? follow_branch(&p, log(request->w), result) : FF_NOCONV;
    if (status == FF_NOCONV) { /* from where the branch was lost */
        state_of_series(&p, exp(p.z[p.n]), &delta, &rate);
        status = settle_near(&p, request->w, delta, rate, result);
    }
    if (status == FF_OK) {
        result->x = p.z;
        p.z = NULL;
    }
out:
    dynamics_branch_path_free(&p);
    return status;
}
