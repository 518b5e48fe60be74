/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "continuation.h"

#include "full-contact.h"
#include "oscillator.h"
#include "settle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lapacke.h>

/* Mesh over natural frequency below which the branch is not followed: it would take no end of steps
   past the many narrow resonances there, so that the motion is sought at the frequency itself. */
static const double direct = 0.1;

/* Arc length, in ln w and in the motion over its size. */
static const double first_step = 0.01, longest_step = 0.05, shortest_step = 1e-8;

/* Cosine between the tangents of neighbours; steps below short_step may turn as they like: where
   the flanks first part, the samples that lose contact turn the branch by jerks. */
static const double straight = 0.97, short_step = 1e-4;

enum { MAX_POINTS = 20000, MAX_CORRECTIONS = 9, MAX_JUMPS = 60, MAX_JUMPS_HERE = 8 };

/* Behind a fold the frequency goes on by this share, so that every jump gets nearer. */
static const double leap = 2e-4;

struct dynamics_continuation {
    const dynamics_continuation_request *request;
    dynamics_harmonics *b;
    size_t n;              /* unknowns of the series; ln w is number n */
    double *z, *next;      /* points of the branch */
    double *tangent, *row; /* along the branch; its scaled copy */
    double *rhs, *matrix;
    lapack_int *pivot;
    double *time; /* samples of a motion */
    double direction, ds, scale, done;
};

typedef struct dynamics_continuation path;

static int path_init(path *p, const dynamics_continuation_request *request)
{
    /* with little damping the branch shows every sample that gains or loses contact */
    size_t samples = request->excitation->zeta < 1e-3 ? 16384 : 2048;
    while (samples < 16 * request->harmonics)
        samples *= 2;
    *p = (path){.request = request, .n = 2 * request->harmonics + 1};
    size_t size = p->n + 1;
    p->b = dynamics_harmonics_new(request->excitation, request->harmonics, samples);
    p->z = calloc(size, sizeof(double));
    p->next = calloc(size, sizeof(double));
    p->tangent = calloc(size, sizeof(double));
    p->row = calloc(size, sizeof(double));
    p->rhs = calloc(size, sizeof(double));
    p->matrix = calloc(size * size, sizeof(double));
    p->pivot = calloc(size, sizeof *p->pivot);
    p->time = calloc(samples, sizeof(double));
    return p->b && p->z && p->next && p->tangent && p->row && p->rhs && p->matrix && p->pivot &&
           p->time;
}

static void path_free(path *p)
{
    dynamics_harmonics_free(p->b);
    free(p->z);
    free(p->next);
    free(p->tangent);
    free(p->row);
    free(p->rhs);
    free(p->matrix);
    free(p->pivot);
    free(p->time);
}

static ff_status fail_because(dynamics_continuation_result *result, const char *why)
{
    result->why = why;
    return FF_NOCONV;
}

static double dot(const path *p, const double *u, const double *v)
{
    double sum = 0;
    for (size_t i = 0; i < p->n; i++)
        sum += u[i] * v[i];
    return sum / (p->scale * p->scale) + u[p->n] * v[p->n];
}

/* Solves the equations of motion at p->next bordered by the direction `tangent`; p->rhs has the
   right side and gets the solution. */
static int solve_bordered(path *p, int with_residual)
{
    size_t size = p->n + 1;
    double w = exp(p->next[p->n]), *last = p->matrix + p->n * size, keep = p->rhs[p->n];
    dynamics_harmonics_residual(p->b, w, p->next, p->rhs, last, p->matrix, size);
    if (!with_residual)
        memset(p->rhs, 0, p->n * sizeof *p->rhs);
    p->rhs[p->n] = keep;
    for (size_t i = 0; i < p->n; i++)
        p->matrix[i * size + p->n] = p->tangent[i] / (p->scale * p->scale);
    last[p->n] = p->tangent[p->n];
    lapack_int order = (lapack_int)size;
    if (LAPACKE_dgesv(LAPACK_COL_MAJOR, order, 1, p->matrix, order, p->pivot, p->rhs, order))
        return 0;
    return isfinite(dot(p, p->rhs, p->rhs));
}

/* The tangent at p->next, on from the old one; the cosine between the two, 0: none. */
static double find_tangent(path *p)
{
    memset(p->rhs, 0, p->n * sizeof *p->rhs);
    p->rhs[p->n] = 1;
    if (!solve_bordered(p, 0))
        return 0;
    double length = sqrt(dot(p, p->rhs, p->rhs)), old = dot(p, p->tangent, p->tangent);
    if (!(length > 0))
        return 0;
    for (size_t i = 0; i <= p->n; i++)
        p->row[i] = p->rhs[i] / length;
    return dot(p, p->row, p->tangent) / sqrt(old);
}

