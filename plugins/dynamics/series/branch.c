/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "branch.h"

#include "../continuation/curve.h"
#include "../orbits/attractor.h"
#include "../oscillator/full-contact.h"
#include "../oscillator/oscillator.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Largest number of guesses from a motion that is not periodic, one guess per mesh cycle. */
enum { GUESSES = 32 };

/* The search for one series. */
typedef struct search {
    const dynamics_branch_request *request;
    dynamics_excitation excitation; /* excitation of the request, with the current damping ratio */
    dynamics_harmonics *b;
    size_t n;      /* number of coefficients of the series */
    double *x;     /* the series */
    double *guess; /* guess of the series */
    double *off;   /* distance of the series from the guess */
    double *time;  /* samples of a motion over a mesh cycle */
} search;

static int search_init(search *s, const dynamics_branch_request *request)
{
    /* with little damping the spacing of the samples at which contact begins or ends affects the
       motion */
    size_t samples = request->excitation->zeta < 1e-3 ? 16384 : 2048;
    while (samples < 16 * request->harmonics)
        samples *= 2;
    *s = (search){
        .request = request, .excitation = *request->excitation, .n = 2 * request->harmonics + 1};
    s->b = dynamics_harmonics_new(&s->excitation, request->harmonics, samples);
    s->x = calloc(s->n, sizeof *s->x);
    s->guess = calloc(s->n, sizeof *s->guess);
    s->off = calloc(s->n, sizeof *s->off);
    s->time = calloc(samples, sizeof *s->time);
    return s->b && s->x && s->guess && s->off && s->time;
}

static void search_free(search *s)
{
    dynamics_harmonics_free(s->b);
    free(s->x);
    free(s->guess);
    free(s->off);
    free(s->time);
}

/* Computes the state of a series at phase 0, before a node there. */
static void state_of_series(const search *s, const dynamics_branch_start *from, double state[2])
{
    const dynamics_excitation *excitation = s->request->excitation;
    const dynamics_piece *last = &excitation->pieces[excitation->count - 1];
    double value, slope;
    dynamics_fourier_at(from->x, from->harmonics, 0, &value, &slope);
    state[0] = value - dynamics_piece_value(last->e, last->degree, last->length);
    state[1] =
        from->w * (slope - dynamics_piece_slope(last->e, last->degree, last->length) / (2 * M_PI));
}

/* Solves for the motion without contact loss, which is the only motion at small excitation. Returns
   0 if there is none. */
static int solve_in_contact(search *s)
{
    const dynamics_excitation *excitation = s->request->excitation;
    double step, value, slope;
    memset(s->x, 0, s->n * sizeof *s->x);
    s->x[0] = excitation->half_gap + excitation->load + 1e-9;
    if ((excitation->load <= 0 && excitation->half_gap > 0) ||
        dynamics_harmonics_solve(s->b, s->request->w, s->x, &step) != DYNAMICS_NEWTON_DONE)
        return 0;
    for (size_t i = 0; i < 1024 && excitation->half_gap > 0; i++) {
        double phase = (double)i / 1024;
        const dynamics_piece *piece = dynamics_excitation_piece(excitation, phase, 0);
        dynamics_fourier_at(s->x, s->request->harmonics, 2 * M_PI * phase, &value, &slope);
        if (value - dynamics_piece_value(piece->e, piece->degree, phase - piece->start) <=
            excitation->half_gap)
            return 0;
    }
    return 1;
}

/* Sets the state of rest on the driving flanks, if there is neither load nor transmission error.
   Returns 0 if there is an excitation. */
static int solve_at_rest(search *s)
{
    const dynamics_excitation *excitation = s->request->excitation;
    for (size_t i = 0; i < excitation->count; i++)
        for (int k = 0; k <= excitation->pieces[i].degree; k++)
            if (excitation->load != 0 || excitation->pieces[i].e[k] != 0)
                return 0;
    memset(s->x, 0, s->n * sizeof *s->x);
    s->x[0] = excitation->half_gap;
    return 1;
}

/* Solves for the stable motion without contact loss. If it exists, it is the lower branch. Returns
   FF_NOCONV if there is none. */
static ff_status solve_in_full_contact(search *s)
{
    double delta, rate, T = 2 * M_PI / s->request->w;
    if (s->request->branch == DYNAMICS_BRANCH_UPPER)
        return FF_NOCONV;
    ff_status status = dynamics_full_contact(s->request->excitation, T, 1e-9, &delta, &rate);
    return status != FF_OK ? status : solve_in_contact(s) ? FF_OK : FF_NOCONV;
}

/* Adds the samples of one recorded mesh cycle, times `part`, to s->time. */
static void read_samples(const search *s, const dynamics_record *record, double part)
{
    double n = (double)record->per_cycle;
    for (size_t i = 0, next = 0; i < record->count && next < record->per_cycle; i++) {
        double at = record->samples[i].phase * n;
        if (fabs(at - (double)next) >= 1e-6)
            continue;
        s->time[next] += part * record->samples[i].s;
        next++;
    }
}

