/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "inputs.h"

#include "../../numerics/exchange.h"
#include "back-inputs.h"
#include "spring.h"
#include "tracks.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *name_of(int input)
{
    return dynamics_input_ports[input].name;
}

static ff_status check_finite(const ff_host *host, const ff_array *in)
{
    for (int i = 0; i < DYNAMICS_INPUT_COUNT; i++) {
        size_t count = in[i].data ? 1 : 0;
        for (uint32_t k = 0; in[i].data && k < in[i].rank; k++)
            count *= in[i].shape[k];
        for (size_t k = 0; k < count; k++)
            if (!isfinite(in[i].data[k]))
                return ff_failf(host, FF_INVALID, name_of(i), "value %zu is not a finite number",
                                k + 1);
    }
    return FF_OK;
}

static ff_status check_series(const ff_host *host, const ff_array *in, int input, size_t count)
{
    if (!in[input].data || (in[input].rank == 1 && in[input].shape[0] == count))
        return FF_OK;
    return ff_failf(host, FF_INVALID, name_of(input), "must be a series of %zu values", count);
}

static ff_status check_shapes(const ff_host *host, const ff_array *in)
{
    if (in[DYNAMICS_IN_TOOTH_FORCE].rank > 1 || in[DYNAMICS_IN_LOAD_SHARE].rank > 1)
        return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_TOOTH_FORCE),
                        "the motion repeats every mesh cycle, but the tooth forces cover "
                        "several: set mesh_cycle of the stiffness to a number or to worst");
    size_t phases = in[DYNAMICS_IN_PHASE].rank == 1 ? in[DYNAMICS_IN_PHASE].shape[0] : 0;
    size_t stations =
        in[DYNAMICS_IN_ROLL_ANGLE].rank == 1 ? in[DYNAMICS_IN_ROLL_ANGLE].shape[0] : 0;
    if (phases < 2)
        return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_PHASE), "needs at least 2 phases");
    if (stations < 1)
        return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_ROLL_ANGLE),
                        "needs at least 1 station");
    ff_status status = check_series(host, in, DYNAMICS_IN_STIFFNESS, phases);
    if (status == FF_OK)
        status = check_series(host, in, DYNAMICS_IN_TRANSMISSION_ERROR, phases);
    if (status == FF_OK)
        status = check_series(host, in, DYNAMICS_IN_LOADED_ERROR, phases);
    if (status == FF_OK)
        status = check_series(host, in, DYNAMICS_IN_TOOTH_FORCE, stations);
    if (status == FF_OK)
        status = check_series(host, in, DYNAMICS_IN_LOAD_SHARE, stations);
    return status;
}

static ff_status check_level_forces(const ff_host *host, const ff_array *force, size_t *count)
{
    *count = force->rank == 1 ? force->shape[0] : 0;
    for (size_t i = 0; i < *count; i++)
        if (i == 0 ? force->data[0] != 0 : !(force->data[i] > force->data[i - 1]))
            return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_FORCE_LEVEL),
                            "must increase from 0, but value %zu is %g N", i + 1, force->data[i]);
    return FF_OK;
}

static ff_status read_levels(const ff_host *host, const ff_array *in, dynamics_force_levels *l)
{
    const double **rows[] = {&l->error, &l->stiffness, &l->tooth_force};
    *l = (dynamics_force_levels){.phases = in[DYNAMICS_IN_PHASE].shape[0],
                                 .stations = in[DYNAMICS_IN_ROLL_ANGLE].shape[0]};
    if (!in[DYNAMICS_IN_FORCE_LEVEL].data)
        return FF_OK;
    l->force = in[DYNAMICS_IN_FORCE_LEVEL].data;
    ff_status status = check_level_forces(host, &in[DYNAMICS_IN_FORCE_LEVEL], &l->count);
    for (int i = 0; i < 3 && status == FF_OK; i++) {
        int input = DYNAMICS_IN_LEVEL_ERROR + i;
        size_t length = input == DYNAMICS_IN_LEVEL_TOOTH_FORCE ? l->stations : l->phases;
        *rows[i] = in[input].data;
        if (in[input].data &&
            (in[input].rank != 2 || in[input].shape[0] != l->count || in[input].shape[1] != length))
            status = ff_failf(host, FF_INVALID, name_of(input), "must be %zu rows of %zu values",
                              l->count, length);
    }
    return status;
}