/* Newton on the plane at distance ds along the tangent; the number of corrections, 0: failed. */
static int correct_point(path *p)
{
    for (size_t i = 0; i <= p->n; i++)
        p->next[i] = p->z[i] + p->ds * p->tangent[i];
    double first = 0;
    for (int n = 1; n <= MAX_CORRECTIONS; n++) {
        p->rhs[p->n] = 0;
        if (!solve_bordered(p, 1))
            return 0;
        double change = sqrt(dot(p, p->rhs, p->rhs));
        if (n == 1)
            first = change;
        if (!(change <= 2 * first) || change > 4 * p->ds)
            return 0;
        for (size_t i = 0; i <= p->n; i++)
            p->next[i] -= p->rhs[i];
        if (change < 1e-9)
            return n;
    }
    return 0;
}

/* Begins to follow the branch from p->z. */
static int begin_branch(path *p)
{
    p->scale = 1 + dynamics_fourier_rms(p->z, p->request->harmonics);
    memset(p->tangent, 0, p->n * sizeof *p->tangent);
    p->tangent[p->n] = p->direction;
    memcpy(p->next, p->z, (p->n + 1) * sizeof *p->z);
    p->ds = first_step;
    if (find_tangent(p) == 0)
        return 0;
    memcpy(p->tangent, p->row, (p->n + 1) * sizeof *p->row);
    return 1;
}

/* One point further to p->next, with its tangent in p->row. */
static int step_along_branch(path *p)
{
    for (; p->ds > shortest_step; p->ds *= 0.5) {
        p->done = p->ds;
        int corrections = correct_point(p);
        double along = corrections ? find_tangent(p) : 0;
        if (along == 0 || (along < straight && p->ds > short_step))
            continue;
        double faster = corrections <= 4 ? 1.5 : corrections >= 7 ? 0.6 : 1;
        p->ds = fmin(p->ds * faster, longest_step);
        return 1;
    }
    return 0;
}

static void accept_point(path *p)
{
    memcpy(p->z, p->next, (p->n + 1) * sizeof *p->z);
    p->scale = 1 + dynamics_fourier_rms(p->z, p->request->harmonics);
    double length = sqrt(dot(p, p->row, p->row));
    for (size_t i = 0; i <= p->n; i++)
        p->tangent[i] = p->row[i] / length;
}

