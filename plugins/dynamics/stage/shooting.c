/* SPDX-License-Identifier: GPL-3.0-or-later */
/* dynamics/shooting: every periodic motion, whether stable or not, as a fixed point of the return
   map. */
#include "../continuation/atlas-report.h"
#include "../continuation/jump-search.h"
#include "../continuation/stable-motions.h"
#include "../excitation/film-wire.h"
#include "../excitation/warm-start.h"
#include "../oil/oil.h"
#include "../orbits/attractor.h"
#include "../orbits/periodicity.h"
#include "../orbits/trajectory.h"
#include "../oscillator/full-contact.h"
#include "references.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct model {
    const ff_host *host;
    double zeta, atlas_from, atlas_to, arc_step;
    int32_t damping, force, knows; /* KNOWS_... for `knows` */
    const char *branch_word;
    dynamics_inertia inertia;
    dynamics_oil oil;
    dynamics_film_wire wire;
    int64_t max_period, speeds, starts, cycles_settle, cycles_measured, steps_per_cycle;
    int by_name; /* 0: the branch is lower or upper; 1: the branch of the atlas called `name` */
    int largest; /* whether the branch is `largest` */
    dynamics_branch branch;
    dynamics_branch_name name;
    dynamics_warm_start from, to; /* motion from the neighbouring case; motion for the next case */
} model;

/* The motions that stable_motions counts, from which the branch `largest` is chosen. */
enum { KNOWS_STARTS, KNOWS_ATLAS };

static const ff_param params[] = {
    DYNAMICS_DAMPING_RATIO_ROW(model, 1e-4),
    DYNAMICS_DAMPING_ROW(model),
    FF_PHRASE(
        "branch", model, branch_word, 0, "lower", NULL,
        "motion that is shown if several exist. lower: the motion without contact loss if it is "
        "stable, otherwise the motion to which a slow rise of the speed from 0.7 times the mesh "
        "frequency leads; upper: the motion to which a slow fall from 1.4 times the natural "
        "frequency leads (at the end of its branch the motion settles to another branch); largest: "
        "the motion with the largest rms of those that stable_motions counts; or the name of a "
        "branch of the atlas, such as p2-1. In a chain of cases over the speed, lower and upper "
        "apply to the first case, largest to every case"),
    FF_ONE_OF("starts|atlas", "known_motions", model, knows, 0, "starts",
              "stable motions that stable_motions counts, and from which branch: largest chooses. "
              "starts: the motions to which lower, upper and 16 other starts lead; atlas: also the "
              "motions of the atlas, which takes about 50 times as long"),
    DYNAMICS_FORCE_ROW(model),
    DYNAMICS_INERTIA_ROWS(model),
    DYNAMICS_OIL_ROWS(model),
    DYNAMICS_FILM_WIRE_ROWS(model),
    FF_QUANTITY("atlas.from", "Hz", model, atlas_from, FF_MIN_OPEN, NULL, NULL, 0, 1e9, 0, 0,
                "lowest mesh frequency of the atlas; default: natural_frequency/8"),
    FF_QUANTITY("atlas.to", "Hz", model, atlas_to, FF_MIN_OPEN, NULL, NULL, 0, 1e9, 0, 0,
                "highest mesh frequency of the atlas; default: 1.4 natural_frequency"),
    FF_COUNT("max_period", model, max_period, 0, "6", NULL, 1, DYNAMICS_PERIOD_MAX, 0, 0,
             "longest period that is tried, in mesh cycles"),
    FF_COUNT("search_speeds", model, speeds, 0, "24", NULL, 0, 10000, 0, 0,
             "number of speeds at which the atlas is searched for isolated motions"),
    FF_COUNT("search_starts", model, starts, 0, "16", NULL, 0, 10000, 0, 0,
             "number of starts of the search at each speed"),
    FF_QUANTITY("arc_step", "1", model, arc_step, 0, "0.04", NULL, 1e-4, 0.5, 1e-3, 0.1,
                "longest step along a branch, over the size of the motion"),
    FF_COUNT_OR(
        "auto", "cycles_settle", model, cycles_settle, FF_TUNABLE, "auto", NULL, 1, 1e6, 0, 0,
        "largest number of mesh cycles in which the lower or upper motion may settle; auto: four "
        "times the number that the damping requires"),
    FF_COUNT("cycles_measured", model, cycles_measured, 0, "64", NULL, 1, 1024, 0, 0,
             "mesh cycles shown if the motion is not periodic"),
    FF_COUNT("steps_per_cycle", model, steps_per_cycle, FF_TUNABLE, "512", NULL, 16, 65536, 0, 0,
             "points shown per mesh cycle; the solver does not depend on them"),
};

