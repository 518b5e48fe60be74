/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the outputs that all mesh stiffness models share. */
#include "outputs.h"

#include <flankfilm/author.h>

#include <math.h>
#include <string.h>

enum { HARMONICS = 20 }; /* number of harmonics of k in the outputs */

const ff_port stiffness_outputs[STIFFNESS_ALL_OUTPUTS] = {
    {.name = "phase",
     .unit = "1",
     .label = "mesh cycle",
     .doc = "phase of the mesh cycle from 0 (the entering pair at SAP) to 1; a repeated phase is a "
            "jump, with the values before and after it",
     .dims = "phase"},
    {.name = "stiffness",
     .unit = "N/m",
     .doc = "mesh stiffness k along the line of action, linear between phases",
     .dims = "phase",
     .max = INFINITY},
    {.name = "stiffness_mean",
     .unit = "N/m",
     .doc = "mean of k over the mesh cycle",
     .dims = "",
     .max = INFINITY},
    {.name = "stiffness_harmonics",
     .unit = "N/m",
     .doc = "amplitude of k at 1, 2, 3 ... times the mesh frequency: |2 int k exp(-2 pi i n phase) "
            "dphase|",
     .dims = "harmonic"},
    {.name = "loaded_transmission_error",
     .label = "transmission error under load",
     .unit = "m",
     .doc = "static transmission error under load, e + F/k",
     .dims = "phase"},
    {.name = "transmission_error",
     .unit = "m",
     .doc = "transmission error e without load",
     .dims = "phase"},
    {.name = "tooth_force",
     .unit = "N",
     .doc = "quasi-static normal force W_s of one pair from SAP to tip",
     .dims = "engagement? gear.station"},
    {.name = "load_share",
     .label = "load share of the pair",
     .unit = "1",
     .doc = "share of the line force on the pair, W_s/F",
     .dims = "engagement? gear.station",
     .max = 1},
    {.name = "pairs_in_contact",
     .unit = "1",
     .doc = "number of pairs of teeth that carry load",
     .dims = "phase",
     .max = INFINITY},
    {.name = "breakpoints",
     .unit = "1",
     .doc = "phases in [0, 1) where k or e jumps or changes its slope",
     .dims = "breakpoint"},
    {.name = "loaded_contact_ratio",
     .unit = "1",
     .doc = "mesh cycles from the first to the last load on a pair",
     .dims = "",
     .max = INFINITY},
    {.name = "engagement_roll",
     .unit = "rad",
     .doc = "roll angle of gear 1 over the whole engagement, including corner contact before SAP "
            "and after the tip",
     .dims = "engagement_point"},
    {.name = "engagement_force",
     .unit = "N",
     .doc = "quasi-static normal force of one pair at engagement_angle",
     .dims = "engagement_point"},
    {.name = "hunting_period",
     .unit = "1",
     .doc = "mesh cycles until the same teeth meet again; 1 without index deviations",
     .dims = ""},
    {.name = "hunting_transmission_error",
     .unit = "m",
     .doc = "transmission error without load over the hunting period, in equal steps of phase from "
            "its start",
     .dims = "hunting"},
    {.name = "hunting_hertz_pressure",
     .unit = "Pa",
     .doc = "highest Hertz pressure on the pair of teeth that enters in each mesh cycle of the "
            "hunting period, quasi-static; needs index deviations",
     .dims = "mesh_cycle",
     .max = INFINITY},
    {.name = "worst_mesh_cycle",
     .unit = "1",
     .doc = "mesh cycle of the hunting period with the highest Hertz pressure",
     .dims = ""},
    {.name = "worst_teeth",
     .unit = "1",
     .doc = "teeth of gear 1 and gear 2 that meet in the worst mesh cycle, counted from 1",
     .dims = "gear"},
    {.name = "transmission_error_peak_to_peak",
     .unit = "m",
     .doc = "maximum minus minimum of loaded_transmission_error over the mesh cycle",
     .dims = "",
     .max = INFINITY},
    {.name = "force_level",
     .unit = "N",
     .doc = "increasing mesh forces from 0; the line force is one of them",
     .dims = "level"},
    {.name = "level_error",
     .unit = "m",
     .doc = "transmission error under each mesh force; for force 0, that without load",
     .dims = "level phase"},
    {.name = "level_stiffness",
     .unit = "N/m",
     .doc = "slope dF/d(e_l) of the mesh force at each mesh force",
     .dims = "level phase",
     .max = INFINITY},
    {.name = "level_tooth_force",
     .unit = "N",
     .doc = "quasi-static normal force of one pair from SAP to tip at each mesh force",
     .dims = "level gear.station"},
    {.name = "back_phase",
     .unit = "1",
     .doc =
         "phase of the curves of the back flanks, which are opposite to the flanks that carry the "
         "line force, from 0 to 1; empty: the back flanks are not known",
     .dims = "back_phase"},
    {.name = "back_offset",
     .unit = "1",
     .doc =
         "sum of the two phases at which the two flanks of a tooth of gear 1 are in contact at the "
         "same roll angle, minus whole mesh cycles",
     .dims = ""},
    {.name = "back_stiffness",
     .unit = "N/m",
     .doc = "mesh stiffness of the back flanks",
     .dims = "back_phase",
     .max = INFINITY},
    {.name = "back_transmission_error",
     .unit = "m",
     .doc = "transmission error of the back flanks without load, positive: they meet later",
     .dims = "back_phase"},
    {.name = "back_loaded_transmission_error",
     .unit = "m",
     .doc = "transmission error of the back flanks under load",
     .dims = "back_phase"},
    {.name = "back_level_error",
     .unit = "m",
     .doc = "transmission error of the back flanks under each force_level",
     .dims = "back_level back_phase"},
    {.name = "back_level_stiffness",
     .unit = "N/m",
     .doc = "slope of the mesh force of the back flanks at each force_level",
     .dims = "back_level back_phase",
     .max = INFINITY},
    {.name = "back_level_tooth_force",
     .unit = "N",
     .doc = "quasi-static normal force on one pair of back flanks at each force_level, at the roll "
            "angles of gear 1",
     .dims = "back_level gear.station"},
};

