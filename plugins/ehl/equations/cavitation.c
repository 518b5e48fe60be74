/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cavitation.h"

#include "../contact/simd-reductions.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Largest change of the pressure in a Newton step, relative to the largest pressure, for smooth and
   for rough flanks. */
static const double PRESSURE_CHANGE = 0.3, ROUGH_PRESSURE_CHANGE = 0.1;

/* Largest share of its thickness by which a film may become thinner in a Newton step. */
static const double THINNING = 0.9;

/* An error of the load below this share is removed by scaling the pressure. */
static const double SMALL_LOAD_ERROR = 0.05;

/* Smallest scale of pressure, relative to the largest Hertz pressure. */
static const double LEAST_SCALE = 1e-6;

/* FULL and FILLING are states of a node while the film grows. A node that was filled QUICK_FILLINGS
   times in one solution is no longer filled in the same step as its neighbour. A node that was
   filled MOST_FILLINGS times (ROUGH_FILLINGS with rough flanks) is not filled again. */
enum { FULL = 1, FILLING = 2, QUICK_FILLINGS = 2, MOST_FILLINGS = 8, ROUGH_FILLINGS = 24 };

ff_status ehl_cavitation_create(ehl_cavitation *w, size_t nodes)
{
    w->filled = calloc(2 * nodes, 1);
    w->cut = w->filled ? w->filled + nodes : NULL;
    return w->filled ? FF_OK : FF_NOMEM;
}

void ehl_cavitation_destroy(ehl_cavitation *w)
{
    free(w->filled);
    w->filled = NULL;
}

void ehl_cavitation_begin(ehl_cavitation *w, size_t nodes)
{
    memset(w->filled, 0, 2 * nodes);
    w->stride = 1;
    w->split = 0;
}

/* Return whether a node of 1 to n - 2 gains mass without being full, and whether a full node has
   oil at a pressure below 0. */
FF_SIMD
static int64_t any_gains(size_t n, const unsigned char *restrict full,
                         const double *restrict residual)
{
    int64_t any = 0;
    for (size_t i = 1; i + 1 < n; i++)
        any |= (int64_t)((residual[i] > 0 ? 1 : 0) & (full[i] ^ FULL));
    return any;
}

FF_SIMD
static int64_t any_pulls(size_t n, const unsigned char *restrict full, const double *restrict p)
{
    int64_t any = 0;
    for (size_t i = 1; i + 1 < n; i++)
        any |= (int64_t)((p[i] < 0 ? 1 : 0) & full[i]);
    return any;
}

int ehl_cavitation_grow_film(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film)
{
    size_t end = r->nodes - 1, reach = w->stride - 1;
    int grown = 0, longer = 0, gains = any_gains(r->nodes, film->full, r->residual) != 0;
    for (size_t i = 1; gains && i < end; i++) {
        if ((film->full[i] & FULL) || !(r->residual[i] > 0))
            continue;
        size_t from = i > reach ? i - reach : 1, to = i + reach < end ? i + reach : end - 1;
        for (size_t k = from; k <= to; k++)
            film->full[k] |= FILLING;
        grown = 1;
    }
    for (size_t i = 1; grown && i < end; i++) {
        longer |= film->full[i] && i >= r->last;
        film->full[i] = film->full[i] != 0;
    }
    w->moved = grown && w->stride > 1;
    w->grown = grown;
    w->stride = grown ? 2 * w->stride : 1;
    return longer;
}

int ehl_cavitation_fill(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film, int steps)
{
    int most =
        /* with rough flanks a time step that reaches the limit fails and is shortened */
        r->rough ? ROUGH_FILLINGS : MOST_FILLINGS;
    int filled = 0, beside = 0; /* beside: whether the node upstream has just been filled */
    for (size_t i = 1; i + 1 < r->nodes; i++) {
        int over =
            !film->full[i] && !(steps && w->cut[i]) && film->content[i] > r->oil.density * r->h[i];
        int careful = w->filled[i] >= QUICK_FILLINGS;
        beside = over && !(careful && beside) && w->filled[i] < most;
        if (!beside)
            continue;
        filled = film->full[i] = 1;
        w->filled[i]++;
    }
    memset(w->cut, 0, r->nodes);
    w->moved = filled;
    w->grown = 0;
    return filled;
}

/* Returns 1 if there is still pressure at a node where neither asperities nor oil carry load. */
static int is_left_over(const ehl_reynolds *r, const ehl_film *film, size_t i)
{
    return r->statistical.law && !film->full[i] && !(r->p_a[i] > 0) && fabs(film->p[i]) > 0;
}

