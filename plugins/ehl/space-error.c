/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "outputs.h"
#include "start.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

int ehl_wants_h_min(uint64_t wanted)
{
    static const uint64_t all = FF_BIT(EHL_H_MIN) | FF_BIT(EHL_H_MIN_ERROR) | FF_BIT(EHL_FILM) |
                                FF_BIT(EHL_H_MIN_LOWEST) | FF_BIT(EHL_H_MIN_LOWEST_AT) |
                                FF_BIT(EHL_H_MIN_LOWEST_MEAN) | FF_BIT(EHL_H_MIN_LOWEST_SPREAD);
    return (wanted & all) != 0;
}

int ehl_wants_h_central(uint64_t wanted)
{
    static const uint64_t all = FF_BIT(EHL_H_CENTRAL) | FF_BIT(EHL_H_CENTRAL_ERROR) |
                                FF_BIT(EHL_FILM) | FF_BIT(EHL_LAMBDA_RATIO) |
                                FF_BIT(EHL_LAMBDA_RATIO_LOWEST);
    return (wanted & all) != 0 || ehl_loss_of_shear(wanted);
}

int ehl_wants_p_max(uint64_t wanted)
{
    static const uint64_t all =
        FF_BIT(EHL_P_MAX) | FF_BIT(EHL_P_MAX_HIGHEST) | FF_BIT(EHL_PRESSURE);
    return (wanted & all) != 0 || ehl_loss_of_shear(wanted);
}

int ehl_wants_lowest_alone(uint64_t wanted)
{
    static const uint64_t lowest = FF_BIT(EHL_H_MIN_LOWEST) | FF_BIT(EHL_H_MIN_LOWEST_AT);
    return ehl_wants_h_min(wanted & lowest) && !ehl_wants_h_min(wanted & ~lowest);
}

int ehl_wants_highest_alone(uint64_t wanted)
{
    static const uint64_t highest = FF_BIT(EHL_P_MAX_HIGHEST);
    return ehl_wants_p_max(wanted & highest) && !ehl_wants_p_max(wanted & ~highest);
}

/* Error of the extreme over all instants by the cells, relative: by how much any instant may go
 * beyond it. */
static double extreme_error(const ehl_results *r, int kind)
{
    double worst = 0, share = r->share.of[kind];
    for (size_t i = 0; i < r->series.count; i++) {
        const double *y = &r->series.data[i * EHL_SERIES];
        double part = share * r->space.data[i * EHL_BOUNDS + (size_t)kind];
        ehl_worse(&worst, kind == EHL_PEAK ? (y[EHL_P_MAX] + part) / r->highest - 1
                                           : 1 - (y[EHL_H_MIN] - part) / r->lowest);
    }
    return worst;
}

/* A film, and what is looked at of it. */
typedef struct twin {
    double least, central, p_max;
    ehl_spike spike;
    ehl_space_errors bound;
} twin;

static twin look_at(ehl_grid_level *l, const ehl_instant *at)
{
    ehl_reynolds *eq = &l->reynolds;
    twin t = {.p_max = 0};
    size_t node;
    ehl_reynolds_gap(eq, at->radius, &l->film);
    t.least = ehl_least_film(eq, &node);
    t.central = ehl_central_film(&l->grid, eq);
    for (size_t i = 0; i < eq->nodes; i++)
        t.p_max = fmax(t.p_max, l->film.p[i]);
    if (!(t.least > 0 && t.central > 0 && t.p_max > 0))
        return (twin){.p_max = 0};
    const ehl_crest of = {l->film.p, t.central, t.p_max};
    t.bound = ehl_space_bounds(eq, at, l->solver.modulus, &of, &t.spike);
    return t;
}

/* Films on 1, 2, 4, 8, 16 times the cells. */
enum { TWINS = 5 };

/*
 * Returns the tip of a spike on the finer of two grids. What the cells cut off it is some multiple
 * of what the formula says on either, which the spikes of both tell; it is bounded, since few cells
 * show a spike beside the place where it will stand.
 */
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