/* Returns the side of a station. The first of two equal stations is the limit from below, the
   second the limit from above; the tip is the limit from below. */
static int station_side(const stiffness_path *path, size_t i)
{
    if (i + 1 == path->stations)
        return STIFFNESS_BELOW;
    double step = (path->roll[i + 1] - path->roll[i]) / path->pitch;
    return step <= STIFFNESS_PHASE_TOLERANCE ? STIFFNESS_BELOW : STIFFNESS_ABOVE;
}

double stiffness_station_age(const stiffness_path *path, size_t i, int *side)
{
    double age = (path->roll[i] - path->roll_sap) / path->pitch;
    age = fmin(fmax(age, 0), path->contact_ratio);
    *side = age <= STIFFNESS_PHASE_TOLERANCE ? STIFFNESS_ABOVE : station_side(path, i);
    return age;
}

/* Returns the share of F at station i on the pair that enters in mesh cycle `number`. */
static double station_share(const stiffness_result *r, const stiffness_path *path, size_t number,
                            size_t i)
{
    int side;
    double age = stiffness_station_age(path, i, &side);
    if (r->engagements > 1)
        return r->share_of_pair(r->self, number, age, side);
    return r->share(r->self, age, stiffness_phase_of(age, side), side);
}

static double share_above(const stiffness_result *r, double age)
{
    return r->share(r->self, age, stiffness_phase_of(age, STIFFNESS_ABOVE), STIFFNESS_ABOVE);
}

/* Bisects between `idle`, an age at which a pair is unloaded, and `loaded`, an age at which it is
   loaded. Returns the age at which the load begins. */
static double start_of_load(const stiffness_result *r, double idle, double loaded)
{
    for (int i = 0; i < 40; i++) {
        double middle = (idle + loaded) / 2;
        *(share_above(r, middle) > 0 ? &loaded : &idle) = middle;
    }
    return loaded;
}

/* Returns the mesh cycles between the first and the last load on a pair. Searches in 400 steps,
   then bisects. */
static double loaded_ratio(const stiffness_result *r, const stiffness_path *path)
{
    enum { STEPS = 400 };
    double from = -r->before, to = path->contact_ratio + r->after, step = (to - from) / STEPS;
    int first = 0, last = STEPS - 1; /* steps whose middle is loaded */
    while (first < last && !(share_above(r, from + (first + 0.5) * step) > 0))
        first++;
    while (last > first && !(share_above(r, from + (last + 0.5) * step) > 0))
        last--;
    double start = start_of_load(r, from + (first - 0.5) * step, from + (first + 0.5) * step);
    double end = start_of_load(r, from + (last + 1.5) * step, from + (last + 0.5) * step);
    return fmin(end, to) - fmax(start, from);
}

