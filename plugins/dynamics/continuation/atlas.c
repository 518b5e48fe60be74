/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "atlas.h"

#include "../orbits/attractor.h"

#include <math.h>
#include <stdlib.h>

/* MOST_CURVES: largest number of curves of an atlas. RESTS: number of intervals of the speed range;
   a motion is started from rest at each end of an interval. */
enum { MOST_CURVES = 400, RESTS = 12 };

typedef struct builder {
    const dynamics_flow *flow;
    const dynamics_atlas_request *request;
    dynamics_continuation_range tracing;
    dynamics_atlas *atlas;
    size_t met[MOST_CURVES]; /* number of starts of the search that led to each curve */
} builder;

/* Returns whether the orbit lies on the stretch of a curve between two points. */
static int lies_between(const dynamics_flow *flow, const dynamics_point *a, const dynamics_point *z,
                        const dynamics_orbit *orbit)
{
    static const double far = 1, same = 1e-6; /* both distances are in units of
                                                 dynamics_state_unit */
    double lambda = orbit->lambda, distance;
    if (!(lambda >= fmin(a->lambda, z->lambda) && lambda <= fmax(a->lambda, z->lambda)))
        return 0;
    dynamics_orbit near = {.period = orbit->period, .lambda = lambda};
    dynamics_curve_between(flow, a, z, lambda, near.x);
    if (!dynamics_orbit_distance(flow, orbit, near.x, &distance) || distance > far)
        return 0;
    return dynamics_orbit_solve(flow, 1e-10, &near) &&
           dynamics_orbit_distance(flow, orbit, near.x, &distance) && distance < same;
}

/* Returns the index of the curve that contains the orbit, or curve_count if no curve contains
   it. */
static size_t curve_of(const dynamics_flow *flow, const dynamics_atlas *atlas,
                       const dynamics_orbit *orbit)
{
    for (size_t i = 0; i < atlas->curve_count; i++) {
        const dynamics_curve *c = &atlas->curves[i];
        for (size_t k = 0; c->period == orbit->period && k + 1 < c->count; k++)
            if (lies_between(flow, &c->points[k], &c->points[k + 1], orbit))
                return i;
    }
    return atlas->curve_count;
}

static ff_status add_curve(builder *b, const dynamics_orbit *orbit)
{
    dynamics_atlas *atlas = b->atlas;
    if (atlas->curve_count == MOST_CURVES)
        return FF_OK;
    dynamics_curve *c = &atlas->curves[atlas->curve_count];
    ff_status status = dynamics_curve_trace(&b->tracing, orbit, c);
    if (c->count < 2)
        dynamics_curve_free(c);
    else
        atlas->curve_count++;
    return status;
}

static ff_status add_if_new(builder *b, const dynamics_orbit *orbit)
{
    int known = curve_of(b->flow, b->atlas, orbit) < b->atlas->curve_count;
    return known ? FF_OK : add_curve(b, orbit);
}

/* Adds the curve of an orbit unless the atlas contains it, and counts the start that led to the
   orbit. */
static ff_status add_met(builder *b, const dynamics_orbit *orbit)
{
    size_t curve = curve_of(b->flow, b->atlas, orbit);
    ff_status status = curve < b->atlas->curve_count ? FF_OK : add_curve(b, orbit);
    if (curve < b->atlas->curve_count)
        b->met[curve]++;
    return status;
}

/* Adds the curve of the motion that starts from rest. If that motion does not repeat after one mesh
   cycle, Newton's method may still find an unstable motion of one mesh cycle near it. */
static ff_status add_from_rest(builder *b, double lambda)
{
    const dynamics_excitation *excitation = b->flow->excitation;
    double T = dynamics_cycle_duration(lambda);
    dynamics_search search = {lambda, b->request->max_period,
                              dynamics_settle_limit(excitation, T, 1e-3), 0};
    dynamics_attractor a = {.x = {dynamics_rest_deflection(excitation), 0}};
    if (!dynamics_attract(b->flow, &search, &a))
        return FF_OK;
    if (a.period > 0) {
        ff_status status = add_if_new(b, &a.orbit);
        if (status != FF_OK || a.period == 1)
            return status;
    }
    dynamics_orbit o = {.period = 1, .lambda = lambda, .x = {a.x[0], a.x[1]}};
    return dynamics_orbit_solve(b->flow, 1e-12, &o) ? add_if_new(b, &o) : FF_OK;
}

