/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quasi-static.h"

#include "hunting.h"

#include <math.h>
#include <stdlib.h>

const double stiffness_corner_reach = 0.45;

enum { MAX_CORNERS = 64, MAX_FOUND = 64, MAX_BREAKS = 2 * MAX_CORNERS + MAX_FOUND + 16 };
/* Points over the hunting period, at most: of teeth without load, and of loaded ones, of which as
   many take a second or two. */
enum { HUNTING_STEPS = 32, HUNTING_MOST = 1 << 22, LOADED_MOST = 1 << 19 };

/* A mesh without load has the stiffness of this one, N. */
static const double least_force = 1e-6;

static int place_of(double age, double phase)
{
    return (int)lround(age - phase);
}

/* Gap of a pair; false when it meets no flank. */
static bool find_gap(const stiffness_source *s, double age, long number, double roll[2],
                     double *gap)
{
    if (s->corner || (age >= 0 && age <= s->conditions->gears.contact_ratio)) {
        if (!stiffness_gears_contact(&s->conditions->gears, age, roll, gap))
            return false;
    } else { /* contact that a source spreads beyond the path is held at its ends */
        double end = age < 0 ? 0 : s->conditions->gears.contact_ratio;
        stiffness_gears_contact(&s->conditions->gears, end, roll, gap);
    }
    for (int g = 0; g < 2; g++)
        *gap -= stiffness_profile(&s->conditions->deviations, g, roll[g]);
    *gap -= stiffness_index(&s->conditions->deviations, number);
    return isfinite(*gap);
}

static void find_pairs(const stiffness_source *s, size_t cycle, double phase, int side,
                       stiffness_position *at, stiffness_contacts *c)
{
    double length = s->before + s->conditions->path.contact_ratio + s->after;
    at->count = 0;
    for (int place = -(int)ceil(s->before); at->count < STIFFNESS_MAX_PAIRS; place++) {
        double age = phase + place;
        if (age + s->before > length + 1)
            break;
        if (!stiffness_touches(length, age + s->before, side))
            continue;
        if (!s->corner && s->sharp)
            age = fmin(fmax(age, 0), s->conditions->path.contact_ratio);
        long number = (long)cycle - place;
        if (find_gap(s, age, number, at->roll[at->count], &c->gap[at->count]))
            at->age[at->count++] = age;
    }
    c->count = at->count;
}

stiffness_loaded stiffness_source_solve(const stiffness_source *s, size_t cycle, double phase,
                                        int side)
{
    stiffness_loaded r = {0};
    stiffness_contacts c;
    find_pairs(s, cycle, phase, side, &r.at, &c);
    s->compliance(s->self, &r.at, &c);
    r.solved = stiffness_share(&c, fmax(s->conditions->path.line_force, least_force), &r.sharing);
    double secant = fmax(s->conditions->path.line_force, least_force) / r.sharing.deflection;
    r.stiffness = s->tangent ? r.sharing.tangent : secant;
    r.solved = r.solved && r.stiffness > 0 && isfinite(r.stiffness);
    double least = INFINITY;
    for (size_t i = 0; i < r.at.count; i++) {
        int place = place_of(r.at.age[i], phase);
        if (r.sharing.force[i] > 0)
            r.loaded |= UINT64_C(1) << (place + 8);
        if (c.gap[i] < least - 1e-15) {
            least = c.gap[i];
            r.first = place;
        }
    }
    return r;
}

static stiffness_loaded solve(const stiffness_source *s, double phase, int side)
{
    return stiffness_source_solve(s, s->cycles.number, phase, side);
}

static double stiffness_at(const void *self, double phase, int side)
{
    return solve(self, phase, side).stiffness;
}

/* Share of the force that the pair whose age is that at a mesh position carries there. */
static double share_in(const stiffness_source *s, const stiffness_loaded *r, double age,
                       double phase)
{
    for (size_t i = 0; i < r->at.count; i++)
        if (place_of(r->at.age[i], phase) == place_of(age, phase))
            return r->sharing.force[i] / fmax(s->conditions->path.line_force, least_force);
    return 0;
}