static bool wants(uint64_t wanted, int output)
{
    return (wanted & FF_BIT(output)) != 0;
}

static ff_status write_stations(const ff_host *host, uint64_t wanted, const stiffness_result *r,
                                const stiffness_path *path)
{
    const size_t count = r->engagements > 1 ? r->engagements : 1;
    const size_t shape[2] = {count, path->stations};
    const uint32_t rank = count > 1 ? 2 : 1;
    bool forces = wants(wanted, STIFFNESS_OUT_TOOTH_FORCE),
         shares = wants(wanted, STIFFNESS_OUT_LOAD_SHARE);
    double *force =
        forces ? host->output(host->ctx, STIFFNESS_OUT_TOOTH_FORCE, rank, &shape[2 - rank]) : NULL;
    double *share =
        shares ? host->output(host->ctx, STIFFNESS_OUT_LOAD_SHARE, rank, &shape[2 - rank]) : NULL;
    if ((forces && !force) || (shares && !share))
        return FF_NOMEM;
    for (size_t k = 0; k < count * path->stations && (forces || shares); k++) {
        double part = station_share(r, path, k / path->stations, k % path->stations);
        if (forces)
            force[k] = path->load * part;
        if (shares)
            share[k] = part;
    }
    return FF_OK;
}

/* Writes W_s at the stations, and at further places before SAP and after the tip where contact is
   possible. */
static ff_status write_engagement(const ff_host *host, uint64_t wanted, const stiffness_result *r,
                                  const stiffness_path *path)
{
    enum { MORE = 40 };
    size_t early = r->before > 0 ? MORE : 0, late = r->after > 0 ? MORE : 0;
    size_t count = early + path->stations + late, n = 0;
    if (!wants(wanted, STIFFNESS_OUT_ENGAGEMENT_ROLL) &&
        !wants(wanted, STIFFNESS_OUT_ENGAGEMENT_FORCE))
        return FF_OK;
    double *roll = ff_put_series(host, STIFFNESS_OUT_ENGAGEMENT_ROLL, count);
    double *force = ff_put_series(host, STIFFNESS_OUT_ENGAGEMENT_FORCE, count);
    if (!roll || !force)
        return FF_NOMEM;
    for (size_t i = 0; i < early; i++, n++) {
        double age = -r->before * (1 - (double)i / MORE);
        roll[n] = path->roll_sap + age * path->pitch;
        force[n] = path->load * share_above(r, age);
    }
    for (size_t i = 0; i < path->stations; i++, n++) {
        roll[n] = path->roll[i];
        force[n] = path->load * station_share(r, path, 0, i);
    }
    for (size_t i = 1; i <= late; i++, n++) {
        double age = path->contact_ratio + r->after * (double)i / MORE;
        roll[n] = path->roll_sap + age * path->pitch;
        force[n] = path->load * share_above(r, age);
    }
    return FF_OK;
}

static double at_phase(const stiffness_result *r, const stiffness_path *path, uint32_t output,
                       size_t i)
{
    double error = r->error ? r->error[i] : 0;
    switch (output) {
    case STIFFNESS_OUT_PHASE:
        return r->cycle.phase[i];
    case STIFFNESS_OUT_STIFFNESS:
        return r->stiffness[i];
    case STIFFNESS_OUT_LOADED_ERROR:
        return r->loaded ? r->loaded[i] : error + path->line_force / r->stiffness[i];
    case STIFFNESS_OUT_ERROR:
        return error;
    default: /* this is STIFFNESS_OUT_PAIRS */
        if (r->pairs)
            return r->pairs[i];
        return (double)stiffness_pairs(path->contact_ratio, r->cycle.phase[i],
                                       stiffness_cycle_side(&r->cycle, i));
    }
}