/* Returns whether a curve of twice the period already ends at this period doubling. */
static int is_joined(const builder *b, const dynamics_point *p, int period)
{
    /* near: distance in state units; near_speed: difference of lambda */
    static const double near = 3e-2, near_speed = 3e-3;
    for (size_t i = 0; i < b->atlas->curve_count; i++) {
        const dynamics_curve *c = &b->atlas->curves[i];
        for (int k = 0; k < 2 && c->period == 2 * period; k++) {
            const dynamics_point *end = &c->points[k ? c->count - 1 : 0];
            if ((k ? c->last : c->first) != DYNAMICS_END_HALVED ||
                fabs(end->lambda - p->lambda) > near_speed)
                continue;
            dynamics_orbit at = {
                .period = period, .lambda = p->lambda, .x = {end->x[0], end->x[1]}};
            double distance;
            if (dynamics_orbit_distance(b->flow, &at, p->x, &distance) && distance < near)
                return 1;
        }
    }
    return 0;
}

/* Adds the curves that branch off from curve `c` at its period doublings. */
static ff_status add_doublings(builder *b, size_t c)
{
    ff_status status = FF_OK;
    int period = b->atlas->curves[c].period;
    for (size_t i = 0; i < b->atlas->curves[c].count && status == FF_OK; i++) {
        const dynamics_point *p = &b->atlas->curves[c].points[i];
        dynamics_orbit o;
        if (2 * period > b->request->max_period || p->kind != DYNAMICS_POINT_DOUBLING ||
            is_joined(b, p, period) || !dynamics_curve_double(&b->tracing, p, period, &o))
            continue;
        status = add_if_new(b, &o);
    }
    return status;
}

/* Returns point i of a sequence that fills a square evenly: the fractional parts of i g and i g^2,
   where 1/g = 1.3247... is the real root of x^3 = x + 1 (Roberts 2018, The unreasonable
   effectiveness of quasirandom sequences). */
static double evenly_spread(size_t i, double ratio)
{
    double x = 0.5 + ratio * (double)i;
    return 2 * (x - floor(x)) - 1;
}

void dynamics_search_start(const dynamics_excitation *excitation, size_t serial, double x[2])
{
    double width = excitation->half_gap + 3;
    x[0] = 1.5 * width * evenly_spread(serial, 0.7548776662466927);
    x[1] = width * evenly_spread(serial, 0.5698402909980532);
}

static ff_status search_at(builder *b, double lambda, size_t *serial)
{
    dynamics_search search = {lambda, b->request->max_period, DYNAMICS_SEARCH_CYCLES, 0};
    ff_status status = FF_OK;
    for (size_t i = 0; i < b->request->starts && status == FF_OK; i++, ++*serial) {
        dynamics_attractor a = {0};
        dynamics_search_start(b->flow->excitation, *serial, a.x);
        b->atlas->starts++;
        if (!dynamics_attract(b->flow, &search, &a))
            continue;
        b->atlas->settled += a.period > 0;
        b->atlas->unbounded += a.period == DYNAMICS_UNBOUNDED;
        if (a.period > 0)
            status = add_met(b, &a.orbit);
    }
    return status;
}

/* Starts from rest at both ends of the range first, since their curves get the first names, and
   then at speeds in between. */
static ff_status start_from_rest(builder *b)
{
    double low = b->request->low, high = b->request->high;
    ff_status status = add_from_rest(b, low);
    if (status == FF_OK)
        status = add_from_rest(b, high);
    for (int i = 1; i < RESTS && status == FF_OK; i++) {
        b->tracing.done = 0.4 * i / RESTS;
        status = add_from_rest(b, low + (high - low) * i / RESTS);
    }
    return status;
}

static ff_status search_range(builder *b)
{
    size_t serial = 0, n = b->request->speeds, first = b->atlas->curve_count;
    ff_status status = FF_OK;
    for (size_t i = 0; i < n && status == FF_OK; i++) {
        double x = ((double)i + 0.5) / (double)n;
        b->tracing.done = 0.4 + 0.5 * x;
        if (b->tracing.host->progress(b->tracing.host->ctx, b->tracing.done))
            return FF_STOPPED;
        status = search_at(b, b->request->low + x * (b->request->high - b->request->low), &serial);
    }
    b->atlas->searched = b->atlas->curve_count - first;
    for (size_t i = first; i < b->atlas->curve_count; i++)
        b->atlas->met_once += b->met[i] == 1;
    return status;
}

