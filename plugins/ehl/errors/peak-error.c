/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures the error of the pressure peak on more cells. */
#include "../solvers/grid-level.h"
#include "results.h"

#include <math.h>
#include <stdlib.h>

/* The film on one grid, and what is read from it. */
typedef struct twin {
    double central, p_max;
    ehl_spike spike;
} twin;

static twin look_at(ehl_grid_level *l, const ehl_instant *at)
{
    ehl_reynolds *eq = &l->reynolds;
    twin t = {.p_max = 0};
    ehl_reynolds_gap(eq, at->radius, &l->film);
    t.central = ehl_central_film(&l->grid, eq);
    for (size_t i = 0; i < eq->nodes; i++)
        t.p_max = fmax(t.p_max, l->film.p[i]);
    if (!(t.central > 0 && t.p_max > 0))
        return (twin){.p_max = 0};
    const ehl_crest of = {l->film.p, t.central, t.p_max};
    t.spike = ehl_spike_of(eq, at, l->solver.modulus, &of);
    return t;
}

/* Films on 1, 2, 4, 8, 16 times the cells. */
enum { TWINS = 5 };

/* Returns the tip of a spike on the finer of two grids. The cells cut off some multiple of what the
 * formula says, the same multiple on both grids; the heights of both spikes give it. It is limited,
 * since on few cells a spike stands beside its final place. */
static double tip_by_formula(const ehl_spike *coarse, const ehl_spike *fine)
{
    const double most = 1.5;
    if (!(fine->seen > 0 && coarse->seen > 0))
        return fine->seen > 0 ? fine->tip : 0;
    double grown = fine->seen / coarse->seen, steep = grown * coarse->cut - fine->cut;
    double times = !(grown > 1) ? 0 : steep > 0 ? fmin(most, (grown - 1) / steep) : most;
    return fine->seen / (1 - fmin(0.9, times * fine->cut));
}

static double crest_of(const twin *t)
{
    return t->spike.seen > 0 ? t->spike.seen : t->p_max;
}

/* Returns the tip by the growth of the spike from grid to grid; t is the finest. In the end the
 * part that is cut off falls at the order of the volumes (`fastest`), since a tip of some cells is
 * round; before, it falls at least as fast as by the formula (`slowest`). The spike of a single
 * grid is uncertain by the place of its nodes, so that the larger of two extrapolations counts:
 * from the last halving, and from both. */
static double tip_by_growth(const twin *t, double fastest, double slowest)
{
    double last = crest_of(t) - crest_of(t - 1), before = crest_of(t - 1) - crest_of(t - 2);
    if (!(last > 0))
        return crest_of(t);
    double ratio = before > 0 ? fmin(fmax(last / before, fastest), slowest) : slowest;
    double square = ratio * ratio;
    return crest_of(t) + fmax(last * ratio / (1 - ratio), (last + before) * square / (1 - square));
}

/* Returns the relative error of p_max of the run, from the films to t[k], k > 1. The tip is
 * resolved if a halving takes more than a third off the share that the cells cut: by the formula,
 * x/(x + w), cells are then shorter than the tip's length w. */
static double peak_error(const ehl_solver *s, double p_max, const twin *t, int k)
{
    double slowest = t[k].spike.cut / t[k - 1].spike.cut, tip = 0;
    double fastest = ldexp(1, -ehl_space_order(s->reynolds));
    if (slowest < 2. / 3)
        tip = tip_by_growth(t + k, fastest, slowest);
    else
        tip = tip_by_formula(&t[k - 2].spike, &t[k].spike);
    return fmax(fmax(0, tip / p_max - 1), fabs(t[k].p_max / p_max - 1));
}

/* Whether the films to t[k] decide if the error of the peak exceeds `enough`. */
static int is_told(const ehl_solver *s, double p_max, const twin *t, int k, double enough)
{
    return k > 1 && (peak_error(s, p_max, t, k) <= enough || t[k].p_max > (1 + enough) * p_max);
}