static ff_status write_phases(const ff_host *host, uint64_t wanted, const stiffness_result *r,
                              const stiffness_path *path)
{
    static const uint32_t rows[] = {STIFFNESS_OUT_PHASE, STIFFNESS_OUT_STIFFNESS,
                                    STIFFNESS_OUT_LOADED_ERROR, STIFFNESS_OUT_ERROR,
                                    STIFFNESS_OUT_PAIRS};
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        if (!wants(wanted, (int)rows[k]))
            continue;
        double *to = ff_put_series(host, rows[k], r->cycle.count);
        if (!to)
            return FF_NOMEM;
        for (size_t i = 0; i < r->cycle.count; i++)
            to[i] = at_phase(r, path, rows[k], i);
    }
    return FF_OK;
}

static ff_status write_hunting(const ff_host *host, uint64_t wanted, const stiffness_result *r)
{
    double period = r->hunting ? (double)r->hunting : 1;
    if (wants(wanted, STIFFNESS_OUT_HUNTING_PERIOD) &&
        ff_put_scalar(host, STIFFNESS_OUT_HUNTING_PERIOD, period) != FF_OK)
        return FF_NOMEM;
    if (!wants(wanted, STIFFNESS_OUT_HUNTING_ERROR))
        return FF_OK;
    size_t count = r->hunting_error ? r->hunting_points : r->cycle.count;
    const double *from = r->hunting_error ? r->hunting_error : r->error;
    double *to = ff_put_series(host, STIFFNESS_OUT_HUNTING_ERROR, count);
    if (!to)
        return FF_NOMEM;
    if (from)
        memcpy(to, from, count * sizeof *to);
    return FF_OK;
}

/* Writes the pressure on the pairs of the hunting period, and the pair with the highest
   pressure. */
static ff_status write_worst(const ff_host *host, uint64_t wanted, const stiffness_result *r)
{
    static const uint32_t rows[] = {STIFFNESS_OUT_HUNTING_PRESSURE, STIFFNESS_OUT_WORST_CYCLE,
                                    STIFFNESS_OUT_WORST_TEETH};
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++)
        if (wants(wanted, (int)rows[k]) && !r->pressure)
            return ff_failf(host, FF_UNSUPPORTED, stiffness_outputs[rows[k]].name,
                            "this output needs index deviations (pitch_error of the gear) and a "
                            "stiffness model that includes them");
    if (wants(wanted, STIFFNESS_OUT_HUNTING_PRESSURE)) {
        double *to = ff_put_series(host, STIFFNESS_OUT_HUNTING_PRESSURE, r->hunting);
        if (!to)
            return FF_NOMEM;
        memcpy(to, r->pressure, r->hunting * sizeof *to);
    }
    if (wants(wanted, STIFFNESS_OUT_WORST_TEETH)) {
        double *to = ff_put_series(host, STIFFNESS_OUT_WORST_TEETH, 2);
        if (!to)
            return FF_NOMEM;
        for (int g = 0; g < 2; g++)
            to[g] = (double)r->worst_teeth[g];
    }
    if (wants(wanted, STIFFNESS_OUT_WORST_CYCLE))
        return ff_put_scalar(host, STIFFNESS_OUT_WORST_CYCLE, (double)r->worst);
    return FF_OK;
}

/* Returns the largest minus the smallest loaded transmission error. */
static double peak_to_peak(const stiffness_result *r, const stiffness_path *path)
{
    double high = -HUGE_VAL, low = HUGE_VAL;
    for (size_t i = 0; i < r->cycle.count; i++) {
        double error = at_phase(r, path, STIFFNESS_OUT_LOADED_ERROR, i);
        high = fmax(high, error);
        low = fmin(low, error);
    }
    return high - low;
}

