/* SPDX-License-Identifier: GPL-3.0-or-later */
/* dynamics/harmonic-balance: the periodic motion as a Fourier series, branch by branch. */
#include "../continuation/stable-motions.h"
#include "../excitation/inputs.h"
#include "../oscillator/motion.h"
#include "../oscillator/settle.h"
#include "../series/branch.h"
#include "../series/harmonics-motion.h"
#include "../series/harmonics-warm-start.h"
#include "../series/harmonics.h"
#include "references.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct model {
    const ff_host *host;
    double zeta, tolerance;
    int32_t damping, force, branch;
    dynamics_inertia inertia;
    int64_t harmonics_given, samples_given, steps_per_cycle; /* as given by the user; -1: auto */
    size_t harmonics, samples;                               /* as given by the user; 0: auto */
    dynamics_harmonics_warm_start from, to; /* series from the neighbouring case; series for the
                                               next case */
} model;

static const ff_param params[] = {
    DYNAMICS_DAMPING_RATIO_ROW(model, 1e-3),
    FF_ONE_OF("always|contact|clipped", "damping", model, damping, 0, "always",
              "when the damper acts; only `always` is possible, since a Fourier series needs a "
              "force without jumps"),
    FF_ONE_OF("lower|upper", "branch", model, branch, 0, "lower",
              "motion that is shown if several exist. lower: the motion without contact loss if it "
              "is stable, otherwise the motion on the branch followed up from 0.7 times the mesh "
              "frequency; upper: the motion on the branch followed down from 1.4 times the natural "
              "frequency, stable or not. In a chain of cases over the speed, branch applies to the "
              "first case"),
    DYNAMICS_FORCE_ROW(model),
    DYNAMICS_INERTIA_ROWS(model),
    FF_COUNT_OR("auto", "harmonics", model, harmonics_given, FF_TUNABLE, "auto", NULL, 1,
                DYNAMICS_MOST_HARMONICS, 5, DYNAMICS_MOST_HARMONICS,
                "number of harmonics of the mesh frequency in the series; auto: increased until "
                "the first neglected harmonics, estimated from the force, are below the tolerance"),
    FF_COUNT_OR(
        "auto", "samples", model, samples_given, FF_TUNABLE, "auto", NULL, 16, 1 << 20, 0, 0,
        "samples of the mesh force per mesh cycle, at least 8 per harmonic; auto: 32 per harmonic"),
    FF_COUNT("steps_per_cycle", model, steps_per_cycle, FF_TUNABLE, "512", NULL, 16, 65536, 0, 0,
             "points shown per mesh cycle"),
    FF_QUANTITY("tolerance", "1", model, tolerance, FF_TUNABLE, "1e-6", NULL, 1e-12, 1e-1, 1e-9,
                1e-3,
                "sum of the amplitudes of the first neglected harmonics over the static "
                "deflection"),
};

static ff_status ready(void *self)
{
    model *m = self;
    m->harmonics = dynamics_count_or_auto(m->harmonics_given);
    m->samples = dynamics_count_or_auto(m->samples_given);
    dynamics_tell_servings(m->host, &m->inertia, m->zeta);
    if (m->damping != DYNAMICS_DAMPING_ALWAYS)
        return ff_failf(m->host, FF_UNSUPPORTED, "damping",
                        "a damper that does not act in the gap makes the mesh force jump, which "
                        "a Fourier series cannot represent; use damping: always, or "
                        "dynamics/time-integration");
    if (m->samples && m->samples < 8 * m->harmonics)
        return ff_failf(m->host, FF_INVALID, "samples",
                        "%zu harmonics need at least %zu samples, not %zu", m->harmonics,
                        8 * m->harmonics, m->samples);
    if (m->samples % 2)
        return ff_failf(m->host, FF_INVALID, "samples", "must be even, but is %zu", m->samples);
    return FF_OK;
}

/* A series and its errors. It is solved at increasing resolution. */
typedef struct solution {
    double *x; /* array of length DYNAMICS_MOST_HARMONICS */
    size_t harmonics, samples;
    double residual, neglected, error;
} solution;

static size_t samples_for(const model *m, size_t harmonics)
{
    size_t samples = 2048;
    while (samples < 32 * harmonics)
        samples *= 2;
    return m->samples > 8 * harmonics ? m->samples : samples;
}

