/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves a mesh cycle of loaded teeth and writes its outputs. */
#include "loaded-cycle.h"

#include "back-flank.h"
#include "breakpoints.h"
#include "cycle.h"
#include "hunting.h"
#include "levels.h"
#include "outputs.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

const double stiffness_corner_reach = 0.45;

/* HUNTING_STEPS: steps per mesh cycle of the transmission error without load. HUNTING_MOST and
   LOADED_MOST: largest number of points over a hunting period without load and with load;
   LOADED_MOST points take one or two seconds. */
enum { HUNTING_STEPS = 32, HUNTING_MOST = 1 << 22, LOADED_MOST = 1 << 19 };

static stiffness_loaded solve(const stiffness_source *s, double phase, int side)
{
    return stiffness_source_solve(s, s->cycles.number, phase, side);
}

static double stiffness_at(const void *self, double phase, int side)
{
    return solve(self, phase, side).stiffness;
}

/* Returns the share of the force on the pair of that age at the mesh position of `r`. */
static double share_in(const stiffness_source *s, const stiffness_loaded *r, double age,
                       double phase)
{
    return stiffness_loaded_force(r, age, phase) / stiffness_source_force(s);
}

static double share(const void *self, double age, double phase, int side)
{
    stiffness_loaded r = solve(self, phase, side);
    return share_in(self, &r, age, phase);
}

/* Returns the share of the pair that enters in mesh cycle `number`. The pair is in contact in this
   mesh cycle and in the following mesh cycles. */
static double share_of_pair(const void *self, size_t number, double age, int side)
{
    double phase = stiffness_phase_of(age, side);
    int later = (int)lround(age - phase);
    size_t period =
        stiffness_hunting_period(&((const stiffness_source *)self)->conditions->deviations);
    size_t cycle = number + period + (size_t)(later % (int)period);
    stiffness_loaded r = stiffness_source_solve(self, cycle, phase, side);
    return share_in(self, &r, age, phase);
}

/* Outputs at the points of the cycle. */
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

enum { REPORT_EVERY = 1024 }; /* points */

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
        if (i % REPORT_EVERY == 0 && s->host->progress(s->host->ctx, (double)i / (double)n) != 0)
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
        if (s->conditions->path.line_force > 0) /* otherwise the deflection is only the rounding
                                                   error of the gaps */
            v->residual = fmax(v->residual, r.sharing.residual);
    }
    return FF_OK;
}

static ff_status sample_hunting(const stiffness_source *s, samples *v)
{
    size_t period = stiffness_hunting_period(&s->conditions->deviations), steps = HUNTING_STEPS;
    if (period == 1)
        return FF_OK;
    while (steps > 1 && period * steps > HUNTING_MOST)
        steps /= 2;
    v->hunting_points = period * steps;
    v->hunting = malloc(v->hunting_points * sizeof *v->hunting);
    if (!v->hunting)
        return FF_NOMEM;
    for (size_t i = 0; i < v->hunting_points; i++)
        v->hunting[i] =
            stiffness_source_unloaded(s, i / steps, (double)(i % steps) / (double)steps);
    return FF_OK;
}

static void report_contact(const stiffness_source *s, const samples *v)
{
    const double limit = 1e-10;
    s->host->quality(
        s->host->ctx, "complementarity", v->residual, limit,
        v->residual <= limit ? FF_GOOD : FF_BAD,
        "largest gap of a loaded pair or overlap of an unloaded pair, relative to the deflection");
}

/* Solves all mesh cycles of the hunting period at equal steps and at the breakpoints known in
   advance. If the worst mesh cycle is requested, selects it. */
static ff_status scan_hunting_period(stiffness_source *s, const stiffness_breakpoint_list *b,
                                     stiffness_hunting *h)
{
    stiffness_cycle grid;
    size_t steps = s->points;
    *h = (stiffness_hunting){.period = stiffness_hunting_period(&s->conditions->deviations)};
    if (h->period == 1)
        return FF_OK;
    while (steps > 8 && h->period * steps > LOADED_MOST)
        steps /= 2;
    if (!stiffness_cycle_make(&grid, steps, b->count, b->list))
        return FF_NOMEM;
    ff_status status = stiffness_hunting_scan(s, &grid, h);
    stiffness_cycle_free(&grid);
    if (s->cycles.which == STIFFNESS_CYCLE_WORST)
        s->cycles.number = h->worst;
    return status;
}