static const uint64_t power_bits =
    FF_BIT(DYNAMICS_POWER_OUTPUT_COUNT) - FF_BIT(DYNAMICS_ATLAS_OUTPUT_COUNT);
static const uint64_t motion_bits = FF_BIT(DYNAMICS_MOTION_OUTPUT_COUNT) - 1;

/* Accuracy to which a motion settles if cycles_settle is auto, before Newton's method starts. */
static const double settle_tolerance = 1e-4;

static ff_status set_branch(model *m)
{
    const char *text = m->branch_word;
    m->by_name = 0;
    m->largest = !strcmp(text, "largest");
    m->branch = DYNAMICS_BRANCH_LOWER;
    if (!strcmp(text, "lower"))
        return FF_OK;
    m->branch = DYNAMICS_BRANCH_UPPER;
    if (m->largest || !strcmp(text, "upper"))
        return FF_OK;
    m->by_name = dynamics_branch_parse(text, &m->name);
    return m->by_name
               ? FF_OK
               : ff_failf(
                     m->host, FF_INVALID, "branch",
                     "must be lower, upper, largest or the name of a branch of the atlas, p1-1 "
                     "to p%d-9999, not \"%.40s\"",
                     DYNAMICS_PERIOD_MAX, text);
}

static ff_status ready(void *self)
{
    model *m = self;
    if (m->atlas_from > 0 && m->atlas_to > 0 && m->atlas_to <= m->atlas_from)
        return ff_failf(m->host, FF_INVALID, "atlas.to", "must be above atlas.from, %g Hz",
                        m->atlas_from);
    ff_status status = set_branch(m);
    if (status == FF_OK)
        status = dynamics_oil_check(m->host, &m->oil, m->damping);
    int only_shown = !m->by_name && !(m->largest && m->knows == KNOWS_ATLAS);
    const ff_serving rows[] = {
        {only_shown, "search_speeds", DYNAMICS_ATLAS_OUTPUTS, NULL, NULL},
        {only_shown, "search_starts", DYNAMICS_ATLAS_OUTPUTS, NULL, NULL},
        {!m->largest, "known_motions", "stable_motions", NULL, NULL},
    };
    dynamics_tell_servings(m->host, &m->inertia, m->zeta);
    ff_serve(m->host, rows, sizeof rows / sizeof rows[0]);
    if (only_shown)
        dynamics_tell_atlas(m->host, DYNAMICS_ATLAS_OUTPUTS);
    return status;
}

/* The data of one evaluation. */
typedef struct job {
    const model *m;
    uint64_t wanted;
    dynamics_inputs inputs;
    dynamics_excitation excitation;
    dynamics_flow flow;
    dynamics_atlas atlas;
    double lambda;
    int in_loop;  /* whether a film is wired back and this is not the first round */
    int searched; /* whether `known` has been computed at lambda */
    dynamics_known_motions known;
    dynamics_film_powers powers; /* powers of the film that is wired back */
    dynamics_warm_start to;      /* motion for the next case */
} job;

