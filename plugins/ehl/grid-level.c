/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "grid-level.h"

#include "kernel.h"
#include "march-part.h"

#include <math.h>
#include <stdlib.h>

/* Change of pressure in the last step of a solution. */
static const double loose = 1e-3;

void ehl_grid_level_destroy(ehl_grid_level *l)
{
    if (l->solver.destroy)
        l->solver.destroy(&l->solver);
    ehl_reynolds_destroy(&l->reynolds);
    free(l->memory);
    free(l->flags);
    *l = (ehl_grid_level){0};
}

ff_status ehl_grid_level_create(ehl_grid_level *l, const ehl_solver *s, size_t cells,
                                double modulus)
{
    const ehl_reynolds *r = s->reynolds;
    size_t n = cells + 1;
    *l = (ehl_grid_level){.grid = *s->grid};
    l->grid.nodes = n;
    l->grid.dx = (s->grid->inlet + s->grid->outlet) / (double)cells;
    if (ehl_reynolds_create(&l->reynolds, &l->grid, &r->laws, &r->oil, r->wedge) != FF_OK)
        return FF_NOMEM;
    double *next = l->memory = calloc(4 * n, sizeof *next);
    l->flags = calloc(2 * n, 1);
    if (!next || !l->flags)
        return FF_NOMEM;
    l->film = (ehl_film){.p = next, .v = next + n, .content = next + 2 * n, .full = l->flags};
    l->film.asperity = l->flags + n;
    l->kernel = next + 3 * n;
    ehl_kernel_fill(n, l->grid.dx, modulus, l->grid.half_width, l->kernel);
    l->reynolds.floor = r->floor;
    l->reynolds.conserving = r->conserving;
    l->reynolds.contact = r->contact;
    l->reynolds.leak = r->leak;
    l->reynolds.unit = r->oil.density * (l->kernel[0] - l->kernel[n - 1]);
    l->solver = (ehl_solver){.grid = &l->grid,
                             .reynolds = &l->reynolds,
                             .kernel = l->kernel,
                             .tolerance = fmax(s->tolerance, loose),
                             .maker = s->maker};
    return s->maker(&l->solver);
}

void ehl_grid_level_refine(const ehl_grid_level *before, ehl_solver *s, ehl_film *film)
{
    const ehl_film *from = &before->film;
    const ehl_grid *coarse = &before->grid;
    size_t n = s->grid->nodes;
    for (size_t i = 0; i < n; i++) {
        double place = (double)i * s->grid->dx / coarse->dx;
        size_t k = (size_t)place;
        k = k + 2 < coarse->nodes ? k : coarse->nodes - 2;
        double far = fmin(place - (double)k, 1);
        int inner = i > 0 && i + 1 < n;
        film->p[i] = inner ? (1 - far) * from->p[k] + far * from->p[k + 1] : 0;
        film->content[i] = (1 - far) * from->content[k] + far * from->content[k + 1];
        film->full[i] = inner && (from->full[k] || from->full[k + 1]);
        film->asperity[i] = 0;
    }
    film->h00 = from->h00;
    s->deflect(s, film->p, film->v);
}

ff_status ehl_grid_level_solve(ehl_grid_level *l, const ehl_grid_level *before,
                               const ehl_step *step, const ehl_instant *at, double modulus,
                               double thinnest)
{
    if (before)
        ehl_grid_level_refine(before, &l->solver, &l->film);
    else
        ehl_first_guess(&l->solver, at, modulus, thinnest, &l->film);
    return l->solver.solve(&l->solver, step, &l->film, EHL_LIMIT_START);
}
