/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decides which factors of the last matrix can be reused for the next one. */
#include "../equations/asperities.h"
#include "gmres.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <string.h>

/* The factors are renewed if a solution takes this many iterations more than the first solution
   after the last factorisation. */
enum { KRYLOV_STALE = 3 };

/* Factors are outdated from the first row whose diagonal has changed by this share.
   CAREFUL_STALE_CHANGE applies to steady films, and if the norm of the pressure contains little
   information about the film; in these cases all factors are renewed. */
static const double STALE_CHANGE = 0.5, CAREFUL_STALE_CHANGE = 0.3;

/* Writes the diagonal of rows 1 ... last - 1. Returns whether a full node before row `from` has
 * changed too much. */
FF_SIMD
static int64_t compare_diagonal(size_t last, size_t from, double self, double stale,
                                const double *restrict by_p, const double *restrict by_h,
                                const unsigned char *restrict full, const double *restrict was,
                                double *restrict now)
{
    int64_t drifted = 0;
    for (size_t i = 1; i < last; i++)
        now[i] = by_p[i] + self * by_h[i];
    for (size_t i = 1; i < from && i < last; i++) {
        double counted = full[i], change = fabs(now[i] - was[i]);
        drifted |= counted * change > stale * fabs(was[i]);
    }
    return drifted;
}

/* Writes to `product` the diagonal of the matrix that the preconditioner approximates. Returns the
   first node upstream of node `from` at which the diagonal has changed too much since its last
   factorisation, or `from` if there is none. With outdated factors the preconditioned residual is
   no measure of the remaining error. */
static size_t first_drifted(const ehl_solver *s, const ehl_film *film, size_t from, double stale)
{
    ehl_linear *w = s->self;
    const ehl_reynolds *r = s->reynolds;
    double self = s->kernel[0] - s->kernel[s->grid->nodes - 1];
    if (!compare_diagonal(r->last, from, self, stale, r->by_p[2], r->by_h[2], film->full,
                          w->diagonal, w->product))
        return from;
    size_t i = 1;
    while (i < from &&
           !(film->full[i] && fabs(w->product[i] - w->diagonal[i]) > stale * fabs(w->diagonal[i])))
        i++;
    return i;
}

/* Encodes the equation of each node: bit 0 full film, bit 1 asperity contact, bit 2 yield. */
FF_SIMD
static void find_kinds(const ehl_reynolds *r, const ehl_film *film, unsigned char *restrict kind)
{
    const unsigned char *restrict full = film->full, *restrict asperity = film->asperity;
    size_t n = r->nodes;
    for (size_t i = 0; i < n; i++)
        kind[i] = (unsigned char)(full[i] | asperity[i] << 1);
    for (size_t i = 0; film->yielding > 0 && i < n; i++)
        kind[i] = (unsigned char)(kind[i] | ehl_yields(r, film, i) << 2);
}

/* Returns the first row whose factors must be renewed, or `last` if all are still valid. */
static size_t first_outdated_row(const ehl_solver *s, const ehl_step *step)
{
    const ehl_linear *w = s->self;
    size_t last = s->reynolds->last, held = last < w->factored_last ? last : w->factored_last;
    size_t i = 1;
    if (!w->factored || w->factored_loaded != step->loaded ||
        w->krylov > w->krylov_fresh + KRYLOV_STALE)
        return 1;
    if (memcmp(w->kind, w->factored_kind, held) == 0)
        i = held;
    while (i < held && w->kind[i] == w->factored_kind[i])
        i++;
    /* the column of a cavitated node belongs to a mass, and rows upstream of the node contain this
       column */
    size_t reached = s->reynolds->conserving && i < last ? EHL_BAND_REACH : 0;
    return i > reached ? i - reached : 1;
}

void ehl_linear_factor(ehl_solver *s, const ehl_step *step, const ehl_film *film)
{
    ehl_linear *w = s->self;
    const ehl_reynolds *r = s->reynolds;
    find_kinds(r, film, w->kind);
    size_t from = first_outdated_row(s, step);
    int careful = w->careful || !(step->rate > 0);
    size_t drifted = first_drifted(s, film, from, careful ? CAREFUL_STALE_CHANGE : STALE_CHANGE);
    from = careful && drifted < from ? 1 : drifted;
    if (from == r->last && r->last == w->factored_last)
        return;
    ehl_band_factor(w->band, r, film, step->loaded, from);
    if (w->coarse && (from == 1 || !ehl_coarse_fits(w->coarse, r->last)))
        ehl_coarse_factor(w->coarse, r, film, step->loaded);
    memcpy(w->diagonal + from, w->product + from, (r->last - from) * sizeof *w->diagonal);
    memcpy(w->factored_kind, w->kind, r->nodes);
    w->factored_last = r->last;
    w->factored_loaded = step->loaded;
    w->factored = 1;
    w->krylov_fresh = from == 1 ? 0 : w->krylov_fresh;
    s->counters.factorisations++;
}