/* State of the series at phase 0, before the node that may lie there. */
static void state_of_series(const path *p, double w, double *delta, double *rate)
{
    const dynamics_excitation *excitation = p->request->excitation;
    const dynamics_piece *last = &excitation->pieces[excitation->count - 1];
    double s, slope;
    dynamics_fourier_at(p->z, p->request->harmonics, 0, &s, &slope);
    *delta = s - last->e - last->e_rate * last->length;
    *rate = w * (slope - last->e_rate / (2 * M_PI));
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

/* Integrates from (delta, rate), which become the state at the end, and takes the last mesh cycle
   as a guess of the series. */
static int guess_in_time(path *p, double w, double *delta, double *rate)
{
    const dynamics_excitation *excitation = p->request->excitation;
    double T = 2 * M_PI / w, cap = dynamics_amplitude_cap(excitation);
    dynamics_record record = {0};
    dynamics_oscillator *o = dynamics_oscillator_new(excitation, 1e-7, 1, DYNAMICS_MOTION);
    int good = o && dynamics_record_init(&record, excitation, dynamics_harmonics_samples(p->b), 1);
    if (good) {
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
    return good;
}

/* True when Newton's method ends near its guess. */
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

/* From a start state to a periodic motion near frequency w, or further on the way. */
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
        if (!guess_in_time(p, w, &delta, &rate))
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

/* The motion without loss of contact, which is the only one at small excitation. */
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
        if (s - piece->e - piece->e_rate * (phase - piece->start) <= excitation->half_gap)
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

/* The motion at the end of the way, between the last point and the next; 0: another branch. */
static int solve_at_end(path *p, double end)
{
    double share = (end - p->z[p->n]) / (p->next[p->n] - p->z[p->n]), step;
    double way = 0, off = 0;
    for (size_t i = 0; i < p->n; i++) {
        p->rhs[i] = p->z[i] + share * (p->next[i] - p->z[i]);
        way += (p->next[i] - p->z[i]) * (p->next[i] - p->z[i]);
        p->row[i] = p->rhs[i];
    }
    if (dynamics_harmonics_solve(p->b, exp(end), p->rhs, &step) != DYNAMICS_NEWTON_DONE)
        return 0;
    for (size_t i = 0; i < p->n; i++)
        off += (p->rhs[i] - p->row[i]) * (p->rhs[i] - p->row[i]);
    if (sqrt(off) > sqrt(way) + 1e-6 * p->scale)
        return 0;
    memcpy(p->z, p->rhs, p->n * sizeof *p->z);
    p->z[p->n] = end;
    return 1;
}

/* Jumps from the fold that lies between the last point and the next. */
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
    if (from != end && !begin_branch(p))
        return fail_because(result,
                            "the branch has no direction: the equations are singular there");
    while (p->direction * (end - p->z[p->n]) > 1e-13) {
        if (++result->points > MAX_POINTS)
            return fail_because(result, "the branch has more than 20000 points on the way");
        if (host->progress(host->ctx, 0.5 * fmin(fmax((p->z[p->n] - from) / (end - from), 0), 1)))
            return FF_STOPPED;
        if (!step_along_branch(p))
            return fail_because(result, "the branch cannot be followed: no step is short enough");
        if (dynamics_fourier_rms(p->next, p->request->harmonics) >
            dynamics_amplitude_cap(p->request->excitation))
            return fail_because(result, "the branch grows without bound");
        if (p->direction * (p->next[p->n] - end) >= 0) {
            if (solve_at_end(p, end))
                return FF_OK;
            p->ds *= 0.25;
            if (p->ds < shortest_step)
                return fail_because(result, "the branch turns back at this very mesh frequency");
            continue;
        }
        if (p->direction * p->row[p->n] > 0) {
            accept_point(p);
            continue;
        }
        ff_status status = jump_at_fold(p, result);
        if (status != FF_OK)
            return status;
        if (p->direction * (end - p->z[p->n]) > 1e-13 && !begin_branch(p))
            return fail_because(result,
                                "the branch has no direction: the equations are singular there");
    }
    return FF_OK;
}

/* From the start of the sweep to its end. */
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

/* Without load and error nothing moves: the driving flanks rest where they touch. */
static int solve_at_rest(path *p)
{
    const dynamics_excitation *excitation = p->request->excitation;
    for (size_t i = 0; i < excitation->count; i++)
        if (excitation->load != 0 || excitation->pieces[i].e != 0 ||
            excitation->pieces[i].e_rate != 0)
            return 0;
    memset(p->z, 0, p->n * sizeof *p->z);
    p->z[0] = excitation->half_gap;
    return 1;
}

/* The lower branch is the motion without separation where there is a stable one. */
static int solve_in_full_contact(path *p)
{
    double delta, rate, w = p->request->w;
    return !p->request->from_above &&
           dynamics_full_contact(p->request->excitation, 2 * M_PI / w, 1e-9, &delta, &rate) &&
           start_in_contact(p, w);
}

ff_status dynamics_continuation_follow(const dynamics_continuation_request *request,
                                       dynamics_continuation_result *result)
{
    path p;
    ff_status status = FF_NOMEM;
    *result = (dynamics_continuation_result){0};
    if (!path_init(&p, request))
        goto out;
    p.direction = request->from_above ? -1 : 1;
    if (solve_at_rest(&p))
        status = FF_OK;
    else if (request->excitation->half_gap == 0) /* a linear system has one motion */
        status =
            start_in_contact(&p, request->w)
                ? FF_OK
                : fail_because(result, "a linear system without damping has none at resonance");
    else if (solve_in_full_contact(&p))
        status = FF_OK;
    else
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
    path_free(&p);
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
    if (!path_init(&p, request))
        goto out;
    if (request->excitation->half_gap == 0 || solve_at_rest(&p)) { /* there is but one motion */
        path_free(&p);
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
    path_free(&p);
    return status;
}

dynamics_continuation *dynamics_continuation_new(const dynamics_continuation_request *request)
{
    path *p = calloc(1, sizeof *p);
    if (p && !path_init(p, request)) {
        dynamics_continuation_free(p);
        return NULL;
    }
    if (p)
        p->direction = request->from_above ? -1 : 1;
    return p;
}

void dynamics_continuation_free(path *p)
{
    if (!p)
        return;
    path_free(p);
    free(p);
}

ff_status dynamics_continuation_begin(path *p, double w, dynamics_continuation_result *result)
{
    ff_status status = start_branch(p, w, result);
    if (status == FF_OK && !begin_branch(p))
        return fail_because(result,
                            "the branch has no direction: the equations are singular there");
    return status;
}

int dynamics_continuation_begin_in_contact(path *p, double w)
{
    return start_in_contact(p, w) && begin_branch(p);
}

dynamics_continuation_point dynamics_continuation_here(const path *p)
{
    return (dynamics_continuation_point){
        .x = p->z, .ln_w = p->z[p->n], .slope = p->tangent[p->n], .length = p->done};
}

int dynamics_continuation_step(path *p)
{
    if (!step_along_branch(p))
        return 0;
    accept_point(p);
    return 1;
}

int dynamics_continuation_solve(path *p, double ln_w, double *x)
{
    double step;
    return dynamics_harmonics_solve(p->b, exp(ln_w), x, &step) == DYNAMICS_NEWTON_DONE;
}
