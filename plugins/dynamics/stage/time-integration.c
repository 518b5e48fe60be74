/* SPDX-License-Identifier: GPL-3.0-or-later */
/* dynamics/time-integration: integrates the motion until it repeats. */
#include "../continuation/stable-motions.h"
#include "../excitation/film-wire.h"
#include "../excitation/inputs.h"
#include "../excitation/warm-start.h"
#include "../oil/oil.h"
#include "../orbits/trajectory.h"
#include "../oscillator/motion.h"
#include "../oscillator/settle.h"
#include "references.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct model {
    const ff_host *host;
    double zeta, tolerance, settle_tolerance;
    int32_t damping, force, branch;
    dynamics_inertia inertia;
    dynamics_oil oil;
    dynamics_film_wire wire;
    int64_t cycles_settle, cycles_measured, steps_per_cycle;
    dynamics_warm_start from, to; /* motion from the neighbouring case; motion for the next case */
} model;

static const ff_param params[] = {
    DYNAMICS_DAMPING_RATIO_ROW(model, 1e-3),
    DYNAMICS_DAMPING_ROW(model),
    FF_ONE_OF("lower|upper", "branch", model, branch, 0, "lower",
              "motion that is shown if several exist. lower: the motion without contact loss if it "
              "is stable, otherwise the motion to which a slow rise of the speed from 0.7 times "
              "the mesh frequency leads; upper: the motion to which a slow fall from 1.4 times the "
              "natural frequency leads. In a chain of cases over the speed, branch applies to the "
              "first case"),
    DYNAMICS_FORCE_ROW(model),
    DYNAMICS_INERTIA_ROWS(model),
    DYNAMICS_OIL_ROWS(model),
    DYNAMICS_FILM_WIRE_ROWS(model),
    FF_COUNT_OR(
        "auto", "cycles_settle", model, cycles_settle, FF_TUNABLE, "auto", NULL, 1, 1e6, 0, 0,
        "largest number of mesh cycles in which the motion may settle; auto: four times the number "
        "that the damping requires"),
    FF_COUNT("cycles_measured", model, cycles_measured, 0, "64", NULL, 1, 1024, 0, 0,
             "mesh cycles shown if the motion is not periodic"),
    FF_COUNT("steps_per_cycle", model, steps_per_cycle, FF_TUNABLE, "512", NULL, 16, 65536, 0, 0,
             "points shown per mesh cycle; they do not affect the steps of the integrator"),
    FF_QUANTITY("tolerance", "1", model, tolerance, FF_TUNABLE, "1e-9", NULL, 1e-13, 1e-3, 1e-12,
                1e-6,
                "error of one integration step over the static deflection; not used with squeeze: "
                "series, which uses the steps of dynamics/shooting"),
    FF_QUANTITY("settle_tolerance", "1", model, settle_tolerance, FF_TUNABLE, "1e-7", NULL, 1e-12,
                1e-2, 1e-11, 1e-4,
                "the motion has settled if its distance to the periodic motion, over the static "
                "deflection, is below this"),
};

static ff_status ready(void *self)
{
    const model *m = self;
    dynamics_tell_servings(m->host, &m->inertia, m->zeta);
    return dynamics_oil_check(m->host, &m->oil, m->damping);
}

static void start_steps(void *self, double T, double delta, double rate)
{
    dynamics_oscillator_start(self, T, delta, rate);
}

static int step_through_cycle(void *self, double T)
{
    return dynamics_oscillator_cycle(self, T, NULL);
}

static void read_steps(const void *self, double x[2])
{
    const double *y = dynamics_oscillator_state(self);
    x[0] = y[DYNAMICS_DELTA];
    x[1] = y[DYNAMICS_RATE];
}

/* A motion with oil between separated flanks, integrated with the steps of flow.h. In wide gaps the
   film equation is stiff, and the explicit steps of oscillator.h would have to resolve it. */
typedef struct oil_motion {
    dynamics_flow flow;
    dynamics_state y;
} oil_motion;

static void start_in_oil(void *self, double T, double delta, double rate)
{
    (void)T;
    oil_motion *o = self;
    o->y = dynamics_state_at(delta, rate);
}

