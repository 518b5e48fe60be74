/* SPDX-License-Identifier: GPL-3.0-or-later */
/* dynamics/coupled: gears on elastic bearings, with two translations and one rotation per gear. */
#include "../coupled/coupled-motion.h"
#include "../coupled/coupled-shooting.h"
#include "references.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The motion that a case of a chain passes to the next case. */
typedef struct handed {
    char mark[16];
    double mesh_frequency;        /* Hz; 0: there is no motion */
    double state[DYNAMICS_TAKEN]; /* state at phase 0: m, m/s */
} handed;
static const char mark[16] = "coupled 1";

typedef struct model {
    const ff_host *host;
    double zeta, tolerance, settle_tolerance;
    int32_t damping, force, branch;
    dynamics_inertia inertia;
    ff_reals bearing, bearing_zeta, mass; /* bearing in N/m, bearing_zeta in 1, mass in kg; one
                                             value or two; mass empty: the masses of the gears */
    int64_t cycles_settle, cycles_measured, steps_per_cycle;
    handed from, to; /* motion from the neighbouring case; motion for the next case */
} model;

static const ff_param params[] = {
    FF_QUANTITY("damping_ratio", "1", model, zeta, 0, "0.01", NULL, 0, 10, 1e-3, 0.2,
                "damping of the mesh over critical damping at the mean stiffness, c/(2 sqrt(k m))"),
    FF_ONE_OF("always|contact|clipped", "damping", model, damping, 0, "always",
              "when the mesh damper acts. always: also in free flight (Li & Kahraman 2011); "
              "contact: only in contact; clipped: only in contact, and the mesh force never pulls"),
    FF_ONE_OF(
        "lower|upper", "branch", model, branch, 0, "lower",
        "motion that is shown if several exist. lower: the motion without contact loss if it is "
        "stable, otherwise the motion to which a slow rise of the speed from 0.7 times the mesh "
        "frequency leads; upper: the motion to which a slow fall from 1.4 times the natural "
        "frequency of the mesh leads. In a chain of cases over the speed, branch applies to the "
        "first case"),
    DYNAMICS_FORCE_ROW(model),
    FF_QUANTITY("equivalent_mass", "kg", model, inertia.equivalent_mass, FF_MIN_OPEN, NULL,
                "inertia", 0, 1e9, 0, 0,
                "equivalent mass at the mesh spring in rotation; default: that of the gear"),
    FF_QUANTITY("natural_frequency", "Hz", model, inertia.natural_frequency, FF_MIN_OPEN, NULL,
                "inertia", 0, 1e9, 0, 0,
                "natural frequency of the linear mesh on rigid bearings at the mean stiffness, "
                "instead of equivalent_mass"),
    FF_LIST("bearing_stiffness", "N/m", model, bearing, FF_REQUIRED | FF_MIN_OPEN, NULL, NULL, 0,
            1e15, 1e7, 1e11, 1, 2,
            "radial stiffness of shaft and bearings of each gear, the same in all directions; "
            "one value or two"),
    FF_LIST("bearing_damping_ratio", "1", model, bearing_zeta, 0, "0.02", NULL, 0, 10, 1e-3, 0.2, 1,
            2,
            "damping of each gear on its bearings over critical damping, c/(2 sqrt(k m)); one "
            "value or two"),
    FF_LIST("gear_mass", "kg", model, mass, FF_MIN_OPEN, NULL, NULL, 0, 1e9, 0, 0, 1, 2,
            "masses that move on the bearings; default: those of the gears; one value or two"),
    FF_COUNT_OR(
        "auto", "cycles_settle", model, cycles_settle, FF_TUNABLE, "auto", NULL, 1, 1e6, 0, 0,
        "largest number of mesh cycles for settling if shooting does not find the motion; auto: "
        "four times the number that the damping requires"),
    FF_COUNT("cycles_measured", model, cycles_measured, 0, "16", NULL, 1, 256, 0, 0,
             "mesh cycles shown if the motion is not periodic"),
    FF_COUNT("steps_per_cycle", model, steps_per_cycle, FF_TUNABLE, "512", NULL, 16, 65536, 0, 0,
             "points shown per mesh cycle; they do not affect the steps of the integrator"),
    FF_QUANTITY("tolerance", "1", model, tolerance, FF_TUNABLE, "1e-9", NULL, 1e-13, 1e-3, 1e-12,
                1e-6, "error of one integration step over the static deflection"),
    FF_QUANTITY("settle_tolerance", "1", model, settle_tolerance, FF_TUNABLE, "1e-6", NULL, 1e-12,
                1e-2, 1e-10, 1e-4,
                "the motion has settled if its distance to the periodic motion, over the static "
                "deflection, is below this"),
};