static ff_status build_atlas(job *j)
{
    const model *m = j->m;
    double natural = j->inputs.unit_frequency, from = m->atlas_from, to = m->atlas_to;
    ff_status status = dynamics_atlas_bounds(m->host, j->inputs.natural_frequency, &from, &to);
    if (status != FF_OK)
        return status;
    if (dynamics_cycle_duration(log(from / natural)) > 0.1 * dynamics_longest_cycle)
        return ff_failf(m->host, FF_INVALID, "atlas.from",
                        "the atlas cannot begin at %g Hz, too far below the natural frequency, %g "
                        "Hz",
                        from, j->inputs.natural_frequency);
    dynamics_atlas_request request = {
        .low = log(from / natural),
        .high = log(to / natural),
        .step = m->arc_step,
        .max_period = (int)m->max_period,
        .speeds = (size_t)m->speeds,
        .starts = (size_t)m->starts,
        .moments = (j->wanted & FF_BIT(DYNAMICS_OUT_ATLAS_RMS)) != 0,
    };
    return dynamics_atlas_build(&j->flow, &request, m->host, &j->atlas);
}

static ff_status find_named(const job *j, dynamics_attractor *a)
{
    const model *m = j->m;
    const dynamics_atlas_branch *branch = dynamics_atlas_find(&j->atlas, m->name);
    if (branch && dynamics_atlas_orbit(&j->flow, &j->atlas, branch, j->lambda, &a->orbit)) {
        a->period = a->orbit.period;
        memcpy(a->x, a->orbit.x, sizeof a->x);
        return FF_OK;
    }
    char names[400], where[80] = "is not in the atlas";
    double natural = j->inputs.unit_frequency;
    dynamics_atlas_list(&j->flow, &j->atlas, j->lambda, names, sizeof names);
    if (branch)
        snprintf(where, sizeof where, "runs from %.6g to %.6g Hz", natural * exp(branch->low),
                 natural * exp(branch->high));
    return ff_failf(m->host, FF_INVALID, "branch", "p%d-%d %s; at %g Hz there are: %s",
                    m->name.period, m->name.number, where, j->inputs.mesh_frequency, names);
}

/* Searches for the known motions, once for all outputs. */
static ff_status find_known(job *j)
{
    const dynamics_atlas *atlas = j->m->knows == KNOWS_ATLAS ? &j->atlas : NULL;
    if (j->searched)
        return FF_OK;
    j->searched = 1;
    return dynamics_known_motions_find(&j->flow, j->lambda, atlas, j->m->host, &j->known);
}

/* Chooses the stable motion with the largest rms. If none is known, the motion of the upper branch
   remains. */
static ff_status find_largest(job *j, dynamics_attractor *a)
{
    ff_status status = find_known(j);
    if (status == FF_OK && dynamics_known_motions_largest(&j->flow, &j->known, &a->orbit)) {
        a->period = a->orbit.period;
        memcpy(a->x, a->orbit.x, sizeof a->x);
    }
    return status;
}

static ff_status find_motion(job *j, dynamics_attractor *a)
{
    const model *m = j->m;
    if (m->by_name)
        return find_named(j, a);
    double T = dynamics_cycle_duration(j->lambda);
    dynamics_search search = {j->lambda, (int)m->max_period,
                              dynamics_count_or_auto(m->cycles_settle), 1};
    if (!search.cycles)
        search.cycles = dynamics_settle_limit(&j->excitation, T, settle_tolerance);
    if (m->from.mesh_frequency > 0 && (!m->largest || j->in_loop)) {
        dynamics_orbit from = {.period = m->from.period <= DYNAMICS_PERIOD_MAX ? (int)m->from.period
                                                                               : DYNAMICS_APERIODIC,
                               .lambda = log(m->from.mesh_frequency / j->inputs.unit_frequency)};
        dynamics_warm_start_state(&m->from, &j->excitation, from.x);
        if (dynamics_cycle_duration(from.lambda) <= dynamics_longest_cycle)
            return dynamics_attract_from(&j->flow, &from, &search, m->host, a);
    }
    if (m->largest) {
        ff_status status = find_largest(j, a);
        if (status != FF_OK || a->period > 0)
            return status;
    }
    return dynamics_attract_branch(&j->flow, m->branch, &search, m->host, a);
}

