/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "narrow.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* film_of returns h_min, h_central or p_max of a row. part_of returns its error due to the cells, m
 * or Pa: a bound, or the measured error, which is negative where the film is too thin. */
static double film_of(const ehl_results *r, size_t row, int kind)
{
    static const uint32_t of[] = {EHL_H_MIN, EHL_H_CENTRAL, EHL_P_MAX};
    return r->series.data[row * EHL_SERIES + of[kind]];
}

static double *part_of(const ehl_results *r, size_t row, int kind)
{
    return &r->space.data[row * EHL_SPACE + (size_t)kind];
}

/* Whether the part of a row is its error, with its sign, and not a bound. */
static int is_signed(const ehl_results *r, size_t row, int kind)
{
    return *part_of(r, row, EHL_ORIGIN + kind) > EHL_BOUNDED;
}

static int is_measured(const ehl_results *r, size_t row, int kind)
{
    return *part_of(r, row, EHL_ORIGIN + kind) > EHL_TRANSPORTED;
}

/* Whether the row has a bound; films below 2 % of the largest load have none. */
static int has_bound(const ehl_results *r, size_t row, int kind)
{
    return fabs(*part_of(r, row, kind)) > 0;
}

/* Estimates p_max of a row without the error of the cells. Between two looks of one passage it is
 * interpolated linearly, but not above its bound: on more cells p_max changes steadily, while the
 * nodes of the run lie anywhere beside the tip. Elsewhere the largest share of a bound that a look
 * found is added. */
static double tip_by_looks(const ehl_results *r, size_t row)
{
    const double value = film_of(r, row, EHL_PEAK), bound = *part_of(r, row, EHL_PEAK);
    const ehl_look *l = r->look;
    for (size_t k = 0; k < r->looks; k++) {
        if (l[k].row == row)
            return l[k].tip;
        if (k > 0 && l[k - 1].row < row && row < l[k].row && l[k - 1].row >= l[k].begin) {
            double far = (double)(row - l[k - 1].row) / (double)(l[k].row - l[k - 1].row);
            double tip = (1 - far) * l[k - 1].tip + far * l[k].tip;
            return fmax(value, fmin(tip, value + bound));
        }
    }
    return value + r->share * bound;
}

static int is_extreme(const ehl_results *r, int kind)
{
    return kind == EHL_LEAST ? r->lowest_alone : kind == EHL_PEAK && r->highest_alone;
}

static int was_looked_at(const ehl_results *r, size_t row)
{
    for (size_t k = 0; k < r->looks; k++)
        if (r->look[k].row == row)
            return 1;
    return 0;
}

/* Does the same, and counts what a narrow peak may add. A narrow peak below half of the highest
 * p_max does not count if only that is wanted. */
static double tip_of(const ehl_results *r, size_t row)
{
    const double value = film_of(r, row, EHL_PEAK), narrow = *part_of(r, row, EHL_NARROW);
    double tip = tip_by_looks(r, row);
    if (!is_extreme(r, EHL_PEAK) && !was_looked_at(r, row))
        tip = fmax(tip, value + *part_of(r, row, EHL_TIP));
    return is_extreme(r, EHL_PEAK) && value < r->highest / 2 ? tip : fmax(tip, value + narrow);
}

/* Returns the largest relative error of a row that has a bound. */
static double share_of_row(const ehl_results *r, size_t row, int kind)
{
    const double value = film_of(r, row, kind);
    const double part = kind == EHL_PEAK ? tip_of(r, row) - value : fabs(*part_of(r, row, kind));
    return isfinite(part) ? part / value : (double)INFINITY;
}

/* A film without a bound is what the contact left of an earlier film, or what a later film is made
 * of: its relative error is the larger one of both. The error of a peak without a bound is not
 * known, since a peak depends on the load. */
double ehl_space_part(const ehl_results *r, size_t row, int kind)
{
    const int none = kind == EHL_PEAK && !has_bound(r, row, kind);
    size_t before = row + 1, behind = row;
    while (before > 0 && !has_bound(r, before - 1, kind))
        before--;
    while (behind < r->series.count && !has_bound(r, behind, kind))
        behind++;
    const int led = before > 0, leads = behind < r->series.count;
    const double share = fmax(led ? share_of_row(r, before - 1, kind) : 0,
                              leads ? share_of_row(r, behind, kind) : 0);
    const double value = film_of(r, row, kind);
    return !(value > 0) ? 0 : (led || leads) && !none ? share * value : (double)INFINITY;
}