/* Returns whether two transmission errors (m) agree within round-off relative to `size`. */
static int agree(double a, double z, double size)
{
    return fabs(a - z) <= 1e-6 * size + 1e-15;
}

/* Checks that row 0 of the levels is the unloaded transmission error, and that the row of the mean
   force is the loaded transmission error. */
static ff_status check_rows(const ff_host *host, const ff_array *in, const dynamics_force_levels *l,
                            double force)
{
    const double *rows[] = {in[DYNAMICS_IN_TRANSMISSION_ERROR].data,
                            in[DYNAMICS_IN_LOADED_ERROR].data};
    const int inputs[] = {DYNAMICS_IN_TRANSMISSION_ERROR, DYNAMICS_IN_LOADED_ERROR};
    for (size_t k = 0; k < l->count; k++) {
        int which = k == 0 ? 0 : fabs(l->force[k] - force) <= 1e-9 * force ? 1 : -1;
        for (size_t i = 0; which >= 0 && i < l->phases; i++) {
            double there = l->error[k * l->phases + i], known = rows[which] ? rows[which][i] : 0;
            if ((rows[which] || which == 0) &&
                !agree(there, known, l->error[(l->count - 1) * l->phases + i] - l->error[i]))
                return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_LEVEL_ERROR),
                                "is %g m under %g N at phase %g, but %s is %g m there", there,
                                l->force[k], in[DYNAMICS_IN_PHASE].data[i], name_of(inputs[which]),
                                known);
        }
    }
    return FF_OK;
}

/* Checks that the levels define a mesh force: errors must increase with the force, and slopes must
   be above 0. */
static ff_status check_levels(const ff_host *host, const ff_array *in,
                              const dynamics_force_levels *l, double force)
{
    if (l->count < 2 || !l->error)
        return ff_failf(host, FF_INVALID, "force",
                        "force: shared needs a stiffness with transmission errors at several "
                        "forces (force_level, level_error), such as stiffness/load-distribution "
                        "under a torque; or use force: frozen");
    if (!(force > 0))
        return ff_failf(host, FF_INVALID, "force",
                        "force: shared needs a line force or a reference force above 0, but it is "
                        "%g N; set reference_torque of the operating stage, or use force: frozen",
                        force);
    if (l->count > DYNAMICS_LINES)
        return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_FORCE_LEVEL),
                        "has %zu forces, more than %d", l->count, DYNAMICS_LINES);
    for (size_t k = 0; k < l->count; k++)
        for (size_t i = 0; i < l->phases; i++) {
            size_t at = k * l->phases + i;
            if (k > 0 && !(l->error[at] > l->error[at - l->phases]))
                return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_LEVEL_ERROR),
                                "must increase with the force, but at phase %g it is %g m under %g "
                                "N and %g m under %g N",
                                in[DYNAMICS_IN_PHASE].data[i], l->error[at - l->phases],
                                l->force[k - 1], l->error[at], l->force[k]);
            if (l->stiffness && !(l->stiffness[at] > 0))
                return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_LEVEL_STIFFNESS),
                                "must be above 0, but is %g N/m under %g N at phase %g",
                                l->stiffness[at], l->force[k], in[DYNAMICS_IN_PHASE].data[i]);
        }
    return check_rows(host, in, l, force);
}

static ff_status check_cycle(const ff_host *host, const ff_array *in)
{
    const double *phase = in[DYNAMICS_IN_PHASE].data, *k = in[DYNAMICS_IN_STIFFNESS].data;
    size_t n = in[DYNAMICS_IN_PHASE].shape[0];
    if (fabs(phase[0]) > 1e-9 || fabs(phase[n - 1] - 1) > 1e-9)
        return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_PHASE),
                        "must run from 0 to 1, not from %g to %g", phase[0], phase[n - 1]);
    for (size_t i = 1; i < n; i++)
        if (phase[i] < phase[i - 1])
            return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_PHASE),
                            "must not decrease, but %g follows %g", phase[i], phase[i - 1]);
    for (size_t i = 0; i < n; i++)
        if (k[i] < 0)
            return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_STIFFNESS),
                            "must not be negative, but is %g N/m at phase %g", k[i], phase[i]);
    return FF_OK;
}