static ff_status output_motion(const job *j, const dynamics_attractor *a)
{
    const model *m = j->m;
    dynamics_motion motion = {
        .excitation = &j->excitation, .period = a->period, .T = dynamics_cycle_duration(j->lambda)};
    motion.cycles =
        a->period > 0 ? (size_t)a->period : dynamics_cycles(&j->inputs, m->cycles_measured);
    if (a->period == DYNAMICS_UNBOUNDED)
        motion.cycles = 1;
    if (j->excitation.film)
        motion.films = a->period > 0 ? a->orbit.films.film : NULL;
    ff_status status = dynamics_trajectory_record(
        &j->flow, &j->inputs, (size_t)m->steps_per_cycle * j->inputs.span, a->x, &motion);
    if (status == FF_OK)
        dynamics_periodicity_report(a, &motion, (int)m->max_period, m->host);
    if (status == FF_OK)
        status = dynamics_motion_put(&motion, &j->inputs, m->host);
    if (status == FF_OK)
        status = dynamics_motion_put_powers(&motion, &j->powers, m->host);
    dynamics_record_free(&motion.record);
    return status;
}

static ff_status fail_too_slow(const job *j)
{
    return ff_failf(j->m->host, FF_NOCONV, "operating.mesh_frequency",
                    "a mesh frequency of %g Hz is so far below the natural frequency of %g Hz that "
                    "every mesh cycle contains too many vibrations; use dynamics/quasi-static",
                    j->inputs.mesh_frequency, j->inputs.natural_frequency);
}

static ff_status find_at(const void *ctx, double lambda, dynamics_attractor *a)
{
    job j = *(const job *)ctx;
    j.lambda = lambda;
    j.searched = 0;
    j.known = (dynamics_known_motions){.count = 0};
    ff_status status = find_motion(&j, a);
    dynamics_known_motions_free(&j.known);
    return status;
}

/* A motion is doubtful if a fold is within this relative distance of its speed, since the speed of
   a machine is not known more accurately. */
static const double near_fold = 0.005;

static void report_jump(const job *j, const dynamics_jump *jump)
{
    const ff_host *host = j->m->host;
    double micron = 1e6 * j->excitation.length, natural = j->inputs.unit_frequency;
    double distance = fabs(expm1(jump->lambda - j->lambda));
    char text[320];
    snprintf(text, sizeof text,
             jump->beside    ? "fold at %.6g Hz, %.2g %% from the mesh frequency: on one side of "
                               "the fold, the motion shown (dte_rms %.3g um) coexists with another "
                               "motion (%.3g um)"
             : jump->is_fold ? "fold at %.6g Hz, %.2g %% from the mesh frequency: the motion shown "
                               "(dte_rms %.3g um) may jump; beyond the fold there is another "
                               "motion (%.3g um)"
                             : "at %.6g Hz, %.2g %% from the mesh frequency, the motion is on "
                               "another branch: dte_rms is %.3g um here, %.3g um there",
             natural * exp(jump->lambda), 100 * distance, jump->rms * micron, jump->other * micron);
    host->quality(host->ctx, "distance_of_jump", distance, near_fold, FF_DOUBTFUL, text);
}

/* Looks for folds near the motion, on its own branch and on others. */
static ff_status find_jump(const job *j, const dynamics_attractor *motion)
{
    const model *m = j->m;
    dynamics_jump jump = {0};
    dynamics_jump_search n = {.flow = &j->flow,
                              .host = m->host,
                              .width = near_fold,
                              .step = m->arc_step,
                              .find = m->by_name ? NULL : find_at,
                              .ctx = j};
    ff_status status = dynamics_find_jump(&n, motion, &jump);
    if (status == FF_OK && !m->by_name && !jump.near)
        status = dynamics_find_fold_of_another(&n, motion, &jump);
    if (status == FF_OK && jump.near)
        report_jump(j, &jump);
    return status;
}

/* Warns that the atlas uses frozen films. A frozen film excites the motion but does not damp it.
   Far from the speed at which the film was computed, folds and multipliers therefore differ from
   those of motion and film together. */