/*
 * Returns the tip by what the spike grows by from grid to grid, t being the finest. What is cut off
 * falls at first order, by 1/2, once cells are short, and by no less than the formula says before;
 * the spike of one grid alone is uncertain by where its nodes lie, so that the growth of both
 * halvings counts as much as that of the last.
 */
static double tip_by_growth(const twin *t, double slowest)
{
    double last = crest_of(t) - crest_of(t - 1), before = crest_of(t - 1) - crest_of(t - 2);
    if (!(last > 0))
        return crest_of(t);
    double ratio = before > 0 ? fmin(fmax(last / before, 0.5), slowest) : slowest;
    double square = ratio * ratio;
    return crest_of(t) + fmax(last * ratio / (1 - ratio), (last + before) * square / (1 - square));
}

/* Returns the error of p_max on the cells of t[0], from the films to t[k], k > 1. By the formula,
   x/(x + w), cells are shorter than a tip of length w where a halving takes a third off the share
   that they cut. */
static double peak_error(const twin *t, int k)
{
    double slowest = t[k].spike.cut / t[k - 1].spike.cut, tip = 0;
    if (k > 2 && slowest < 2. / 3)
        tip = tip_by_growth(t + k, slowest);
    else
        tip = tip_by_formula(&t[k - 2].spike, &t[k].spike);
    return fmax(fmax(0, tip / t[0].p_max - 1), fabs(t[k].p_max / t[0].p_max - 1));
}

/* Whether it is known if the error of the peak exceeds `enough`, by the films to t[k]. */
static int is_told(const twin *t, int k, double enough)
{
    return !(enough > 0) ||
           (k > 1 && (peak_error(t, k) <= enough || t[k].p_max > (1 + enough) * t[0].p_max));
}

/* Straight lines between the nodes: `times` cells in place of each of the `cells` of `from`. */
static void spread(const double *from, size_t cells, size_t times, double *to)
{
    for (size_t i = 0; i < cells * times; i++) {
        double far = (double)(i % times) / (double)times;
        to[i] = (1 - far) * from[i / times] + far * from[i / times + 1];
    }
    to[cells * times] = from[cells];
}

/* Finds the film on `times` the cells of `s`, from that of the level before, if any. */
static ff_status find_twin(const ehl_solver *s, const ehl_bound *run, size_t times,
                           const ehl_grid_level *before, ehl_grid_level *l, twin *t)
{
    const ehl_instant *at = &run->at;
    size_t cells = s->grid->nodes - 1;
    double thinnest = ehl_moes_film(at, s->modulus, &s->reynolds->oil);
    double *change = malloc((cells * times + 1) * sizeof *change);
    ff_status status = change ? ehl_grid_level_create(l, s, cells * times, s->modulus) : FF_NOMEM;
    if (status == FF_OK) {
        const ehl_step step = {.entrainment = at->entrainment - run->frame,
                               .sliding = at->sliding,
                               .radius = at->radius,
                               .load = at->load,
                               .loaded = 1,
                               .past = change};
        spread(run->change, cells, times, change);
        status = ehl_grid_level_solve(l, before, &step, at, s->modulus, thinnest);
    }
    if (status == FF_OK)
        *t = look_at(l, at);
    free(change);
    return status == FF_OK && !(t->p_max > 0) ? FF_NOCONV : status;
}

