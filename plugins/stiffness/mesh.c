/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mesh.h"

#include <math.h>
#include <string.h>

enum { HARMONICS = 20 };

/* More pairs than any gear has; keeps loops over pairs short. */
static const double highest_contact_ratio = 10;

const ff_port stiffness_outputs[STIFFNESS_OUTPUTS] = {
    [STIFFNESS_OUT_PHASE] = {.name = "phase",
                             .unit = "1",
                             .doc =
                                 "mesh cycle from 0 (the entering pair at SAP) to 1; a phase given "
                                 "twice marks a jump: value before, value after",
                             .dims = "phase"},
    [STIFFNESS_OUT_STIFFNESS] =
        {.name = "stiffness",
         .unit = "N/m",
         .doc = "mesh stiffness k along the line of action, linear between phases",
         .dims = "phase"},
    [STIFFNESS_OUT_MEAN] = {.name = "stiffness_mean",
                            .unit = "N/m",
                            .doc = "mean of k over the mesh cycle",
                            .dims = ""},
    [STIFFNESS_OUT_HARMONICS] = {.name = "stiffness_harmonics",
                                 .unit = "N/m",
                                 .doc = "amplitude of k at 1, 2, 3 ... times the mesh frequency: "
                                        "|2 int k exp(-2 pi i n phase) dphase|",
                                 .dims = "harmonic"},
    [STIFFNESS_OUT_LOADED_ERROR] = {.name = "loaded_transmission_error",
                                    .unit = "m",
                                    .doc = "static transmission error under load, e + F/k",
                                    .dims = "phase"},
    [STIFFNESS_OUT_ERROR] = {.name = "transmission_error",
                             .unit = "m",
                             .doc = "transmission error e without load",
                             .dims = "phase"},
    [STIFFNESS_OUT_TOOTH_FORCE] = {.name = "tooth_force",
                                   .unit = "N",
                                   .doc =
                                       "quasi-static normal force W_s of one pair from SAP to tip",
                                   .dims = "engagement? station"},
    [STIFFNESS_OUT_LOAD_SHARE] = {.name = "load_share",
                                  .unit = "1",
                                  .doc = "the pair's part of the line force, W_s/F",
                                  .dims = "engagement? station"},
    [STIFFNESS_OUT_PAIRS] = {.name = "pairs_in_contact",
                             .unit = "1",
                             .doc = "pairs of teeth that carry load",
                             .dims = "phase"},
    [STIFFNESS_OUT_BREAKPOINTS] = {.name = "breakpoints",
                                   .unit = "1",
                                   .doc = "phases in [0, 1) where k or e jumps or has a kink",
                                   .dims = "breakpoint"},
    [STIFFNESS_OUT_LOADED_RATIO] = {.name = "loaded_contact_ratio",
                                    .unit = "1",
                                    .doc = "mesh cycles from the first to the last load on a pair",
                                    .dims = ""},
    [STIFFNESS_OUT_ENGAGEMENT_ROLL] = {.name = "engagement_roll",
                                       .unit = "rad",
                                       .doc =
                                           "roll angle of gear 1 over the whole engagement, corner "
                                           "contact before SAP and after the tip included",
                                       .dims = "engagement_point"},
    [STIFFNESS_OUT_ENGAGEMENT_FORCE] = {.name = "engagement_force",
                                        .unit = "N",
                                        .doc = "quasi-static normal force of one pair there",
                                        .dims = "engagement_point"},
    [STIFFNESS_OUT_HUNTING_PERIOD] = {.name = "hunting_period",
                                      .unit = "1",
                                      .doc =
                                          "mesh cycles until the same teeth meet again; 1 without "
                                          "index deviations",
                                      .dims = ""},
    [STIFFNESS_OUT_HUNTING_ERROR] =
        {.name = "hunting_transmission_error",
         .unit = "m",
         .doc = "transmission error without load over the hunting period, in "
                "equal steps of phase from its start",
         .dims = "hunting"},
    [STIFFNESS_OUT_HUNTING_PRESSURE] =
        {.name = "hunting_hertz_pressure",
         .unit = "Pa",
         .doc = "highest Hertz pressure on the pair of teeth that enters "
                "in each mesh cycle of the hunting period, quasi-static; "
                "needs index deviations",
         .dims = "mesh_cycle"},
    [STIFFNESS_OUT_WORST_CYCLE] = {.name = "worst_mesh_cycle",
                                   .unit = "1",
                                   .doc =
                                       "mesh cycle of the hunting period with the highest of them",
                                   .dims = ""},
    [STIFFNESS_OUT_WORST_TEETH] = {.name = "worst_teeth",
                                   .unit = "1",
                                   .doc =
                                       "teeth of gear 1 and gear 2 that meet then, counted from 1",
                                   .dims = "gear"},
};

