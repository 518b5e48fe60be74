/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "passage.h"
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

/* Films of the row, and what the cells add to them, m: a bound, or what was measured, negative
   where the film is too thin. */
static double film_of(const ehl_results *r, size_t row, int kind)
{
    static const uint32_t of[] = {EHL_H_MIN, EHL_H_CENTRAL, EHL_P_MAX};
    return r->series.data[row * EHL_SERIES + of[kind]];
}

static double *part_of(const ehl_results *r, size_t row, int kind)
{
    return &r->space.data[row * EHL_SPACE + (size_t)kind];
}

/* A film, and what is looked at of it. */
typedef struct twin {
    double central, p_max, bound; /* bound: of the error of p_max */
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
    t.bound = ehl_space_bounds(eq, at, l->solver.modulus, &of, &t.spike).of[EHL_PEAK];
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
    return k > 1 && (peak_error(t, k) <= enough || t[k].p_max > (1 + enough) * t[0].p_max);
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

/* Fills t with the films of the instant, three at least, until the peak is told; *last: of them. */
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
        told = status == FF_OK && is_told(t, k, enough);
    }
    ehl_grid_level_destroy(&l[0]);
    ehl_grid_level_destroy(&l[1]);
    return status;
}

static int are_within(double a, double b, double factor)
{
    return a < factor * b && b < factor * a;
}

ff_status ehl_space_measure(const ehl_solver *s, const ehl_bound *run, double enough, double *share,
                            int *finest)
{
    const double thicker = 1.2, higher = 1.1; /* without heat, and still much the same film */
    twin t[TWINS];
    int last = 0;
    if (!(run->at.entrainment > fmax(0, run->frame)))
        return FF_NOCONV;
    ff_status status = find_twins(s, run, enough, t, &last);
    if (status != FF_OK)
        return status;
    *finest = 1 << last;
    if (!are_within(t[0].central, run->h_central, thicker) ||
        !are_within(t[0].p_max, run->p_max, higher))
        return FF_NOCONV;
    /* a bound that is as good as none tells nothing of those that are large */
    *share = t[0].bound > EHL_PEAK_LIMIT / 2 ? peak_error(t, last) / t[0].bound : 0;
    return FF_OK;
}

/* Raises the share of the peaks by that at the instant of a bound. Where its own is not known
   there, it stands. */
static ff_status raise_peak(ehl_results *r, const ehl_march *m, const ehl_bound *b, double *all)
{
    double highest = r->highest_alone ? r->highest : b->p_max, share = 0;
    double enough = (1 + EHL_PEAK_LIMIT) * highest / b->p_max - 1;
    int finest = 0;
    ff_status status = ehl_space_measure(m->solver, b, enough, &share, &finest);
    if (status == FF_NOMEM)
        return FF_NOMEM;
    r->finest = finest > r->finest ? finest : r->finest;
    *all = fmax(*all, status == FF_OK && share > 0 ? share : 1);
    return FF_OK;
}

static ff_status measure_peaks(ehl_results *r, const ehl_march *m)
{
    double all = 0;
    if (!(ehl_wants_p_max(r->wanted) && r->worst_peak.worst > EHL_PEAK_LIMIT))
        return FF_OK;
    ff_status status = raise_peak(r, m, &r->worst_peak, &all);
    int other = fabs(r->at_highest.at.time - r->worst_peak.at.time) > 0;
    if (status == FF_OK && other && r->at_highest.worst > EHL_PEAK_LIMIT)
        status = raise_peak(r, m, &r->at_highest, &all);
    r->share = all;
    return status;
}

static int is_measured(const ehl_results *r, size_t row, int kind)
{
    return *part_of(r, row, EHL_MEASURED + kind) > 0;
}

/* Films below 2 % of the largest load have none. */
static int has_bound(const ehl_results *r, size_t row, int kind)
{
    return fabs(*part_of(r, row, kind)) > 0;
}

static int is_extreme(const ehl_results *r, int kind)
{
    return kind == EHL_LEAST ? r->lowest_alone : kind == EHL_PEAK && r->highest_alone;
}

/* Returns what a row makes of the error of the output by the cells: its own, or by how much it goes
   beyond the extreme of all, where that alone is wanted. */
static double error_of_row(const ehl_results *r, size_t row, int kind)
{
    double value = film_of(r, row, kind), part = *part_of(r, row, kind), error = 0;
    if (!is_extreme(r, kind))
        error = fabs(part) / value;
    else if (kind == EHL_PEAK)
        error = (value + r->share * part) / r->highest - 1;
    else
        error = 1 - (value - part) / r->lowest;
    return isfinite(error) ? error : 1e300;
}

