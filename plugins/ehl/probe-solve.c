/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "probe-solve.h"

#include "grid-level.h"

#include <math.h>

/* Solutions on one grid and on the next finer one. */
typedef struct pair {
    ehl_grid_level coarse, fine;
} pair;

typedef struct films {
    double least, central;
} films;

static films films_of(ehl_grid_level *l, double radius)
{
    ehl_reynolds *r = &l->reynolds;
    const ehl_grid *g = &l->grid;
    ehl_reynolds_gap(r, radius, &l->film);
    size_t left = (size_t)(g->inlet / g->dx);
    double part = g->inlet / g->dx - (double)left;
    films f = {.least = HUGE_VAL, .central = (1 - part) * r->h[left] + part * r->h[left + 1]};
    for (size_t i = 0; i < g->nodes; i++)
        f.least = fmin(f.least, r->h[i]);
    return f;
}

/* Returns the relative error of `coarse` from `fine`, with twice the cells, where it falls with
   that power of the cells (Richardson). */
static double extrapolated_error(double coarse, double fine, double power)
{
    return fabs(coarse / fine - 1) / (1 - pow(2, -power));
}

static ff_status measure_errors(pair *p, const ehl_instant *at, const ehl_history *h,
                                const ehl_oil *oil, double *least, double *central)
{
    const ehl_step step = {.entrainment = at->entrainment,
                           .sliding = at->sliding,
                           .radius = at->radius,
                           .load = at->load,
                           .loaded = 1};
    double thinnest = ehl_moes_film(at, h->modulus, oil);
    ff_status status = ehl_grid_level_solve(&p->coarse, NULL, &step, at, h->modulus, thinnest);
    if (status == FF_OK)
        status = ehl_grid_level_solve(&p->fine, &p->coarse, &step, at, h->modulus, thinnest);
    if (status != FF_OK)
        return status;
    films coarse = films_of(&p->coarse, at->radius), fine = films_of(&p->fine, at->radius);
    if (!(coarse.least > 0 && fine.least > 0))
        return FF_NOCONV;
    *least = extrapolated_error(coarse.least, fine.least, 3);
    *central = extrapolated_error(coarse.central, fine.central, 2);
    return FF_OK;
}

static double work_of(const ehl_grid_level *l)
{
    double cells = (double)(l->grid.nodes - 1);
    return l->solver.counters.convolutions * cells * log2(cells);
}

ff_status ehl_probe_solve(const ehl_history *h, const ehl_laws *laws, const ehl_oil *oil,
                          const ehl_instant *at, size_t count, size_t cells, ehl_probe *probe)
{
    ehl_grid grid;
    ehl_grid_fit(&grid, cells, 0, 0, h, oil, 0);
    ehl_reynolds second_order = {.laws = *laws, .oil = *oil, .wedge = 2};
    const ehl_solver kind = {.grid = &grid, .reynolds = &second_order, .maker = ehl_newton_krylov};
    pair p = {0};
    ff_status status = ehl_grid_level_create(&p.coarse, &kind, cells, h->modulus);
    if (status == FF_OK)
        status = ehl_grid_level_create(&p.fine, &kind, 2 * cells, h->modulus);
    *probe = (ehl_probe){.cells = cells};
    for (size_t k = 0; k < count && status == FF_OK; k++) {
        double least = 0, central = 0;
        status = measure_errors(&p, &at[k], h, oil, &least, &central);
        if (fmax(least, central) > fmax(probe->least, probe->central))
            probe->worst = k;
        probe->least = fmax(probe->least, least);
        probe->central = fmax(probe->central, central);
    }
    probe->work = work_of(&p.coarse) + work_of(&p.fine);
    if (status == FF_NOCONV)
        probe->cells = 0;
    ehl_grid_level_destroy(&p.coarse);
    ehl_grid_level_destroy(&p.fine);
    return status == FF_NOCONV ? FF_OK : status;
}