typedef struct bound {
    int input;
    double above;
    int or_equal;
} bound;

static ff_status check_scalars(const ff_host *host, const ff_array *in)
{
    static const bound bounds[] = {
        {DYNAMICS_IN_TEETH, 0, 0},          {DYNAMICS_IN_BACKLASH, 0, 1},
        {DYNAMICS_IN_MESH_FREQUENCY, 0, 0}, {DYNAMICS_IN_STIFFNESS_MEAN, 0, 0},
        {DYNAMICS_IN_LINE_FORCE, 0, 1},     {DYNAMICS_IN_REFERENCE_FORCE, 0, 1},
        {DYNAMICS_IN_DRIVEN_MASS, 0, 1},
    };
    for (size_t i = 0; i < sizeof bounds / sizeof bounds[0]; i++) {
        double value = in[bounds[i].input].data ? in[bounds[i].input].data[0] : 1;
        if (!(bounds[i].or_equal ? value >= bounds[i].above : value > bounds[i].above))
            return ff_failf(host, FF_INVALID, name_of(bounds[i].input), "must %s, but is %g %s",
                            bounds[i].or_equal ? "not be negative" : "be above 0", value,
                            dynamics_input_ports[bounds[i].input].unit);
    }
    return FF_OK;
}

void dynamics_tell_servings(const ff_host *host, const dynamics_inertia *inertia, double zeta)
{
    const char *mass = name_of(DYNAMICS_IN_EQUIVALENT_MASS);
    const ff_serving rows[] = {
        {inertia->equivalent_mass > 0, mass, "", "equivalent_mass",
         "equivalent_mass replaces the inertia of the gear"},
        {inertia->natural_frequency > 0, mass, "", "natural_frequency",
         "natural_frequency replaces the inertia of the gear"},
        {!(zeta > 0) && !isnan(zeta), "damping", "", NULL, "damping_ratio is 0"},
    };
    ff_serve(host, rows, sizeof rows / sizeof rows[0]);
}

void dynamics_tell_atlas(const ff_host *host, const char *outputs)
{
    const ff_serving rows[] = {{1, "atlas.from", outputs, NULL, NULL},
                               {1, "atlas.to", outputs, NULL, NULL}};
    ff_serve(host, rows, sizeof rows / sizeof rows[0]);
}

ff_status dynamics_natural_frequency(const ff_host *host, const dynamics_inertia *inertia,
                                     const ff_array *gear_mass, double stiffness, double *frequency)
{
    double mass = inertia->equivalent_mass;
    *frequency = inertia->natural_frequency;
    if (*frequency > 0)
        return FF_OK;
    if (!(mass > 0) && gear_mass->data) {
        mass = gear_mass->data[0];
        if (!(mass > 0 && isfinite(mass)))
            return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_EQUIVALENT_MASS),
                            "must be above 0, but is %g kg", mass);
    }
    *frequency = mass > 0 ? sqrt(stiffness / mass) / (2 * M_PI) : 0;
    return FF_OK;
}

/* The default range contains the main resonance and the superharmonic resonances up to order 8. */
ff_status dynamics_atlas_bounds(const ff_host *host, double natural, double *from, double *to)
{
    const char *item = *to > 0 ? "atlas.to" : "atlas.from";
    *from = *from > 0 ? *from : natural / 8;
    *to = *to > 0 ? *to : 1.4 * natural;
    if (*to > *from)
        return FF_OK;
    return ff_failf(host, FF_INVALID, item,
                    "the range of the atlas, %g to %g Hz, must be positive "
                    "and increasing",
                    *from, *to);
}

/* Returns the unit of length: the static deflection; if that is 0, the range of the transmission
   error; if that is 0 too, a small part of the gap. */
