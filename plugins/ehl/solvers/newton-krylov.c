/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newton's method for one instant. Cavitation, contact and yield are primal-dual active sets
   (Hintermueller, Ito & Kunisch 2002). gmres.h solves the linear systems. */
#include "../contact/simd-reductions.h"
#include "../equations/asperities.h"
#include "../equations/cavitation.h"
#include "../equations/solver.h"
#include "gmres.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <stdlib.h>

typedef struct newton {
    ehl_linear linear;
    ehl_cavitation cavitation;
} newton;

static void destroy(ehl_solver *s)
{
    newton *w = s->self;
    if (!w)
        return;
    ehl_linear_destroy(&w->linear);
    ehl_cavitation_destroy(&w->cavitation);
    free(w);
    s->self = NULL;
}

/* Fills h with the change of the film, and `share` with its ratio to the film where the film is
   full. Returns the largest ratio. */
FF_SIMD
static double measure_film(size_t last, double dh00, const double *restrict v,
                           const unsigned char *restrict full, const double *restrict thick,
                           double *restrict h, double *restrict share)
{
    for (size_t i = 1; i < last; i++) {
        h[i] = v[i] + dh00;
        share[i] = full[i] * h[i] / thick[i];
    }
    return ehl_greatest_size(last - 1, share + 1);
}

/* Fills h_step, the change of the film, and finds the largest changes: *dp of the pressure (Pa),
   and *dh of the full film (relative). The change of a cavitated node's mass is included in *dh. */
static void measure_step(const ehl_solver *s, const ehl_film *film, double dh00, double *dp,
                         double *dh)
{
    const newton *w = s->self;
    const ehl_reynolds *r = s->reynolds;
    if (!r->conserving && !(film->yielding > 0)) {
        *dp = ehl_greatest_size(r->last - 1, w->linear.p_step + 1);
        *dh = measure_film(r->last, dh00, w->linear.v_step, film->full, r->thick, w->linear.h_step,
                           w->linear.left);
        return;
    }
    *dp = *dh = 0;
    for (size_t i = 1; i < r->last; i++) {
        int yields = ehl_yields(r, film, i);
        double change = w->linear.h_step[i] =
            w->linear.v_step[i] + dh00 + (yields ? r->give * w->linear.p_step[i] : 0);
        double a = yields ? 0 : fabs(w->linear.p_step[i]), b = fabs(change) / r->thick[i];
        if (ehl_is_cavitated(r, film, i)) {
            double oil = r->unit * w->linear.p_step[i];
            if (i + 2 == r->nodes) /* at the last node no oil can leave that is not there
                                      (take_step) */
                oil = fmax(oil, -film->content[i]);
            b = fabs(oil) / (r->oil.density * r->thick[i]);
            a = 0;
        }
        *dp = a > *dp ? a : *dp;
        *dh = (film->full[i] || r->conserving) && b > *dh ? b : *dh;
    }
}

/* Rescales only the pressures below the hardness. Their deflection is then recomputed with a
   convolution. */
static int rescale_elastic_part(ehl_solver *s, const ehl_step *step, ehl_film *film)
{
    newton *w = s->self;
    size_t n = s->grid->nodes, centre = (size_t)(s->grid->inlet / s->grid->dx);
    double load = ehl_film_load(film, n, s->grid->dx),
           below = load - ehl_yield_load(s->reynolds, film);
    s->rescaling = fabs((step->load - load) / below);
    int held = ehl_yield_balance(s->reynolds, film, step->load, w->linear.left);
    ehl_linear_deflect(s, w->linear.left, w->linear.v_step);
    ehl_add(film->v, 1, w->linear.v_step, n);
    film->h00 -= w->linear.v_step[centre < n ? centre : n - 1];
    return held;
}

static int rescale_to_load(ehl_solver *s, const ehl_step *step, ehl_film *film)
{
    return step->loaded && film->yielding > 0 ? rescale_elastic_part(s, step, film)
                                              : ehl_rescale_to_load(s, step, film);
}

/* Returns 1 if the first Newton steps do not represent the last steps: a steady film starts far
   from its solution, and under a light load the film hardly affects the pressure. */
static int is_far(const ehl_solver *s, const ehl_step *step)
{
    const newton *w = s->self;
    return !(step->rate > 0) || w->linear.careful;
}

/* Computes one Newton step: p_step, v_step, h_step, *dh00, and its largest changes *dp and *dh. */
static ff_status newton_step(ehl_solver *s, const ehl_step *step, ehl_film *film, double *dh00,
                             double *dp, double *dh)
{
    newton *w = s->self;
    ehl_reynolds *r = s->reynolds;
    ehl_reynolds_evaluate(r, step, film);
    int moved = r->conserving ? ehl_cavitation_fill(&w->cavitation, r, film, step->rate > 0)
                              : ehl_cavitation_grow_film(&w->cavitation, r, film);
    if (w->cavitation.grown && is_far(s, step)) /* the end of the film may still move */
        w->cavitation.moved = 1;
    if (r->rough)
        moved |= ehl_contact_choose(r, step, film);
    if (moved)
        ehl_reynolds_turned(r, step, film);
    ehl_reynolds_slopes(r, step, film);
    if (r->rough) {
        ehl_contact_rows(r, step, film);
        ehl_yield_columns(r, film);
    }
    if (r->statistical.law)
        ehl_statistical_rows(r, film);
    if (ehl_linear_solve(s, step, film, dh00) != FF_OK)
        return FF_NOCONV;
    s->counters.newton += w->linear.krylov > 0; /* without iterations the residual was already small
                                                   enough, and no step was needed */
    measure_step(s, film, *dh00, dp, dh);
    return isfinite(*dp) && isfinite(*dh) && isfinite(*dh00) ? FF_OK : FF_NOCONV;
}

