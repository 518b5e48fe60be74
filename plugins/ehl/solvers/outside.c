/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves one instant with the discretisation of another stage (film.h), instead of a solver of this
   plugin. */
#include "../equations/deflection.h"
#include "../equations/solver.h"

#include <math.h>
#include <stdlib.h>

/* The march fails after MOST_FAILURES instants without a film, if these are more than
   1/FAILING_SHARE of all instants. Without this limit steps would be shortened endlessly. */
enum { MOST_FAILURES = 200, FAILING_SHARE = 5 };

typedef struct outside {
    ehl_fft *fft;
    ff_film_contact contact;
    void *solver;
    size_t asked, failed; /* numbers of instants requested, and without a film */
} outside;

static void deflect(ehl_solver *s, const double *p, double *v)
{
    outside *o = s->self;
    ehl_fft_apply(o->fft, p, v);
    s->counters.convolutions++;
}

static void destroy(ehl_solver *s)
{
    outside *o = s->self;
    if (!o)
        return;
    if (o->solver)
        s->outside->close(o->solver);
    ehl_fft_destroy(o->fft);
    free(o);
    s->self = NULL;
}

/* Returns 1 if the film consists of finite numbers and its pressure is 0 at both ends. */
static int is_film(const ff_film_state *film, size_t nodes)
{
    double sum = film->h00;
    for (size_t i = 0; i < nodes; i++)
        sum += fabs(film->p[i]) + fabs(film->v[i]);
    return isfinite(sum) && !(fabs(film->p[0]) > 0) && !(fabs(film->p[nodes - 1]) > 0);
}

static ff_status solve(ehl_solver *s, const ehl_step *step, ehl_film *film, int limit)
{
    outside *o = s->self;
    (void)limit;
    const ff_film_instant instant = {
        .size = sizeof instant,
        .entrainment = step->entrainment,
        .sliding = step->sliding,
        .radius = step->radius,
        .loaded = step->loaded,
        .load = step->load,
        .rate = step->rate,
        .past = step->past,
    };
    ff_film_state state = {
        .size = sizeof state,
        .p = film->p,
        .v = film->v,
        .h00 = film->h00,
        .full = film->full,
        .content = film->content,
    };
    ff_status status = s->outside->solve(o->solver, &instant, &state);
    s->counters.newton += state.iterations;
    s->rescaling = 0;
    if (status < 0)
        return status;
    o->asked++;
    o->failed += status != FF_OK;
    if (o->failed > MOST_FAILURES && o->failed > o->asked / FAILING_SHARE) {
        s->gave_up = 1;
        return FF_UNSUPPORTED;
    }
    s->no_film |= status == FF_OK && !is_film(&state, s->grid->nodes);
    if (status != FF_OK || s->no_film)
        return FF_NOCONV;
    film->h00 = state.h00;
    film->full[0] = film->full[s->grid->nodes - 1] = 0;
    ehl_reynolds_evaluate(s->reynolds, step, film); /* computes quantities that the losses need */
    return FF_OK;
}

ff_status ehl_outside(ehl_solver *s)
{
    const ehl_grid *g = s->grid;
    const ehl_reynolds *r = s->reynolds;
    outside *o = s->self = calloc(1, sizeof *o);
    s->solve = solve;
    s->deflect = deflect;
    s->destroy = destroy;
    if (!o)
        return FF_NOMEM;
    o->contact = (ff_film_contact){
        .size = sizeof o->contact,
        .nodes = g->nodes,
        .dx = g->dx,
        .first = g->first,
        .half_width = g->half_width,
        .pressure = g->pressure,
        .modulus = s->modulus,
        .tolerance = s->tolerance,
        .order = r->wedge,
        .conserving = r->conserving,
        .viscosity = r->laws.viscosity,
        .density = r->laws.density,
        .rheology = r->laws.rheology_ambient,
    };
    o->fft = ehl_fft_create(g->nodes, s->kernel);
    ff_status status =
        o->fft ? s->outside->open(s->outside->self, &o->contact, &o->solver) : FF_NOMEM;
    if (status == FF_OK)
        return FF_OK;
    o->solver = NULL;
    destroy(s);
    return status < 0 ? status : FF_UNSUPPORTED;
}