/* Fills t with the films of the instant, two at least, until the peak is told; *last: of them. */
static ff_status find_twins(const ehl_solver *s, const ehl_bound *run, double enough, twin *t,
                            int *last)
{
    ehl_grid_level l[2] = {0};
    ff_status status = FF_OK;
    ehl_solver kind = *s;
    if (kind.maker != ehl_line_relaxation) /* the dense solver has the same films */
        kind.maker = ehl_newton_krylov;
    for (int k = 0, told = 0; k < TWINS && status == FF_OK && !told; k++) {
        ehl_grid_level *here = &l[k % 2], *before = k > 0 ? &l[1 - k % 2] : NULL;
        ehl_grid_level_destroy(here);
        status = find_twin(&kind, run, (size_t)1 << k, before, here, &t[k]);
        if (status == FF_NOCONV && k > 2) { /* three films tell of the peak what they can */
            status = FF_OK;
            break;
        }
        *last = k;
        told = status == FF_OK && k > 0 && is_told(t, k, enough);
    }
    ehl_grid_level_destroy(&l[0]);
    ehl_grid_level_destroy(&l[1]);
    return status;
}

/* Error of a film from that on twice the cells (Richardson). */
static double film_error(double coarse, double fine, int order)
{
    return fabs(coarse / fine - 1) / (1 - ldexp(1, -order));
}

/* A bound that is as good as none tells nothing of those that are large: 0. */
static double share_of(double error, double bound, double limit)
{
    return bound > limit / 2 ? error / bound : 0;
}

static int are_within(double a, double b, double factor)
{
    return a < factor * b && b < factor * a;
}

ff_status ehl_space_measure(const ehl_solver *s, const ehl_bound *run, double enough,
                            ehl_space_errors *share, int *finest)
{
    const double thicker = 1.2, higher = 1.1; /* without heat, and still much the same film */
    twin t[TWINS];
    int order = s->reynolds->wedge == 2 ? 2 : 1, last = 0;
    if (!(run->at.entrainment > fmax(0, run->frame)))
        return FF_NOCONV;
    ff_status status = find_twins(s, run, enough, t, &last);
    if (status != FF_OK)
        return status;
    *finest = 1 << last;
    if (!are_within(t[0].central, run->h_central, thicker) ||
        !are_within(t[0].p_max, run->p_max, higher))
        return FF_NOCONV;
    const double *bound = t[0].bound.of;
    *share = (ehl_space_errors){{
        share_of(film_error(t[0].least, t[1].least, order), bound[EHL_LEAST], EHL_FILM_LIMIT),
        share_of(film_error(t[0].central, t[1].central, order), bound[EHL_CENTRAL], EHL_FILM_LIMIT),
        last > 1 ? share_of(peak_error(t, last), bound[EHL_PEAK], EHL_PEAK_LIMIT) : 0,
    }};
    return FF_OK;
}

/* Raises the shares by those at the instant of a bound. Where its own is not known there, it
   stands. */
static ff_status raise_shares(ehl_results *r, const ehl_march *m, const ehl_bound *b, int kind,
                              ehl_space_errors *all)
{
    double highest = r->highest_alone ? r->highest : b->p_max;
    double enough = kind == EHL_PEAK ? (1 + EHL_PEAK_LIMIT) * highest / b->p_max - 1 : 0;
    ehl_space_errors share = {0};
    int finest = 0;
    ff_status status = ehl_space_measure(m->solver, b, enough, &share, &finest);
    if (status == FF_NOMEM)
        return FF_NOMEM;
    r->measured += status == FF_OK;
    r->finest = finest > r->finest ? finest : r->finest;
    if (status != FF_OK || !(share.of[kind] > 0))
        share.of[kind] = 1;
    int peak = kind == EHL_PEAK; /* whose frame is not that of the films */
    for (int k = peak ? EHL_PEAK : 0; k < (peak ? EHL_BOUNDS : EHL_PEAK); k++)
        all->of[k] = fmax(all->of[k], share.of[k]);
    return FF_OK;
}

