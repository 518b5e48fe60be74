/* SPDX-License-Identifier: GPL-3.0-or-later */
/* dynamics/time-integration: integrates the motion until it repeats itself. */
#include "assess.h"
#include "inputs.h"
#include "motion.h"
#include "settle.h"
#include "stable-motions.h"
#include "warm-start.h"

#include <flankfilm/author.h>

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    P_DAMPING_RATIO,
    P_DAMPING,
    P_BRANCH,
    P_EQUIVALENT_MASS,
    P_NATURAL_FREQUENCY,
    P_CYCLES_SETTLE,
    P_CYCLES_MEASURED,
    P_STEPS_PER_CYCLE,
    P_TOLERANCE,
    P_SETTLE_TOLERANCE
};

static const ff_param params[] = {
    {"damping_ratio", "1", "damping over critical damping at the mean stiffness, c/(2 sqrt(k m))",
     FF_REAL, 0, "0.01", NULL, NULL, 0, 10, 1e-3, 0.2, 0, 0, 0, NULL},
    {"damping", "",
     "when the damper acts: always (also in free flight, as Li & Kahraman 2011), in contact only, "
     "or in contact and clipped so that the flanks never pull",
     FF_CHOICE, 0, "always", "always|contact|clipped", NULL, 0, 0, 0, 0, 0, 0, 0, NULL},
    {"branch", "",
     "which of several motions: lower is the one without separation where it is stable, or else "
     "what comes up slowly from 0.7 times the mesh frequency; upper comes down from 1.4 times the "
     "natural frequency; where a study follows the speed, it is for the first case of a chain",
     FF_CHOICE, 0, "lower", "lower|upper", NULL, 0, 0, 0, 0, 0, 0, 0, NULL},
    {"equivalent_mass", "kg", "mass that the mesh spring sees; default: the gear's", FF_REAL,
     FF_MIN_OPEN, NULL, NULL, "inertia", 0, 1e9, 0, 0, 0, 0, 0, NULL},
    {"natural_frequency", "Hz",
     "linear natural frequency at the mean stiffness, in place of the mass", FF_REAL, FF_MIN_OPEN,
     NULL, NULL, "inertia", 0, 1e9, 0, 0, 0, 0, 0, NULL},
    {"cycles_settle", "1",
     "mesh cycles in which the motion may settle; auto: four times what the damping takes", FF_INT,
     FF_TUNABLE, "auto", "auto", NULL, 1, 1e6, 0, 0, 0, 0, 0, NULL},
    {"cycles_measured", "1", "mesh cycles shown when the motion is not periodic", FF_INT, 0, "64",
     NULL, NULL, 1, 1024, 0, 0, 0, 0, 0, NULL},
    {"steps_per_cycle", "1", "points shown per mesh cycle; the integrator's steps are its own",
     FF_INT, FF_TUNABLE, "512", NULL, NULL, 16, 65536, 0, 0, 0, 0, 0, NULL},
    {"tolerance", "1", "error of one integration step over the static deflection", FF_REAL,
     FF_TUNABLE, "1e-9", NULL, NULL, 1e-13, 1e-3, 1e-12, 1e-6, 0, 0, 0, NULL},
    {"settle_tolerance", "1",
     "distance to the periodic motion at which it has settled, over the static deflection", FF_REAL,
     FF_TUNABLE, "1e-7", NULL, NULL, 1e-12, 1e-2, 1e-11, 1e-4, 0, 0, 0, NULL},
};

typedef struct model {
    const ff_host *host;
    double zeta, tolerance, settle_tolerance;
    int damping;
    dynamics_branch branch;
    dynamics_inertia inertia;
    size_t cycles_settle, cycles_measured, steps_per_cycle;
    dynamics_warm_start from, to; /* what the neighbouring case left, and what it is left */
} model;