ff_status stiffness_input(const ff_host *host, const ff_array *array, const char *name, size_t i,
                          double *value)
{
    size_t count = 1;
    for (uint32_t k = 0; k < array->rank; k++)
        count *= array->shape[k];
    if (!array->data || i >= count)
        return ff_failf(host, FF_INVALID, name, "element %zu is missing", i + 1);
    *value = array->data[i];
    if (!isfinite(*value))
        return ff_failf(host, FF_INVALID, name, "a finite number is needed, this is %g", *value);
    return FF_OK;
}

static ff_status check_stations(const ff_host *host, const stiffness_path *e, double roll_tip)
{
    double slack = STIFFNESS_PHASE_TOLERANCE * e->pitch;
    for (size_t i = 0; i < e->stations; i++) {
        double roll = e->roll[i];
        if (!(roll >= e->roll_sap - slack && roll <= roll_tip + slack) ||
            (i > 0 && roll < e->roll[i - 1]))
            return ff_failf(host, FF_INVALID, "gear.roll_angle",
                            "the roll angles must rise from SAP to the tip, but number %zu is "
                            "%.9g rad on a path from %.9g to %.9g rad",
                            i + 1, roll, e->roll_sap, roll_tip);
    }
    return FF_OK;
}

ff_status stiffness_path_read(const ff_host *host, const ff_array *in, stiffness_path *e)
{
    double tip = 0, teeth = 0;
    ff_status status =
        stiffness_input(host, &in[STIFFNESS_IN_SAP], "gear.roll_sap", 0, &e->roll_sap);
    if (status == FF_OK)
        status = stiffness_input(host, &in[STIFFNESS_IN_TIP], "gear.roll_tip", 0, &tip);
    if (status == FF_OK)
        status = stiffness_input(host, &in[STIFFNESS_IN_TEETH], "gear.teeth", 0, &teeth);
    if (status == FF_OK)
        status = stiffness_input(host, &in[STIFFNESS_IN_FORCE], "operating.line_force", 0,
                                 &e->line_force);
    if (status != FF_OK)
        return status;
    if (!(teeth >= 1))
        return ff_failf(host, FF_INVALID, "gear.teeth", "a gear of %g teeth does not mesh", teeth);
    if (!(e->line_force >= 0))
        return ff_failf(host, FF_INVALID, "operating.line_force",
                        "the line force must not be negative; it is %g N", e->line_force);
    e->pitch = 2 * M_PI / teeth;
    e->contact_ratio = (tip - e->roll_sap) / e->pitch;
    if (!(e->contact_ratio >= 1 - STIFFNESS_PHASE_TOLERANCE &&
          e->contact_ratio <= highest_contact_ratio))
        return ff_failf(host, FF_INVALID, "gear.roll_tip",
                        "the path of contact gives a contact ratio of %.6g; a mesh that never "
                        "loses all pairs needs 1, and at most %g is dealt with",
                        e->contact_ratio, highest_contact_ratio);
    const ff_array *roll = &in[STIFFNESS_IN_ROLL];
    if (!roll->data || roll->rank != 1 || roll->shape[0] == 0)
        return ff_failf(host, FF_INVALID, "gear.roll_angle", "no station on the path of contact");
    e->stations = roll->shape[0];
    e->roll = roll->data;
    return check_stations(host, e, tip);
}

/* A station given twice is the limit from below, then from above; the tip is left from below. */
static int station_side(const stiffness_path *e, size_t i)
{
    if (i + 1 == e->stations)
        return STIFFNESS_BELOW;
    double step = (e->roll[i + 1] - e->roll[i]) / e->pitch;
    return step <= STIFFNESS_PHASE_TOLERANCE ? STIFFNESS_BELOW : STIFFNESS_ABOVE;
}

/* Share of the pair that enters in mesh cycle `number`; where all are alike, of any. */
static double station_share(const stiffness_result *mesh, const stiffness_path *e, size_t number,
                            size_t i)
{
    double age = (e->roll[i] - e->roll_sap) / e->pitch;
    age = fmin(fmax(age, 0), e->contact_ratio);
    int side = age <= STIFFNESS_PHASE_TOLERANCE ? STIFFNESS_ABOVE : station_side(e, i);
    if (mesh->engagements > 1)
        return mesh->share_of_pair(mesh->self, number, age, side);
    return mesh->share(mesh->self, age, stiffness_phase_of(age, side), side);
}