/* Returns whether the film ends between its last node and the next one. The pressure is
   proportional to the square of the distance from the film's end. If the end is one cell downstream
   of the last node, the pressure at the last node is a quarter of the pressure one cell upstream.
   If the end is farther away, this ratio is larger. */
static int ends_in_node(const ehl_reynolds *r, const ehl_film *film)
{
    const double quarter = 0.25;
    size_t end = r->last - 1;
    return end < 2 || !(film->p[end] > quarter * film->p[end - 1]);
}

double ehl_cavitation_shrink_film(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film,
                                  double *change)
{
    size_t nodes = r->nodes;
    const double *p = ehl_fluid(r, film);
    double cut = 0;
    int full_behind = 0;
    w->split = 0;
    if (w->grown && !r->conserving && !ends_in_node(r, film))
        w->moved = 1;
    if (!r->statistical.law && !film->plastic && !any_pulls(nodes, film->full, p))
        return 0;
    memset(change, 0, nodes * sizeof *change);
    for (size_t i = nodes - 2; i > 0; i--) {
        full_behind |= film->full[i] && !(p[i] < 0);
        if (is_left_over(r, film, i)) {
            change[i] = -film->p[i];
            cut = fmax(cut, fabs(film->p[i]));
            film->p[i] = 0;
        } else if (film->full[i] && p[i] < 0) {
            w->split |= full_behind;
            change[i] = -p[i];
            cut = fmax(cut, -p[i]);
            film->p[i] -= p[i];
            film->full[i] = 0;
            w->cut[i] = 1;
            film->asperity[i] = 0;
            w->moved = 1;
            w->stride = 1;
            if (r->conserving)
                film->content[i] = r->oil.density * r->h[i];
        }
    }
    return cut;
}

double ehl_pressure_scale(const ehl_grid *g, const ehl_film *film, size_t nodes)
{
    return ehl_greatest(nodes, film->p, LEAST_SCALE * g->pressure);
}

/* Returns whether a node of 1 to last - 1 loses more than THINNING of its gap. */
FF_SIMD
static int64_t any_thins(size_t last, const double *restrict dh, const double *restrict h)
{
    int64_t any = 0;
    for (size_t i = 1; i < last; i++)
        any |= -dh[i] > THINNING * h[i];
    return any;
}

double ehl_step_share(const ehl_grid *g, const ehl_reynolds *r, const ehl_film *film, double dp,
                      const double *dh)
{
    double most = PRESSURE_CHANGE * fmax(g->pressure, ehl_pressure_scale(g, film, r->nodes)),
           fall = 1;
    double share = dp > most ? most / dp : 1;
    if (r->rough) /* between rough flanks no limit is needed, since a film that becomes too thin
                     comes into contact */
        return dp > ROUGH_PRESSURE_CHANGE * most / PRESSURE_CHANGE
                   ? ROUGH_PRESSURE_CHANGE * most / (PRESSURE_CHANGE * dp)
                   : 1;
    int thins = any_thins(r->last, dh, r->h) != 0;
    for (size_t i = 1; thins && i < r->last; i++) { /* the film must not vanish */
        double part = r->h[i] > r->floor && film->full[i] ? -dh[i] / (THINNING * r->h[i]) : 0;
        fall = part > fall ? part : fall;
    }
    return fmin(share, 1 / fall);
}

FF_SIMD
static void scale(size_t n, double factor, double *x)
{
    for (size_t i = 0; i < n; i++)
        x[i] *= factor;
}

/* Sets the effect of the oil in front of the domain on the film. */
static void feed(const ehl_solver *s, const ehl_step *step, ehl_film *film)
{
    double rise = step->feed - film->p[0];
    film->ahead = step->ahead - step->feed * s->grid->dx / 2; /* half of the first node's cell is in
                                                                 front of the domain */
    film->p[0] = step->feed;
    for (size_t i = 0; fabs(rise) > 0 && i < s->grid->nodes; i++)
        film->v[i] += rise * s->kernel[i];
}

int ehl_rescale_to_load(ehl_solver *s, const ehl_step *step, ehl_film *film)
{
    size_t n = s->grid->nodes, centre = (size_t)(s->grid->inlet / s->grid->dx);
    feed(s, step, film);
    double load = ehl_film_load(film, n, s->grid->dx);
    double factor = step->loaded ? (step->load - film->ahead) / (load - film->ahead) : 1;
    s->rescaling = fabs(factor - 1);
    if (!(s->rescaling < SMALL_LOAD_ERROR))
        return 0;
    film->h00 -= (factor - 1) * film->v[centre < n ? centre : n - 1];
    scale(n, factor, film->p);
    scale(n, factor, film->v);
    feed(s, step, film);
    return 1;
}