static ff_status create(const ff_host *host, void **self)
{
    /* GSL's own handler would end the program; all its returns are checked here */
    gsl_set_error_handler_off();
    model *m = calloc(1, sizeof *m);
    if (!m)
        return FF_NOMEM;
    m->host = host;
    *self = m;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    model *m = self;
    switch (param) {
    case P_DAMPING_RATIO:
        m->zeta = value->real;
        break;
    case P_DAMPING:
        m->damping = (int)value->integer;
        break;
    case P_BRANCH:
        m->branch = (dynamics_branch)value->integer;
        break;
    case P_EQUIVALENT_MASS:
        m->inertia.equivalent_mass = value->real;
        break;
    case P_NATURAL_FREQUENCY:
        m->inertia.natural_frequency = value->real;
        break;
    case P_CYCLES_SETTLE:
        m->cycles_settle = dynamics_count_or_auto(value);
        break;
    case P_CYCLES_MEASURED:
        m->cycles_measured = (size_t)value->integer;
        break;
    case P_STEPS_PER_CYCLE:
        m->steps_per_cycle = (size_t)value->integer;
        break;
    case P_TOLERANCE:
        m->tolerance = value->real;
        break;
    default:
        m->settle_tolerance = value->real;
    }
    return FF_OK;
}

/* How far the end of the period moves when the steps are halved and the tolerance is a hundredth,
   divided by 1 - |mu|: the fixed point of a map that contracts by mu moves by that much. */
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
            m->zeta > 0 ? "the motion does not repeat itself within 8 mesh cycles: aperiodic, "
                          "or it needs more cycles_settle"
                        : "without damping the motion never settles; what is shown depends on "
                          "its start",
            host);
    /* a step is about half a radian, and at worst the errors of all steps add up */
    double limit = m->tolerance * fmax(1000, 2 * (double)motion->cycles * motion->T);
    host->quality(host->ctx, "settled_cycles", (double)settled->cycles, (double)settled->limit,
                  FF_GOOD, NULL);
    host->quality(host->ctx, "energy_balance", motion->energy_error, limit,
                  motion->energy_error <= limit ? FF_GOOD : FF_DOUBTFUL, NULL);
    host->quality(host->ctx, "determinant", motion->det_error, limit,
                  motion->det_error <= limit ? FF_GOOD : FF_DOUBTFUL, NULL);
    if (settled->period < 1)
        return;
    if (settled->period > 1)
        host->quality(host->ctx, "coexistence", settled->period, 1, FF_DOUBTFUL,
                      "a motion of several mesh cycles is seldom the only one at its speed, and "
                      "round-off may decide which is reached; dynamics/shooting lists them");
    host->quality(host->ctx, "stability", largest, 1, largest < 1 ? FF_GOOD : FF_DOUBTFUL,
                  largest < 1 ? NULL : "a disturbance of this motion does not die out");
    host->quality(host->ctx, "state_error", error, 1e-5, error <= 1e-5 ? FF_GOOD : FF_DOUBTFUL,
                  "error of the steps, over the static deflection");
}

static ff_status fail_too_many_steps(const ff_host *host, const dynamics_inputs *inputs)
{
    return ff_failf(host, FF_NOCONV, "operating.mesh_frequency",
                    "a mesh frequency of %g Hz and a natural frequency of %g Hz take more than 20 "
                    "million steps; give fewer cycles_settle, or take dynamics/quasi-static far "
                    "below resonance",
                    inputs->mesh_frequency, inputs->natural_frequency);
}

