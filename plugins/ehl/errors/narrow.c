/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks of squeezed films that the cells of a run do not resolve, found on more of them. */
#include "narrow.h"

#include <math.h>
#include <stdlib.h>

/* Most cells, their ratio from march to march, and most marches. */
enum { MOST_CELLS = 16384, FINER = 4, LEVELS = 2 };

typedef double (*films)[EHL_PASSED];

static double *film_of(const ehl_results *r, size_t row)
{
    return r->series.data + row * EHL_SERIES;
}

static double *part(const ehl_results *r, size_t row, uint32_t column)
{
    return &r->space.data[row * EHL_SPACE + column];
}

static int is_narrow(const ehl_results *r, size_t row)
{
    return isinf(*part(r, row, EHL_NARROW));
}

/* Whether a march has found the film of the run, and not another one, at a narrow row. */
static int is_like(const ehl_results *r, const ehl_passage *p, films film, size_t row)
{
    const double like = 0.2; /* of the film */
    double fine = film[row - p->first][EHL_CENTRAL];
    return is_narrow(r, row) && fabs(fine / film_of(r, row)[EHL_H_CENTRAL] - 1) < like;
}

static double moved_by(const ehl_results *r, const ehl_passage *p, films film, size_t row)
{
    return fabs(film[row - p->first][EHL_PEAK] - film_of(r, row)[EHL_P_MAX]);
}

/* Returns how far a march moves the peaks that its cells do not resolve, relative to the march
 * before; infinite without one. All rows count alike, since nodes pass the tip of a peak at any
 * distance. */
static double settling(const ehl_results *r, const ehl_passage *p, films film, const double *before)
{
    double sum = 0, sum_before = 0;
    for (size_t row = p->first; row <= p->last; row++)
        if (is_like(r, p, film, row) && isinf(film[row - p->first][EHL_PEAK_BOUND])) {
            sum += moved_by(r, p, film, row);
            sum_before += before[row];
        }
    return sum_before > 0 ? sum / sum_before : (double)INFINITY;
}

/* Takes over the films on more cells; `moved` is how far the march before has moved the peaks. If
 * the cells resolve a peak, its error is the larger one of its bound and of what they moved it by.
 * Otherwise, if peaks settle, its error is the sum of the moves to come, a geometric series with
 * the ratio of this move to the one before. If a peak keeps climbing, only the highest value found
 * is known. */
static void take_over(ehl_results *r, const ehl_passage *p, films film, double *moved)
{
    const double slowest = 2. / 3, ratio = settling(r, p, film, moved);
    for (size_t row = p->first; row <= p->last; row++) {
        if (!is_like(r, p, film, row))
            continue;
        const double *fine = film[row - p->first];
        double *p_max = &film_of(r, row)[EHL_P_MAX], by = moved_by(r, p, film, row);
        double left = fmax(by, fine[EHL_PEAK_BOUND]);
        if (isinf(left) && ratio < slowest && by < EHL_PEAK_LIMIT * fine[EHL_PEAK])
            left = fmax(by, ratio * moved[row]) * fmax(1, ratio / (1 - ratio));
        *part(r, row, EHL_NARROW) = left;
        if (isfinite(left)) {
            *part(r, row, EHL_PEAK) = left;
            *part(r, row, EHL_TIP) = 0;
            *p_max = fine[EHL_PEAK];
        }
        *p_max = fmax(*p_max, fine[EHL_PEAK]);
        r->highest = fmax(r->highest, *p_max);
        moved[row] = by;
    }
}

/* Marches to the last narrow peak of the rows until none is left, or there are too many cells. */
static ff_status march_again(ehl_results *r, const ehl_march *m, ehl_passage *p, size_t first,
                             size_t last)
{
    size_t cells = m->solver->grid->nodes - 1;
    films film = malloc((last - first + 1) * sizeof *film);
    double *moved = calloc(r->series.count, sizeof *moved);
    ff_status status = film && moved ? FF_OK : FF_NOMEM;
    for (size_t k = 1, times = FINER; status == FF_OK && k <= LEVELS && times * cells <= MOST_CELLS;
         k++, times *= FINER) {
        while (first <= last && !is_narrow(r, first))
            first++;
        while (last > first && !is_narrow(r, last))
            last--;
        if (first > last)
            break;
        status = ehl_passage_again(r, m, p, first, last, times, film);
        if (status == FF_OK) {
            take_over(r, p, film, moved);
            r->narrow = times > r->narrow ? times : r->narrow;
        }
    }
    free(film);
    free(moved);
    return status == FF_NOMEM || status == FF_STOPPED ? status : FF_OK;
}

ff_status ehl_narrow_peaks(ehl_results *r, const ehl_march *m, ehl_passage *p)
{
    ff_status status = FF_OK;
    const size_t count = r->series.count;
    for (size_t row = 0, end; row < count && status == FF_OK; row = end) {
        const double number = film_of(r, row)[EHL_ENGAGEMENT];
        size_t narrow = 0;
        for (end = row; end < count && !(fabs(film_of(r, end)[EHL_ENGAGEMENT] - number) > 0); end++)
            narrow += (size_t)is_narrow(r, end);
        if (narrow > 0)
            status = march_again(r, m, p, row, end - 1);
    }
    return status;
}