static int cycle_in_oil(void *self, double T)
{
    oil_motion *o = self;
    return dynamics_flow_motion(&o->flow, T, &o->y, NULL);
}

static void read_in_oil(const void *self, double x[2])
{
    const oil_motion *o = self;
    x[0] = o->y.delta;
    x[1] = o->y.rate;
}

/* Estimates the error of the steps. The estimate is the change of the state at the end of the
   period if the steps are halved and the tolerance is divided by 100, over 1 - |mu|: this is the
   change of the fixed point of a map that contracts by mu. */
static ff_status step_error(const model *m, const dynamics_excitation *excitation,
                            const dynamics_motion *motion, const dynamics_settled *settled,
                            double largest, double *error)
{
    double end[2][2];
    for (int k = 0; k < 2; k++) {
        double tolerance = k ? fmax(0.01 * m->tolerance, 1e-14) : m->tolerance;
        dynamics_oscillator *o =
            dynamics_oscillator_new(excitation, tolerance, k + 1, DYNAMICS_MOTION);
        if (!o)
            return FF_NOMEM;
        dynamics_oscillator_start(o, motion->T, settled->delta, settled->rate);
        int good = 1;
        for (size_t i = 0; i < motion->cycles && good; i++)
            good = dynamics_oscillator_cycle(o, motion->T, NULL);
        memcpy(end[k], dynamics_oscillator_state(o), sizeof end[k]);
        dynamics_oscillator_free(o);
        if (!good)
            return FF_NOCONV;
    }
    double change = fmax(fabs(end[0][0] - end[1][0]), fabs(end[0][1] - end[1][1]));
    *error = change / fmax(1 - largest, 1e-6);
    return FF_OK;
}

static void report(const model *m, const dynamics_settled *settled, const dynamics_motion *motion,
                   double largest, double error)
{
    const ff_host *host = m->host;
    if (settled->period == DYNAMICS_APERIODIC && m->zeta > 0 &&
        largest > dynamics_chaotic_disturbance)
        dynamics_chaos_line(pow(largest, 1 / (double)motion->cycles), host);
    else
        dynamics_periodicity_line(
            settled, m->settle_tolerance,
            m->zeta > 0 ? "the motion does not repeat within 8 mesh cycles: it is aperiodic, or it "
                          "needs a larger cycles_settle"
                        : "without damping the motion never settles; the motion shown depends on "
                          "its start",
            host);
    /* a step is about half a radian long; in the worst case the errors of all steps sum */
    double limit = m->tolerance * fmax(1000, 2 * (double)motion->cycles * motion->T);
    host->quality(host->ctx, "settled_cycles", (double)settled->cycles, (double)settled->limit,
                  FF_GOOD, NULL);
    host->quality(host->ctx, "energy_balance", motion->energy_error, limit,
                  motion->energy_error <= limit ? FF_GOOD : FF_DOUBTFUL, NULL);
    if (!motion->excitation->film)
        host->quality(host->ctx, "determinant", motion->det_error, limit,
                      motion->det_error <= limit ? FF_GOOD : FF_DOUBTFUL, NULL);
    if (settled->period < 1)
        return;
    if (settled->period > 1)
        host->quality(host->ctx, "coexistence", settled->period, 1, FF_DOUBTFUL,
                      "a motion with a period of several mesh cycles is rarely the only motion at "
                      "its speed, and round-off may decide which motion is found; "
                      "dynamics/shooting lists all motions");
    host->quality(host->ctx, "stability", largest, 1, largest < 1 ? FF_GOOD : FF_DOUBTFUL,
                  largest < 1 ? NULL
                              : "largest Floquet multiplier: a disturbance of this motion "
                                "does not decay");
    if (!motion->excitation->film)
        host->quality(host->ctx, "state_error", error, 1e-5, error <= 1e-5 ? FF_GOOD : FF_DOUBTFUL,
                      "error due to the integration steps, over the static deflection");
}