/* Interpolates linearly to the nodes of a finer grid. */
static void spread(const double *from, size_t cells, double *to, size_t to_cells)
{
    for (size_t i = 0; i <= to_cells; i++) {
        size_t at = i * cells / to_cells;
        double far = (double)(i * cells % to_cells) / (double)to_cells;
        to[i] = far > 0 ? (1 - far) * from[at] + far * from[at + 1] : from[at];
    }
}

/* Finds the film on `times` the cells of `s`, from that of the level before, if any. */
static ff_status find_twin(const ehl_solver *s, const ehl_instant_film *f, size_t times,
                           const ehl_grid_level *before, ehl_grid_level *l, twin *t)
{
    const ehl_instant *at = &f->at;
    size_t cells = s->grid->nodes - 1;
    double thinnest = ehl_moes_film(at, s->modulus, &s->reynolds->oil);
    double *change = malloc((cells * times + 1) * sizeof *change);
    ff_status status = change ? ehl_grid_level_create(l, s, cells * times, s->modulus) : FF_NOMEM;
    if (status == FF_OK) {
        ehl_step step = {.entrainment = at->entrainment - f->frame,
                         .sliding = at->sliding,
                         .radius = at->radius,
                         .load = at->load,
                         .loaded = 1,
                         .past = change};
        ehl_feed_step(s, at, &step);
        spread(f->change, f->cells, change, cells * times);
        status = ehl_grid_level_solve(l, before, &step, at, s->modulus, thinnest);
    }
    if (status == FF_OK)
        *t = look_at(l, at);
    free(change);
    return status == FF_OK && !(t->p_max > 0) ? FF_NOCONV : status;
}

/* Fills t with the films of the instant on more and more cells, three at least, until they decide
 * about the peak. Sets *last to the index of the last one. */
static ff_status find_twins(const ehl_solver *s, const ehl_instant_film *run,
                            const ehl_instant_film *fine, double enough, twin *t, int *last)
{
    ehl_grid_level l[2] = {0};
    ff_status status = FF_OK;
    ehl_solver kind = *s;
    if (kind.maker != ehl_line_relaxation) /* the dense solver has the same films */
        kind.maker = ehl_newton_krylov;
    for (int k = 0, told = 0; k < TWINS && status == FF_OK && !told; k++) {
        ehl_grid_level *here = &l[k % 2], *before = k > 0 ? &l[1 - k % 2] : NULL;
        ehl_grid_level_destroy(here);
        status = find_twin(&kind, k > 0 ? fine : run, (size_t)1 << k, before, here, &t[k]);
        if (status == FF_NOCONV && k > 2) { /* three films are enough for an estimate */
            status = FF_OK;
            break;
        }
        *last = k;
        told = status == FF_OK && is_told(&kind, run->p_max, t, k, enough);
    }
    ehl_grid_level_destroy(&l[0]);
    ehl_grid_level_destroy(&l[1]);
    return status;
}

static int are_within(double a, double b, double factor)
{
    return a < factor * b && b < factor * a;
}

int ehl_is_like(const ehl_instant_film *f, double h_central, double p_max)
{
    const double thicker = 1.2, higher = 1.1; /* of much the same film, also without its heat */
    return are_within(f->h_central, h_central, thicker) && are_within(f->p_max, p_max, higher);
}

ff_status ehl_peak_error(const ehl_solver *s, const ehl_instant_film *run,
                         const ehl_instant_film *fine, double enough, double *error, int *finest)
{
    twin t[TWINS];
    int last = 0;
    if (!(fine->at.entrainment > fmax(0, fine->frame)))
        return FF_NOCONV;
    ff_status status = find_twins(s, run, fine, enough, t, &last);
    if (status != FF_OK)
        return status;
    *finest = 1 << last;
    *error = peak_error(s, run->p_max, t, last);
    return ehl_is_like(run, t[0].central, t[0].p_max) ? FF_OK : FF_NOCONV;
}