static double share_above(const stiffness_result *mesh, double age)
{
    return mesh->share(mesh->self, age, stiffness_phase_of(age, STIFFNESS_ABOVE), STIFFNESS_ABOVE);
}

/* Age between `idle`, where a pair carries nothing, and `loaded`, where it does. */
static double edge_of_load(const stiffness_result *mesh, double idle, double loaded)
{
    for (int i = 0; i < 40; i++) {
        double middle = (idle + loaded) / 2;
        *(share_above(mesh, middle) > 0 ? &loaded : &idle) = middle;
    }
    return loaded;
}

/* From the first to the last load. */
static double loaded_ratio(const stiffness_result *mesh, const stiffness_path *e)
{
    enum { STEPS = 400 };
    double from = -mesh->before, to = e->contact_ratio + mesh->after, step = (to - from) / STEPS;
    int first = 0, last = STEPS - 1; /* loaded middles of steps */
    while (first < last && !(share_above(mesh, from + (first + 0.5) * step) > 0))
        first++;
    while (last > first && !(share_above(mesh, from + (last + 0.5) * step) > 0))
        last--;
    double start = edge_of_load(mesh, from + (first - 0.5) * step, from + (first + 0.5) * step);
    double end = edge_of_load(mesh, from + (last + 1.5) * step, from + (last + 0.5) * step);
    return fmin(end, to) - fmax(start, from);
}

static bool wants(uint64_t wanted, int output)
{
    return (wanted & FF_BIT(output)) != 0;
}

static ff_status put_stations(const ff_host *host, uint64_t wanted, const stiffness_result *mesh,
                              const stiffness_path *e)
{
    const size_t count = mesh->engagements > 1 ? mesh->engagements : 1;
    const size_t shape[2] = {count, e->stations};
    const uint32_t rank = count > 1 ? 2 : 1;
    bool forces = wants(wanted, STIFFNESS_OUT_TOOTH_FORCE),
         shares = wants(wanted, STIFFNESS_OUT_LOAD_SHARE);
    double *force =
        forces ? host->output(host->ctx, STIFFNESS_OUT_TOOTH_FORCE, rank, &shape[2 - rank]) : NULL;
    double *share =
        shares ? host->output(host->ctx, STIFFNESS_OUT_LOAD_SHARE, rank, &shape[2 - rank]) : NULL;
    if ((forces && !force) || (shares && !share))
        return FF_NOMEM;
    for (size_t k = 0; k < count * e->stations && (forces || shares); k++) {
        double part = station_share(mesh, e, k / e->stations, k % e->stations);
        if (forces)
            force[k] = e->line_force * part;
        if (shares)
            share[k] = part;
    }
    return FF_OK;
}

/* W_s at the stations, with some more before SAP and after the tip where contact is possible. */
static ff_status put_engagement(const ff_host *host, uint64_t wanted, const stiffness_result *mesh,
                                const stiffness_path *e)
{
    enum { MORE = 40 };
    size_t early = mesh->before > 0 ? MORE : 0, late = mesh->after > 0 ? MORE : 0;
    size_t count = early + e->stations + late, n = 0;
    if (!wants(wanted, STIFFNESS_OUT_ENGAGEMENT_ROLL) &&
        !wants(wanted, STIFFNESS_OUT_ENGAGEMENT_FORCE))
        return FF_OK;
    double *roll = ff_put_series(host, STIFFNESS_OUT_ENGAGEMENT_ROLL, count);
    double *force = ff_put_series(host, STIFFNESS_OUT_ENGAGEMENT_FORCE, count);
    if (!roll || !force)
        return FF_NOMEM;
    for (size_t i = 0; i < early; i++, n++) {
        double age = -mesh->before * (1 - (double)i / MORE);
        roll[n] = e->roll_sap + age * e->pitch;
        force[n] = e->line_force * share_above(mesh, age);
    }
    for (size_t i = 0; i < e->stations; i++, n++) {
        roll[n] = e->roll[i];
        force[n] = e->line_force * station_share(mesh, e, 0, i);
    }
    for (size_t i = 1; i <= late; i++, n++) {
        double age = e->contact_ratio + mesh->after * (double)i / MORE;
        roll[n] = e->roll_sap + age * e->pitch;
        force[n] = e->line_force * share_above(mesh, age);
    }
    return FF_OK;
}