static ff_status fail_too_many_steps(const ff_host *host, const dynamics_inputs *inputs)
{
    return ff_failf(host, FF_NOCONV, "operating.mesh_frequency",
                    "a mesh frequency of %g Hz and a natural frequency of %g Hz need more than 20 "
                    "million steps, or a step with oil has no solution; reduce cycles_settle, or "
                    "use dynamics/quasi-static far below resonance",
                    inputs->mesh_frequency, inputs->natural_frequency);
}

/* `oil` is the settled motion; NULL: there is no oil between separated flanks. */
static ff_status output_motion(const model *m, const dynamics_excitation *excitation,
                               const dynamics_inputs *inputs, double T,
                               const dynamics_settled *settled, const oil_motion *oil)
{
    const double x[2] = {settled->delta, settled->rate};
    dynamics_motion motion = {.excitation = excitation, .period = settled->period, .T = T};
    motion.cycles =
        settled->period > 0 ? (size_t)settled->period : dynamics_cycles(inputs, m->cycles_measured);
    if (settled->period == DYNAMICS_UNBOUNDED)
        motion.cycles = 1;
    double multipliers[4], error = 0;
    if (oil && settled->period != DYNAMICS_UNBOUNDED)
        motion.films = oil->y.oil.film;
    ff_status status =
        oil ? dynamics_trajectory_record(&oil->flow, inputs,
                                         (size_t)m->steps_per_cycle * inputs->span, x, &motion)
            : dynamics_motion_record(&motion, inputs, m->tolerance,
                                     (size_t)m->steps_per_cycle * inputs->span, x[0], x[1]);
    double largest = status == FF_OK ? dynamics_motion_multipliers(&motion, multipliers) : 0;
    if (status == FF_OK && settled->period > 0 && !oil)
        status = step_error(m, excitation, &motion, settled, largest, &error);
    if (status == FF_OK)
        report(m, settled, &motion, largest, error);
    if (status == FF_OK)
        status = dynamics_motion_put(&motion, inputs, m->host);
    dynamics_record_free(&motion.record);
    return status;
}

/* The data of one evaluation. */
typedef struct job {
    model *m;
    dynamics_inputs inputs;
    dynamics_excitation excitation;
    dynamics_film *film; /* film of a motion in oil; NULL: the oscillator without oil is used */
    oil_motion oil;
    dynamics_oscillator *steps;
} job;

static ff_status open_follower(job *j, dynamics_follower *follower)
{
    if (j->film) {
        *follower = (dynamics_follower){&j->oil, start_in_oil, cycle_in_oil, read_in_oil};
        return dynamics_flow_init(&j->oil.flow, &j->excitation) ? FF_OK : FF_NOMEM;
    }
    j->steps = dynamics_oscillator_new(&j->excitation, j->m->tolerance, 1, DYNAMICS_MOTION);
    *follower = (dynamics_follower){j->steps, start_steps, step_through_cycle, read_steps};
    return j->steps ? FF_OK : FF_NOMEM;
}

static ff_status evaluate_job(job *j, uint64_t wanted)
{
    model *m = j->m;
    const dynamics_inputs *inputs = &j->inputs;
    dynamics_settling how = {
        .branch = (dynamics_branch)m->branch,
        .T = 2 * M_PI * inputs->unit_frequency / inputs->mesh_frequency,
        .cycles = dynamics_count_or_auto(m->cycles_settle),
        .tolerance = m->settle_tolerance,
        .step_tolerance = m->tolerance,
        .host = m->host,
    };
    dynamics_settled settled;
    dynamics_follower follower;
    m->to.mesh_frequency = 0;
    if (dynamics_floats(inputs, &j->excitation)) {
        ff_status put = dynamics_motion_put_floating(inputs, &j->excitation, m->host);
        return put == FF_OK ? ff_put_scalar(m->host, DYNAMICS_OUT_STABLE_MOTIONS, 0) : put;
    }
    if (m->from.mesh_frequency > 0) {
        how.from = m->from.mesh_frequency / inputs->unit_frequency;
        dynamics_warm_start_state(&m->from, &j->excitation, how.start);
    }
    if (fmax(how.T, how.from > 0 ? 2 * M_PI / how.from : 0) > dynamics_longest_cycle)
        return fail_too_many_steps(m->host, inputs);
    ff_status status = open_follower(j, &follower);
    if (status == FF_OK)
        status = dynamics_settle(&follower, &j->excitation, &how, &settled);
    if (status == FF_OK)
        status =
            output_motion(m, &j->excitation, inputs, how.T, &settled, j->film ? &j->oil : NULL);
    if (status == FF_OK && settled.period != DYNAMICS_UNBOUNDED)
        m->to = dynamics_warm_start_motion(&j->excitation, inputs->mesh_frequency, settled.period,
                                           settled.delta, settled.rate);
    if (status == FF_OK && wanted & FF_BIT(DYNAMICS_OUT_STABLE_MOTIONS))
        status = dynamics_stable_motions_put(
            &j->excitation, inputs->mesh_frequency / inputs->unit_frequency, m->host);
    return status == FF_NOCONV ? fail_too_many_steps(m->host, inputs) : status;
}