static double share(const void *self, double age, double phase, int side)
{
    stiffness_loaded r = solve(self, phase, side);
    return share_in(self, &r, age, phase);
}

/* The pair passes from the mesh cycle that it enters in to the next ones. */
static double share_of_pair(const void *self, size_t number, double age, int side)
{
    double phase = stiffness_phase_of(age, side);
    int later = place_of(age, phase);
    size_t period = stiffness_hunting(&((const stiffness_source *)self)->conditions->deviations);
    size_t cycle = number + period + (size_t)(later % (int)period);
    stiffness_loaded r = stiffness_source_solve(self, cycle, phase, side);
    return share_in(self, &r, age, phase);
}

typedef struct breaks {
    size_t count;
    stiffness_break list[MAX_BREAKS];
    double phase[MAX_BREAKS];
} breaks;

static void add_break(breaks *b, double age, bool jump)
{
    if (b->count < MAX_BREAKS)
        b->list[b->count++] = (stiffness_break){stiffness_phase_of(age, STIFFNESS_ABOVE), jump};
}

static int by_phase(const void *a, const void *b)
{
    double x = ((const stiffness_break *)a)->phase, y = ((const stiffness_break *)b)->phase;
    return (x > y) - (x < y);
}

/* Sorts, and makes one of those that agree. */
static void tidy(breaks *b)
{
    size_t n = 0;
    qsort(b->list, b->count, sizeof b->list[0], by_phase);
    for (size_t i = 0; i < b->count; i++) {
        if (n > 0 && b->list[i].phase - b->list[n - 1].phase <= STIFFNESS_PHASE_TOLERANCE)
            b->list[n - 1].jump |= b->list[i].jump;
        else
            b->list[n++] = b->list[i];
    }
    b->count = n;
    for (size_t i = 0; i < n; i++)
        b->phase[i] = b->list[i].phase;
}

/* Ends of contact, bends of the compliance and corners of the profiles. */
static void known_breaks(const stiffness_source *s, breaks *b)
{
    double tip = s->conditions->path.contact_ratio, roll[MAX_CORNERS];
    add_break(b, 0, s->sharp);
    add_break(b, -s->before, s->sharp);
    add_break(b, tip, s->sharp && !(s->after > 0));
    add_break(b, tip + s->after, s->sharp);
    for (size_t i = 0; i < s->bends; i++)
        add_break(b, s->bend[i], false);
    for (int g = 0; g < 2; g++) {
        size_t corners =
            stiffness_profile_corners(&s->conditions->deviations, g, roll, MAX_CORNERS);
        double sap = stiffness_gears_roll(&s->conditions->gears, g, 0),
               end = stiffness_gears_roll(&s->conditions->gears, g, tip);
        for (size_t i = 0; i < corners; i++) {
            double age = tip * (roll[i] - sap) / (end - sap);
            if (age >= 0 && age <= tip)
                add_break(b, age, false);
        }
    }
}

static bool same_state(const stiffness_loaded *a, const stiffness_loaded *b)
{
    return a->loaded == b->loaded && a->first == b->first;
}

/* Where pairs gain or lose load, or another pair becomes the first: by bisection of the equal
   steps. */
static void find_breaks(const stiffness_source *s, breaks *b)
{
    stiffness_cycle grid;
    size_t known = b->count, limit = known + MAX_FOUND;
    if (!stiffness_cycle_make(&grid, s->points, known, b->list))
        return;
    for (size_t i = 1; i < grid.count; i++) {
        double low = grid.phase[i - 1], end = grid.phase[i];
        if (!(end > low))
            continue;
        stiffness_loaded from = solve(s, low, STIFFNESS_ABOVE), to = solve(s, end, STIFFNESS_BELOW);
        for (int more = 0; more < 4 && !same_state(&from, &to) && b->count < limit; more++) {
            double high = end;
            for (int k = 0; k < 50 && high - low > 1e-12; k++) {
                double middle = (low + high) / 2;
                stiffness_loaded there = solve(s, middle, STIFFNESS_ABOVE);
                *(same_state(&from, &there) ? &low : &high) = middle;
            }
            add_break(b, high, false);
            low = fmin(high + STIFFNESS_PHASE_TOLERANCE, end);
            from = solve(s, low, STIFFNESS_ABOVE);
        }
    }
    stiffness_cycle_free(&grid);
    tidy(b);
}

