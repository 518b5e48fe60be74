/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "band.h"

#include "../contact/simd-reductions.h"
#include "../equations/reynolds.h"

#include <stdlib.h>
#include <string.h>

/* REACH: number of nodes after which the kernel is cut off. LOWER, UPPER: entries of a row on
   either side of the diagonal. LANES: length of a SIMD vector. BEHIND: UPPER rounded up to whole
   vectors. WIDTH: length of a row, with zeros at its end. */
enum {
    REACH = EHL_BAND_REACH - 1,
    LOWER = REACH + 2,
    UPPER = EHL_BAND_REACH,
    LANES = EHL_LANES,
    BEHIND = (UPPER + LANES - 1) / LANES * LANES,
    WIDTH = 32,
    PAD = 16 /* number of zeros on either side of an array */
};
_Static_assert(LOWER + 1 + BEHIND <= WIDTH && PAD >= LOWER, "a row reaches no farther");
_Static_assert(LOWER % 2 == 0, "pairs of columns");

/* A block of the factors. A substitution computes LANES values at a time, those of the rows i ... i
   + LANES - 1. It first applies the columns of values already known, then the inverse of the
   triangle between these rows. below[j] belongs to the column i - LOWER + j, above[j] to the column
   i + LANES + j. */
typedef struct block {
    double below[LOWER][LANES], below_inverse[LANES - 1][LANES]; /* L, with ones on its diagonal */
    double above[UPPER][LANES], above_inverse[LANES][LANES];     /* U */
} block;

struct ehl_band {
    size_t rows;
    int loaded;
    double shift;              /* value of the kernel just after the cut */
    double cut[2 * REACH + 7]; /* the shifted kernel at -REACH-3 ... REACH+3 */
    double *matrix;            /* row i: columns i - LOWER ... i + UPPER */
    double *inverse;           /* inverse pivots */
    block *blocks;
    double *line;    /* PAD zeros, a vector, PAD zeros */
    double *memory;  /* PAD zeros, `carries`, PAD zeros */
    double *carries; /* ehl_carries */
    double *border;  /* matrix^-1 times the effect of h00 */
    double border_sum;
};

static size_t count_blocks(size_t rows)
{
    return (rows + LANES - 1) / LANES;
}

ehl_band *ehl_band_create(size_t nodes, const double *kernel)
{
    ehl_band *b = calloc(1, sizeof *b);
    if (!b)
        return NULL;
    b->matrix = calloc((nodes + PAD) * WIDTH, sizeof *b->matrix);
    b->blocks = calloc(count_blocks(nodes), sizeof *b->blocks);
    b->inverse = calloc(nodes, sizeof *b->inverse);
    b->line = calloc(nodes + 2 * (size_t)PAD, sizeof *b->line);
    b->border = calloc(nodes + PAD, sizeof *b->border);
    b->memory = calloc(nodes + 2 * (size_t)PAD, sizeof *b->memory);
    if (!b->memory || !b->matrix || !b->blocks || !b->inverse || !b->line || !b->border) {
        ehl_band_destroy(b);
        return NULL;
    }
    b->carries = b->memory + PAD;
    b->shift = kernel[REACH + 1];
    for (size_t k = 0; k <= REACH; k++)
        b->cut[REACH + 3 + k] = b->cut[REACH + 3 - k] = kernel[k] - b->shift;
    return b;
}

void ehl_band_destroy(ehl_band *b)
{
    if (!b)
        return;
    free(b->matrix);
    free(b->blocks);
    free(b->inverse);
    free(b->line);
    free(b->border);
    free(b->memory);
    free(b);
}

/* Writes row = by_h * cut kernel. `cut` points to the kernel at the row's first column and the node
   i - 2 of the stencil. */
FF_SIMD
static void fill_row(double h0, double h1, double h2, double h3, const double *restrict cut,
                     double *restrict row)
{
    for (size_t k = 0; k < LOWER + 1 + UPPER; k++)
        row[k] = h0 * cut[k + 2] + h1 * cut[k + 1] + h2 * cut[k] + h3 * (cut - 1)[k];
}

/* Removes the kernel from the columns whose unknown is no pressure and causes no deflection. */
FF_SIMD
static void drop_columns(const double *restrict carries, double *restrict row)
{
    for (size_t k = 0; k < LOWER + 1 + UPPER; k++)
        row[k] *= carries[k];
}