static ff_status evaluate_driving(void *self, uint64_t wanted, const ff_array *in, int back)
{
    model *m = self;
    job j = {.m = m,
             .excitation = {.zeta = m->zeta,
                            .damping = m->damping,
                            .shared = m->force == 1,
                            .on_chord = m->oil.squeeze == DYNAMICS_SQUEEZE_SERIES,
                            .both_flanks = m->oil.squeeze == DYNAMICS_SQUEEZE_NONE &&
                                           !dynamics_film_is_wired(in)}};
    dynamics_film_powers powers;
    ff_status status = dynamics_inputs_read(m->host, in, &m->inertia, &j.inputs, &j.excitation);
    j.inputs.wanted = wanted;
    j.inputs.back = back;
    if (status == FF_OK)
        status = dynamics_motion_check_back(m->host, &j.inputs, &j.excitation);
    if (status == FF_OK)
        status = dynamics_oil_read(m->host, in, &m->oil, &j.inputs, &j.excitation, &j.film);
    if (status == FF_OK)
        status = dynamics_film_wire_read(m->host, in, &m->wire, &j.inputs, &j.excitation, &powers);
    if (status == FF_OK &&
        dynamics_film_is_wired(in)) /* a later round continues from the previous round */
        m->from = m->to;
    if (status == FF_OK)
        status = evaluate_job(&j, wanted);
    m->from.mesh_frequency = 0;
    dynamics_oscillator_free(j.steps);
    dynamics_flow_free(&j.oil.flow);
    free(j.film);
    dynamics_excitation_free(&j.excitation);
    return status;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    return dynamics_evaluate(((const model *)self)->host, dynamics_oil_input_ports,
                             DYNAMICS_OIL_INPUT_COUNT, DYNAMICS_IN_TOOTH_FORCE, in,
                             evaluate_driving, self, wanted);
}

static ff_status carry(void *self, const ff_state_bytes *from, ff_state_bytes *to)
{
    model *m = self;
    return dynamics_warm_start_carry(&m->from, from, &m->to, to);
}

FF_MODEL(
    dynamics_time_integration, model, .id = "dynamics/time-integration", .version = "1.0.0",
    .summary =
        "non-linear dynamics of the gear pair with backlash, integrated until the motion repeats",
    .reference = "Li & Kahraman 2011, Influence of dynamic behaviour on elastohydrodynamic "
                 "lubrication of spur gears, Proc. IMechE J 225, 740-753, eqs 2-5",
    .bibtex = BIB_likahraman2011 "\n", .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
    .inputs = dynamics_oil_input_ports, .input_count = DYNAMICS_OIL_INPUT_COUNT,
    .input_stride = sizeof dynamics_oil_input_ports[0], .outputs = dynamics_motion_outputs,
    .output_count = DYNAMICS_SPEED_OUTPUT_COUNT, .output_stride = sizeof dynamics_motion_outputs[0],
    .ready = ready, .evaluate = evaluate, .destroy = free, .carry = carry);
FF_EXPORT_MODELS(&dynamics_time_integration);
