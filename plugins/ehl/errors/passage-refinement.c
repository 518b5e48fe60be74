/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "passage-refinement.h"

#include "../solvers/grid-level.h"
#include "../time/start.h"
#include "../time/step-control.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Films of the rows that are looked at. */
typedef double (*films)[EHL_PASSED];

/* Steps of the run are joined until the oil has moved by this share of a cell. */
static const double joined = 0.2;

static double value(const ehl_results *r, size_t row, uint32_t output)
{
    return r->series.data[row * EHL_SERIES + output];
}

static int are_together(const ehl_results *r, size_t row, size_t other)
{
    return !(fabs(value(r, row, EHL_ENGAGEMENT) - value(r, other, EHL_ENGAGEMENT)) > 0);
}

/* Returns the engagement of a row. */
static ehl_history engagement_of(const ehl_results *r, const ehl_passage *p, size_t row)
{
    ehl_history one;
    size_t next = ehl_history_engagement(p->whole, 0, &one);
    for (size_t i = 1; i <= row; i++)
        if (!are_together(r, i, i - 1))
            next = ehl_history_engagement(p->whole, next, &one);
    return one;
}

/* Returns how far the oil moves from a row to another one, m; below 0 if that is an earlier one. */
static double way_between(const ehl_results *r, const ehl_history *h, size_t row, size_t other)
{
    double from = value(r, row, EHL_TIME), to = value(r, other, EHL_TIME);
    return (ehl_history_at(h, from).entrainment + ehl_history_at(h, to).entrainment) / 2 *
           (to - from);
}

/* Returns the length of a passage: from the point where the pressure flow makes the film, some
   build-up lengths in front of the contact, to the outlet. Twice or four times as many lengths
   change the errors by at most 0.2 % of the film. */
static double length_of_passage(const ehl_results *r, const ehl_march *m, const ehl_history *h,
                                size_t row)
{
    const double lengths = 4;
    double radius = ehl_history_at(h, value(r, row, EHL_TIME)).radius;
    double film = value(r, row, EHL_H_CENTRAL), a = m->solver->grid->half_width;
    return 2 * fmax(a, sqrt(2 * radius * film)) + lengths * ehl_inlet_buildup(a, radius, film);
}

/* Returns the row of the engagement that is at a distance `length` of the oil from this one, or the
 * end of the engagement. */
static size_t row_away(const ehl_results *r, const ehl_history *h, size_t row, double length,
                       int forwards)
{
    for (double way = 0; way < length;) {
        size_t next = forwards ? row + 1 : row - 1;
        if ((forwards ? next == r->series.count : row == 0) || !are_together(r, row, next))
            break;
        way += fabs(way_between(r, h, row, next));
        row = next;
    }
    return row;
}

static double half_width(const ehl_results *r, const ehl_history *h, size_t row)
{
    ehl_instant at = ehl_history_at(h, value(r, row, EHL_TIME));
    return ehl_hertz_half_width(at.load, at.radius, h->modulus);
}

int ehl_outlet_moves(const ehl_passage *p, const ehl_results *r, size_t row)
{
    const ehl_history h = engagement_of(r, p, row);
    double a = half_width(r, &h, row);
    size_t before = row_away(r, &h, row, a / 10, 0);
    return fabs(a - half_width(r, &h, before)) > way_between(r, &h, before, row) / 2;
}

void ehl_passage_about(ehl_passage *p, const ehl_results *r, const ehl_march *m, size_t row,
                       ehl_row_counts *counts, int kind)
{
    const ehl_history h = engagement_of(r, p, row);
    const double length = length_of_passage(r, m, &h, row);
    p->first = row_away(r, &h, row, length, 0);
    p->last = row_away(r, &h, row, length, 1);
    while (p->first < row && !counts(r, p->first, kind))
        p->first++;
    while (p->last > row && !counts(r, p->last, kind))
        p->last--;
    p->begin = row_away(r, &h, p->first, length, 0);
}

/* Returns the row that the next step leads to, over which the oil moves by at least `way`. Where
 * the oil hardly moves, the flanks squeeze it: steps there are no longer than at a tenth of the
 * largest speed. */
static size_t next_row(const ehl_results *r, const ehl_passage *p, const ehl_history *h, double way,
                       size_t row)
{
    const double longest = way / (0.1 * h->speed_max);
    double time = value(r, row, EHL_TIME);
    size_t next = row + 1;
    while (next < p->last && way_between(r, h, row, next) < way &&
           value(r, next, EHL_TIME) - time < longest)
        next++;
    return next;
}

