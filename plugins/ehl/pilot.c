/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "pilot.h"

#include "level.h"

#include <math.h>

/* Solutions on one grid and on the next finer one. */
typedef struct pair {
    ff_level coarse, fine;
} pair;

typedef struct films {
    double least, central;
} films;

static films films_of(ff_level *l, double radius)
{
    ff_reynolds *r = &l->reynolds;
    const ff_grid *g = &l->grid;
    ff_reynolds_gap(r, radius, &l->film);
    size_t left = (size_t)(g->inlet / g->dx);
    double part = g->inlet / g->dx - (double)left;
    films f = {.least = HUGE_VAL, .central = (1 - part) * r->h[left] + part * r->h[left + 1]};
    for (size_t i = 0; i < g->nodes; i++)
        f.least = fmin(f.least, r->h[i]);
    return f;
}

/* The error that falls with that power of the cells, from that of twice as many. */
static double off(double coarse, double fine, double power)
{
    return fabs(coarse / fine - 1) / (1 - pow(2, -power));
}

static ff_status measure(pair *p, const ff_instant *at, const ff_history *h, const ff_oil *oil,
                         double *least, double *central)
{
    const ff_step step = {.entrainment = at->entrainment,
                          .sliding = at->sliding,
                          .radius = at->radius,
                          .load = at->load,
                          .loaded = 1};
    double thinnest = ff_moes_film(at, h->modulus, oil);
    ff_status status = ff_level_find(&p->coarse, NULL, &step, at, h->modulus, thinnest);
    if (status == FF_OK)
        status = ff_level_find(&p->fine, &p->coarse, &step, at, h->modulus, thinnest);
    if (status != FF_OK)
        return status;
    films coarse = films_of(&p->coarse, at->radius), fine = films_of(&p->fine, at->radius);
    if (!(coarse.least > 0 && fine.least > 0))
        return FF_NOCONV;
    *least = off(coarse.least, fine.least, 3);
    *central = off(coarse.central, fine.central, 2);
    return FF_OK;
}

static double work_of(const ff_level *l)
{
    double cells = (double)(l->grid.nodes - 1);
    return l->solver.tally.convolutions * cells * log2(cells);
}

ff_status ff_pilot_fly(const ff_history *h, const ff_laws *laws, const ff_oil *oil,
                       const ff_instant *at, size_t count, size_t cells, ff_pilot *pilot)
{
    ff_grid grid;
    ff_grid_fit(&grid, cells, 0, 0, h, oil, 0);
    ff_reynolds second_order = {.laws = *laws, .oil = *oil, .wedge = 2};
    const ff_solver kind = {.grid = &grid, .reynolds = &second_order, .maker = ff_newton_krylov};
    pair p = {0};
    ff_status status = ff_level_create(&p.coarse, &kind, cells, h->modulus);
    if (status == FF_OK)
        status = ff_level_create(&p.fine, &kind, 2 * cells, h->modulus);
    *pilot = (ff_pilot){.cells = cells};
    for (size_t k = 0; k < count && status == FF_OK; k++) {
        double least = 0, central = 0;
        status = measure(&p, &at[k], h, oil, &least, &central);
        if (fmax(least, central) > fmax(pilot->least, pilot->central))
            pilot->worst = k;
        pilot->least = fmax(pilot->least, least);
        pilot->central = fmax(pilot->central, central);
    }
    pilot->work = work_of(&p.coarse) + work_of(&p.fine);
    if (status == FF_NOCONV)
        pilot->cells = 0;
    ff_level_destroy(&p.coarse);
    ff_level_destroy(&p.fine);
    return status == FF_NOCONV ? FF_OK : status;
}