static void add_branch(dynamics_atlas *atlas, size_t curve, size_t first, size_t last, int *number)
{
    const dynamics_curve *c = &atlas->curves[curve];
    dynamics_atlas_branch b = {{c->period, ++*number}, curve, first, last, INFINITY, -INFINITY, 0};
    size_t stable = 0, plain = 0;
    for (size_t i = first; i <= last; i++) {
        const dynamics_point *p = &c->points[i];
        b.low = fmin(b.low, p->lambda);
        b.high = fmax(b.high, p->lambda);
        plain += p->kind == DYNAMICS_POINT_PLAIN;
        stable += p->kind == DYNAMICS_POINT_PLAIN && p->largest < dynamics_stable_multiplier;
    }
    b.stable = (stable > 0) + (stable > 0 && stable == plain);
    atlas->branches[atlas->branch_count++] = b;
}

/* Divides the curves at their folds into branches, and numbers the branches. */
static ff_status name_branches(dynamics_atlas *atlas)
{
    size_t folds = 0;
    int number[DYNAMICS_PERIOD_MAX + 1] = {0};
    for (size_t i = 0; i < atlas->curve_count; i++)
        for (size_t k = 0; k < atlas->curves[i].count; k++)
            folds += atlas->curves[i].points[k].kind == DYNAMICS_POINT_FOLD;
    atlas->branches = calloc(atlas->curve_count + folds + 1, sizeof *atlas->branches);
    if (!atlas->branches)
        return FF_NOMEM;
    for (size_t i = 0; i < atlas->curve_count; i++) {
        const dynamics_curve *c = &atlas->curves[i];
        size_t first = 0;
        for (size_t k = 1; k < c->count; k++)
            if (c->points[k].kind == DYNAMICS_POINT_FOLD || k + 1 == c->count) {
                add_branch(atlas, i, first, k, &number[c->period]);
                first = k;
            }
    }
    return FF_OK;
}

ff_status dynamics_atlas_build(const dynamics_flow *flow, const dynamics_atlas_request *request,
                               const ff_host *host, dynamics_atlas *atlas)
{
    builder b = {
        .flow = flow,
        .request = request,
        .tracing = {flow, request->low, request->high, request->step, request->moments, host, 0},
        .atlas = atlas};
    *atlas = (dynamics_atlas){.curves = calloc(MOST_CURVES, sizeof *atlas->curves)};
    if (!atlas->curves)
        return FF_NOMEM;
    ff_status status = start_from_rest(&b);
    if (status == FF_OK && request->starts > 0)
        status = search_range(&b);
    b.tracing.done = 0.9;
    for (size_t i = 0; i < atlas->curve_count && status == FF_OK; i++)
        status = add_doublings(&b, i);
    return status == FF_OK ? name_branches(atlas) : status;
}

void dynamics_atlas_free(dynamics_atlas *atlas)
{
    for (size_t i = 0; i < atlas->curve_count; i++)
        dynamics_curve_free(&atlas->curves[i]);
    free(atlas->curves);
    free(atlas->branches);
    *atlas = (dynamics_atlas){0};
}

const dynamics_atlas_branch *dynamics_atlas_find(const dynamics_atlas *atlas,
                                                 dynamics_branch_name name)
{
    for (size_t i = 0; i < atlas->branch_count; i++) {
        const dynamics_branch_name *n = &atlas->branches[i].name;
        if (n->period == name.period && n->number == name.number)
            return &atlas->branches[i];
    }
    return NULL;
}

int dynamics_atlas_orbit(const dynamics_flow *flow, const dynamics_atlas *atlas,
                         const dynamics_atlas_branch *branch, double lambda, dynamics_orbit *orbit)
{
    const dynamics_curve *c = &atlas->curves[branch->curve];
    for (size_t i = branch->first; i < branch->last; i++) {
        const dynamics_point *a = &c->points[i], *z = &c->points[i + 1];
        if (lambda < fmin(a->lambda, z->lambda) || lambda > fmax(a->lambda, z->lambda))
            continue;
        *orbit = (dynamics_orbit){.period = c->period};
        return dynamics_curve_solve(flow, a, z, lambda, orbit) &&
               dynamics_orbit_solve(flow, dynamics_orbit_accuracy, orbit);
    }
    return 0;
}

const dynamics_atlas_branch *dynamics_atlas_locate(const dynamics_flow *flow,
                                                   const dynamics_atlas *atlas,
                                                   const dynamics_orbit *orbit)
{
    for (size_t i = 0; i < atlas->branch_count; i++) {
        const dynamics_atlas_branch *b = &atlas->branches[i];
        const dynamics_curve *c = &atlas->curves[b->curve];
        for (size_t k = b->first; c->period == orbit->period && k < b->last; k++)
            if (lies_between(flow, &c->points[k], &c->points[k + 1], orbit))
                return b;
    }
    return NULL;
}