/* Returns the value of ehl_carries if no metal yields. */
FF_SIMD
static void find_carrying(size_t rows, int all, const unsigned char *restrict full,
                          double *restrict carries)
{
    for (size_t i = 0; i < rows; i++)
        carries[i] = all | full[i];
}

/* Fills by_p + by_h * cut kernel; row i of the matrix is node i + 1. */
static void fill(ehl_band *b, const ehl_reynolds *r, const ehl_film *film, size_t first)
{
    memset(b->carries + b->rows, 0, (r->nodes - b->rows) * sizeof *b->carries);
    find_carrying(b->rows, r->statistical.law != NULL, film->full + 1, b->carries);
    for (size_t i = 0; film->yielding > 0 && i < b->rows; i++)
        b->carries[i] = ehl_carries(r, film, i + 1);
    for (size_t i = first; i < b->rows; i++) {
        double *row = b->matrix + i * WIDTH;
        if (!ehl_is_solved(r, film, i + 1)) {
            memset(row, 0, WIDTH * sizeof *row);
            row[LOWER] = 1;
            continue;
        }
        /* column k - LOWER from the diagonal is k - LOWER + 2 from the node i - 2 of the stencil */
        fill_row(r->by_h[0][i + 1], r->by_h[1][i + 1], r->by_h[2][i + 1], r->by_h[3][i + 1],
                 b->cut + REACH + 3 - LOWER, row);
        /* these entries are not zero if an earlier elimination overflowed */
        memset(row + LOWER + 1 + UPPER, 0, (WIDTH - LOWER - 1 - UPPER) * sizeof *row);
        if (r->conserving)
            drop_columns(b->carries + i - LOWER, row);
        for (size_t s = 0; s < EHL_STENCIL; s++)
            row[LOWER - 2 + s] += r->by_p[s][i + 1];
    }
}

/* Factorises row by row; the rows before `first` are not changed. */
FF_SIMD
static void eliminate(double *matrix, double *restrict inverse, size_t first, size_t rows)
{
    for (size_t i = first; i < rows; i++) {
        double *row = matrix + i * WIDTH;
        for (size_t s = i < LOWER ? i : LOWER; s > 0; s--) {
            const double *pivot = matrix + (i - s) * WIDTH + LOWER + 1;
            double *entry = row + LOWER - s, factor = *entry *= inverse[i - s];
            for (size_t j = 0; j < BEHIND; j += LANES) {
                ehl_lanes to, from;
                memcpy(&to, entry + 1 + j, sizeof to);
                memcpy(&from, pivot + j, sizeof from);
                to -= factor * from;
                memcpy(entry + 1 + j, &to, sizeof to);
            }
        }
        inverse[i] = 1 / row[LOWER];
    }
}

/* Inverts the triangles of a block of `count` rows, whose columns begin at i - LOWER in `row`. */
static void invert_triangles(block *k, const double *row, const double *inverse, size_t count)
{
    for (size_t j = 0; j < count; j++) { /* columns of the inverses */
        for (size_t i = j + 1; i < count; i++) {
            double sum = row[i * WIDTH + LOWER + j - i];
            for (size_t m = j + 1; m < i; m++)
                sum += row[i * WIDTH + LOWER + m - i] * k->below_inverse[j][m];
            k->below_inverse[j][i] = -sum;
        }
        k->above_inverse[j][j] = inverse[j];
        for (size_t i = j; i-- > 0;) {
            double sum = 0;
            for (size_t m = i + 1; m <= j; m++)
                sum += row[i * WIDTH + LOWER + m - i] * k->above_inverse[j][m];
            k->above_inverse[j][i] = -sum * inverse[i];
        }
    }
}

/* Arranges the factors from row `first` on in blocks. */
static void arrange(ehl_band *b, size_t first)
{
    for (size_t n = first / LANES; n < count_blocks(b->rows); n++) {
        block *k = b->blocks + n;
        size_t at = n * LANES, count = b->rows - at < LANES ? b->rows - at : LANES;
        const double *row = b->matrix + at * WIDTH;
        if (count < LANES) /* an incomplete block leaves entries that must be 0 */
            memset(k, 0, sizeof *k);
        for (size_t i = 0; i < count; i++) {
            for (size_t j = i; j < LOWER; j++)
                k->below[j][i] = row[i * WIDTH + j - i];
            for (size_t j = 0; LANES + j <= UPPER + i; j++)
                k->above[j][i] = row[i * WIDTH + LOWER + LANES + j - i];
        }
        invert_triangles(k, row, b->inverse + at, count);
    }
}