static ff_status ready(void *self)
{
    const model *m = self;
    dynamics_tell_servings(m->host, &m->inertia, m->zeta);
    return FF_OK;
}

static ff_status check_gears(const model *m, const ff_array *in)
{
    for (int i = DYNAMICS_INPUT_COUNT; i < DYNAMICS_COUPLED_INPUT_COUNT; i++) {
        const char *name = dynamics_input_ports[i].name;
        int pair = i != DYNAMICS_IN_CENTRE_DISTANCE;
        if (!in[i].data)
            continue;
        if (pair && (in[i].rank != 1 || in[i].shape[0] != 2))
            return ff_failf(m->host, FF_INVALID, name, "must be two values, one for each gear");
        for (int k = 0; k <= pair; k++)
            if (!(in[i].data[k] > 0 && isfinite(in[i].data[k])))
                return ff_failf(m->host, FF_INVALID, name, "must be above 0, but is %g %s",
                                in[i].data[k], dynamics_input_ports[i].unit);
    }
    const double *base = in[DYNAMICS_IN_BASE_RADIUS].data,
                 centre = in[DYNAMICS_IN_CENTRE_DISTANCE].data[0];
    if (!(centre > (base[0] + base[1]) * (1 + 1e-9)))
        return ff_failf(m->host, FF_INVALID, dynamics_input_ports[DYNAMICS_IN_CENTRE_DISTANCE].name,
                        "must be above the sum of the base radii, %g m, but is %g m",
                        base[0] + base[1], centre);
    if (m->mass.count == 0 && !in[DYNAMICS_IN_MASS].data)
        return ff_failf(m->host, FF_INVALID, "gear_mass",
                        "the masses are not known: give gear_mass, or wire a gear that gives mass");
    return FF_OK;
}

/* Makes the checked inputs dimensionless. The damping coefficient of each gear is c = 2 zeta sqrt(k
   m). */
static ff_status build_pair(const model *m, const ff_array *in, const dynamics_inputs *inputs,
                            dynamics_coupled *pair)
{
    const dynamics_excitation *excitation = pair->excitation;
    const double *base = in[DYNAMICS_IN_BASE_RADIUS].data;
    double unit_mass = excitation->stiffness / (excitation->omega * excitation->omega);
    pair->base = (base[0] + base[1]) / excitation->length;
    pair->centre = in[DYNAMICS_IN_CENTRE_DISTANCE].data[0] / excitation->length;
    pair->line = sqrt((pair->centre - pair->base) * (pair->centre + pair->base));
    pair->angle = atan2(pair->line, pair->base);
    pair->base_1 = base[0] / excitation->length;
    pair->base_pitch = pair->base_1 * inputs->pitch;
    for (int i = 0; i < 2; i++) {
        pair->mass[i] =
            (m->mass.count > 0 ? ff_of_both(&m->mass, i) : in[DYNAMICS_IN_MASS].data[i]) /
            unit_mass;
        pair->bearing[i] = ff_of_both(&m->bearing, i) / excitation->stiffness;
        pair->damper[i] =
            2 * ff_of_both(&m->bearing_zeta, i) * sqrt(pair->bearing[i] * pair->mass[i]);
    }
    double *cycle = calloc(2 * inputs->stations, sizeof *cycle), *share = cycle + inputs->stations;
    if (!cycle)
        return FF_NOMEM;
    int known = inputs->load_share || inputs->line_force > 0;
    for (size_t i = 0; i < inputs->stations; i++) {
        cycle[i] = fmax((inputs->roll_angle[i] - inputs->roll_sap) / inputs->pitch, 0);
        if (known)
            share[i] = inputs->load_share ? inputs->load_share[i]
                                          : inputs->tooth_force[i] / inputs->line_force;
    }
    int built =
        dynamics_coupled_pair_stiffness(pair, inputs->stations, cycle, known ? share : NULL);
    free(cycle);
    return built ? FF_OK : FF_NOMEM;
}