static stiffness_result result_of(const stiffness_source *s, const samples *v,
                                  const stiffness_breakpoint_list *b, const stiffness_hunting *h)
{
    return (stiffness_result){.cycle = v->cycle,
                              .stiffness = v->stiffness,
                              .error = v->error,
                              .loaded = v->loaded,
                              .pairs = v->pairs,
                              .breakpoints = b->count,
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

/* Finds the breakpoints and solves the cycle. */
static ff_status solve_cycle(const stiffness_source *s, stiffness_breakpoint_list *b, samples *v)
{
    return stiffness_breakpoints_find(s, b) &&
                   stiffness_cycle_make(&v->cycle, s->points, b->count, b->list)
               ? sample(s, v)
               : FF_NOMEM;
}

static stiffness_flank flank_of(const samples *v, const stiffness_level_rows *levels)
{
    return (stiffness_flank){&v->cycle, v->stiffness, v->error, v->loaded, *levels};
}

/* Solves the mesh cycle of the back flanks separately. The rows of the levels are one allocated
   block, which begins at rows->error. */
static ff_status solve_back(const stiffness_source *source, samples *v, stiffness_level_rows *rows)
{
    stiffness_conditions conditions = *source->conditions;
    stiffness_source s = *source;
    stiffness_breakpoint_list *b = calloc(1, sizeof *b);
    if (!b)
        return FF_NOMEM;
    conditions.deviations = conditions.back;
    s.conditions = &conditions;
    stiffness_breakpoints_known(&s, b);
    ff_status status = solve_cycle(&s, b, v);
    free(b);
    if (status != FF_OK)
        return status;
    const size_t count = stiffness_levels_count(&s), points = count * v->cycle.count;
    double *block = malloc((2 * points + count * conditions.path.stations) * sizeof *block);
    *rows = (stiffness_level_rows){count, block, block + points, block + 2 * points};
    return block ? stiffness_levels_solve(&s, &v->cycle, rows) : FF_NOMEM;
}

/* Writes the curves of the back flanks. If both flanks are equal and the levels of the driving
   flanks are known, the curves of the driving flanks, `v`, are used. */
static ff_status publish_back(const stiffness_source *s, uint64_t wanted, const samples *v,
                              const stiffness_level_rows *levels)
{
    const stiffness_conditions *c = s->conditions;
    const bool known = !c->deviations.index[0] && !c->deviations.index[1];
    const bool alike = c->same_back && levels->count > 0;
    samples back = {0};
    stiffness_level_rows rows = {0};
    stiffness_flank flank = flank_of(v, levels);
    ff_status status = FF_OK;
    if (!(wanted >> STIFFNESS_OUT_BACK_PHASE))
        return FF_OK;
    if (known && !alike) {
        status = solve_back(s, &back, &rows);
        flank = flank_of(&back, &rows);
    }
    if (status == FF_OK)
        status =
            stiffness_back_publish(s->host, &c->gears, known ? &flank : NULL, c->path.stations);
    free(rows.error);
    samples_free(&back);
    return status;
}

ff_status stiffness_loaded_cycle_publish(const stiffness_source *source, uint64_t wanted)
{
    stiffness_source s = *source;
    stiffness_breakpoint_list *b = calloc(1, sizeof *b);
    samples v = {0};
    stiffness_hunting h = {0};
    stiffness_level_rows levels;
    ff_status status = FF_NOMEM;
    if (!b)
        goto out;
    stiffness_breakpoints_known(&s, b);
    status = scan_hunting_period(&s, b, &h);
    if (status != FF_OK)
        goto out;
    status = solve_cycle(&s, b, &v);
    if (status == FF_OK && wanted & FF_BIT(STIFFNESS_OUT_HUNTING_ERROR))
        status = sample_hunting(&s, &v);
    if (status != FF_OK)
        goto out;
    report_contact(&s, &v);
    if (h.pressure && s.cycles.which != STIFFNESS_CYCLE_ALL)
        stiffness_hunting_report(&s, &h, s.cycles.number);
    stiffness_result result = result_of(&s, &v, b, &h);
    status = stiffness_result_publish(s.host, wanted, &result, &s.conditions->path);
    if (status == FF_OK)
        status = stiffness_levels_publish(&s, &v.cycle, wanted, &levels);
    if (status == FF_OK)
        status = publish_back(&s, wanted, &v, &levels);
out:
    free(h.pressure);
    samples_free(&v);
    free(b);
    return status;
}
