/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds steady films between smooth flanks, on one grid and on nested grids. */
#include "grid-level.h"

#include "../equations/deflection.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The first guess of the pressure is half an ellipse: Hertz's pressure under a high load; under a
   low load as wide as the pressure of a rigid cylinder, from -2 S to 0.475 S with S = sqrt(2 R
   h). */
void ehl_first_guess(ehl_solver *s, const ehl_instant *at, double modulus, double thinnest,
                     ehl_film *film)
{
    const ehl_grid *g = s->grid;
    double a = ehl_hertz_half_width(at->load, at->radius, modulus);
    double film_length = sqrt(2 * at->radius * thinnest);
    double width = hypot(a, 1.2 * film_length), sum = 0;
    double centre = -0.5 * film_length * film_length / (a + film_length);
    centre = fmax(centre, -0.5 * g->inlet);
    width = fmin(fmax(width, 2 * g->dx), 0.9 * fmin(g->inlet, g->outlet));
    memset(film->full, 0, g->nodes);
    memset(film->asperity, 0, g->nodes);
    for (size_t i = 0; i < g->nodes; i++) {
        double x = (g->first + (double)i * g->dx - centre) / width;
        int inner = i > 0 && i + 1 < g->nodes;
        film->p[i] = inner && fabs(x) < 1 ? sqrt(1 - x * x) : 0;
        film->full[i] = inner && x < 1;
        sum += film->p[i];
    }
    for (size_t i = 0; i < g->nodes; i++)
        film->p[i] *= at->load / (sum * g->dx);
    s->deflect(s, film->p, film->v);
    film->h00 = 0;
    ehl_reynolds_gap(s->reynolds, at->radius, film);
    double least = s->reynolds->h[0];
    for (size_t i = 0; i < g->nodes; i++)
        least = fmin(least, s->reynolds->h[i]);
    film->h00 = thinnest - least;
    for (size_t i = 0; i < g->nodes; i++)
        film->content[i] = s->reynolds->oil.density * thinnest;
}

/* Tolerance for films that are only the start on a finer grid, or that measure the error due to the
   cells. */
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
    l->reynolds.statistical = r->statistical;
    l->reynolds.unit = r->oil.density * (l->kernel[0] - l->kernel[n - 1]);
    l->solver = (ehl_solver){.grid = &l->grid,
                             .reynolds = &l->reynolds,
                             .kernel = l->kernel,
                             .modulus = modulus,
                             .tolerance = fmax(s->tolerance, loose),
                             .outside = s->outside,
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

/* A grid with at most this number of cells is not halved. */
enum { COARSEST = 512 };

/* Fills `film` with the steady film on half the cells, by nested grids. The end of a film moves by
   only a few cells in a Newton step. It is therefore found on a coarse grid first, and each finer
   grid starts from the film on the previous grid. Returns FF_NOCONV if the grid of `s` is already
   coarse, or if no coarser grid has a solution. */
ff_status ehl_nested_film(ehl_solver *s, const ehl_step *step, const ehl_instant *at,
                          double modulus, double thinnest, ehl_film *film)
{
    ehl_grid_level l[2] = {0};
    size_t all = s->grid->nodes - 1, halvings = 0, now = 0;
    int found = 0;
    ff_status status = FF_NOCONV;
    while (all >> (halvings + 1) >= COARSEST)
        halvings++;
    for (size_t k = halvings; k > 0; k--) {
        ehl_grid_level *before = &l[now];
        now = 1 - now;
        ehl_grid_level_destroy(&l[now]);
        status = ehl_grid_level_create(&l[now], s, all >> k, modulus);
        if (status == FF_OK)
            status =
                ehl_grid_level_solve(&l[now], found ? before : NULL, step, at, modulus, thinnest);
        if (status != FF_OK && (found || status != FF_NOCONV))
            break;
        found = status == FF_OK; /* a grid that is too coarse for a film is skipped */
    }
    if (status == FF_OK)
        ehl_grid_level_refine(&l[now], s, film);
    ehl_grid_level_destroy(&l[0]);
    ehl_grid_level_destroy(&l[1]);
    return status;
}