static void report_frozen_films(const job *j)
{
    static const double near = 0.02;
    const model *m = j->m;
    double natural = j->inputs.natural_frequency, from = m->atlas_from, to = m->atlas_to;
    if (dynamics_atlas_bounds(m->host, natural, &from, &to) != FF_OK)
        return;
    double far =
        fmax(fabs(log(to / j->inputs.mesh_frequency)), fabs(log(from / j->inputs.mesh_frequency)));
    m->host->quality(
        m->host->ctx, "atlas_films", far, near, far <= near ? FF_GOOD : FF_DOUBTFUL,
        "largest distance of the atlas from the mesh frequency (natural logarithm of the ratio). "
        "The film that is wired back was computed at the mesh frequency and is frozen in the "
        "atlas: it excites the motion but does not damp it");
}

/* If the branch that was followed ended before the requested speed, reports where it ended. */
static void report_end(const job *j, const dynamics_attractor *a)
{
    const model *m = j->m;
    double natural = j->inputs.unit_frequency, end = natural * exp(a->ended);
    char text[200];
    if (m->by_name || a->ends == 0)
        return;
    snprintf(text, sizeof text,
             "the branch \"%s\" ends at %.8g Hz; from there the motion settled to the motion shown",
             m->largest ? "upper" : m->branch_word, end);
    m->host->quality(m->host->ctx, "branch_end", fabs(end / j->inputs.mesh_frequency - 1), 0,
                     FF_GOOD, text);
}

/* Writes the number of stable motions, and reports whether the atlas has more stable motions. */
static ff_status put_known(job *j)
{
    const ff_host *host = j->m->host;
    char text[160];
    ff_status status = find_known(j);
    if (status == FF_OK)
        status = dynamics_known_motions_put(&j->flow, &j->known, host);
    if (status != FF_OK || !j->atlas.curves || j->m->knows == KNOWS_ATLAS)
        return status;
    if (!dynamics_known_motions_add_atlas(&j->flow, &j->atlas, j->lambda, &j->known))
        return FF_NOMEM;
    snprintf(text, sizeof text,
             "the atlas has %zu more stable motions at this speed than stable_motions counts; "
             "known_motions: atlas counts them",
             j->known.of_atlas);
    if (j->known.of_atlas)
        host->quality(host->ctx, "uncounted_motions", (double)j->known.of_atlas, 0, FF_DOUBTFUL,
                      text);
    return FF_OK;
}

/* Gears that float have no isolated motion, so there is nothing to count, and there are no
   branches. */
static ff_status put_floating(const job *j)
{
    const model *m = j->m;
    const dynamics_motion none = {.excitation = &j->excitation, .cycles = 1, .T = 1};
    if ((j->wanted & ~power_bits) >> DYNAMICS_SPEED_OUTPUT_COUNT || m->by_name)
        return ff_failf(m->host, FF_UNSUPPORTED, m->by_name ? "branch" : "operating.line_force",
                        "without a torque the gears float, and there is no branch of motions: "
                        "give a torque, or do not request the atlas");
    ff_status status = dynamics_motion_put_floating(&j->inputs, &j->excitation, m->host);
    if (status == FF_OK)
        status = dynamics_motion_put_powers(&none, &(dynamics_film_powers){0, 0}, m->host);
    return status == FF_OK ? ff_put_scalar(m->host, DYNAMICS_OUT_STABLE_MOTIONS, 0) : status;
}