/* Whether steps over which the oil moves by `way` join steps of the run. */
static int joins(const ehl_results *r, const ehl_passage *p, double way)
{
    const ehl_history h = engagement_of(r, p, p->first);
    for (size_t row = p->begin, next; row < p->last; row = next) {
        next = next_row(r, p, &h, way, row);
        if (next > row + 1)
            return 1;
    }
    return 0;
}

/* Marches to the last row, and keeps the films of the rows from p->first on at which a step ends.
 * If `at_last` is not NULL it also keeps how the last film changes. */
static ff_status pass(const ehl_results *r, const ehl_march *run, const ehl_passage *p, double way,
                      ehl_grid_level *l, films film, ehl_instant_film *at_last)
{
    enum { BETWEEN = 16 };
    const ehl_history h = engagement_of(r, p, p->first);
    ehl_march m;
    ehl_step_control steps = {0};
    size_t node, row = p->begin;
    ff_status status = ehl_march_create(&m, &h, &l->solver, run->scheme);
    if (status == FF_OK)
        status = ehl_march_start_at(&m, value(r, row, EHL_TIME));
    if (status == FF_OK)
        status = ehl_step_control_create(&steps, &m, 0, p->equal);
    for (int k = 1; status == FF_OK; k++) {
        if (row >= p->first) {
            ehl_reynolds_gap(&l->reynolds, m.at.radius, &m.state[0].film);
            film[row - p->first][EHL_LEAST] = ehl_least_film(&l->reynolds, &node);
            film[row - p->first][EHL_CENTRAL] = ehl_central_film(&l->grid, &l->reynolds);
            film[row - p->first][EHL_PEAK] = m.state[0].highest;
            film[row - p->first][EHL_PEAK_BOUND] = ehl_peak_bound(&m);
        }
        if (row == p->last && at_last)
            ehl_space_keep(&m, at_last);
        if (row == p->last)
            break;
        row = next_row(r, p, &h, way, row);
        status = k % BETWEEN == 0 && r->host->progress(r->host->ctx, 1)
                     ? FF_STOPPED
                     : ehl_step_control_to(&steps, &m, value(r, row, EHL_TIME));
    }
    ehl_step_control_destroy(&steps);
    ehl_march_destroy(&m);
    return status;
}

/* Marches like pass, on `times` the cells of the run. */
static ff_status pass_on(const ehl_results *r, const ehl_march *run, const ehl_passage *p,
                         double way, size_t times, films film, ehl_instant_film *at_last)
{
    /* the errors of the solutions add up on the way, and the change of the last film is a small
       difference of two films */
    const double tolerance = at_last ? 5e-5 : 2e-4;
    ehl_solver kind = *run->solver;
    ehl_grid_level l = {0};
    if (kind.maker != ehl_line_relaxation) /* the dense solver has the same films */
        kind.maker = ehl_newton_krylov;
    ff_status status =
        ehl_grid_level_create(&l, &kind, times * (kind.grid->nodes - 1), kind.modulus);
    l.solver.tolerance = tolerance;
    if (status == FF_OK)
        status = pass(r, run, p, way, &l, film, at_last);
    ehl_grid_level_destroy(&l);
    return status;
}

/* Returns the films on 2^level times the cells of the run. */
static films films_on(const ehl_passage *p, films all, int level)
{
    return all + (size_t)level * (p->last - p->first + 1);
}

/* Gives a row at which no step ends the larger error of its neighbours, since h_min may jump from
 * one dip to another between them. */
static void take_larger(films all, size_t count, films error)
{
    for (int k = EHL_LEAST; k < EHL_PEAK; k++)
        for (size_t i = 1, led = all[0][k] > 0; i + 1 < count; i++) {
            double before = error[i - 1][k];
            if (all[i][k] > 0)
                led = 1;
            else if (led && !isnan(error[i][k]) && !(fabs(error[i][k]) >= fabs(before)))
                error[i][k] = before;
        }
}

/* Finds the errors from the films up to the level `finest`. The error that remains on that level
 * follows from the order of convergence. */