static void report(const model *m, const dynamics_coupled_motion *motion, double largest)
{
    const ff_host *host = m->host;
    dynamics_periodicity_line(&motion->settled, m->settle_tolerance,
                              "the motion does not repeat within 8 mesh cycles: it is aperiodic, "
                              "or it needs a larger cycles_settle",
                              host);
    host->quality(host->ctx, "settled_cycles", (double)motion->settled.cycles,
                  (double)motion->settled.limit, FF_GOOD, NULL);
    double limit = m->tolerance * fmax(1e4, 2 * (double)motion->cycles * motion->T);
    host->quality(host->ctx, "energy_balance", motion->energy_error, limit,
                  motion->energy_error <= limit ? FF_GOOD : FF_DOUBTFUL, NULL);
    if (motion->settled.period > 0)
        host->quality(host->ctx, "stability", largest, 1, largest < 1 ? FF_GOOD : FF_DOUBTFUL,
                      largest < 1 ? NULL
                                  : "largest Floquet multiplier: a disturbance of this "
                                    "motion does not decay");
}

static ff_status fail_too_many_steps(const ff_host *host, const dynamics_inputs *inputs)
{
    return ff_failf(host, FF_NOCONV, "bearing_stiffness",
                    "a mesh frequency of %g Hz with bearings this stiff takes too many steps; "
                    "use softer bearings, a higher speed, or dynamics/time-integration with "
                    "rigid bearings",
                    inputs->mesh_frequency);
}

/* Returns the highest natural frequency of a gear on its bearings, relative to that of the mesh. */
static double highest_frequency(const dynamics_coupled *pair)
{
    return sqrt(1 + fmax(pair->bearing[0] / pair->mass[0], pair->bearing[1] / pair->mass[1]));
}

/* Returns the unit of a component of the state. */
static double unit_of(const dynamics_excitation *excitation, int i)
{
    return excitation->length * (i < DYNAMICS_RATES ? 1 : excitation->omega);
}

static void take_over(const handed *from, const dynamics_excitation *excitation,
                      const dynamics_inputs *inputs, dynamics_coupled_motion *motion)
{
    motion->from = from->mesh_frequency / inputs->natural_frequency;
    for (int i = 0; i < DYNAMICS_TAKEN; i++)
        motion->state[i] = from->state[i] / unit_of(excitation, i);
}

static void hand_on(const dynamics_coupled_motion *motion, const dynamics_excitation *excitation,
                    const dynamics_inputs *inputs, handed *to)
{
    memcpy(to->mark, mark, sizeof mark);
    to->mesh_frequency = inputs->mesh_frequency;
    for (int i = 0; i < DYNAMICS_TAKEN; i++)
        to->state[i] = motion->state[i] * unit_of(excitation, i);
}

