/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tooth forces and transmission errors at several mesh forces. */
#include "levels.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { MEAN = 3 /* index of the level with the mean force F */, MOST = STIFFNESS_MOST_LEVELS };

typedef struct levels {
    const stiffness_source *source;
    size_t count;
    double force[MOST];
} levels;

/* The forces are F (i/3)^2, i = 0 to 9, up to 9 F. If the line force fluctuates, the exponent may
   be larger than 2, so that the highest level exceeds the largest line force by at least a
   fifth. */
static levels levels_of(const stiffness_source *s)
{
    static const double above = 1.2, square = (MOST - 1) * (MOST - 1) / (double)(MEAN * MEAN);
    double F = s->conditions->path.line_force, top = above * s->conditions->path.largest;
    levels x = {.source = s, .count = F > 0 ? MOST : 1};
    const double power = top > square * F && F > 0 ? 2 * log(top / F) / log(square) : 2;
    for (size_t i = 0; i < x.count; i++)
        x.force[i] =
            power > 2 ? F * pow((double)i / MEAN, power) : F * (double)(i * i) / (MEAN * MEAN);
    return x;
}

static ff_status fail_at(const levels *x, double phase, double force)
{
    return ff_failf(x->source->host, FF_INVALID, x->source->fault,
                    "at phase %g the teeth cannot carry %g N, one of the force levels, too", phase,
                    force);
}

static ff_status put_cycle(const levels *x, const stiffness_cycle *cycle, double *error,
                           double *stiffness)
{
    const stiffness_source *s = x->source;
    stiffness_loaded r[MOST];
    for (size_t i = 0; i < cycle->count; i++) {
        stiffness_source_solve_all(s, s->cycles.number, cycle->phase[i],
                                   stiffness_cycle_side(cycle, i), x->count, x->force, r);
        for (size_t k = 0; k < x->count; k++) {
            if (!r[k].solved)
                return fail_at(x, cycle->phase[i], x->force[k]);
            double deflection = x->force[k] > 0 ? r[k].sharing.deflection : 0;
            error[k * cycle->count + i] = r[k].sharing.unloaded + deflection;
            stiffness[k * cycle->count + i] = r[k].sharing.tangent;
        }
    }
    return FF_OK;
}

static ff_status put_stations(const levels *x, double *force)
{
    const stiffness_source *s = x->source;
    const stiffness_path *path = &s->conditions->path;
    stiffness_loaded r[MOST];
    for (size_t i = 0; i < path->stations; i++) {
        int side;
        double age = stiffness_station_age(path, i, &side), phase = stiffness_phase_of(age, side);
        force[i] = 0;
        stiffness_source_solve_all(s, s->cycles.number, phase, side, x->count - 1, x->force + 1, r);
        for (size_t k = 1; k < x->count; k++) {
            if (!r[k - 1].solved)
                return fail_at(x, phase, x->force[k]);
            force[k * path->stations + i] = stiffness_loaded_force(&r[k - 1], age, phase);
        }
    }
    return FF_OK;
}

size_t stiffness_levels_count(const stiffness_source *s)
{
    return levels_of(s).count;
}

ff_status stiffness_levels_solve(const stiffness_source *s, const stiffness_cycle *cycle,
                                 const stiffness_level_rows *rows)
{
    levels x = levels_of(s);
    ff_status status = put_cycle(&x, cycle, rows->error, rows->stiffness);
    return status == FF_OK ? put_stations(&x, rows->teeth) : status;
}

ff_status stiffness_levels_publish(const stiffness_source *s, const stiffness_cycle *cycle,
                                   uint64_t wanted, stiffness_level_rows *rows)
{
    const ff_host *host = s->host;
    levels x = levels_of(s);
    const size_t phases[] = {x.count, cycle->count};
    const size_t stations[] = {x.count, s->conditions->path.stations};
    *rows = (stiffness_level_rows){0};
    if (!(wanted >> STIFFNESS_OUT_FORCE_LEVEL))
        return FF_OK;
    double *force = ff_put_series(host, STIFFNESS_OUT_FORCE_LEVEL, x.count);
    *rows = (stiffness_level_rows){
        .count = x.count,
        .error = host->output(host->ctx, STIFFNESS_OUT_LEVEL_ERROR, 2, phases),
        .stiffness = host->output(host->ctx, STIFFNESS_OUT_LEVEL_STIFFNESS, 2, phases),
        .teeth = host->output(host->ctx, STIFFNESS_OUT_LEVEL_TOOTH_FORCE, 2, stations)};
    if (!force || !rows->error || !rows->stiffness || !rows->teeth)
        return FF_NOMEM;
    for (size_t k = 0; k < x.count; k++)
        force[k] = x.force[k];
    return stiffness_levels_solve(s, cycle, rows);
}
