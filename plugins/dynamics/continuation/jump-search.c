/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "jump-search.h"

#include "atlas.h"

#include <math.h>

/* Smallest relative change of the rms that counts as a jump. Within the narrow range of speeds that
   is searched, nothing else changes the rms so much. */
static const double jumps = 0.2;

/* Keeps the fold if it is the nearest so far, with the rms of the motions at both ends of the
   curve. These two motions merge at the fold. */
static void keep_nearest_fold(const dynamics_curve *curve, size_t at, dynamics_jump *jump)
{
    const dynamics_point *fold = &curve->points[at];
    double one = curve->points[0].rms, two = curve->points[curve->count - 1].rms;
    if (jump->near && fabs(fold->lambda) >= fabs(jump->lambda))
        return;
    *jump =
        (dynamics_jump){.near = 1, .is_fold = 1, .lambda = fold->lambda, .rms = one, .other = two};
}

static ff_status search_along_curve(const dynamics_jump_search *n, const dynamics_attractor *a,
                                    dynamics_jump *jump)
{
    dynamics_continuation_range tracing = {.flow = n->flow,
                                           .low = a->orbit.lambda - n->width,
                                           .high = a->orbit.lambda + n->width,
                                           .step = n->step,
                                           .moments = 1,
                                           .host = n->host};
    dynamics_curve curve = {0};
    ff_status status = dynamics_curve_trace(&tracing, &a->orbit, &curve);
    for (size_t i = 0; status == FF_OK && i < curve.count; i++)
        if (curve.points[i].kind == DYNAMICS_POINT_FOLD &&
            fabs(curve.points[i].lambda - a->orbit.lambda) <= n->width)
            keep_nearest_fold(&curve, i, jump);
    dynamics_curve_free(&curve);
    return status;
}

static ff_status search_beside(const dynamics_jump_search *n, double lambda, double rms,
                               dynamics_jump *jump)
{
    dynamics_attractor other = {.period = DYNAMICS_APERIODIC};
    double beside = 0;
    ff_status status = n->find(n->ctx, lambda, &other);
    if (status != FF_OK)
        return status == FF_NOCONV ? FF_OK : status;
    if (other.period > 0 && !dynamics_orbit_rms(n->flow, &other.orbit, &beside))
        return FF_OK;
    if (!jump->near && fabs(beside - rms) > jumps * fmax(rms, beside))
        *jump = (dynamics_jump){.near = 1, .lambda = lambda, .rms = rms, .other = beside};
    return FF_OK;
}

ff_status dynamics_find_jump(const dynamics_jump_search *n, const dynamics_attractor *a,
                             dynamics_jump *jump)
{
    double rms;
    *jump = (dynamics_jump){0};
    if (!dynamics_orbit_rms(n->flow, &a->orbit, &rms))
        return FF_OK;
    ff_status status = search_along_curve(n, a, jump);
    for (int side = -1; status == FF_OK && n->find && side <= 1; side += 2)
        status = search_beside(n, a->orbit.lambda + side * n->width, rms, jump);
    return status;
}

/* Returns the rms of the stable motion that ends at a fold, taken at the point before the fold.
   Returns a negative number if no stable motion ends there. */
static double rms_of_stable_end(const dynamics_curve *c, size_t fold)
{
    for (int side = -1; side <= 1; side += 2) {
        size_t at = side < 0 ? fold - 1 : fold + 1;
        if (c->points[at].largest < dynamics_stable_multiplier)
            return c->points[at].rms;
    }
    return -1;
}

/* Searches above the speed only: resonance curves bend towards low speeds, so a motion that ends
   near this speed exists at higher speeds. */
ff_status dynamics_find_fold_of_another(const dynamics_jump_search *n, const dynamics_attractor *a,
                                        dynamics_jump *jump)
{
    double lambda = a->orbit.lambda, rms = 0;
    dynamics_atlas_request request = {
        .low = lambda - 0.05, .high = lambda + 0.8, .step = n->step, .max_period = 1, .moments = 1};
    dynamics_atlas atlas = {0};
    ff_status status = dynamics_atlas_build(n->flow, &request, n->host, &atlas);
    int known = dynamics_orbit_rms(n->flow, &a->orbit, &rms);
    for (size_t i = 0; status == FF_OK && known && i < atlas.curve_count; i++) {
        const dynamics_curve *c = &atlas.curves[i];
        for (size_t k = 1; k + 1 < c->count; k++) {
            double distance = fabs(c->points[k].lambda - lambda);
            double other = c->points[k].kind == DYNAMICS_POINT_FOLD ? rms_of_stable_end(c, k) : -1;
            if (distance <= n->width && other >= 0)
                *jump = (dynamics_jump){1, c->points[k].lambda, rms, other, 1, 1};
        }
    }
    dynamics_atlas_free(&atlas);
    return status;
}
