/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "coarse.h"

#include "../contact/simd-reductions.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Corner k is the node k stride. The pressure is unknown at the corners 1 ... count and zero at the
   others. Block i consists of the nodes nearest to corner i + 1. With its stencils it depends on
   the corners i ... i + 2; the fourth of the NEAR corners only fills the SIMD vector and has weight
   0. */
enum { NEAR = 4 };

struct ehl_coarse {
    size_t stride, most; /* most: largest number of corners */
    size_t count;        /* number of unknown pressures; h00 is one more unknown */
    int solvable, loaded;
    double *memory;
    double *way;  /* position of a node between two corners, 0 ... 1 */
    double *bend; /* deflection at a distance of k - `most` corners from a pressure */
    double (*by_p)[NEAR], (*by_v)[NEAR]; /* derivatives of a block's balance with respect to the
                                            values at its corners */
    double *x, *v;                       /* x: the unknowns; v: values at the corners */
    double *matrix;                      /* stored by columns */
    size_t *pivot;
};

/* Returns the deflection at a distance of `distance` nodes from a unit pressure that decreases
   linearly to 0 within a stride. */
static double bend_of(const double *kernel, size_t nodes, size_t stride, size_t distance)
{
    double sum = 0;
    for (size_t i = 0; i < stride; i++) {
        size_t far = distance + i, near = distance > i ? distance - i : i - distance;
        double share = (i > 0 ? 1 : 0.5) * (1 - (double)i / (double)stride);
        far = far < nodes ? far : nodes - 1;
        near = near < nodes ? near : nodes - 1;
        sum += share * (kernel[far] + kernel[near]);
    }
    return sum;
}

ehl_coarse *ehl_coarse_create(size_t nodes, size_t stride, const double *kernel)
{
    ehl_coarse *c = calloc(1, sizeof *c);
    if (!c)
        return NULL;
    size_t most = c->most = nodes / stride + NEAR;
    c->stride = stride;
    double *next = c->memory =
        calloc(stride + 1 + (4 + 2 * NEAR) * most + most * most, sizeof *c->memory);
    c->pivot = calloc(most, sizeof *c->pivot);
    if (!c->memory || !c->pivot) {
        ehl_coarse_destroy(c);
        return NULL;
    }
    c->way = next;
    c->bend = next += stride + 1;
    c->x = next += 2 * most;
    c->v = next += most;
    c->by_p = (double(*)[NEAR])(next += most);
    c->by_v = c->by_p + most;
    c->matrix = next + 2 * NEAR * most;
    for (size_t i = 0; i <= stride; i++)
        c->way[i] = (double)i / (double)stride;
    for (size_t k = 0; k < most; k++)
        c->bend[most + k] = c->bend[most - k] = bend_of(kernel, nodes, stride, k * stride);
    return c;
}

void ehl_coarse_destroy(ehl_coarse *c)
{
    if (!c)
        return;
    free(c->memory);
    free(c->pivot);
    free(c);
}

/* Returns the block of a node. */
static size_t block(const ehl_coarse *c, size_t node)
{
    size_t corner = (node + c->stride / 2) / c->stride;
    corner = corner < 1 ? 1 : corner > c->count ? c->count : corner;
    return corner - 1;
}

/* Sums the derivatives over the blocks. The last column of the matrix (h00) and its last row (load)
   are not set here. */
static void gather(ehl_coarse *c, const ehl_reynolds *r, const ehl_film *film)
{
    size_t m = c->count, rows = m + 1;
    double *h00_change = c->matrix + m * rows;
    memset(c->by_p, 0, m * sizeof *c->by_p);
    memset(c->by_v, 0, m * sizeof *c->by_v);
    memset(h00_change, 0, rows * sizeof *h00_change);
    memset(c->v, 0, c->most * sizeof *c->v);
    for (size_t i = 1; i < r->last; i++) {
        size_t b = block(c, i);
        for (size_t s = i > 1 ? 0 : 1; s < EHL_STENCIL && film->full[i]; s++) {
            size_t node = i + s - 2, k = node / c->stride - b;
            double far = c->way[node % c->stride];
            double p = film->full[node] ? r->by_p[s][i] : 0, v = r->by_h[s][i];
            c->by_p[b][k] += (1 - far) * p;
            c->by_p[b][k + 1] += far * p;
            c->by_v[b][k] += (1 - far) * v;
            c->by_v[b][k + 1] += far * v;
            h00_change[b] += v;
        }
        double far = c->way[i % c->stride];
        if (film->full[i]) { /* load of the corners */
            c->v[i / c->stride] += 1 - far;
            c->v[i / c->stride + 1] += far;
        }
    }
    h00_change[m] = !c->loaded;
    for (size_t j = 0; j < m; j++)
        c->matrix[j * rows + m] = c->loaded ? c->v[j + 1] : 0;
}

static void fill(ehl_coarse *c)
{
    size_t m = c->count, rows = m + 1;
    for (size_t j = 0; j < m; j++) {
        double *column = c->matrix + j * rows;
        const double *bend = c->bend + c->most - 1 - j; /* from corner j + 1 to corner 0 */
        for (size_t i = 0; i < m; i++) {
            const double *v = c->by_v[i];
            column[i] =
                v[0] * bend[i] + v[1] * bend[i + 1] + v[2] * bend[i + 2] + v[3] * bend[i + 3];
        }
        for (size_t k = 0; k < 3; k++)
            if (j + 1 >= k && j + 1 - k < m)
                column[j + 1 - k] += c->by_p[j + 1 - k][k];
    }
}