/* Values at the points of the cycle. */
typedef struct samples {
    stiffness_cycle cycle;
    double *stiffness, *error, *loaded, *pairs, *hunting;
    size_t hunting_points;
    double residual;
} samples;

static void samples_free(samples *v)
{
    stiffness_cycle_free(&v->cycle);
    free(v->stiffness);
    free(v->hunting);
}

static ff_status sample(const stiffness_source *s, samples *v)
{
    size_t n = v->cycle.count;
    v->stiffness = malloc(4 * n * sizeof *v->stiffness);
    if (!v->stiffness)
        return FF_NOMEM;
    v->error = v->stiffness + n;
    v->loaded = v->error + n;
    v->pairs = v->loaded + n;
    for (size_t i = 0; i < n; i++) {
        if (i % 1024 == 0 && s->host->progress(s->host->ctx, (double)i / (double)n) != 0)
            return FF_STOPPED;
        stiffness_loaded r = solve(s, v->cycle.phase[i], stiffness_cycle_side(&v->cycle, i));
        if (!r.solved)
            return ff_failf(s->host, FF_INVALID, s->fault,
                            "at phase %g the teeth cannot carry F = %g N: stiffness %g N/m",
                            v->cycle.phase[i], s->conditions->path.line_force, r.stiffness);
        v->stiffness[i] = r.stiffness;
        v->error[i] = r.sharing.unloaded;
        v->loaded[i] =
            r.sharing.unloaded + (s->conditions->path.line_force > 0 ? r.sharing.deflection : 0);
        v->pairs[i] = 0;
        for (size_t k = 0; k < r.at.count; k++)
            v->pairs[i] += r.sharing.force[k] > 0;
        v->residual = fmax(v->residual, r.sharing.residual);
    }
    return FF_OK;
}

static double unloaded_error(const stiffness_source *s, size_t cycle, double phase)
{
    stiffness_position at;
    stiffness_contacts c;
    double least = INFINITY;
    find_pairs(s, cycle, phase, STIFFNESS_ABOVE, &at, &c);
    for (size_t i = 0; i < c.count; i++)
        least = fmin(least, c.gap[i]);
    return least;
}

static ff_status sample_hunting(const stiffness_source *s, samples *v)
{
    size_t period = stiffness_hunting(&s->conditions->deviations), steps = HUNTING_STEPS;
    if (period == 1)
        return FF_OK;
    while (steps > 1 && period * steps > HUNTING_MOST)
        steps /= 2;
    v->hunting_points = period * steps;
    v->hunting = malloc(v->hunting_points * sizeof *v->hunting);
    if (!v->hunting)
        return FF_NOMEM;
    for (size_t i = 0; i < v->hunting_points; i++)
        v->hunting[i] = unloaded_error(s, i / steps, (double)(i % steps) / (double)steps);
    return FF_OK;
}

stiffness_mesh_cycles stiffness_mesh_cycles_set(const ff_value *value)
{
    if (!value->text)
        return (stiffness_mesh_cycles){.number = (size_t)value->integer};
    return (stiffness_mesh_cycles){.which = value->text[0] == 'w' ? STIFFNESS_CYCLE_WORST
                                                                  : STIFFNESS_CYCLE_ALL};
}

static ff_status check_cycle(const ff_host *host, const stiffness_deviations *d, size_t cycle)
{
    size_t period = stiffness_hunting(d);
    if (cycle == 0 || cycle < period)
        return FF_OK;
    return ff_failf(host, FF_INVALID, "mesh_cycle",
                    "the teeth meet again after %zu mesh cycles: the last one is number %zu, not "
                    "%zu",
                    period, period - 1, cycle);
}