static size_t worst_row(const ehl_results *r, int kind)
{
    size_t worst = 0;
    double most = -HUGE_VAL;
    for (size_t i = 0; i < r->series.count; i++) {
        double error = error_of_row(r, i, kind);
        if (error > most) {
            most = error;
            worst = i;
        }
    }
    return worst;
}

/* Returns the error of an output by the cells, relative. The lowest film may be as low as the films
   of all instants may be, or be higher as far as all of them are. */
static double error_of(const ehl_results *r, int kind)
{
    if (kind == EHL_PEAK && !is_extreme(r, kind))
        return r->share * r->worst_peak.worst;
    double error = error_of_row(r, worst_row(r, kind), kind), highest = HUGE_VAL;
    for (size_t i = 0; i < r->series.count && kind == EHL_LEAST && r->lowest_alone; i++) {
        double part = *part_of(r, i, kind);
        highest = fmin(highest, film_of(r, i, kind) + (is_measured(r, i, kind) ? -part : part));
    }
    return isfinite(highest) ? fmax(error, highest / r->lowest - 1) : error;
}

static int is_doubtful(const ehl_results *r, size_t row, int kind)
{
    return error_of_row(r, row, kind) > EHL_FILM_LIMIT / 2;
}

/* Where the outlet moves errors are larger than their bounds: a film that is somewhat thicker may
   be the lowest, too. */
static int is_low(const ehl_results *r, size_t row, int kind)
{
    return is_doubtful(r, row, kind) ||
           (has_bound(r, row, kind) && film_of(r, row, kind) < 1.1 * r->lowest);
}

/* Returns the largest share of their bounds that errors have, all at most, and all where no bound
   is large: those that are as good as none tell nothing of others. */
static double largest_share(const ehl_results *r, const ehl_passage *p, int kind)
{
    double share = 0;
    for (size_t i = p->first; i <= p->last; i++) {
        double bound = fabs(*part_of(r, i, kind)) / film_of(r, i, kind),
               e = fabs(p->error[i - p->first][kind]);
        if (bound > EHL_FILM_LIMIT / 2)
            share = fmax(share, e <= bound ? e / bound : 1);
    }
    return share > 0 ? share : 1;
}

/* Puts the errors that are known in place of what bounds them, and leaves that share of the bounds
   at the rows that were not looked at. A film without load has no bound, and its error does not
   count. */
static void put_errors(ehl_results *r, const ehl_passage *p, int kind)
{
    double share = largest_share(r, p, kind);
    for (size_t i = 0; i < r->series.count; i++) {
        double *part = part_of(r, i, kind);
        if (i < p->first || i > p->last) {
            *part *= is_measured(r, i, kind) ? 1 : share;
        } else if (has_bound(r, i, kind) && isfinite(p->error[i - p->first][kind])) {
            *part = p->error[i - p->first][kind] * film_of(r, i, kind);
            *part_of(r, i, EHL_MEASURED + kind) = 1;
            r->measured[kind] = 1;
        }
    }
}

/* Returns the row of the lowest film of all. */
static size_t lowest_row(const ehl_results *r)
{
    size_t row = 0;
    while (row + 1 < r->series.count && film_of(r, row, EHL_LEAST) > r->lowest)
        row++;
    return row;
}

static int is_looked_at(const ehl_passage *p, size_t row)
{
    return row >= p->first && row <= p->last;
}

/* Returns the row to look at, SIZE_MAX when there is none: the worst one where the error is not
   known yet, else that of the lowest film of all where its outlet moves, since bounds are those of
   steady films. */
static size_t find_row(const ehl_results *r, const ehl_passage *p, int kind, double enough)
{
    size_t row = worst_row(r, kind);
    if (error_of_row(r, row, kind) > enough && !is_looked_at(p, row))
        return row;
    row = lowest_row(r);
    return is_extreme(r, kind) && has_bound(r, row, kind) && !is_measured(r, row, kind) &&
                   !is_looked_at(p, row) && ehl_outlet_moves(p, r, row)
               ? row
               : SIZE_MAX;
}

/* Whether the verdict hangs on how much is left of an error on twice the cells: on half of what is
   there on the cells of the run, or on nothing. */
static int order_decides(const ehl_results *r, const ehl_march *m, int kind)
{
    double left = ldexp(1, -ehl_carrying_order(m->solver->reynolds));
    double found = (1 - left) * error_of(r, kind);
    return found <= EHL_FILM_LIMIT && 2 * found > EHL_FILM_LIMIT;
}