/* Solves with that number of harmonics. s->x is first the guess, then the solution. */
static ff_status solve(const model *m, const dynamics_excitation *excitation, double w,
                       size_t harmonics, solution *s)
{
    size_t size = 2 * harmonics + 1;
    s->samples = m->samples && m->harmonics ? m->samples : samples_for(m, harmonics);
    s->harmonics = harmonics;
    dynamics_harmonics *b = dynamics_harmonics_new(excitation, harmonics, s->samples);
    double *residual = malloc(size * sizeof *residual), step;
    ff_status status = b && residual ? FF_OK : FF_NOMEM;
    if (status == FF_OK && dynamics_harmonics_solve(b, w, s->x, &step) != DYNAMICS_NEWTON_DONE)
        status = FF_NOCONV;
    if (status == FF_OK) {
        s->neglected = dynamics_harmonics_neglected(b, w, s->x);
        dynamics_harmonics_residual(b, w, s->x, residual, NULL, NULL, 0);
        s->residual = 0;
        for (size_t i = 0; i < size; i++)
            s->residual = fmax(s->residual, fabs(residual[i]));
    }
    free(residual);
    dynamics_harmonics_free(b);
    return status;
}

/* Estimates, to first order, how much the series would change with twice the harmonics and twice
   the samples. With many harmonics a quarter more are used, since the work grows with their
   cube. */
static ff_status estimate_error(const dynamics_excitation *excitation, double w, solution *s)
{
    size_t harmonics = s->harmonics <= 200 ? 2 * s->harmonics : s->harmonics + s->harmonics / 4;
    double *x = malloc((2 * harmonics + 1) * sizeof *x);
    dynamics_harmonics *b = dynamics_harmonics_new(excitation, harmonics, 2 * s->samples);
    ff_status status = x && b ? FF_OK : FF_NOMEM;
    if (status == FF_OK) {
        dynamics_fourier_resize(s->x, s->harmonics, x, harmonics);
        if (dynamics_harmonics_correction(b, w, x, &s->error) != DYNAMICS_NEWTON_DONE)
            s->error = 1e300;
    }
    dynamics_harmonics_free(b);
    free(x);
    return status;
}

/* Refines the series of the continuation to the requested resolution. */
static ff_status refine(const model *m, const dynamics_excitation *excitation, double w,
                        const double *x, size_t harmonics, solution *s)
{
    size_t had = harmonics;
    if (m->harmonics)
        harmonics = m->harmonics;
    dynamics_fourier_resize(x, had < harmonics ? had : harmonics, s->x, DYNAMICS_MOST_HARMONICS);
    ff_status status = solve(m, excitation, w, harmonics, s);
    while (status == FF_OK && !m->harmonics && s->neglected > m->tolerance &&
           harmonics < DYNAMICS_MOST_HARMONICS) {
        size_t more = harmonics + harmonics / 2;
        harmonics = more < DYNAMICS_MOST_HARMONICS ? more : DYNAMICS_MOST_HARMONICS;
        status = solve(m, excitation, w, harmonics, s);
    }
    return status == FF_OK ? estimate_error(excitation, w, s) : status;
}

static void report_stability(const model *m, const dynamics_motion *motion, double largest)
{
    const ff_host *host = m->host;
    const char *text = "largest Floquet multiplier: a disturbance of this motion does not decay";
    int32_t verdict = largest < 1 ? FF_GOOD : FF_DOUBTFUL;
    if (motion->period == DYNAMICS_UNBOUNDED) {
        text = "without backlash a disturbance of this motion grows without bound";
        verdict = FF_BAD;
    } else if (m->zeta == 0)
        text = "without damping a disturbance of this motion cannot decay";
    host->quality(host->ctx, "stability", largest, 1, verdict, verdict == FF_GOOD ? NULL : text);
}