static void take_step(const ehl_solver *s, ehl_film *film, double share, double dh00)
{
    const newton *w = s->self;
    const ehl_reynolds *r = s->reynolds;
    for (size_t i = 1; r->conserving && i < r->last; i++)
        if (ehl_is_cavitated(r, film, i))
            film->content[i] = fmax(0, film->content[i] + share * r->unit * w->linear.p_step[i]);
    ehl_yield_step(r, film, share, w->linear.p_step);
    ehl_add(film->p, share, ehl_pressure_part(s, film, w->linear.p_step), r->nodes);
    ehl_add(film->v, share, w->linear.v_step, r->nodes);
    film->h00 += share * dh00;
}

/* Damping of the Newton steps. A node may alternate between contact and film. As long as the steps
   do not shrink, a smaller share of each step is taken; this ends the alternation. */
typedef struct damping {
    double share;        /* share of a Newton step that is taken */
    double last, before; /* sizes of the last step and of the previous one, Pa */
} damping;

static double damped_share(damping *d, int k, double size)
{
    const double least_share = 0.25,
                 shrinking = 0.6; /* shrinking: least reduction over two steps */
    int stuck = k > 2 && size > shrinking * d->before;
    d->share = stuck ? fmax(least_share, d->share / 2) : fmin(1, 2 * d->share);
    d->before = d->last;
    d->last = size;
    return d->share;
}

/* Relative change of the traction if the end of the film still moves by one node after the last
   step. */
static const double END_OF_FILM = 2e-5;

/* Returns whether the error after a step is small enough. dp and dh are the relative changes of
   pressure and film in the step. If the ends of the film did not move, the error is predicted. If
   the ends moved or are not yet found, or if the flanks are rough and contacts may change in the
   next step, the step itself must be small. */
static int is_small(const ehl_solver *s, double dp, double dh)
{
    const newton *w = s->self;
    double times = s->reynolds->rough || !s->reynolds->conserving ? 10 : 1;
    int whole = s->reynolds->rough || s->tolerance < END_OF_FILM;
    int small = whole || w->cavitation.moved ? dp <= s->tolerance && dh <= times * s->tolerance
                                             : ehl_linear_settles(s, dp, dh, times);
    return small && (whole || ehl_linear_balances(s));
}

/* The last Newton step of a smooth film whose ends did not move; the error that a step leaves is
   estimated from it and the next step. */
typedef struct judged {
    double size, reached; /* size: relative change of the pressure, 0: none; reached: remaining
                             share of the residual */
} judged;

/* Adapts the estimate of the error that a step leaves from the previous step, and stores the
   current step. */
static void learn(ehl_solver *s, const ehl_step *step, judged *last, double size, int whole)
{
    const newton *w = s->self;
    if (is_far(s, step))
        return;
    if (last->size > 0)
        ehl_linear_learn(s, last->size, last->reached, size);
    *last = (judged){.reached = w->linear.reached};
    if (whole && !w->cavitation.moved && !s->reynolds->rough)
        last->size = size;
}

static ff_status solve(ehl_solver *s, const ehl_step *step, ehl_film *film, int limit)
{
    newton *w = s->self;
    size_t n = s->grid->nodes;
    int rough = s->reynolds->rough != NULL;
    damping settled = {.share = 1};
    judged last = {0};
    ehl_cavitation_begin(&w->cavitation, n);
    if (is_far(s, step))
        ehl_linear_unlearn(s);
    if (ehl_yield_begin(s->reynolds, film))
        ehl_linear_deflect(s, film->p, film->v);
    rescale_to_load(s, step, film);
    for (int k = 0; k < limit; k++) {
        double dh00, dp, dh;
        if (newton_step(s, step, film, &dh00, &dp, &dh) != FF_OK)
            return FF_NOCONV;
        double share = ehl_step_share(s->grid, s->reynolds, film, dp, w->linear.h_step);
        if (rough)
            share = fmin(share, damped_share(&settled, k, dp));
        take_step(s, film, share, dh00);
        if (s->reynolds->statistical.law)
            ehl_reynolds_gap(s->reynolds, step->radius, film);
        double cut =
            ehl_cavitation_shrink_film(&w->cavitation, s->reynolds, film, w->linear.p_step);
        cut = fmax(cut, ehl_yield_turn(s->reynolds, film, w->linear.p_step));
        if (cut > 0) {
            ehl_linear_deflect(s, w->linear.p_step, w->linear.v_step);
            ehl_add(film->v, 1, w->linear.v_step, n);
        }
        int whole =
            rescale_to_load(s, step, film) && share >= 1 && ehl_linear_converged(&w->linear);
        double scale = ehl_pressure_scale(s->grid, film, n);
        learn(s, step, &last, dp / scale, whole);
        if (whole && !(w->cavitation.split && !rough) && cut <= s->tolerance * scale &&
            is_small(s, dp / scale, dh)) {
            if (k == 0)
                ehl_linear_forget(s);
            return FF_OK;
        }
    }
    return FF_NOCONV;
}

ff_status ehl_newton_krylov(ehl_solver *s)
{
    size_t n = s->grid->nodes;
    newton *w = s->self = calloc(1, sizeof *w);
    s->solve = solve;
    s->deflect = ehl_linear_deflect;
    s->destroy = destroy;
    if (!w)
        return FF_NOMEM;
    if (ehl_linear_create(s, &w->linear) != FF_OK ||
        ehl_cavitation_create(&w->cavitation, n) != FF_OK) {
        destroy(s);
        return FF_NOMEM;
    }
    return FF_OK;
}