static ff_status evaluate_job(job *j)
{
    const model *m = j->m;
    dynamics_attractor a = {.period = DYNAMICS_APERIODIC};
    int needs_motion = (j->wanted & (motion_bits | power_bits)) != 0;
    int needs_atlas = ((j->wanted & ~power_bits) >> DYNAMICS_SPEED_OUTPUT_COUNT) != 0;
    int needs_known = (j->wanted & FF_BIT(DYNAMICS_OUT_STABLE_MOTIONS)) != 0;
    int knows_atlas = m->knows == KNOWS_ATLAS && (needs_known || (needs_motion && m->largest));
    ff_status status = FF_OK;
    j->lambda = log(j->inputs.mesh_frequency / j->inputs.unit_frequency);
    if (needs_motion && dynamics_cycle_duration(j->lambda) > dynamics_longest_cycle)
        return fail_too_slow(j);
    if (dynamics_floats(&j->inputs, &j->excitation))
        return put_floating(j);
    if (!dynamics_flow_init(&j->flow, &j->excitation))
        return FF_NOMEM;
    if (needs_atlas || knows_atlas || (needs_motion && m->by_name))
        status = build_atlas(j);
    if (status == FF_OK && needs_motion)
        status = find_motion(j, &a);
    if (status == FF_OK && a.period > 1) {
        dynamics_orbit_order(&j->flow, &a.orbit);
        memcpy(a.x, a.orbit.x, sizeof a.x);
    }
    if (status == FF_OK && needs_motion)
        report_end(j, &a);
    if (status == FF_OK && needs_motion)
        status = output_motion(j, &a);
    if (status == FF_OK && needs_motion && a.period != DYNAMICS_UNBOUNDED)
        j->to = dynamics_warm_start_motion(&j->excitation, j->inputs.mesh_frequency, a.period,
                                           a.x[0], a.x[1]);
    if (status == FF_NOCONV)
        return fail_too_slow(j);
    if (status == FF_OK && needs_known)
        status = put_known(j);
    if (status == FF_OK && needs_known && a.period > 0)
        status = find_jump(j, &a);
    if (status == FF_OK && j->atlas.curves)
        dynamics_atlas_report(&j->flow, &j->atlas, j->lambda, a.period > 0 ? &a.orbit : NULL,
                              m->host);
    if (needs_atlas && j->in_loop)
        report_frozen_films(j);
    if (status == FF_OK && needs_atlas)
        status = dynamics_atlas_put(&j->atlas, &j->excitation, j->inputs.unit_frequency, m->host);
    return status;
}

static ff_status evaluate_driving(void *self, uint64_t wanted, const ff_array *in, int back)
{
    model *m = self;
    job j = {.m = m,
             .wanted = wanted,
             .excitation = {.zeta = m->zeta,
                            .damping = m->damping,
                            .shared = m->force == 1,
                            .on_chord = m->oil.squeeze == DYNAMICS_SQUEEZE_SERIES,
                            .both_flanks = m->oil.squeeze == DYNAMICS_SQUEEZE_NONE &&
                                           !dynamics_film_is_wired(in)}};
    ff_status status = dynamics_inputs_read(m->host, in, &m->inertia, &j.inputs, &j.excitation);
    j.inputs.wanted = wanted;
    j.inputs.back = back;
    dynamics_film *film = NULL;
    if (status == FF_OK)
        status = dynamics_motion_check_back(m->host, &j.inputs, &j.excitation);
    if (status == FF_OK)
        status = dynamics_oil_read(m->host, in, &m->oil, &j.inputs, &j.excitation, &film);
    if (status == FF_OK)
        status =
            dynamics_film_wire_read(m->host, in, &m->wire, &j.inputs, &j.excitation, &j.powers);
    j.in_loop = dynamics_film_is_wired(in);
    if (j.in_loop) /* a later round continues from the previous round */
        m->from = m->to;
    if (status == FF_OK)
        status = evaluate_job(&j);
    m->from.mesh_frequency = 0;
    m->to = j.to;
    dynamics_known_motions_free(&j.known);
    dynamics_atlas_free(&j.atlas);
    dynamics_flow_free(&j.flow);
    free(film);
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
    dynamics_shooting, model, .id = "dynamics/shooting", .version = "1.0.0",
    .summary = "every periodic motion of the gear pair with backlash, stable or not, to round-off",
    .reference = "Li & Kahraman 2011, Proc. IMechE J 225, 740-753, eqs 2-5; continuation: Keller "
                 "1977, Numerical solution of bifurcation and nonlinear eigenvalue problems",
    .bibtex = BIB_likahraman2011 "\n" BIB_keller1977 "\n", .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params), .inputs = dynamics_oil_input_ports,
    .input_count = DYNAMICS_OIL_INPUT_COUNT, .input_stride = sizeof dynamics_oil_input_ports[0],
    .outputs = dynamics_motion_outputs, .output_count = DYNAMICS_POWER_OUTPUT_COUNT,
    .output_stride = sizeof dynamics_motion_outputs[0], .ready = ready, .evaluate = evaluate,
    .destroy = free, .carry = carry, .cost = 3e-3);
FF_EXPORT_MODELS(&dynamics_shooting);