/* Integrates over `cycles` mesh cycles from `state`, sets `state` to the end, and takes the mean of
   the cycles as the guess. Returns FF_NOCONV if there are too many steps. */
static ff_status guess_in_time(search *s, int cycles, double state[2])
{
    const dynamics_excitation *excitation = &s->excitation;
    double T = 2 * M_PI / s->request->w;
    size_t samples = dynamics_harmonics_samples(s->b);
    dynamics_oscillator *o = dynamics_oscillator_new(excitation, 1e-7, 1, DYNAMICS_MOTION);
    int good = 1;
    if (!o)
        return FF_NOMEM;
    memset(s->time, 0, samples * sizeof *s->time);
    dynamics_oscillator_start(o, T, state[0], state[1]);
    for (int i = 0; i < cycles && good; i++) {
        dynamics_record record = {0};
        if (!dynamics_record_init(&record, excitation, samples, 1)) {
            dynamics_oscillator_free(o);
            return FF_NOMEM;
        }
        good = dynamics_oscillator_cycle(o, T, &record);
        read_samples(s, &record, 1.0 / cycles);
        dynamics_record_free(&record);
    }
    const double *y = dynamics_oscillator_state(o);
    state[0] = y[DYNAMICS_DELTA];
    state[1] = y[DYNAMICS_RATE];
    if (good)
        dynamics_harmonics_analyse(s->b, s->time, s->guess);
    dynamics_oscillator_free(o);
    return good ? FF_OK : FF_NOCONV;
}

/* Returns whether Newton's method finds a motion near the guess. */
static int solve_near_guess(search *s)
{
    size_t harmonics = s->request->harmonics;
    double step;
    double size = dynamics_fourier_rms(s->guess, harmonics) + 0.1 * s->request->excitation->load;
    memcpy(s->x, s->guess, s->n * sizeof *s->x);
    if (dynamics_harmonics_solve(s->b, s->request->w, s->x, &step) != DYNAMICS_NEWTON_DONE)
        return 0;
    for (size_t i = 0; i < s->n; i++)
        s->off[i] = s->x[i] - s->guess[i];
    return dynamics_fourier_rms(s->off, harmonics) < 0.5 * size;
}

/* No branch is followed below this ratio of mesh frequency to natural frequency, since the
   resonances there are narrow and too numerous. */
static const double slowest = 0.1;

/* Follows the curve of motions of period 1, around its folds, from the start of the sweep to the
   requested speed. Used with hardly any damping, since motions do not settle then. Returns
   FF_NOCONV if the curve does not reach the speed, or if the speed is below `slowest`. */
static ff_status trace_to_speed(const search *s, const dynamics_flow *flow, dynamics_attractor *a)
{
    const dynamics_branch_request *request = s->request;
    double start = log(dynamics_sweep_from(request->branch, request->excitation, request->w)),
           end = log(request->w);
    dynamics_continuation_range range = {.flow = flow,
                                         .low = fmin(start, end),
                                         .high = fmax(start, end),
                                         .step = 0.1,
                                         .host = request->host};
    dynamics_curve curve = {.count = 0};
    dynamics_orbit o = {
        .period = 1, .lambda = start, .x = {dynamics_rest_deflection(request->excitation), 0}};
    if (request->w < slowest || !(fabs(start - end) > 0) ||
        !dynamics_orbit_solve(flow, dynamics_orbit_accuracy, &o))
        return FF_NOCONV;
    ff_status status = dynamics_curve_trace(&range, &o, &curve);
    const dynamics_point *last = curve.points + curve.count - 1;
    if (status == FF_OK &&
        (curve.last != DYNAMICS_END_RANGE || fabs(last->lambda - end) > 1e-6 * fabs(end - start)))
        status = FF_NOCONV;
    if (status == FF_OK) {
        a->period = 1;
        memcpy(a->x, last->x, sizeof a->x);
    }
    dynamics_curve_free(&curve);
    return status;
}

/* Damping ratio below which motions take too long to settle. */
static const double hardly_damped = 2e-3;

/* Continues the series from the current damping to that of the request by Newton's method, as far
   as possible. If this fails, a new solution with another number of samples may reach the requested
   damping. */
static void lower_damping(search *s)
{
    static const double shortest = 1e-3;
    double high = s->excitation.zeta, low = s->request->excitation->zeta, share = 1, step = 0.5;
    while (high > low && share > 0 && step > shortest) {
        double to = fmax(share - step, 0);
        memcpy(s->guess, s->x, s->n * sizeof *s->x);
        s->excitation.zeta = low + to * (high - low);
        if (solve_near_guess(s)) {
            share = to;
        } else {
            memcpy(s->x, s->guess, s->n * sizeof *s->x);
            step *= 0.5;
        }
    }
}

/* Lets the motion settle at a slow speed: from rest, or for the upper branch from the motion at
   `slowest`. */