/* Measures the films about a row. */
static ff_status measure_passage(ehl_results *r, const ehl_march *m, ehl_passage *p, size_t row,
                                 int kind)
{
    int moves = is_extreme(r, kind) && ehl_outlet_moves(p, r, row);
    ehl_row_counts *counts = moves ? is_low : is_doubtful;
    ehl_passage_destroy(p);
    ehl_passage_about(p, r, m, row, counts, kind);
    ff_status status = ehl_passage_errors(r, m, p, counts, kind);
    if (status == FF_OK)
        put_errors(r, p, kind);
    return status;
}

/* Measures the films that the error of an output hangs on, and once more where those were not all.
   The lowest film of all is first looked at from half of the limit on. */
static ff_status measure_film(ehl_results *r, const ehl_march *m, ehl_passage *p, int kind)
{
    enum { MOST = 2 };
    double enough = is_extreme(r, kind) ? EHL_FILM_LIMIT / 2 : EHL_FILM_LIMIT;
    ff_status status = FF_OK;
    p->first = 1; /* none was looked at */
    p->last = 0;
    for (int k = 0; k < MOST && status == FF_OK; k++, enough = EHL_FILM_LIMIT) {
        size_t row = find_row(r, p, kind, enough);
        if (row == SIZE_MAX)
            break;
        status = measure_passage(r, m, p, row, kind);
    }
    if (status == FF_OK && p->film && order_decides(r, m, kind)) {
        status = ehl_passage_refine(r, m, p);
        if (status == FF_OK)
            put_errors(r, p, kind);
    }
    ehl_passage_destroy(p);
    return status == FF_NOMEM || status == FF_STOPPED ? status : FF_OK;
}

ff_status ehl_results_measure(ehl_results *r, const ehl_march *m, const ehl_history *whole,
                              int equal)
{
    enum { LEAST_COUNT = 100 }; /* a peak takes as long however short the run */
    ehl_passage p = {.whole = whole, .equal = equal};
    size_t count = r->series.count;
    ff_status status = FF_OK;
    if (r->rough || m->solver->outside)
        return FF_OK;
    if (count > 1 && ehl_wants_h_min(r->wanted))
        status = measure_film(r, m, &p, EHL_LEAST);
    if (status == FF_OK && count > 1 && ehl_wants_h_central(r->wanted))
        status = measure_film(r, m, &p, EHL_CENTRAL);
    return status == FF_OK && count >= LEAST_COUNT ? measure_peaks(r, m) : status;
}

/* Returns how many cells would meet the limit of an error of a film, by its order. */
static double enough_cells(const ehl_march *m, double error, double limit)
{
    double times = pow(error / limit, 1. / ehl_carrying_order(m->solver->reynolds));
    return 16 * ceil((double)(m->solver->grid->nodes - 1) * times / 16);
}

static void report_cells(const ehl_results *r, const ehl_march *m, int kind, const char *name,
                         double limit)
{
    static const char *const all[] = {"h_min", "h_central", "p_max"};
    static const char *const extreme[] = {"h_min_lowest", "", "p_max_highest"};
    const char *of = is_extreme(r, kind) ? extreme[kind] : all[kind];
    double error = error_of(r, kind);
    char how[128] = "", enough[96] = "", text[400];
    if (kind == EHL_PEAK && fabs(r->share - 1) > 0)
        snprintf(how, sizeof how, "; by its film on %d times the cells %.3g of what bounds it",
                 r->finest, r->share);
    else if (kind != EHL_PEAK && r->measured[kind])
        snprintf(how, sizeof how, "; measured by the last passage of the contact on more cells");
    if (kind == EHL_PEAK)
        snprintf(enough, sizeof enough,
                 "; above 0.1 the cells may cut the spike at the outlet off: use more of them");
    else if (error > limit && error < 0.5)
        snprintf(enough, sizeof enough, "; cells: %.0f would be about enough",
                 enough_cells(m, error, limit));
    snprintf(text, sizeof text,
             "estimate of the error of %s by the cells, over it; loads above 2 %% of the "
             "largest%s%s",
             of, how, enough);
    r->host->quality(r->host->ctx, name, error, limit, error <= limit ? FF_GOOD : FF_DOUBTFUL,
                     text);
}

int ehl_results_estimate_cells(const ehl_results *r)
{
    if (r->rough || !(ehl_wants_h_min(r->wanted) || ehl_wants_h_central(r->wanted)))
        return 0;
    return !r->lowest_alone || r->series.count == 0 || has_bound(r, lowest_row(r), EHL_LEAST);
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