static void report(const model *m, const dynamics_motion *motion, const solution *s,
                   const dynamics_branch_result *result, double largest)
{
    const ff_host *host = m->host;
    int enough = s->neglected <= m->tolerance;
    host->quality(host->ctx, "harmonics", (double)s->harmonics, DYNAMICS_MOST_HARMONICS, FF_GOOD,
                  NULL);
    host->quality(host->ctx, "neglected_harmonics", s->neglected, m->tolerance,
                  enough ? FF_GOOD : FF_DOUBTFUL,
                  enough ? NULL : "the motion needs more harmonics than the series can have");
    host->quality(host->ctx, "residual", s->residual, 1e-8, s->residual <= 1e-8 ? FF_GOOD : FF_BAD,
                  NULL);
    double limit = fmax(10 * m->tolerance, 1e-8);
    host->quality(host->ctx, "state_error", fmin(s->error, 1e300), limit,
                  s->error <= limit ? FF_GOOD : FF_DOUBTFUL,
                  "change of the series with more harmonics and samples, over the static "
                  "deflection");
    host->quality(host->ctx, "determinant", motion->det_error, 1e-9,
                  motion->det_error <= 1e-9 ? FF_GOOD : FF_DOUBTFUL, NULL);
    host->quality(host->ctx, "jumps_on_the_way", result->ends, 20000,
                  result->lost ? FF_DOUBTFUL : FF_GOOD,
                  result->lost ? "the branch could not be followed to this mesh frequency; the "
                                 "motion without contact loss is shown"
                               : NULL);
    report_stability(m, motion, largest);
}

static ff_status report_and_output(const model *m, const dynamics_excitation *excitation,
                                   const dynamics_inputs *inputs, double w, const solution *s,
                                   const dynamics_branch_result *result)
{
    dynamics_motion motion = {
        .excitation = excitation, .period = 1, .cycles = 1, .T = 2 * M_PI / w};
    double multipliers[4];
    ff_status status =
        dynamics_harmonics_motion(&motion, inputs, s->x, s->harmonics, (size_t)m->steps_per_cycle);
    if (status == FF_OK) {
        double largest = dynamics_motion_multipliers(&motion, multipliers);
        if (excitation->half_gap == 0 && largest > 1 + 1e-9)
            motion.period = DYNAMICS_UNBOUNDED;
        report(m, &motion, s, result, largest);
        status = dynamics_motion_put(&motion, inputs, m->host);
    }
    dynamics_record_free(&motion.record);
    return status;
}

static ff_status fail_without_motion(const model *m, const dynamics_inputs *inputs, const char *why)
{
    return ff_failf(m->host, FF_NOCONV, "operating.mesh_frequency",
                    "no motion of one mesh cycle was found at %g Hz on the %s branch: %s",
                    inputs->mesh_frequency, m->branch == DYNAMICS_BRANCH_UPPER ? "upper" : "lower",
                    why ? why : "Newton's method fails with these harmonics");
}

/* Returns the number of harmonics used while a branch is followed: they reach 15 times the natural
   frequency, within bounds that limit the work. */
static size_t harmonics_on_the_way(double w)
{
    return (size_t)fmin(fmax(ceil(15 / w), 24), 160);
}

/* Finds the series on the branch, or the series that continues the motion of the neighbouring
   case. */
static ff_status find_series(const model *m, dynamics_branch_request *request, double natural,
                             dynamics_branch_result *result)
{
    double x[2 * DYNAMICS_MOST_HARMONICS + 1];
    dynamics_branch_start from = {x, m->from.harmonics, m->from.mesh_frequency / natural};
    if (m->from.harmonics == 0 || from.w * DYNAMICS_MOST_HARMONICS < 2)
        return dynamics_branch_series(request, result);
    for (size_t i = 0; i <= 2 * m->from.harmonics; i++)
        x[i] = m->from.x[i] / request->excitation->length;
    request->from = from;
    ff_status status = dynamics_branch_series(request, result);
    request->from.x = NULL;
    return status == FF_NOCONV ? dynamics_branch_series(request, result) : status;
}

