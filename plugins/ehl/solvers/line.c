/* SPDX-License-Identifier: GPL-3.0-or-later */
/* This file is compiled with -ffast-math, which reorders sums of products and ignores NaN. It must
   therefore not test for NaN. */
#include "line.h"

#include <stdlib.h>
#include <string.h>

struct ehl_line_matrix {
    size_t nodes, rows, reach; /* reach: number of nodes on either side whose deflection is
                                  included */
    size_t lower, width;       /* number of entries before the diagonal, and of entries in a row */
    int loaded;
    double shift;    /* value of the kernel just after the last included node */
    double *cut;     /* the shifted kernel at -(reach + margin) ... reach + margin */
    double *matrix;  /* row i: columns i - lower ... */
    double *inverse; /* inverse pivots */
    double *carries; /* 1: the unknown is a pressure and causes deflection; 0: it causes none */
    double *border;  /* matrix^-1 times the effect of h00 */
    double border_sum;
};

enum { LEAST = 8, MOST = 64, SHARE = 16, AFTER = EHL_STENCIL - 1 - EHL_ASYMMETRIC_BEFORE };
/* Number of zeros on either side of `cut`: the stencil of a row extends this far beyond `reach`. */
enum { MARGIN = EHL_STENCIL };

static size_t reach_of(size_t nodes)
{
    size_t reach = nodes / SHARE;
    reach = reach < LEAST ? LEAST : reach > MOST ? MOST : reach;
    return reach + 2 < nodes ? reach : nodes - 3;
}

ehl_line_matrix *ehl_line_create(size_t nodes, const double *kernel)
{
    ehl_line_matrix *m = calloc(1, sizeof *m);
    if (!m)
        return NULL;
    m->nodes = nodes;
    m->reach = reach_of(nodes);
    m->lower = m->reach + EHL_ASYMMETRIC_BEFORE;
    m->width = m->lower + 1 + m->reach + AFTER;
    m->matrix = calloc(nodes * m->width, sizeof *m->matrix);
    m->cut = calloc(2 * (m->reach + MARGIN) + 1, sizeof *m->cut);
    m->inverse = calloc(3 * nodes, sizeof *m->inverse);
    if (!m->matrix || !m->cut || !m->inverse) {
        ehl_line_destroy(m);
        return NULL;
    }
    m->carries = m->inverse + nodes;
    m->border = m->carries + nodes;
    m->shift = kernel[m->reach + 1];
    double *middle = m->cut + m->reach + MARGIN;
    for (size_t k = 0; k <= m->reach; k++)
        middle[k] = *(middle - k) = kernel[k] - m->shift;
    return m;
}

void ehl_line_destroy(ehl_line_matrix *m)
{
    if (!m)
        return;
    free(m->matrix);
    free(m->cut);
    free(m->inverse);
    free(m);
}

/* Fills by_p + by_h * cut kernel; row i of the matrix is node i + 1. */
static void fill_line(ehl_line_matrix *m, const ehl_reynolds *r, const ehl_film *film)
{
    for (size_t i = 0; i < m->rows; i++)
        m->carries[i] = film->full[i + 1];
    for (size_t i = 0; i < m->rows; i++) {
        double *row = m->matrix + i * m->width;
        if (!film->full[i + 1] && !r->conserving) {
            memset(row, 0, m->width * sizeof *row);
            row[m->lower] = 1;
            continue;
        }
        /* column k lies k - lower after the diagonal, and k - lower + BEFORE - s after stencil node
         * s */
        const double *d = m->cut + m->reach + MARGIN - m->lower + EHL_ASYMMETRIC_BEFORE;
        double h0 = r->by_h[0][i + 1], h1 = r->by_h[1][i + 1], h2 = r->by_h[2][i + 1],
               h3 = r->by_h[3][i + 1];
        for (size_t k = 0; k < m->width; k++)
            row[k] = h0 * d[k] + h1 * (d - 1)[k] + h2 * (d - 2)[k] + h3 * (d - 3)[k];
        for (size_t k = 0; k < m->width && r->conserving; k++)
            if (i + k >= m->lower && i + k - m->lower < m->rows)
                row[k] *= m->carries[i + k - m->lower];
        for (size_t s = 0; s < EHL_STENCIL; s++)
            row[m->lower + s - EHL_ASYMMETRIC_BEFORE] += r->by_p[s][i + 1];
    }
}

/* Factorises without pivoting, which is possible since the diagonal is large. */
static void eliminate_line(ehl_line_matrix *m)
{
    size_t lower = m->lower, upper = m->width - 1 - lower;
    for (size_t i = 0; i < m->rows; i++) {
        double *row = m->matrix + i * m->width;
        for (size_t s = i < lower ? i : lower; s > 0; s--) {
            const double *pivot = m->matrix + (i - s) * m->width + lower;
            double *entry = row + lower - s, factor = *entry *= m->inverse[i - s];
            for (size_t j = 1; j <= upper; j++)
                entry[j] -= factor * pivot[j];
        }
        m->inverse[i] = 1 / row[lower];
    }
}

static void substitute_line(const ehl_line_matrix *m, double *x)
{
    size_t lower = m->lower, upper = m->width - 1 - lower;
    for (size_t i = 0; i < m->rows; i++) {
        size_t reach = i < lower ? i : lower;
        const double *row = m->matrix + i * m->width + lower - reach, *before = x + i - reach;
        double sum = 0;
        for (size_t j = 0; j < reach; j++)
            sum += row[j] * before[j];
        x[i] -= sum;
    }
    for (size_t i = m->rows; i-- > 0;) {
        size_t reach = m->rows - 1 - i < upper ? m->rows - 1 - i : upper;
        const double *row = m->matrix + i * m->width + lower;
        double sum = 0;
        for (size_t j = 1; j <= reach; j++)
            sum += row[j] * x[i + j];
        x[i] = (x[i] - sum) * m->inverse[i];
    }
}

void ehl_line_factor(ehl_line_matrix *m, const ehl_reynolds *r, const ehl_film *film, int loaded)
{
    m->rows = r->last - 1;
    m->loaded = loaded;
    fill_line(m, r, film);
    eliminate_line(m);
    for (size_t i = 0; i < m->rows; i++)
        m->border[i] =
            r->by_h[0][i + 1] + r->by_h[1][i + 1] + r->by_h[2][i + 1] + r->by_h[3][i + 1];
    substitute_line(m, m->border);
    m->border_sum = 0;
    for (size_t i = 0; i < m->rows; i++)
        m->border_sum += m->carries[i] * m->border[i];
}

void ehl_line_solve(ehl_line_matrix *m, const double *residual, double sum, double *dp,
                    double *dh00)
{
    double *x = dp + 1, total = 0,
           h00_change; /* lift: uniform change of the film that replaces the shift of the kernel */
    memset(dp, 0, m->nodes * sizeof *dp);
    memcpy(x, residual + 1, m->rows * sizeof *x);
    substitute_line(m, x);
    for (size_t i = 0; i < m->rows; i++)
        total += m->carries[i] * x[i];
    if (m->loaded) {
        h00_change = (total - sum) / m->border_sum;
        *dh00 = h00_change - m->shift * sum;
    } else {
        h00_change = m->shift * total / (1 + m->shift * m->border_sum);
        *dh00 = 0;
    }
    for (size_t i = 0; i < m->rows; i++)
        x[i] -= h00_change * m->border[i];
}