static double length_unit(const ff_array *in, double force, double stiffness)
{
    double low = 0, high = 0, gap = in[DYNAMICS_IN_BACKLASH].data[0] / 2;
    const double *e = in[DYNAMICS_IN_TRANSMISSION_ERROR].data;
    for (size_t i = 0; e && i < in[DYNAMICS_IN_PHASE].shape[0]; i++) {
        low = i ? fmin(low, e[i]) : e[i];
        high = i ? fmax(high, e[i]) : e[i];
    }
    double unit = fmax(force / stiffness, high - low);
    unit = fmax(unit, 1e-6 * gap);
    return unit > 1e-15 ? unit : 1e-6;
}

static void read_stations(const ff_array *in, dynamics_inputs *inputs)
{
    inputs->stations = in[DYNAMICS_IN_ROLL_ANGLE].shape[0];
    inputs->roll_angle = in[DYNAMICS_IN_ROLL_ANGLE].data;
    inputs->roll_sap = in[DYNAMICS_IN_ROLL_SAP].data[0];
    inputs->pitch = 2 * M_PI / in[DYNAMICS_IN_TEETH].data[0];
    inputs->tooth_force = in[DYNAMICS_IN_TOOTH_FORCE].data;
    inputs->load_share = in[DYNAMICS_IN_LOAD_SHARE].data;
}

static ff_status check_stations(const ff_host *host, const dynamics_inputs *inputs)
{
    for (size_t i = 0; i < inputs->stations; i++) {
        double cycles = (inputs->roll_angle[i] - inputs->roll_sap) / inputs->pitch;
        if (!(cycles > -1e-9 && cycles < 10) ||
            (i && inputs->roll_angle[i] < inputs->roll_angle[i - 1]))
            return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_ROLL_ANGLE),
                            "must increase from the start of active profile by less than 10 mesh "
                            "cycles; station %zu is %g mesh cycles after it",
                            i + 1, cycles);
    }
    return FF_OK;
}

/* Reports how much the smooth pieces differ from the straight lines of the stiffness. If the
   straight lines sample a smooth curve, they deviate from that curve by the same amount. */
static void report_representation(const ff_host *host, const dynamics_excitation *excitation)
{
    static const double limit = 1e-4;
    const dynamics_representation *r = &excitation->represented;
    char text[200];
    if (!(r->at_nodes > 0 || r->between > 0))
        return;
    snprintf(text, sizeof text,
             "%zu straight lines of k(t) are replaced by %zu polynomial pieces, which deviate by "
             "%.1g of the mean stiffness at the nodes and by %.1g between them",
             r->lines, r->pieces, r->at_nodes, r->between);
    host->quality(host->ctx, "stiffness_representation", r->between, limit, FF_GOOD, text);
}

/* Reports which spring the motion uses if the slope k and the chord F/(e_l - e) differ. */
static void report_spring(const ff_host *host, const dynamics_spring_nodes *s)
{
    char text[300];
    static const double much = 0.05; /* relative difference between slope and chord */
    double off = fmax(s->soft, s->unknown);
    if (!s->stiffness)
        return;
    if (!s->lines) {
        snprintf(
            text, sizeof text,
            "with squeeze: series the mesh spring is the secant stiffness F/(e_l - e); the tangent "
            "stiffness at the mean load is %.3g %% higher on average",
            100 * s->steeper);
        host->quality(host->ctx, "mesh_slope", s->steeper, much,
                      s->steeper <= much ? FF_GOOD : FF_DOUBTFUL, text);
        return;
    }
    if (s->unknown > 0)
        snprintf(
            text, sizeof text,
            "at %.3g %% of the phases the loaded transmission error does not exceed the unloaded "
            "transmission error: the spring is linear there",
            100 * s->unknown);
    else if (s->soft > 0)
        snprintf(
            text, sizeof text,
            "at %.3g %% of the phases the tangent stiffness is below the secant stiffness F/(e_l - "
            "e), but a mesh stiffens under load: the secant is used there",
            100 * s->soft);
    else
        snprintf(
            text, sizeof text,
            "the mesh spring has the tangent stiffness at the mean load, on average %.3g %% above "
            "the secant stiffness F/(e_l - e); below half the mean force it is a straight line to "
            "contact loss at e",
            100 * s->steeper);
    host->quality(host->ctx, "mesh_slope", off, 0, off > 0 ? FF_DOUBTFUL : FF_GOOD, text);
}