/* Factorises by Gaussian elimination with partial pivoting. Returns 0 if the matrix is singular. */
static int eliminate(ehl_coarse *c)
{
    size_t rows = c->count + 1;
    double *a = c->matrix;
    for (size_t k = 0; k < rows; k++) {
        double *column = a + k * rows;
        size_t best = k;
        for (size_t i = k + 1; i < rows; i++)
            best = fabs(column[i]) > fabs(column[best]) ? i : best;
        c->pivot[k] = best;
        if (!(fabs(column[best]) > 0))
            return 0;
        for (size_t j = 0; j < rows && best != k; j++) {
            double swap = a[j * rows + k];
            a[j * rows + k] = a[j * rows + best];
            a[j * rows + best] = swap;
        }
        column[k] = 1 / column[k];
        for (size_t i = k + 1; i < rows; i++)
            column[i] *= column[k];
        for (size_t j = k + 1; j < rows; j++) {
            double *restrict other = a + j * rows, factor = other[k];
            for (size_t i = k + 1; i < rows; i++)
                other[i] -= factor * column[i];
        }
    }
    return 1;
}

int ehl_coarse_fits(const ehl_coarse *c, size_t last)
{
    return (last - 1) / c->stride == c->count;
}

void ehl_coarse_factor(ehl_coarse *c, const ehl_reynolds *r, const ehl_film *film, int loaded)
{
    c->count = (r->last - 1) / c->stride;
    c->loaded = loaded;
    c->solvable = 0;
    if (c->count == 0)
        return;
    gather(c, r, film);
    fill(c);
    c->solvable = eliminate(c);
}

/* x[0] ... x[n-1] -= value column */
FF_SIMD
static void subtract(size_t n, double value, const double *restrict column, double *restrict x)
{
    for (size_t i = 0; i < n; i++)
        x[i] -= value * column[i];
}

static void substitute(ehl_coarse *c)
{
    size_t rows = c->count + 1;
    double *x = c->x;
    for (size_t k = 0; k < rows; k++) {
        double value = x[c->pivot[k]];
        x[c->pivot[k]] = x[k];
        x[k] = value;
    }
    for (size_t k = 0; k < rows; k++) {
        const double *column = c->matrix + k * rows;
        subtract(rows - k - 1, x[k], column + k + 1, x + k + 1);
    }
    for (size_t k = rows; k-- > 0;) {
        const double *column = c->matrix + k * rows;
        x[k] *= column[k];
        subtract(k, x[k], column, x);
    }
}

/* Computes the deflection at the corners. */
static void deflect(ehl_coarse *c)
{
    size_t corners = c->count + 2;
    double *v = c->v;
    memset(v, 0, c->most * sizeof *v);
    for (size_t j = 0; j < c->count; j++) {
        subtract(corners, -c->x[j], c->bend + c->most - 1 - j, v);
    }
}

/* Sums the residuals of the mass balances over the blocks. Nodes with another equation, or with
   none, are skipped. */
static void restrict_to_blocks(ehl_coarse *c, const double *residual, const unsigned char *full,
                               size_t last)
{
    size_t half = c->stride / 2, i = 1;
    for (size_t b = 0; b < c->count; b++) {
        size_t end = b + 1 < c->count ? (b + 2) * c->stride - half : last;
        end = end < last ? end : last;
        double sum = 0;
        if (i < end && !memchr(full + i, 0, end - i)) {
            sum = ehl_sum(end - i, residual + i);
            i = end;
        }
        for (; i < end; i++)
            sum += full[i] ? residual[i] : 0;
        c->x[b] = sum;
    }
}

FF_SIMD
static void ramp(size_t n, double from, double rise, const double *restrict way, double *restrict y)
{
    for (size_t i = 0; i < n; i++)
        y[i] = from + way[i] * rise;
}

/* Interpolates between the corners; cavitated nodes keep p = 0. */
static void interpolate(const ehl_coarse *c, size_t last, const ehl_film *film, double *dp,
                        double *dh)
{
    const double *way = c->way;
    for (size_t k = 0; k <= c->count; k++) {
        size_t begin = k * c->stride, end = k < c->count ? begin + c->stride : last + 1;
        end = end < last + 1 ? end : last + 1;
        double p = k > 0 ? c->x[k - 1] : 0, rise = (k < c->count ? c->x[k] : 0) - p;
        double v = c->x[c->count] + c->v[k], h00_change = c->v[k + 1] - c->v[k];
        if (begin >= end)
            break;
        ramp(end - begin, p, rise, way, dp + begin);
        ramp(end - begin, v, h00_change, way, dh + begin);
        if (memchr(film->full + begin, 0, end - begin))
            for (size_t i = begin; i < end; i++)
                dp[i] = film->full[i] ? dp[i] : 0;
    }
}

int ehl_coarse_solve(ehl_coarse *c, size_t last, const double *residual, double sum,
                     const ehl_film *film, double *dp, double *dh, double *dh00)
{
    if (!c->solvable)
        return 0;
    restrict_to_blocks(c, residual, film->full, last);
    c->x[c->count] = c->loaded ? sum : 0;
    substitute(c);
    deflect(c);
    interpolate(c, last, film, dp, dh);
    *dh00 = c->x[c->count];
    return 1;
}
