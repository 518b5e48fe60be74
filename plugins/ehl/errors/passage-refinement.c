/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "passage-refinement.h"

#include "../solvers/grid-level.h"
#include "../time/start.h"
#include "../time/step-control.h"

#include <math.h>

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