ff_status stiffness_conditions_read(const ff_host *host, const ff_array *in,
                                    const stiffness_rim *rim, stiffness_mesh_cycles cycles,
                                    stiffness_conditions *conditions)
{
    ff_status status = stiffness_path_read(host, in, &conditions->path);
    if (status == FF_OK)
        status = stiffness_deviations_read(host, in, &conditions->deviations);
    if (status == FF_OK)
        status = check_cycle(host, &conditions->deviations, cycles.number);
    return status == FF_OK
               ? stiffness_gears_read(host, in, &conditions->path, rim, &conditions->gears)
               : status;
}

static void report_contact(const stiffness_source *s, const samples *v)
{
    const double limit = 1e-10;
    s->host->quality(s->host->ctx, "complementarity", v->residual, limit,
                     v->residual <= limit ? FF_GOOD : FF_BAD,
                     "gap of a loaded pair or overlap of another, over the deflection");
}

/* What the hunting period holds, on the equal steps and the breaks that are known beforehand; the
   worst mesh cycle becomes the number if that is asked for. */
static ff_status hunt(stiffness_source *s, const breaks *b, stiffness_hunt *h)
{
    stiffness_cycle grid;
    size_t steps = s->points;
    *h = (stiffness_hunt){.period = stiffness_hunting(&s->conditions->deviations)};
    if (h->period == 1)
        return FF_OK;
    while (steps > 8 && h->period * steps > LOADED_MOST)
        steps /= 2;
    if (!stiffness_cycle_make(&grid, steps, b->count, b->list))
        return FF_NOMEM;
    ff_status status = stiffness_hunt_scan(s, &grid, h);
    stiffness_cycle_free(&grid);
    if (s->cycles.which == STIFFNESS_CYCLE_WORST)
        s->cycles.number = h->worst;
    return status;
}

static stiffness_result mesh_of(const stiffness_source *s, const samples *v, const breaks *b,
                                const stiffness_hunt *h)
{
    return (stiffness_result){.cycle = v->cycle,
                              .stiffness = v->stiffness,
                              .error = v->error,
                              .loaded = v->loaded,
                              .pairs = v->pairs,
                              .breaks = b->count,
                              .breakpoint = b->phase,
                              .stiffness_at = stiffness_at,
                              .share = share,
                              .share_of_pair = share_of_pair,
                              .self = s,
                              .before = s->before,
                              .after = s->after,
                              .balance = 1e-12,
                              .hunting = h->period,
                              .engagements = s->cycles.which == STIFFNESS_CYCLE_ALL ? h->period : 1,
                              .pressure = h->pressure,
                              .worst = h->worst,
                              .worst_teeth = {h->teeth[0], h->teeth[1]},
                              .hunting_points = v->hunting_points,
                              .hunting_error = v->hunting};
}

ff_status stiffness_source_publish(const stiffness_source *source, uint64_t wanted)
{
    stiffness_source s = *source;
    breaks *b = calloc(1, sizeof *b);
    samples v = {0};
    stiffness_hunt h = {0};
    ff_status status = FF_NOMEM;
    if (!b)
        goto out;
    known_breaks(&s, b);
    tidy(b);
    status = hunt(&s, b, &h);
    if (status != FF_OK)
        goto out;
    find_breaks(&s, b);
    status =
        stiffness_cycle_make(&v.cycle, s.points, b->count, b->list) ? sample(&s, &v) : FF_NOMEM;
    if (status == FF_OK && wanted & FF_BIT(STIFFNESS_OUT_HUNTING_ERROR))
        status = sample_hunting(&s, &v);
    if (status != FF_OK)
        goto out;
    report_contact(&s, &v);
    if (h.pressure && s.cycles.which == STIFFNESS_CYCLE_NUMBER)
        stiffness_hunt_report(&s, &h, s.cycles.number);
    stiffness_result mesh = mesh_of(&s, &v, b, &h);
    status = stiffness_result_publish(s.host, wanted, &mesh, &s.conditions->path);
out:
    free(h.pressure);
    samples_free(&v);
    free(b);
    return status;
}