static ff_status write_cycle_figures(const ff_host *host, uint64_t wanted,
                                     const stiffness_result *r, const stiffness_path *path)
{
    if (wants(wanted, STIFFNESS_OUT_LOADED_RATIO) &&
        ff_put_scalar(host, STIFFNESS_OUT_LOADED_RATIO, loaded_ratio(r, path)) != FF_OK)
        return FF_NOMEM;
    if (wants(wanted, STIFFNESS_OUT_PEAK_TO_PEAK) &&
        ff_put_scalar(host, STIFFNESS_OUT_PEAK_TO_PEAK, peak_to_peak(r, path)) != FF_OK)
        return FF_NOMEM;
    if (wants(wanted, STIFFNESS_OUT_MEAN) &&
        ff_put_scalar(host, STIFFNESS_OUT_MEAN, stiffness_cycle_mean(&r->cycle, r->stiffness)) !=
            FF_OK)
        return FF_NOMEM;
    if (wants(wanted, STIFFNESS_OUT_HARMONICS)) {
        double *to = ff_put_series(host, STIFFNESS_OUT_HARMONICS, HARMONICS);
        if (!to)
            return FF_NOMEM;
        for (int n = 1; n <= HARMONICS; n++)
            to[n - 1] = stiffness_cycle_amplitude(&r->cycle, r->stiffness, n);
    }
    if (wants(wanted, STIFFNESS_OUT_BREAKPOINTS)) {
        double *to = ff_put_series(host, STIFFNESS_OUT_BREAKPOINTS, r->breakpoints);
        if (!to)
            return FF_NOMEM;
        if (r->breakpoints > 0)
            memcpy(to, r->breakpoint, r->breakpoints * sizeof *to);
    }
    return FF_OK;
}

/* Returns the largest |sum of the tooth forces - F|/F over the mesh cycle. */
static double imbalance(const stiffness_result *r, const stiffness_path *path)
{
    double worst = 0;
    for (size_t i = 0; i < r->cycle.count; i++) {
        double phase = r->cycle.phase[i], sum = 0;
        int side = stiffness_cycle_side(&r->cycle, i);
        double length = r->before + path->contact_ratio + r->after;
        for (double age = phase - ceil(r->before); age <= length + 1; age += 1)
            if (stiffness_touches(length, age + r->before, side))
                sum += r->share(r->self, age, phase, side);
        worst = fmax(worst, fabs(sum - 1));
    }
    return worst;
}

static void report_equilibrium(const ff_host *host, const stiffness_result *r,
                               const stiffness_path *path)
{
    double residual = imbalance(r, path);
    int held = residual <= r->balance;
    host->quality(host->ctx, "equilibrium", residual, r->balance, held ? FF_GOOD : FF_DOUBTFUL,
                  held ? "relative difference between the sum of the tooth forces and the line "
                         "force"
                       : "relative difference between the sum of the tooth forces and the line "
                         "force: the load share does not fit the gear's path of contact");
}

/* Reports the mean deviation of k from linear interpolation between the points, over the mean of k.
   The error of the amplitudes of k is at most twice this mean deviation. For a parabola, the mean
   deviation is 2/3 of the deviation from the chord in the middle. */
static void report_interpolation(const ff_host *host, const stiffness_result *r)
{
    const double limit = 1e-3;
    double sum = 0;
    for (size_t i = 1; i < r->cycle.count; i++) {
        double a = r->cycle.phase[i - 1], b = r->cycle.phase[i];
        if (!(b > a))
            continue;
        double there = r->stiffness_at(r->self, (a + b) / 2, STIFFNESS_ABOVE);
        double line = (r->stiffness[i - 1] + r->stiffness[i]) / 2;
        sum += 2. / 3 * fabs(line - there) * (b - a);
    }
    double mean = sum / stiffness_cycle_mean(&r->cycle, r->stiffness);
    int held = mean <= limit;
    host->quality(host->ctx, "interpolation_error", mean, limit, held ? FF_GOOD : FF_DOUBTFUL,
                  held ? "mean deviation of k from straight lines between the points, over the "
                         "mean of k"
                       : "mean deviation of k from straight lines between the points, over the "
                         "mean of k: increase points");
}

ff_status stiffness_result_publish(const ff_host *host, uint64_t wanted, const stiffness_result *r,
                                   const stiffness_path *path)
{
    ff_status status = write_phases(host, wanted, r, path);
    if (status == FF_OK)
        status = write_cycle_figures(host, wanted, r, path);
    if (status == FF_OK)
        status = write_hunting(host, wanted, r);
    if (status == FF_OK)
        status = write_worst(host, wanted, r);
    if (status == FF_OK)
        status = write_stations(host, wanted, r, path);
    if (status == FF_OK)
        status = write_engagement(host, wanted, r, path);
    if (status == FF_OK &&
        (wants(wanted, STIFFNESS_OUT_TOOTH_FORCE) || wants(wanted, STIFFNESS_OUT_LOAD_SHARE)))
        report_equilibrium(host, r, path);
    if (status == FF_OK)
        report_interpolation(host, r);
    return status;
}