/* Returns what a row contributes to the error of the output due to the cells: its own relative
 * error, or, if only the extreme of all rows is wanted, how much it may exceed that extreme.
 * Infinite: not known. A peak without a bound contributes 0. */
static double error_of_row(const ehl_results *r, size_t row, int kind)
{
    double value = film_of(r, row, kind), part = *part_of(r, row, kind), error = 0;
    if (kind == EHL_PEAK && !has_bound(r, row, kind))
        return 0;
    if (kind == EHL_PEAK)
        error = tip_of(r, row) / (is_extreme(r, kind) ? r->highest : value) - 1;
    else if (!is_extreme(r, kind))
        error = fabs(part) / value;
    else
        error = 1 - (value - part) / r->lowest;
    return isfinite(error) ? error : (double)INFINITY;
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

/* Returns the relative error of an output due to the cells. The lowest film of all lies between the
 * least lower end and the least upper end of the bars of all rows. */
static double error_of(const ehl_results *r, int kind)
{
    double error = error_of_row(r, worst_row(r, kind), kind), highest = HUGE_VAL;
    for (size_t i = 0; i < r->series.count && kind == EHL_LEAST && r->lowest_alone; i++) {
        double part = *part_of(r, i, kind);
        highest = fmin(highest, film_of(r, i, kind) + (is_signed(r, i, kind) ? -part : part));
    }
    return isfinite(highest) ? fmax(error, highest / r->lowest - 1) : error;
}

static int is_doubtful(const ehl_results *r, size_t row, int kind)
{
    return error_of_row(r, row, kind) > EHL_FILM_LIMIT / 2;
}

/* Whether a film may be the lowest. If the outlet moves, errors are larger than their bounds, so
 * that films up to 10 % thicker count too. */
static int is_low(const ehl_results *r, size_t row, int kind)
{
    return is_doubtful(r, row, kind) || film_of(r, row, kind) < 1.1 * r->lowest;
}

/* Returns the largest ratio of a measured error to its bound, at most 1. Small bounds are left
 * out, since their ratio says nothing about larger ones; 1 if all are small. */
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

/* Replaces bounds and transported errors by measured errors. At rows that were not measured, bounds
 * are multiplied by the largest ratio found, and transported errors stay. A film without load has
 * no bound; its error counts only if the lowest film alone is wanted. */
static void put_errors(ehl_results *r, const ehl_passage *p, int kind)
{
    double share = largest_share(r, p, kind);
    for (size_t i = 0; i < r->series.count; i++) {
        double *part = part_of(r, i, kind);
        if (i < p->first || i > p->last) {
            *part *= is_signed(r, i, kind) ? 1 : share;
        } else if ((has_bound(r, i, kind) || is_extreme(r, kind)) &&
                   !isnan(p->error[i - p->first][kind])) {
            *part = p->error[i - p->first][kind] * film_of(r, i, kind);
            *part_of(r, i, EHL_ORIGIN + kind) = EHL_FINER;
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

/* Whether the row of the lowest film is measured: if its error is large, or if it has a bound
 * and the outlet moves, since bounds are those of steady films. */
static int lowest_counts(const ehl_results *r, const ehl_passage *p, size_t row, double enough)
{
    return is_signed(r, row, EHL_LEAST) ? error_of(r, EHL_LEAST) > enough
                                        : ehl_outlet_moves(p, r, row);
}

/* Returns the row to measure next; SIZE_MAX: none. It is the worst row if that row is not measured
 * yet; else the row of the lowest film if lowest_counts says so. */
static size_t find_row(const ehl_results *r, const ehl_passage *p, int kind, double enough)
{
    size_t row = worst_row(r, kind);
    if (error_of_row(r, row, kind) > enough && !is_looked_at(p, row))
        return row;
    row = lowest_row(r);
    return is_extreme(r, kind) && !is_measured(r, row, kind) && !is_looked_at(p, row) &&
                   lowest_counts(r, p, row, enough)
               ? row
               : SIZE_MAX;
}

/* Whether the verdict depends on how much of an error is left on twice the cells: half of the error
 * on the cells of the run, or nothing. */
static int order_decides(const ehl_results *r, const ehl_march *m, int kind)
{
    double left = ldexp(1, -ehl_carrying_order(m->solver->reynolds));
    double found = (1 - left) * error_of(r, kind);
    return found <= EHL_FILM_LIMIT && 2 * found > EHL_FILM_LIMIT;
}

/* Puts the measured errors in place of what is known of the output that they were measured for. A
 * transported error stands on its own, so that the passage serves the other output as well. */
static void put_measured(ehl_results *r, const ehl_march *m, const ehl_passage *p, int kind)
{
    put_errors(r, p, kind);
    if (m->transport)
        put_errors(r, p, kind == EHL_LEAST ? EHL_CENTRAL : EHL_LEAST);
}

/* Measures the errors of the films around a row. */
static ff_status measure_passage(ehl_results *r, const ehl_march *m, ehl_passage *p, size_t row,
                                 int kind)
{
    int low = is_extreme(r, kind) && (is_signed(r, row, kind) || ehl_outlet_moves(p, r, row));
    ehl_row_counts *counts = low ? is_low : is_doubtful;
    ehl_passage_destroy(p);
    ehl_passage_about(p, r, m, row, counts, kind);
    ff_status status = ehl_passage_errors(r, m, p, counts, kind);
    if (status == FF_OK)
        put_measured(r, m, p, kind);
    return status;
}

/* Measures the films that decide the error of an output, and a second time if another row is then
 * the worst. The lowest film of all is measured from half of the limit on. */
static ff_status measure_film(ehl_results *r, const ehl_march *m, ehl_passage *p, int kind)
{
    enum { MOST = 2 };
    double enough = is_extreme(r, kind) ? EHL_FILM_LIMIT / 2 : EHL_FILM_LIMIT;
    ff_status status = FF_OK;
    p->first = 1; /* no row has been measured */
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
            put_measured(r, m, p, kind);
    }
    ehl_passage_destroy(p);
    return status == FF_NOMEM || status == FF_STOPPED ? status : FF_OK;
}

/* Inserts a look, in the order of the rows. */
static void keep_look(ehl_results *r, ehl_look look)
{
    size_t k = r->looks++;
    for (; k > 0 && r->look[k - 1].row > look.row; k--)
        r->look[k] = r->look[k - 1];
    r->look[k] = look;
}

/* Finds the error of p_max of a row. The contact is marched on four times the cells, for a spike
 * that moves: the cells of the run smooth its change in time, and twice as many still do in part.
 */
static ff_status find_peak_error(ehl_results *r, const ehl_march *m, ehl_passage *p, size_t row,
                                 double *error)
{
    enum { FINER = 4 };
    double value = film_of(r, row, EHL_PEAK);
    double highest = is_extreme(r, EHL_PEAK) ? r->highest : value;
    double *change = malloc((1 + FINER) * r->nodes * sizeof *change);
    ehl_instant_film run = {.change = change}, fine = {.change = change ? change + r->nodes : NULL};
    int finest = 0;
    ff_status status = change ? ehl_passage_to(r, m, p, row, 1, &run) : FF_NOMEM;
    if (status == FF_OK && !ehl_is_like(&run, film_of(r, row, EHL_CENTRAL), value))
        status = FF_NOCONV;
    if (status == FF_OK)
        status = ehl_passage_to(r, m, p, row, FINER, &fine);
    if (status == FF_OK)
        status = ehl_peak_error(m->solver, &run, &fine, (1 + EHL_PEAK_LIMIT) * highest / value - 1,
                                error, &finest);
    if (status == FF_OK && finest > r->finest)
        r->finest = finest;
    free(change);
    return status;
}

/* Measures p_max of a row on more cells. If that fails, the bound stands there and at all rows that
 * are not between two looks. */
static ff_status look_at_peak(ehl_results *r, const ehl_march *m, ehl_passage *p, size_t row)
{
    double value = film_of(r, row, EHL_PEAK), bound = *part_of(r, row, EHL_PEAK) / value, error = 0;
    ff_status status = find_peak_error(r, m, p, row, &error);
    if (status == FF_NOMEM || status == FF_STOPPED)
        return status;
    if (status != FF_OK)
        error = bound;
    /* the ratio at a small bound says nothing about large ones */
    double share = bound > EHL_PEAK_LIMIT / 2 ? error / bound : 0;
    r->share = r->looks > 0 ? fmax(r->share, share) : share;
    keep_look(r, (ehl_look){row, p->begin, (1 + error) * value});
    return FF_OK;
}

static size_t highest_row(const ehl_results *r)
{
    size_t row = 0;
    while (row + 1 < r->series.count && film_of(r, row, EHL_PEAK) < r->highest)
        row++;
    return row;
}

/* Returns the row to look at; SIZE_MAX: none. First the worst row and the row of the highest p_max,
 * if the error exceeds half of the limit; then rows whose error may exceed the limit, until one is
 * known to exceed it. */
static size_t find_peak(const ehl_results *r)
{
    size_t worst = worst_row(r, EHL_PEAK), highest = highest_row(r);
    double error = error_of_row(r, worst, EHL_PEAK);
    int seen = 0;
    for (size_t k = 0; k < r->looks; k++) {
        seen |= r->look[k].row == highest;
        if (error_of_row(r, r->look[k].row, EHL_PEAK) > EHL_PEAK_LIMIT)
            return SIZE_MAX;
    }
    if (isinf(error))
        return SIZE_MAX; /* no look can reduce it */
    if (r->looks == 0)
        return error > EHL_PEAK_LIMIT / 2 ? worst : SIZE_MAX;
    if (r->looks == 1 && !seen && *part_of(r, highest, EHL_PEAK) > EHL_PEAK_LIMIT / 2 * r->highest)
        return highest;
    return error > EHL_PEAK_LIMIT && r->looks < EHL_LOOKS ? worst : SIZE_MAX;
}

static ff_status measure_peaks(ehl_results *r, const ehl_march *m, ehl_passage *p)
{
    ff_status status = FF_OK;
    while (status == FF_OK && ehl_wants_p_max(r->wanted)) {
        size_t row = find_peak(r);
        if (row == SIZE_MAX)
            break;
        status = look_at_peak(r, m, p, row);
    }
    return status;
}

ff_status ehl_results_measure(ehl_results *r, const ehl_march *m, const ehl_history *whole,
                              int equal)
{
    enum { LEAST_COUNT = 100 }; /* measuring a peak takes the same time for a short run */
    ehl_passage p = {.whole = whole, .equal = equal};
    size_t count = r->series.count;
    ff_status status = FF_OK;
    if (r->rough || m->solver->outside)
        return FF_OK;
    if (count > 1 && ehl_wants_h_min(r->wanted))
        status = measure_film(r, m, &p, EHL_LEAST);
    if (status == FF_OK && count > 1 && ehl_wants_h_central(r->wanted))
        status = measure_film(r, m, &p, EHL_CENTRAL);
    if (status == FF_OK && ehl_wants_p_max_itself(r->wanted) && !m->heat && !m->thermal)
        status = ehl_narrow_peaks(r, m, &p);
    return status == FF_OK && count >= LEAST_COUNT ? measure_peaks(r, m, &p) : status;
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
    if (kind != EHL_PEAK && isinf(error))
        error = NAN; /* not known, nor from which side */
    char how[128] = "", enough[96] = "", text[400];
    if (kind == EHL_PEAK && r->narrow > 0)
        snprintf(how, sizeof how,
                 "; peaks as narrow as a few cells are those of %zu times the cells", r->narrow);
    else if (kind == EHL_PEAK && fabs(r->share - 1) > 0)
        snprintf(how, sizeof how, "; by its film on %d times the cells %.3g of what bounds it",
                 r->finest, r->share);
    else if (kind != EHL_PEAK && r->measured[kind])
        snprintf(how, sizeof how, "; measured by the last passage of the contact on more cells");
    else if (kind != EHL_PEAK && m->transport)
        snprintf(how, sizeof how, "; 1.5 times what their transport tells");
    if (kind == EHL_PEAK && isinf(error))
        snprintf(enough, sizeof enough,
                 "; a peak as narrow as a few cells is not resolved: p_max is at least what they "
                 "show");
    else if (kind == EHL_PEAK)
        snprintf(enough, sizeof enough,
                 "; above 0.1 the cells may cut the spike at the outlet off: use more of them");
    else if (error > limit)
        snprintf(enough, sizeof enough, "; cells: %.0f would be about enough",
                 enough_cells(m, error, limit));
    else if (isnan(error))
        snprintf(enough, sizeof enough, "; above %g it is not known: use more cells",
                 EHL_KNOWN_ERROR);
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
    return !r->lowest_alone || r->series.count == 0 || has_bound(r, lowest_row(r), EHL_LEAST) ||
           is_signed(r, lowest_row(r), EHL_LEAST);
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