/* Writes the motion at the mesh frequency of the operating point. */
static ff_status output_motion(model *m, const dynamics_excitation *excitation,
                               const dynamics_inputs *inputs)
{
    double w = inputs->mesh_frequency / inputs->natural_frequency;
    if (w * DYNAMICS_MOST_HARMONICS < 2)
        return fail_without_motion(
            m, inputs,
            "the mesh frequency is so low that a series of 512 harmonics does not reach twice the "
            "natural frequency; use dynamics/quasi-static");
    dynamics_branch_result result = {0};
    solution s = {.x = calloc(2 * DYNAMICS_MOST_HARMONICS + 1, sizeof *s.x)};
    dynamics_branch_request request = {.excitation = excitation,
                                       .host = m->host,
                                       .branch = (dynamics_branch)m->branch,
                                       .w = w,
                                       .harmonics = harmonics_on_the_way(w)};
    ff_status status =
        s.x ? find_series(m, &request, inputs->natural_frequency, &result) : FF_NOMEM;
    if (status == FF_OK)
        status = refine(m, excitation, w, result.x, request.harmonics, &s);
    if (status == FF_OK)
        status = report_and_output(m, excitation, inputs, w, &s, &result);
    if (status == FF_OK)
        dynamics_harmonics_warm_start_set(&m->to, inputs->mesh_frequency, s.x, s.harmonics,
                                          excitation->length);
    if (status == FF_NOCONV)
        status = fail_without_motion(m, inputs, result.why);
    free(result.x);
    free(s.x);
    return status;
}

static ff_status evaluate_driving(void *self, uint64_t wanted, const ff_array *in, int back)
{
    model *m = self;
    const uint64_t motion_outputs = FF_BIT(DYNAMICS_MOTION_OUTPUT_COUNT) - 1;
    dynamics_excitation excitation = {
        .zeta = m->zeta, .damping = m->damping, .shared = m->force == 1};
    dynamics_inputs inputs;
    m->to.harmonics = 0;
    ff_status status = dynamics_inputs_read(m->host, in, &m->inertia, &inputs, &excitation);
    inputs.wanted = wanted;
    inputs.back = back;
    if (status == FF_OK)
        status = dynamics_motion_check_back(m->host, &inputs, &excitation);
    if (status == FF_OK)
        status = dynamics_refuse_fluctuation(m->host, &in[DYNAMICS_IN_FLUCTUATION_ORDER],
                                             "a series of the mesh cycle");
    const int floats = status == FF_OK && dynamics_floats(&inputs, &excitation);
    if (floats)
        status = dynamics_motion_put_floating(&inputs, &excitation, m->host);
    else if (status == FF_OK && (wanted & motion_outputs || !wanted))
        status = output_motion(m, &excitation, &inputs);
    if (status == FF_OK && floats)
        status = ff_put_scalar(m->host, DYNAMICS_OUT_STABLE_MOTIONS, 0);
    else if (status == FF_OK && wanted & FF_BIT(DYNAMICS_OUT_STABLE_MOTIONS))
        status = dynamics_stable_motions_put(
            &excitation, inputs.mesh_frequency / inputs.natural_frequency, m->host);
    m->from.harmonics = 0;
    dynamics_excitation_free(&excitation);
    return status;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    return dynamics_evaluate(((const model *)self)->host, dynamics_input_ports,
                             DYNAMICS_INPUT_COUNT, DYNAMICS_IN_TOOTH_FORCE, in, evaluate_driving,
                             self, wanted);
}

static ff_status carry(void *self, const ff_state_bytes *from, ff_state_bytes *to)
{
    model *m = self;
    return dynamics_harmonics_warm_start_carry(&m->from, from, &m->to, to);
}

FF_MODEL(
    dynamics_harmonic_balance, model, .id = "dynamics/harmonic-balance", .version = "1.0.0",
    .summary = "non-linear dynamics of the gear pair with backlash, as a Fourier series over the "
               "mesh cycle, by continuation in speed",
    .reference = "Cameron & Griffin 1989, An alternating frequency/time domain method for "
                 "calculating the steady-state response of nonlinear dynamic systems, J. Appl. "
                 "Mech. 56, 149-154; Li & Kahraman 2011, Proc. IMechE J 225, 740-753, eqs 2-5",
    .bibtex = BIB_camerongriffin1989 "\n", .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params), .inputs = dynamics_input_ports, .input_count = DYNAMICS_INPUT_COUNT,
    .input_stride = sizeof dynamics_input_ports[0], .outputs = dynamics_motion_outputs,
    .output_count = DYNAMICS_SPEED_OUTPUT_COUNT, .output_stride = sizeof dynamics_motion_outputs[0],
    .ready = ready, .evaluate = evaluate, .destroy = free, .carry = carry);
FF_EXPORT_MODELS(&dynamics_harmonic_balance);