/* Solves x = U^-1 L^-1 x in place; x must be zero for PAD entries on both sides. */
FF_SIMD
static void substitute(const block *restrict blocks, size_t count, double *x)
{
    for (size_t n = 0; n < count; n++) {
        const block *k = blocks + n;
        const double *known = x + n * LANES - LOWER;
        ehl_lanes sum, other = {0}, column;
        memcpy(&sum, x + n * LANES, sizeof sum);
        for (size_t j = 0; j < LOWER; j += 2) {
            memcpy(&column, k->below[j], sizeof column);
            sum -= known[j] * column;
            memcpy(&column, k->below[j + 1], sizeof column);
            other += known[j + 1] * column;
        }
        sum -= other;
        other = sum;
        for (size_t j = 0; j + 1 < LANES; j++) {
            memcpy(&column, k->below_inverse[j], sizeof column);
            other += sum[j] * column;
        }
        memcpy(x + n * LANES, &other, sizeof other);
    }
    for (size_t n = count; n-- > 0;) {
        const block *k = blocks + n;
        const double *known = x + (n + 1) * LANES;
        ehl_lanes sum, other = {0}, column;
        memcpy(&sum, x + n * LANES, sizeof sum);
        for (size_t j = UPPER; j-- > 0;) { /* the nearest columns were found last */
            memcpy(&column, k->above[j], sizeof column);
            if (j % 2)
                sum -= known[j] * column;
            else
                other += known[j] * column;
        }
        sum -= other;
        other = (ehl_lanes){0};
        for (size_t j = 0; j < LANES; j++) {
            memcpy(&column, k->above_inverse[j], sizeof column);
            other += sum[j] * column;
        }
        memcpy(x + n * LANES, &other, sizeof other);
    }
}

/* Returns the sum of carries[i] x[i] over whole vectors. */
FF_SIMD
static double carried(size_t blocks, const double *restrict carries, const double *restrict x)
{
    ehl_lanes sum = {0}, a, b;
    for (size_t i = 0; i < blocks * LANES; i += LANES) {
        memcpy(&a, carries + i, sizeof a);
        memcpy(&b, x + i, sizeof b);
        sum += a * b;
    }
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

FF_SIMD
static void subtract(size_t n, const double *restrict x, double factor,
                     const double *restrict border, double *restrict dp)
{
    for (size_t i = 0; i < n; i++)
        dp[i] = x[i] - factor * border[i];
}

FF_SIMD
static void add_slopes(size_t n, const double *restrict h0, const double *restrict h1,
                       const double *restrict h2, const double *restrict h3, double *restrict sum)
{
    for (size_t i = 0; i < n; i++)
        sum[i] = h0[i] + h1[i] + h2[i] + h3[i];
}

void ehl_band_factor(ehl_band *b, const ehl_reynolds *r, const ehl_film *film, int loaded,
                     size_t from)
{
    b->rows = r->last - 1;
    b->loaded = loaded;
    memset(b->line + PAD + b->rows, 0, (PAD + r->nodes - b->rows) * sizeof *b->line);
    fill(b, r, film, from - 1);
    eliminate(b->matrix, b->inverse, from - 1, b->rows);
    arrange(b, from - 1);
    double *x = b->line + PAD;
    add_slopes(b->rows, r->by_h[0] + 1, r->by_h[1] + 1, r->by_h[2] + 1, r->by_h[3] + 1, x);
    for (size_t i = 0; !(r->conserving || r->statistical.law) && i < b->rows; i++)
        x[i] = film->full[i + 1] ? x[i] : 0;
    substitute(b->blocks, count_blocks(b->rows), x);
    memcpy(b->border, x, b->rows * sizeof *x);
    b->border_sum = carried(count_blocks(b->rows), b->carries, x);
}

void ehl_band_solve(ehl_band *b, const double *residual, double sum, double *dp, double *dh00)
{
    double *x = b->line + PAD;
    memcpy(x, residual + 1, b->rows * sizeof *x);
    substitute(b->blocks, count_blocks(b->rows), x);
    double total = carried(count_blocks(b->rows), b->carries, x);
    double h00_change; /* change of h00 without the shift of the kernel */
    if (b->loaded) {
        h00_change = (total - sum) / b->border_sum;
        *dh00 = h00_change - b->shift * sum;
    } else {
        h00_change = b->shift * total / (1 + b->shift * b->border_sum);
        *dh00 = 0;
    }
    subtract(b->rows, x, h00_change, b->border, dp + 1);
}