/* Warns if there is neither a damper nor an oil film: then no disturbance decays. */
static void report_damping(const ff_host *host, const dynamics_excitation *excitation)
{
    if (excitation->zeta == 0 && !excitation->on_chord)
        host->quality(
            host->ctx, "damping", 0, 0, FF_DOUBTFUL,
            "damping_ratio is 0: no disturbance decays. The motion shown is one of many undamped "
            "motions, and a real machine would not settle to it");
}

static void report_shared(const ff_host *host, const dynamics_force_levels *l, double force,
                          double convex, double soft)
{
    static const double limit = 1e-3;
    char text[240];
    snprintf(text, sizeof text,
             "largest change of the mesh force over the mean force: at one of the %zu force "
             "levels, up to %.3g times the mean, it was below the tangent at a smaller level and "
             "was raised",
             l->count, l->force[l->count - 1] / force);
    host->quality(host->ctx, "mesh_force_convex", convex, limit,
                  convex <= limit ? FF_GOOD : FF_DOUBTFUL, text);
    if (soft > 0)
        host->quality(host->ctx, "soft_levels", soft, 0, FF_DOUBTFUL,
                      "share of the phases and forces at which level_stiffness is below the secant "
                      "from the previous force, but a mesh stiffens under load: the secant is used "
                      "there");
}

/* Makes the spring at the nodes of the curves. */
static ff_status make_spring(const ff_host *host, const ff_array *in, const dynamics_inputs *inputs,
                             const dynamics_excitation *excitation, dynamics_spring_nodes *spring)
{
    double force = inputs->reference, convex;
    if (!excitation->shared)
        return dynamics_spring_nodes_make(&inputs->curves, inputs->loaded_error, force,
                                          excitation->on_chord, spring)
                   ? FF_OK
                   : FF_NOMEM;
    ff_status status = check_levels(host, in, &inputs->levels, force);
    if (status != FF_OK)
        return status;
    if (!dynamics_spring_nodes_share(&inputs->levels, force, 1, spring, &convex))
        return FF_NOMEM;
    report_shared(host, &inputs->levels, force, convex, spring->soft);
    return FF_OK;
}

static ff_status build_excitation(const ff_host *host, const ff_array *in,
                                  const dynamics_inputs *inputs, dynamics_excitation *excitation)
{
    dynamics_spring_nodes spring = {0};
    ff_status status = make_spring(host, in, inputs, excitation, &spring);
    if (status != FF_OK)
        return status;
    int built =
        dynamics_excitation_build_bent(excitation, &inputs->curves, spring.rows ? &spring : NULL);
    report_spring(host, &spring);
    report_damping(host, excitation);
    dynamics_spring_nodes_free(&spring);
    if (built)
        report_representation(host, excitation);
    return built ? FF_OK : FF_NOMEM;
}

int dynamics_floats(const dynamics_inputs *inputs, const dynamics_excitation *excitation)
{
    const dynamics_mesh_curves *c = &inputs->curves;
    double highest = 0, lowest = 0;
    for (size_t i = 0; c->error && i < c->count; i++) {
        highest = fmax(highest, fabs(c->error[i]));
        lowest = i ? fmin(lowest, c->error[i]) : c->error[i];
    }
    if (inputs->line_force != 0 || inputs->fluctuation.count > 0)
        return 0;
    if (dynamics_tracks_differ(excitation))
        return lowest / excitation->length + dynamics_back_lowest(excitation) >
               -2 * excitation->half_gap;
    return highest < excitation->half_gap * excitation->length;
}

void dynamics_floating_line(const ff_host *host)
{
    static const char text[] =
        "without a torque nothing presses the flanks together: the gears float, and every position "
        "in the backlash is an equilibrium. The middle is shown, without forces. A drag torque or "
        "a fluctuation of torque or speed would cause a motion";
    host->log(host->ctx, FF_LOG_INFO, text);
    host->quality(host->ctx, "floating", 0, 0, FF_GOOD, text);
}