ff_status ehl_results_measure(ehl_results *r, const ehl_march *m)
{
    enum { LEAST_COUNT = 100 };
    const double limit[] = {EHL_FILM_LIMIT, EHL_FILM_LIMIT, EHL_PEAK_LIMIT};
    const int wanted[] = {ehl_wants_h_min(r->wanted), ehl_wants_h_central(r->wanted),
                          ehl_wants_p_max(r->wanted)};
    ehl_space_errors all = {0};
    ff_status status = FF_OK;
    if (r->rough || m->solver->outside || r->series.count < LEAST_COUNT)
        return FF_OK;
    for (int k = 0; k < EHL_BOUNDS && status == FF_OK; k++)
        if (wanted[k] && r->bound[k].worst > limit[k])
            status = raise_shares(r, m, &r->bound[k], k, &all);
    int other = fabs(r->at_highest.at.time - r->bound[EHL_PEAK].at.time) > 0;
    if (status == FF_OK && wanted[EHL_PEAK] && other && r->at_highest.worst > EHL_PEAK_LIMIT)
        status = raise_shares(r, m, &r->at_highest, EHL_PEAK, &all);
    for (int k = 0; k < EHL_BOUNDS; k++)
        if (wanted[k] && r->bound[k].worst > limit[k])
            r->share.of[k] = all.of[k];
    return status;
}

/* Returns how many cells would meet the limit of an error of a film, by its order. */
static double enough_cells(const ehl_march *m, double error, double limit)
{
    double times = pow(error / limit, 1. / m->solver->reynolds->wedge);
    return 16 * ceil((double)(m->solver->grid->nodes - 1) * times / 16);
}

/* What the cells cost an output, relative: where they make the film, and where it carries a change
   on. */
typedef struct cost {
    double error, carried;
    const char *of;
} cost;

static cost cost_of(const ehl_results *r, int kind)
{
    static const char *const series[] = {"h_min", "h_central", "p_max"};
    if (kind == EHL_LEAST && r->lowest_alone)
        return (cost){extreme_error(r, kind), 1 - r->least_carried / r->lowest, "h_min_lowest"};
    double error = r->share.of[kind] * r->bound[kind].worst;
    if (kind != EHL_PEAK)
        return (cost){error, r->worst_carried[kind], series[kind]};
    return r->highest_alone ? (cost){extreme_error(r, kind), 0, "p_max_highest"}
                            : (cost){error, 0, series[kind]};
}

static void report_cells(const ehl_results *r, const ehl_march *m, int kind, const char *name,
                         double limit)
{
    const cost c = cost_of(r, kind);
    double share = r->share.of[kind], error = fmax(c.error, c.carried);
    char how[128] = "", enough[96] = "", text[400];
    if (c.carried > c.error)
        snprintf(how, sizeof how,
                 "; largest where the film carries a change through the contact that is few cells "
                 "long");
    else if (fabs(share - 1) > 0)
        snprintf(how, sizeof how, "; by its film on %d times the cells %.3g of what bounds it",
                 kind == EHL_PEAK ? r->finest : 2, share);
    if (kind == EHL_PEAK)
        snprintf(enough, sizeof enough,
                 "; above 0.1 the cells may cut the spike at the outlet off: use more of them");
    else if (error > limit && error < 0.5)
        snprintf(enough, sizeof enough, "; cells: %.0f would be about enough",
                 enough_cells(m, error, limit));
    snprintf(text, sizeof text,
             "estimate of the error of %s by the cells, over it; loads above 2 %% of the "
             "largest%s%s",
             c.of, how, enough);
    r->host->quality(r->host->ctx, name, error, limit, error <= limit ? FF_GOOD : FF_DOUBTFUL,
                     text);
}

void ehl_results_report_cells(const ehl_results *r, const ehl_march *m)
{
    if (r->rough)
        return;
    if (ehl_wants_h_min(r->wanted))
        report_cells(r, m, EHL_LEAST, "h_min_space_error", EHL_FILM_LIMIT);
    if (ehl_wants_h_central(r->wanted))
        report_cells(r, m, EHL_CENTRAL, "h_central_space_error", EHL_FILM_LIMIT);
    if (ehl_wants_p_max(r->wanted))
        report_cells(r, m, EHL_PEAK, "p_max_space_error", EHL_PEAK_LIMIT);
}
