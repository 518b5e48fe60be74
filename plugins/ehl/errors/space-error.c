/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "narrow.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* film_of returns h_min, h_central or p_max of a row. part_of returns its error due to the cells, m
 * or Pa; those of h_min and h_central are negative where the film is too thin. */
static double film_of(const ehl_results *r, size_t row, int kind)
{
    static const uint32_t of[] = {EHL_H_MIN, EHL_H_CENTRAL, EHL_P_MAX};
    return r->series.data[row * EHL_SERIES + of[kind]];
}

static double *part_of(const ehl_results *r, size_t row, int kind)
{
    return &r->space.data[row * EHL_SPACE + (size_t)kind];
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

/* Returns the row whose bar ends lowest. */
static size_t lowest_end(const ehl_results *r)
{
    size_t lowest = 0;
    double least = HUGE_VAL;
    for (size_t i = 0; i < r->series.count; i++) {
        double end = film_of(r, i, EHL_LEAST) - *part_of(r, i, EHL_LEAST);
        if (end < least) {
            least = end;
            lowest = i;
        }
    }
    return lowest;
}

/* Returns the relative error of an output due to the cells. The lowest film of all lies between the
 * least lower end and the least upper end of the bars of all rows. */
static double error_of(const ehl_results *r, int kind)
{
    double error = error_of_row(r, worst_row(r, kind), kind);
    size_t row = lowest_end(r);
    double end = film_of(r, row, EHL_LEAST) - *part_of(r, row, EHL_LEAST);
    return kind == EHL_LEAST && r->lowest_alone && isfinite(end) ? fmax(error, end / r->lowest - 1)
                                                                 : error;
}

/* Returns the row that decides this error. */
static size_t deciding_row(const ehl_results *r, int kind)
{
    size_t row = worst_row(r, kind);
    return error_of(r, kind) > error_of_row(r, row, kind) ? lowest_end(r) : row;
}

/* Whether a film is measured with the one that decides: if its error is large, or if it may be the
 * lowest. */
static int is_doubtful(const ehl_results *r, size_t row, int kind)
{
    const double film = film_of(r, row, kind), bar = fabs(*part_of(r, row, kind));
    return error_of_row(r, row, kind) > EHL_FILM_LIMIT / 2 ||
           (is_extreme(r, kind) && film - bar < r->lowest);
}

/* Returns the relative error of a row due to the cells, from its film on twice the cells. */
static double error_by_finer(const ehl_results *r, const ehl_march *m, size_t row,
                             const double *finer, int kind)
{
    const double left = ldexp(1, -ehl_space_order(m->solver->reynolds));
    return (1 - finer[kind] / film_of(r, row, kind)) / (1 - left);
}

/* Puts bars in place of those of the films of a passage, from films on twice the cells. Where an
 * error crosses 0 it counts as EHL_FLOOR of the largest error of the passage, from the side of a
 * film that is too thick. */
static void put_errors(ehl_results *r, const ehl_march *m, const ehl_passage *p,
                       double (*film)[EHL_PASSED])
{
    double largest = 0;
    for (size_t i = p->first; i <= p->last; i++)
        for (int k = EHL_LEAST; k <= EHL_CENTRAL; k++)
            largest = fmax(largest, fabs(error_by_finer(r, m, i, film[i - p->first], k)));
    for (size_t i = p->first; i <= p->last; i++)
        for (int k = EHL_LEAST; k <= EHL_CENTRAL; k++) {
            const double off = error_by_finer(r, m, i, film[i - p->first], k);
            if (!has_bound(r, i, k))
                continue;
            const double floor = EHL_FLOOR * largest, error = fabs(off) > floor ? off : floor;
            *part_of(r, i, k) = ehl_known_error(EHL_CAUTION * error) * film_of(r, i, k);
            *part_of(r, i, EHL_MEASURED + k) = 1;
            r->measured[k] = 1;
        }
}

/* Measures the errors of the films around a row. */
static ff_status measure_passage(ehl_results *r, const ehl_march *m, ehl_passage *p, size_t row,
                                 int kind)
{
    ehl_passage_about(p, r, m, row, is_doubtful, kind);
    double(*film)[EHL_PASSED] = malloc((p->last - p->first + 1) * sizeof *film);
    ff_status status = film ? ehl_passage_again(r, m, p, p->first, p->last, 2, film) : FF_NOMEM;
    if (status == FF_OK)
        put_errors(r, m, p, film);
    free(film);
    return status;
}

/* Returns the row of the lowest film of all. */
static size_t lowest_row(const ehl_results *r)
{
    size_t row = 0;
    while (row + 1 < r->series.count && film_of(r, row, EHL_LEAST) > r->lowest)
        row++;
    return row;
}

static int was_measured(const ehl_results *r, size_t row, int kind)
{
    return *part_of(r, row, EHL_MEASURED + kind) > 0;
}

/* Returns the row whose passage is to be measured; SIZE_MAX: none. The lowest film comes first:
 * near it errors may change their sign from row to row, so that other rows seem to bound it. */
static size_t find_film(const ehl_results *r, int kind)
{
    const size_t lowest = lowest_row(r), row = deciding_row(r, kind);
    const double bar = fabs(*part_of(r, lowest, kind));
    if (is_extreme(r, kind) && bar > EHL_FILM_LIMIT * r->lowest && !was_measured(r, lowest, kind))
        return lowest;
    return error_of(r, kind) > EHL_FILM_LIMIT && !was_measured(r, row, kind) ? row : SIZE_MAX;
}

/* Measures the films that decide the error of an output, and a second time if another row decides
 * it then. */
static ff_status measure_film(ehl_results *r, const ehl_march *m, ehl_passage *p, int kind)
{
    enum { MOST = 2 };
    ff_status status = FF_OK;
    for (int k = 0; k < MOST && status == FF_OK; k++) {
        size_t row = find_film(r, kind);
        if (row == SIZE_MAX)
            break;
        status = measure_passage(r, m, p, row, kind);
    }
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
    while (status == FF_OK && r->peaks) {
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
    const int films = r->judged && count > 1 && !m->heat && !m->thermal;
    if (films && ehl_wants_h_min(r->wanted))
        status = measure_film(r, m, &p, EHL_LEAST);
    if (status == FF_OK && films && ehl_wants_h_central(r->wanted))
        status = measure_film(r, m, &p, EHL_CENTRAL);
    if (status == FF_OK && ehl_wants_p_max(r->wanted) && !m->heat && !m->thermal)
        status = ehl_narrow_peaks(r, m, &p);
    return status == FF_OK && r->judged && count >= LEAST_COUNT ? measure_peaks(r, m, &p) : status;
}

/* Returns how many cells would meet the limit of an error of a film, by its order. */
static double enough_cells(const ehl_march *m, double error, double limit)
{
    double times = pow(error / limit, 1. / ehl_space_order(m->solver->reynolds));
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
    else if (kind != EHL_PEAK)
        snprintf(how, sizeof how, "; 1.5 times what %s tell%s",
                 m->transport ? "their transport" : "half the cells and steps",
                 m->transport ? "s" : "");
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
    return !r->lowest_alone || r->series.count == 0 || has_bound(r, lowest_row(r), EHL_LEAST);
}

void ehl_results_report_cells(const ehl_results *r, const ehl_march *m)
{
    if (r->rough || !r->judged)
        return;
    if (ehl_wants_h_min(r->wanted))
        report_cells(r, m, EHL_LEAST, "h_min_space_error", EHL_FILM_LIMIT);
    if (ehl_wants_h_central(r->wanted))
        report_cells(r, m, EHL_CENTRAL, "h_central_space_error", EHL_FILM_LIMIT);
    if (r->peaks)
        report_cells(r, m, EHL_PEAK, "p_max_space_error", EHL_PEAK_LIMIT);
}