static ff_status settle_at_speed(const search *s, const dynamics_flow *flow,
                                 const dynamics_search *how, dynamics_attractor *a)
{
    const dynamics_branch_request *request = s->request;
    dynamics_search slow = *how;
    ff_status status = FF_OK;
    slow.lambda = log(slowest);
    if (request->branch == DYNAMICS_BRANCH_UPPER)
        status = dynamics_attract_branch(flow, request->branch, &slow, request->host, a);
    if (request->branch != DYNAMICS_BRANCH_UPPER || a->period == DYNAMICS_UNBOUNDED) {
        a->x[0] = dynamics_rest_deflection(flow->excitation);
        a->x[1] = 0;
    }
    if (status != FF_OK)
        return status;
    return dynamics_attract(flow, how, a) ? FF_OK : FF_NOCONV;
}

/* Finds the motion at the speed by settling or by a change of speed. */
static ff_status lead_to_speed(const search *s, const dynamics_flow *flow, dynamics_attractor *a)
{
    const dynamics_branch_request *request = s->request;
    double T = 2 * M_PI / request->w;
    const dynamics_search how = {.lambda = log(request->w),
                                 .max_period = DYNAMICS_PERIOD_MAX,
                                 .cycles = dynamics_settle_limit(&s->excitation, T, 1e-6)};
    dynamics_orbit from = {.period = 1};
    if (!request->from.x && request->w < slowest)
        return settle_at_speed(s, flow, &how, a);
    if (!request->from.x)
        return dynamics_attract_branch(flow, request->branch, &how, request->host, a);
    from.lambda = log(request->from.w);
    state_of_series(s, &request->from, from.x);
    return dynamics_attract_from(flow, &from, &how, request->host, a);
}

/* Converts a motion to a series. For a motion of several mesh cycles the guess is the mean of the
   cycles, which is near the motion of period 1 from which it branched off. */
static ff_status solve_from_motion(search *s, dynamics_attractor *a)
{
    int cycles = a->period > 0 ? a->period : 1, guesses = a->period == 1 ? 1 : GUESSES;
    const ff_host *host = s->request->host;
    for (int i = 0; i < guesses; i++) {
        if (host->progress(host->ctx, 0.5))
            return FF_STOPPED;
        ff_status status = guess_in_time(s, i ? 1 : cycles, a->x);
        if (status != FF_OK || solve_near_guess(s))
            return status;
    }
    return FF_NOCONV;
}

static ff_status solve_on_curve(search *s, const dynamics_flow *flow)
{
    dynamics_attractor a = {.period = DYNAMICS_APERIODIC};
    ff_status status = s->request->from.x ? FF_NOCONV : trace_to_speed(s, flow, &a);
    return status == FF_OK ? solve_from_motion(s, &a) : status;
}

/* Solves for the series on the requested branch. With hardly any damping a motion is followed to
   the speed along the curve; if that fails it is found with more damping first. If settling leads
   to a motion that is not near a motion of period 1, the curve is followed instead. */
static ff_status solve_on_branch(search *s, const dynamics_flow *flow,
                                 dynamics_branch_result *result)
{
    dynamics_attractor a = {.period = DYNAMICS_APERIODIC};
    int damped = s->excitation.zeta >= hardly_damped;
    ff_status status = damped ? FF_NOCONV : solve_on_curve(s, flow);
    if (status != FF_NOCONV)
        return status;
    s->excitation.zeta = fmax(s->excitation.zeta, hardly_damped);
    status = lead_to_speed(s, flow, &a);
    result->ends = a.ends;
    if (status == FF_OK)
        status = a.period == DYNAMICS_UNBOUNDED ? FF_NOCONV : solve_from_motion(s, &a);
    if (status == FF_NOCONV && damped)
        status = solve_on_curve(s, flow);
    if (status == FF_NOCONV && a.period == DYNAMICS_UNBOUNDED)
        result->why = "the motion grows without bound";
    if (status == FF_OK)
        lower_damping(s);
    return status;
}

ff_status dynamics_branch_series(const dynamics_branch_request *request,
                                 dynamics_branch_result *result)
{
    search s;
    dynamics_flow flow = {0};
    ff_status status = FF_NOMEM;
    *result = (dynamics_branch_result){0};
    if (!search_init(&s, request) || !dynamics_flow_init(&flow, &s.excitation))
        goto out;
    status = FF_OK;
    if (!solve_at_rest(&s)) {
        int linear = request->excitation->half_gap == 0; /* a linear system has only one motion */
        if (linear && !solve_in_contact(&s)) {
            status = FF_NOCONV;
            result->why = "a linear system without damping has no periodic motion at resonance";
        }
        if (!linear)
            status = request->from.x ? FF_NOCONV : solve_in_full_contact(&s);
        if (!linear && status == FF_NOCONV)
            status = solve_on_branch(&s, &flow, result);
        s.excitation.zeta = request->excitation->zeta;
        if (!linear && status == FF_NOCONV && request->branch == DYNAMICS_BRANCH_LOWER &&
            solve_in_contact(&s)) {
            result->lost = 1;
            status = FF_OK;
        }
    }
    if (status == FF_OK) {
        result->x = s.x;
        s.x = NULL;
    }
out:
    dynamics_flow_free(&flow);
    search_free(&s);
    return status;
}