static ff_status output_motion(model *m, const dynamics_coupled *pair,
                               const dynamics_inputs *inputs)
{
    double multipliers[2 * DYNAMICS_TAKEN], largest = 0;
    dynamics_coupled_motion motion = {.T = 2 * M_PI * inputs->natural_frequency /
                                           inputs->mesh_frequency};
    dynamics_settling how = {
        .branch = (dynamics_branch)m->branch,
        .T = motion.T,
        .cycles = dynamics_count_or_auto(m->cycles_settle),
        .tolerance = m->settle_tolerance,
        .step_tolerance = m->tolerance,
        .host = m->host,
    };
    if (m->from.mesh_frequency > 0)
        take_over(&m->from, pair->excitation, inputs, &motion);
    m->from.mesh_frequency = m->to.mesh_frequency = 0;
    if (motion.T * highest_frequency(pair) > dynamics_longest_cycle)
        return fail_too_many_steps(m->host, inputs);
    dynamics_coupled_run *run = dynamics_coupled_run_new(pair, m->tolerance);
    ff_status status = run ? dynamics_coupled_settle(run, pair, &how, &motion) : FF_NOMEM;
    if (status == FF_OK && motion.settled.period != DYNAMICS_UNBOUNDED)
        hand_on(&motion, pair->excitation, inputs, &m->to);
    motion.cycles =
        motion.settled.period > 0 ? (size_t)motion.settled.period : (size_t)m->cycles_measured;
    motion.cycles = motion.settled.period == DYNAMICS_UNBOUNDED ? 1 : motion.cycles;
    if (status == FF_OK)
        status = dynamics_coupled_motion_record(&motion, pair, inputs, m->tolerance,
                                                (size_t)m->steps_per_cycle, m->host);
    if (status == FF_OK)
        status = dynamics_coupled_multipliers(motion.monodromy, multipliers, &largest);
    if (status == FF_OK)
        report(m, &motion, largest);
    if (status == FF_OK)
        status = dynamics_coupled_put(&motion, pair, inputs, m->host);
    if (status == FF_NOCONV)
        status = fail_too_many_steps(m->host, inputs);
    free(motion.record.samples);
    dynamics_coupled_run_free(run);
    return status;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    model *m = self;
    dynamics_excitation excitation = {
        .zeta = m->zeta, .damping = m->damping, .shared = m->force == 1};
    dynamics_coupled pair = {.excitation = &excitation};
    dynamics_inputs inputs;
    if (in[DYNAMICS_IN_LINE_FORCE].data[0] < 0)
        return ff_failf(m->host, FF_UNSUPPORTED, "operating.line_force",
                        "the torque is below 0, but gears on elastic bearings are computed for a "
                        "driving gear 1 only: exchange gear 1 and gear 2 in the file and give a "
                        "torque above 0, or use another model of the kind dynamics");
    ff_status status = dynamics_inputs_read(m->host, in, &m->inertia, &inputs, &excitation);
    inputs.wanted = wanted;
    inputs.back = 0;
    if (status == FF_OK)
        status = dynamics_refuse_fluctuation(m->host, &in[DYNAMICS_IN_FLUCTUATION_ORDER],
                                             "a gear on its bearings");
    if (status == FF_OK)
        status = check_gears(m, in);
    if (status == FF_OK)
        status = build_pair(m, in, &inputs, &pair);
    if (status == FF_OK)
        status = output_motion(m, &pair, &inputs);
    dynamics_coupled_free(&pair);
    dynamics_excitation_free(&excitation);
    return status;
}

static ff_status carry(void *self, const ff_state_bytes *from, ff_state_bytes *to)
{
    model *m = self;
    m->from.mesh_frequency = 0;
    if (from && from->count == sizeof m->from && !memcmp(from->bytes, mark, sizeof mark))
        memcpy(&m->from, from->bytes, sizeof m->from);
    if (to) {
        to->bytes = &m->to;
        to->count = m->to.mesh_frequency > 0 ? sizeof m->to : 0;
    }
    return FF_OK;
}

FF_MODEL(dynamics_coupled_model, model, .id = "dynamics/coupled", .version = "1.0.0",
         .summary = "non-linear dynamics of the gear pair on elastic bearings, with two "
                    "translations and a rotation per gear; backlash, pressure angle and contact "
                    "ratio depend on the centre distance",
         .reference = "Kim, Yoo & Chung 2010, Dynamic analysis for a pair of spur gears with "
                      "translational motion due to bearing deformation, J. Sound Vib. 329, "
                      "4409-4421; Li & Kahraman 2011, Proc. IMechE J 225, 740-753, eqs 2-5",
         .bibtex = BIB_kim2010gears "\n", .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
         .inputs = dynamics_input_ports, .input_count = DYNAMICS_COUPLED_INPUT_COUNT,
         .input_stride = sizeof dynamics_input_ports[0], .outputs = dynamics_coupled_outputs,
         .output_count = DYNAMICS_COUPLED_OUTPUT_COUNT,
         .output_stride = sizeof dynamics_coupled_outputs[0], .ready = ready, .evaluate = evaluate,
         .destroy = free, .carry = carry);
FF_EXPORT_MODELS(&dynamics_coupled_model);