ff_status dynamics_evaluate(const ff_host *host, const ff_port *ports, size_t count, size_t force,
                            const ff_array *in, dynamics_evaluation *evaluation, void *self,
                            uint64_t wanted)
{
    numerics_exchange exchange;
    ff_status status = numerics_exchange_open(ports, count, in, &exchange);
    if (status == FF_OK)
        status = numerics_exchange_check(host, ports, &exchange, force);
    if (status == FF_OK)
        status = evaluation(self, wanted, exchange.in, exchange.back);
    numerics_exchange_close(&exchange);
    return status;
}

void dynamics_put_stations(double *x, size_t stations, size_t total, int back)
{
    for (size_t row = 0; back && stations && row < total / stations; row++)
        numerics_reverse(x + row * stations, stations, 1);
}

ff_status dynamics_inputs_read(const ff_host *host, const ff_array *in,
                               const dynamics_inertia *inertia, dynamics_inputs *inputs,
                               dynamics_excitation *excitation)
{
    ff_status status = check_finite(host, in);
    if (status == FF_OK)
        status = check_shapes(host, in);
    if (status == FF_OK)
        status = check_scalars(host, in);
    if (status == FF_OK)
        status = check_cycle(host, in);
    if (status == FF_OK)
        status = read_levels(host, in, &inputs->levels);
    if (status != FF_OK)
        return status;
    read_stations(in, inputs);
    inputs->curves = (dynamics_mesh_curves){
        .count = in[DYNAMICS_IN_PHASE].shape[0],
        .phase = in[DYNAMICS_IN_PHASE].data,
        .stiffness = in[DYNAMICS_IN_STIFFNESS].data,
        .error = in[DYNAMICS_IN_TRANSMISSION_ERROR].data,
    };
    inputs->loaded_error = in[DYNAMICS_IN_LOADED_ERROR].data;
    double stiffness = in[DYNAMICS_IN_STIFFNESS_MEAN].data[0];
    inputs->line_force = in[DYNAMICS_IN_LINE_FORCE].data[0];
    inputs->reference = inputs->line_force;
    if (in[DYNAMICS_IN_REFERENCE_FORCE].data && in[DYNAMICS_IN_REFERENCE_FORCE].data[0] > 0)
        inputs->reference = in[DYNAMICS_IN_REFERENCE_FORCE].data[0];
    inputs->mesh_frequency = in[DYNAMICS_IN_MESH_FREQUENCY].data[0];
    status = check_stations(host, inputs);
    if (status == FF_OK)
        status = dynamics_fluctuation_read(host, in, in[DYNAMICS_IN_TEETH].data[0],
                                           &inputs->fluctuation, &inputs->span);
    const ff_array *driven = &in[DYNAMICS_IN_DRIVEN_MASS],
                   *mass = driven->data && driven->data[0] > 0 ? driven
                                                               : &in[DYNAMICS_IN_EQUIVALENT_MASS];
    if (status == FF_OK)
        status =
            dynamics_natural_frequency(host, inertia, mass, stiffness, &inputs->natural_frequency);
    if (status != FF_OK)
        return status;
    if (!(inputs->natural_frequency > 0))
        return ff_failf(host, FF_INVALID, "equivalent_mass",
                        "the inertia is not known: give equivalent_mass or natural_frequency, or "
                        "wire a gear that gives equivalent_mass");
    excitation->stiffness = stiffness;
    excitation->omega = 2 * M_PI * inputs->natural_frequency;
    inputs->unit_frequency = inputs->natural_frequency * (double)inputs->span;
    excitation->length = length_unit(
        in, inputs->line_force + dynamics_fluctuation_size(&inputs->fluctuation), stiffness);
    excitation->half_gap = in[DYNAMICS_IN_BACKLASH].data[0] / 2 / excitation->length;
    excitation->load = inputs->line_force / stiffness / excitation->length;
    inputs->shared = excitation->shared;
    status = build_excitation(host, in, inputs, excitation);
    if (status == FF_OK)
        status = dynamics_back_inputs_read(host, in, inputs, excitation);
    if (status == FF_OK && inputs->fluctuation.count > 0 &&
        !dynamics_excitation_fluctuate(excitation, &inputs->fluctuation, inputs->span))
        status = FF_NOMEM;
    return status;
}