static ff_status output_motion(const model *m, const dynamics_excitation *excitation,
                               const dynamics_inputs *inputs, double T,
                               const dynamics_settled *settled)
{
    dynamics_motion motion = {.excitation = excitation, .period = settled->period, .T = T};
    motion.cycles = settled->period > 0 ? (size_t)settled->period : m->cycles_measured;
    if (settled->period == DYNAMICS_UNBOUNDED)
        motion.cycles = 1;
    double multipliers[4], error = 0;
    ff_status status = dynamics_motion_record(&motion, inputs, m->tolerance, m->steps_per_cycle,
                                              settled->delta, settled->rate);
    double largest = status == FF_OK ? dynamics_motion_multipliers(&motion, multipliers) : 0;
    if (status == FF_OK && settled->period > 0)
        status = step_error(m, excitation, &motion, settled, largest, &error);
    if (status == FF_OK)
        report(m, settled, &motion, largest, error);
    if (status == FF_OK)
        status = dynamics_motion_put(&motion, inputs, m->host);
    dynamics_record_free(&motion.record);
    return status;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    model *m = self;
    dynamics_excitation excitation = {.zeta = m->zeta, .damping = m->damping};
    dynamics_inputs inputs;
    dynamics_oscillator *o = NULL;
    ff_status status = dynamics_inputs_read(m->host, in, &m->inertia, &inputs, &excitation);
    if (status != FF_OK)
        goto out;
    dynamics_settling how = {
        .branch = m->branch,
        .T = 2 * M_PI * inputs.natural_frequency / inputs.mesh_frequency,
        .cycles = m->cycles_settle,
        .tolerance = m->settle_tolerance,
        .step_tolerance = m->tolerance,
        .host = m->host,
    };
    dynamics_settled settled;
    m->to.mesh_frequency = 0;
    if (m->from.mesh_frequency > 0) {
        how.from = m->from.mesh_frequency / inputs.natural_frequency;
        dynamics_warm_start_state(&m->from, &excitation, how.start);
    }
    if (fmax(how.T, how.from > 0 ? 2 * M_PI / how.from : 0) > dynamics_longest_cycle) {
        status = fail_too_many_steps(m->host, &inputs);
        goto out;
    }
    o = dynamics_oscillator_new(&excitation, m->tolerance, 1, DYNAMICS_MOTION);
    status = o ? dynamics_settle(o, &excitation, &how, &settled) : FF_NOMEM;
    if (status == FF_OK)
        status = output_motion(m, &excitation, &inputs, how.T, &settled);
    if (status == FF_OK && settled.period != DYNAMICS_UNBOUNDED)
        m->to = dynamics_warm_start_motion(&excitation, inputs.mesh_frequency, settled.period,
                                           settled.delta, settled.rate);
    if (status == FF_OK && wanted & FF_BIT(DYNAMICS_OUT_STABLE_MOTIONS))
        status = dynamics_stable_motions_put(
            &excitation, inputs.mesh_frequency / inputs.natural_frequency, m->host);
    if (status == FF_NOCONV)
        status = fail_too_many_steps(m->host, &inputs);
out:
    m->from.mesh_frequency = 0;
    dynamics_oscillator_free(o);
    dynamics_excitation_free(&excitation);
    return status;
}

/* In eight random scenes dte_rms agrees with that of shooting to 1e-8; what is promised is ten
   times the distance that may be left after settling. */
static ff_status assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                        ff_assessment *a)
{
    const model *m = self;
    const dynamics_assessment estimate = {
        .error = fmax(10 * m->settle_tolerance, 1e-5),
        .cost = 5e-3,
        .longest = dynamics_longest_cycle,
        .branch = m->branch,
        .from = &m->from,
        .reason = "integrated until it repeats itself, contact loss included; whether it is about "
                  "to jump is not looked at",
    };
    (void)wanted, (void)accuracy;
    return dynamics_assess(&estimate, m->host, in, &m->inertia,
                           (dynamics_excitation){.zeta = m->zeta, .damping = m->damping}, a);
}

static ff_status carry(void *self, const ff_state_bytes *from, ff_state_bytes *to)
{
    model *m = self;
    return dynamics_warm_start_carry(&m->from, from, &m->to, to);
}

static void destroy(void *self)
{
    free(self);
}

static const ff_model descriptor = {
    .size = sizeof descriptor,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = "dynamics/time-integration",
    .version = "1.0.0",
    .summary = "non-linear dynamics of the gear pair with backlash, integrated until it repeats "
               "itself",
    .reference = "Li & Kahraman 2011, Influence of dynamic behaviour on elastohydrodynamic "
                 "lubrication of spur gears, Proc. IMechE J 225, 740-753, eqs 2-5",
    .bibtex = "@article{likahraman2011,\n"
              "  author = {Li, S. and Kahraman, A.},\n"
              "  title = {Influence of dynamic behaviour on elastohydrodynamic lubrication of spur "
              "gears},\n"
              "  journal = {Proc. IMechE, Part J: J. Engineering Tribology},\n"
              "  volume = {225},\n"
              "  pages = {740--753},\n"
              "  year = {2011}\n"
              "}\n",
    .licence = "GPL-3.0-or-later",
    .params = params,
    .param_count = sizeof params / sizeof params[0],
    .param_stride = sizeof params[0],
    .inputs = dynamics_input_ports,
    .input_count = DYNAMICS_INPUT_COUNT,
    .input_stride = sizeof dynamics_input_ports[0],
    .outputs = dynamics_motion_outputs,
    .output_count = DYNAMICS_SPEED_OUTPUT_COUNT,
    .output_stride = sizeof dynamics_motion_outputs[0],
    .create = create,
    .set = set,
    .evaluate = evaluate,
    .destroy = destroy,
    .carry = carry,
    .assess = assess,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &descriptor;
}