static double at_phase(const stiffness_result *mesh, const stiffness_path *e, uint32_t output,
                       size_t i)
{
    double error = mesh->error ? mesh->error[i] : 0;
    switch (output) {
    case STIFFNESS_OUT_PHASE:
        return mesh->cycle.phase[i];
    case STIFFNESS_OUT_STIFFNESS:
        return mesh->stiffness[i];
    case STIFFNESS_OUT_LOADED_ERROR:
        return mesh->loaded ? mesh->loaded[i] : error + e->line_force / mesh->stiffness[i];
    case STIFFNESS_OUT_ERROR:
        return error;
    default: /* STIFFNESS_OUT_PAIRS */
        if (mesh->pairs)
            return mesh->pairs[i];
        return (double)stiffness_pairs(e->contact_ratio, mesh->cycle.phase[i],
                                       stiffness_cycle_side(&mesh->cycle, i));
    }
}

static ff_status put_phases(const ff_host *host, uint64_t wanted, const stiffness_result *mesh,
                            const stiffness_path *e)
{
    static const uint32_t rows[] = {STIFFNESS_OUT_PHASE, STIFFNESS_OUT_STIFFNESS,
                                    STIFFNESS_OUT_LOADED_ERROR, STIFFNESS_OUT_ERROR,
                                    STIFFNESS_OUT_PAIRS};
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
        if (!wants(wanted, (int)rows[r]))
            continue;
        double *to = ff_put_series(host, rows[r], mesh->cycle.count);
        if (!to)
            return FF_NOMEM;
        for (size_t i = 0; i < mesh->cycle.count; i++)
            to[i] = at_phase(mesh, e, rows[r], i);
    }
    return FF_OK;
}

static ff_status put_hunting(const ff_host *host, uint64_t wanted, const stiffness_result *mesh)
{
    double period = mesh->hunting ? (double)mesh->hunting : 1;
    if (wants(wanted, STIFFNESS_OUT_HUNTING_PERIOD) &&
        ff_put_scalar(host, STIFFNESS_OUT_HUNTING_PERIOD, period) != FF_OK)
        return FF_NOMEM;
    if (!wants(wanted, STIFFNESS_OUT_HUNTING_ERROR))
        return FF_OK;
    size_t count = mesh->hunting_error ? mesh->hunting_points : mesh->cycle.count;
    const double *from = mesh->hunting_error ? mesh->hunting_error : mesh->error;
    double *to = ff_put_series(host, STIFFNESS_OUT_HUNTING_ERROR, count);
    if (!to)
        return FF_NOMEM;
    if (from)
        memcpy(to, from, count * sizeof *to);
    return FF_OK;
}

/* The pairs of the hunting period, and the worst of them. */
static ff_status put_worst(const ff_host *host, uint64_t wanted, const stiffness_result *mesh)
{
    static const uint32_t rows[] = {STIFFNESS_OUT_HUNTING_PRESSURE, STIFFNESS_OUT_WORST_CYCLE,
                                    STIFFNESS_OUT_WORST_TEETH};
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++)
        if (wants(wanted, (int)rows[r]) && !mesh->pressure)
            return ff_failf(host, FF_UNSUPPORTED, stiffness_outputs[rows[r]].name,
                            "this output needs index deviations, pitch_error of the gear, and a "
                            "stiffness that knows them");
    if (wants(wanted, STIFFNESS_OUT_HUNTING_PRESSURE)) {
        double *to = ff_put_series(host, STIFFNESS_OUT_HUNTING_PRESSURE, mesh->hunting);
        if (!to)
            return FF_NOMEM;
        memcpy(to, mesh->pressure, mesh->hunting * sizeof *to);
    }
    if (wants(wanted, STIFFNESS_OUT_WORST_TEETH)) {
        double *to = ff_put_series(host, STIFFNESS_OUT_WORST_TEETH, 2);
        if (!to)
            return FF_NOMEM;
        for (int g = 0; g < 2; g++)
            to[g] = (double)mesh->worst_teeth[g];
    }
    if (wants(wanted, STIFFNESS_OUT_WORST_CYCLE))
        return ff_put_scalar(host, STIFFNESS_OUT_WORST_CYCLE, (double)mesh->worst);
    return FF_OK;
}

