/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "nest.h"

#include "kernel.h"
#include "march-part.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cells that are not halved any more. */
enum { COARSEST = 512 };

/* Of the coarser grids. */
static const double loose = 1e-3;

/* One grid with all that its film needs. */
typedef struct level {
    ff_grid grid;
    ff_reynolds reynolds;
    ff_solver solver;
    ff_film film;
    double *memory, *kernel;
    unsigned char *flags;
} level;

static void level_destroy(level *l)
{
    if (l->solver.destroy)
        l->solver.destroy(&l->solver);
    ff_reynolds_destroy(&l->reynolds);
    free(l->memory);
    free(l->flags);
    *l = (level){0};
}

/* The domain of `s` with that many cells. */
static ff_status level_create(level *l, const ff_solver *s, size_t cells, double modulus)
{
    const ff_reynolds *r = s->reynolds;
    size_t n = cells + 1;
    *l = (level){.grid = *s->grid};
    l->grid.nodes = n;
    l->grid.dx = (s->grid->inlet + s->grid->outlet) / (double)cells;
    if (ff_reynolds_create(&l->reynolds, &l->grid, &r->laws, &r->oil, r->wedge) != FF_OK)
        return FF_NOMEM;
    double *next = l->memory = calloc(4 * n, sizeof *next);
    l->flags = calloc(2 * n, 1);
    if (!next || !l->flags)
        return FF_NOMEM;
    l->film = (ff_film){.p = next, .v = next + n, .content = next + 2 * n, .wet = l->flags};
    l->film.touch = l->flags + n;
    l->kernel = next + 3 * n;
    ff_kernel_fill(n, l->grid.dx, modulus, l->grid.half_width, l->kernel);
    l->reynolds.floor = r->floor;
    l->reynolds.conserving = r->conserving;
    l->reynolds.contact = r->contact;
    l->reynolds.leak = r->leak;
    l->reynolds.unit = r->oil.density * (l->kernel[0] - l->kernel[n - 1]);
    l->solver = (ff_solver){.grid = &l->grid,
                            .reynolds = &l->reynolds,
                            .kernel = l->kernel,
                            .tolerance = fmax(s->tolerance, loose),
                            .maker = s->maker};
    return s->maker(&l->solver);
}

/* Linear between the nodes of a coarser film on the same domain. */
static void refine(const ff_film *from, const ff_grid *coarse, ff_solver *s, ff_film *film)
{
    size_t n = s->grid->nodes;
    for (size_t i = 0; i < n; i++) {
        double place = (double)i * s->grid->dx / coarse->dx;
        size_t k = (size_t)place;
        k = k + 2 < coarse->nodes ? k : coarse->nodes - 2;
        double far = fmin(place - (double)k, 1);
        int inner = i > 0 && i + 1 < n;
        film->p[i] = inner ? (1 - far) * from->p[k] + far * from->p[k + 1] : 0;
        film->content[i] = (1 - far) * from->content[k] + far * from->content[k + 1];
        film->wet[i] = inner && (from->wet[k] || from->wet[k + 1]);
        film->touch[i] = 0;
    }
    film->h00 = from->h00;
    s->deflect(s, film->p, film->v);
}

/* The film of level `l`, from that of the level before or from a first guess. */
static ff_status find(level *l, const level *before, const ff_step *step, const ff_instant *at,
                      double modulus, double thinnest)
{
    if (before)
        refine(&before->film, &before->grid, &l->solver, &l->film);
    else
        ff_first_guess(&l->solver, at, modulus, thinnest, &l->film);
    return l->solver.solve(&l->solver, step, &l->film, FF_LIMIT_START);
}

ff_status ff_nested_film(ff_solver *s, const ff_step *step, const ff_instant *at, double modulus,
                         double thinnest, ff_film *film)
{
    level l[2] = {0};
    size_t all = s->grid->nodes - 1, halvings = 0, now = 0;
    int found = 0;
    ff_status status = FF_NOCONV;
    while (all >> (halvings + 1) >= COARSEST)
        halvings++;
    for (size_t k = halvings; k > 0; k--) {
        level *before = &l[now];
        now = 1 - now;
        level_destroy(&l[now]);
        status = level_create(&l[now], s, all >> k, modulus);
        if (status == FF_OK)
            status = find(&l[now], found ? before : NULL, step, at, modulus, thinnest);
        if (status != FF_OK && (found || status != FF_NOCONV))
            break;
        found = status == FF_OK; /* what is too coarse for a film is left out */
    }
    if (status == FF_OK)
        refine(&l[now].film, &l[now].grid, s, film);
    level_destroy(&l[0]);
    level_destroy(&l[1]);
    return status;
}