static void find_errors(const ehl_results *r, const ehl_march *m, const ehl_passage *p, films all,
                        int finest, films error)
{
    const uint32_t of[] = {EHL_H_MIN, EHL_H_CENTRAL};
    /* errors that all levels share cancel in their difference, and a film with heat has nearly the
       same relative errors as one without */
    const double within = m->heat || m->thermal ? 10 : 0.25;
    const double left = ldexp(1, -ehl_carrying_order(m->solver->reynolds));
    const films before = films_on(p, all, finest - 1), fine = films_on(p, all, finest);
    size_t count = p->last - p->first + 1;
    for (size_t i = count; i-- > 0;)
        for (int k = EHL_LEAST; k < EHL_PEAK; k++) {
            double coarse = all[i][k], film = value(r, p->first + i, of[k]);
            if (i + 1 < count && !(coarse > 0)) { /* no step led there */
                error[i][k] = error[i + 1][k];
                continue;
            }
            double exact = fine[i][k] + (fine[i][k] - before[i][k]) * left / (1 - left);
            error[i][k] = 1 - exact / coarse;
            if (!(fabs(coarse / film - 1) <= within * fmax(EHL_FILM_LIMIT, fabs(error[i][k]))))
                error[i][k] = NAN;
            else
                error[i][k] = ehl_known_error(error[i][k]);
        }
    take_larger(all, count, error);
}

/* Returns the number of rows that count and whose film differs from that of the run. */
static size_t differing(const ehl_results *r, const ehl_passage *p, ehl_row_counts *counts,
                        int kind, films error)
{
    size_t count = 0;
    for (size_t i = p->first; i <= p->last; i++)
        count += isnan(error[i - p->first][kind]) && counts(r, i, kind);
    return count;
}

/* Finds the films on the cells of the run and on twice as many, and their errors; all: zeroed. */
static ff_status pass_twins(const ehl_results *r, const ehl_march *m, const ehl_passage *p,
                            double way, films all, films error)
{
    ff_status status = pass_on(r, m, p, way, 1, films_on(p, all, 0), NULL);
    if (status == FF_OK)
        status = pass_on(r, m, p, way, 2, films_on(p, all, 1), NULL);
    if (status == FF_OK)
        find_errors(r, m, p, all, 1, error);
    return status;
}

ff_status ehl_passage_errors(const ehl_results *r, const ehl_march *m, ehl_passage *p,
                             ehl_row_counts *counts, int kind)
{
    /* Many steps of a run move the oil by less than a fifth of a cell. If its load vibrates, joined
     * steps give other films; the march is then repeated with shorter ones. */
    const double shorter = 0.25;
    const size_t count = p->last - p->first + 1;
    films tried = calloc(3 * count, sizeof *tried);
    p->film = calloc(3 * count, sizeof *p->film);
    p->error = calloc(count, sizeof *p->error);
    p->way = joined * m->solver->grid->dx;
    ff_status status = tried && p->film && p->error ? FF_OK : FF_NOMEM;
    if (status == FF_OK)
        status = pass_twins(r, m, p, p->way, p->film, p->error);
    size_t differ = status == FF_OK ? differing(r, p, counts, kind, p->error) : 0;
    if (differ > 0 && joins(r, p, p->way)) {
        films error = films_on(p, tried, 2);
        ff_status again = pass_twins(r, m, p, shorter * p->way, tried, error);
        if (again == FF_OK && differing(r, p, counts, kind, error) < differ) {
            p->way *= shorter;
            memcpy(p->film, tried, 2 * count * sizeof *tried);
            memcpy(p->error, error, count * sizeof *error);
        } else if (again == FF_NOMEM || again == FF_STOPPED) {
            status = again;
        }
    }
    free(tried);
    return status;
}

ff_status ehl_passage_refine(const ehl_results *r, const ehl_march *m, ehl_passage *p)
{
    ff_status status = pass_on(r, m, p, p->way, 4, films_on(p, p->film, 2), NULL);
    if (status == FF_OK)
        find_errors(r, m, p, p->film, 2, p->error);
    return status;
}

ff_status ehl_passage_to(const ehl_results *r, const ehl_march *m, ehl_passage *p, size_t row,
                         size_t times, ehl_instant_film *f)
{
    const ehl_history h = engagement_of(r, p, row);
    const double length = length_of_passage(r, m, &h, row);
    double film[1][EHL_PASSED];
    p->first = p->last = row;
    p->begin = row_away(r, &h, row, length, 0);
    return pass_on(r, m, p, joined * m->solver->grid->dx, times, film, f);
}

ff_status ehl_passage_again(const ehl_results *r, const ehl_march *m, ehl_passage *p, size_t first,
                            size_t last, size_t times, double (*film)[EHL_PASSED])
{
    const ehl_history h = engagement_of(r, p, first);
    p->first = first;
    p->last = last;
    p->begin = row_away(r, &h, first, length_of_passage(r, m, &h, first), 0);
    return pass_on(r, m, p, 0, times, film, NULL);
}

void ehl_passage_destroy(ehl_passage *p)
{
    free(p->film);
    free(p->error);
    p->film = p->error = NULL;
}