static ff_status put_cycle_figures(const ff_host *host, uint64_t wanted,
                                   const stiffness_result *mesh, const stiffness_path *e)
{
    if (wants(wanted, STIFFNESS_OUT_LOADED_RATIO) &&
        ff_put_scalar(host, STIFFNESS_OUT_LOADED_RATIO, loaded_ratio(mesh, e)) != FF_OK)
        return FF_NOMEM;
    if (wants(wanted, STIFFNESS_OUT_MEAN) &&
        ff_put_scalar(host, STIFFNESS_OUT_MEAN,
                      stiffness_cycle_mean(&mesh->cycle, mesh->stiffness)) != FF_OK)
        return FF_NOMEM;
    if (wants(wanted, STIFFNESS_OUT_HARMONICS)) {
        double *to = ff_put_series(host, STIFFNESS_OUT_HARMONICS, HARMONICS);
        if (!to)
            return FF_NOMEM;
        for (int n = 1; n <= HARMONICS; n++)
            to[n - 1] = stiffness_cycle_amplitude(&mesh->cycle, mesh->stiffness, n);
    }
    if (wants(wanted, STIFFNESS_OUT_BREAKPOINTS)) {
        double *to = ff_put_series(host, STIFFNESS_OUT_BREAKPOINTS, mesh->breaks);
        if (!to)
            return FF_NOMEM;
        if (mesh->breaks > 0)
            memcpy(to, mesh->breakpoint, mesh->breaks * sizeof *to);
    }
    return FF_OK;
}

/* Largest |sum of the tooth forces - F|/F over the mesh cycle. */
static double imbalance(const stiffness_result *mesh, const stiffness_path *e)
{
    double worst = 0;
    for (size_t i = 0; i < mesh->cycle.count; i++) {
        double phase = mesh->cycle.phase[i], sum = 0;
        int side = stiffness_cycle_side(&mesh->cycle, i);
        double length = mesh->before + e->contact_ratio + mesh->after;
        for (double age = phase - ceil(mesh->before); age <= length + 1; age += 1)
            if (stiffness_touches(length, age + mesh->before, side))
                sum += mesh->share(mesh->self, age, phase, side);
        worst = fmax(worst, fabs(sum - 1));
    }
    return worst;
}

static void report_equilibrium(const ff_host *host, const stiffness_result *mesh,
                               const stiffness_path *e)
{
    double residual = imbalance(mesh, e);
    int held = residual <= mesh->balance;
    host->quality(host->ctx, "equilibrium", residual, mesh->balance, held ? FF_GOOD : FF_DOUBTFUL,
                  held ? "the tooth forces add up to the line force"
                       : "the tooth forces do not add up to the line force: the load share does "
                         "not fit the gear's path of contact");
}

/*
 * Mean distance of k from the straight lines between the points, over the mean of k: an amplitude
 * of k is off by at most twice that. A parabola is farthest from its chord in the middle, by 3/2 of
 * the mean.
 */
static void report_interpolation(const ff_host *host, const stiffness_result *mesh)
{
    const double limit = 1e-3;
    double sum = 0;
    for (size_t i = 1; i < mesh->cycle.count; i++) {
        double a = mesh->cycle.phase[i - 1], b = mesh->cycle.phase[i];
        if (!(b > a))
            continue;
        double there = mesh->stiffness_at(mesh->self, (a + b) / 2, STIFFNESS_ABOVE);
        double line = (mesh->stiffness[i - 1] + mesh->stiffness[i]) / 2;
        sum += 2. / 3 * fabs(line - there) * (b - a);
    }
    double mean = sum / stiffness_cycle_mean(&mesh->cycle, mesh->stiffness);
    int held = mean <= limit;
    host->quality(host->ctx, "interpolation_error", mean, limit, held ? FF_GOOD : FF_DOUBTFUL,
                  held ? "straight lines between the points follow k"
                       : "straight lines between the points cut corners of k: raise points");
}

ff_status stiffness_result_publish(const ff_host *host, uint64_t wanted,
                                   const stiffness_result *mesh, const stiffness_path *e)
{
    ff_status status = put_phases(host, wanted, mesh, e);
    if (status == FF_OK)
        status = put_cycle_figures(host, wanted, mesh, e);
    if (status == FF_OK)
        status = put_hunting(host, wanted, mesh);
    if (status == FF_OK)
        status = put_worst(host, wanted, mesh);
    if (status == FF_OK)
        status = put_stations(host, wanted, mesh, e);
    if (status == FF_OK)
        status = put_engagement(host, wanted, mesh, e);
    if (status == FF_OK &&
        (wants(wanted, STIFFNESS_OUT_TOOTH_FORCE) || wants(wanted, STIFFNESS_OUT_LOAD_SHARE)))
        report_equilibrium(host, mesh, e);
    if (status == FF_OK)
        report_interpolation(host, mesh);
    return status;
}
