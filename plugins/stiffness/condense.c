/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "condense.h"

#include "../numerics/room.h"

#include <stdlib.h>
#include <string.h>
#include <suitesparse/cholmod.h>

/* Right-hand sides that are solved at a time: few enough for the cache. */
enum { BLOCK = 48 };

typedef struct coupling {
    size_t inside, side;
    double value;
} coupling;

typedef struct work {
    const stiffness_sector *sector;
    /* First degree of freedom of each node, those inside first, then those of the left and of the
       right side; STIFFNESS_NO_NODE where it is held. */
    size_t *freedom;
    size_t inside, side;
    coupling *coupling; /* stiffness between inside and sides */
    size_t couplings;
    cholmod_common common;
    cholmod_triplet *inner;
    cholmod_factor *factor;
    cholmod_dense *known, *solution, *spare[2]; /* a block of columns at a time */
} work;

static int number_freedoms(work *w)
{
    const stiffness_sector *s = w->sector;
    w->freedom = malloc(s->nodes * sizeof *w->freedom);
    if (!w->freedom)
        return 0;
    for (size_t n = 0; n < s->nodes; n++)
        w->freedom[n] = STIFFNESS_NO_NODE;
    for (size_t i = 1; i < s->rows; i++)
        for (size_t j = 0; j < s->columns; j++) {
            size_t n = s->grid[i * s->columns + j];
            if (n == STIFFNESS_NO_NODE || (i < s->body_rows && (j == 0 || j + 1 == s->columns)))
                continue;
            w->freedom[n] = w->inside;
            w->inside += 2;
        }
    w->side = 2 * (s->body_rows - 1);
    for (size_t i = 1; i < s->body_rows; i++) {
        w->freedom[s->grid[i * s->columns]] = w->inside + 2 * (i - 1);
        w->freedom[s->grid[(i + 1) * s->columns - 1]] = w->inside + w->side + 2 * (i - 1);
    }
    return 1;
}

static void add_triplet(cholmod_triplet *t, size_t row, size_t column, double value)
{
    ((int *)t->i)[t->nnz] = (int)row;
    ((int *)t->j)[t->nnz] = (int)column;
    ((double *)t->x)[t->nnz] = value;
    t->nnz++;
}

/* Adds the stiffness of one element: to the matrix of the inside, of which the lower half is kept,
   to the coupling of inside and sides, and to the sides. */
static void add_element(work *w, stiffness_condensed *c, size_t element, double k[16][16])
{
    size_t at[16], inside = w->inside;
    for (size_t n = 0; n < 16; n++) {
        size_t first = w->freedom[w->sector->element[element][n / 2]];
        at[n] = first == STIFFNESS_NO_NODE ? STIFFNESS_NO_NODE : first + n % 2;
    }
    for (size_t a = 0; a < 16; a++)
        for (size_t b = 0; b < 16; b++) {
            if (at[a] == STIFFNESS_NO_NODE || at[b] == STIFFNESS_NO_NODE)
                continue;
            if (at[a] < inside && at[b] <= at[a])
                add_triplet(w->inner, at[a], at[b], k[a][b]);
            else if (at[a] < inside && at[b] >= inside)
                w->coupling[w->couplings++] = (coupling){at[a], at[b] - inside, k[a][b]};
            else if (at[a] >= inside && at[b] >= inside)
                c->stiffness[(at[b] - inside) * 2 * w->side + at[a] - inside] += k[a][b];
        }
}

static double *column_of(const cholmod_dense *matrix, size_t column)
{
    return (double *)matrix->x + column * matrix->d;
}

static void clear(cholmod_dense *matrix)
{
    memset(matrix->x, 0, matrix->nzmax * sizeof(double));
}

/* Right-hand sides: columns of the coupling from the side's freedom `first` on. */
static void set_sides(work *w, size_t first)
{
    clear(w->known);
    for (size_t i = 0; i < w->couplings; i++) {
        const coupling *c = &w->coupling[i];
        if (c->side >= first && c->side < first + w->known->ncol)
            column_of(w->known, c->side - first)[c->inside] += c->value;
    }
}

static void set_loads(work *w, size_t parts, const stiffness_nodal *part)
{
    clear(w->known);
    for (size_t p = 0; p < parts; p++) {
        double *to = column_of(w->known, part[p].load);
        for (int k = 0; k < 3; k++) {
            size_t at = w->freedom[part[p].node[k]];
            if (at == STIFFNESS_NO_NODE || at >= w->inside)
                continue;
            to[at] += part[p].weight[k] * part[p].direction.x;
            to[at + 1] += part[p].weight[k] * part[p].direction.y;
        }
    }
}

static int factorise(work *w)
{
    cholmod_sparse *matrix = cholmod_triplet_to_sparse(w->inner, w->inner->nnz, &w->common);
    if (matrix)
        w->factor = cholmod_analyze(matrix, &w->common);
    int done = w->factor && cholmod_factorize(matrix, w->factor, &w->common);
    cholmod_free_sparse(&matrix, &w->common);
    if (!done)
        return STIFFNESS_CONDENSE_MEMORY;
    return w->common.status == CHOLMOD_OK ? STIFFNESS_CONDENSED : STIFFNESS_CONDENSE_SINGULAR;
}

/* Solves for the right-hand sides and subtracts K_si X from the columns of `to` from `first` on. */
static int solve_block(work *w, size_t first, size_t columns, double *to)
{
    if (!cholmod_solve2(CHOLMOD_A, w->factor, w->known, NULL, &w->solution, NULL, &w->spare[0],
                        &w->spare[1], &w->common))
        return 0;
    for (size_t k = 0; k < w->known->ncol && first + k < columns; k++) {
        const double *x = column_of(w->solution, k);
        double *column = to + (first + k) * 2 * w->side;
        for (size_t i = 0; i < w->couplings; i++)
            column[w->coupling[i].side] -= w->coupling[i].value * x[w->coupling[i].inside];
    }
    return 1;
}

/* Static condensation (Guyan 1965): with i inside, s on the sides, loads f and K_ii X = [K_is, f],
   stiffness = K_ss - K_si X_s, pull = -K_si X_f, held = f' X_f. */
static int condense(work *w, stiffness_condensed *c, size_t parts, const stiffness_nodal *part)
{
    size_t both = 2 * w->side;
    for (size_t first = 0; first < both; first += w->known->ncol) {
        set_sides(w, first);
        if (!solve_block(w, first, both, c->stiffness))
            return STIFFNESS_CONDENSE_MEMORY;
    }
    set_loads(w, parts, part);
    if (!solve_block(w, 0, c->loads, c->pull))
        return STIFFNESS_CONDENSE_MEMORY;
    for (size_t a = 0; a < c->loads; a++)
        for (size_t b = 0; b < c->loads; b++) {
            const double *f = column_of(w->known, b), *x = column_of(w->solution, a);
            double sum = 0;
            for (size_t i = 0; i < w->inside; i++)
                sum += f[i] * x[i];
            c->held[b * c->loads + a] = sum;
        }
    return STIFFNESS_CONDENSED;
}

static int allocate(work *w, stiffness_condensed *c)
{
    size_t elements = w->sector->elements, both = 2 * w->side;
    /* an element has 16 x 16 entries, 136 of them in the lower half, and fewer than 2 body_rows
       elements touch a side */
    w->coupling = malloc(256 * 2 * w->sector->body_rows * sizeof *w->coupling);
    w->inner = cholmod_allocate_triplet(w->inside, w->inside, 136 * elements, -1, CHOLMOD_REAL,
                                        &w->common);
    w->known =
        cholmod_zeros(w->inside, c->loads > BLOCK ? c->loads : BLOCK, CHOLMOD_REAL, &w->common);
    c->stiffness = calloc(both * both, sizeof *c->stiffness);
    c->pull = calloc(both * c->loads, sizeof *c->pull);
    c->held = calloc(c->loads * c->loads, sizeof *c->held);
    return w->coupling && w->inner && w->known && c->stiffness && c->pull && c->held;
}

int stiffness_condense(stiffness_condensed *c, const stiffness_sector *sector,
                       const stiffness_material *material, size_t loads, size_t parts,
                       const stiffness_nodal *part)
{
    work w = {.sector = sector};
    double k[16][16];
    int result = STIFFNESS_CONDENSE_MEMORY;
    *c = (stiffness_condensed){.loads = loads};
    cholmod_start(&w.common);
    w.common.print = 0;
    /* the one that is best for plane elements; without memory for it CHOLMOD would take another
       one, whose answer is not the same to the last bit */
    w.common.nmethods = 1;
    w.common.method[0].ordering = CHOLMOD_AMD;
    if (!number_freedoms(&w) || !allocate(&w, c) || !numerics_has_room(numerics_openmp_room()))
        goto out;
    c->side = w.side;
    for (size_t e = 0; e < sector->elements; e++) {
        stiffness_sector_stiffness(sector, e, material, k);
        add_element(&w, c, e, k);
    }
    result = factorise(&w);
    if (result == STIFFNESS_CONDENSED)
        result = condense(&w, c, parts, part);
out:
    cholmod_free_factor(&w.factor, &w.common);
    cholmod_free_dense(&w.solution, &w.common);
    cholmod_free_dense(&w.spare[0], &w.common);
    cholmod_free_dense(&w.spare[1], &w.common);
    cholmod_free_dense(&w.known, &w.common);
    cholmod_free_triplet(&w.inner, &w.common);
    cholmod_finish(&w.common);
    free(w.coupling);
    free(w.freedom);
    return result;
}

void stiffness_condensed_free(stiffness_condensed *c)
{
    free(c->stiffness);
    free(c->pull);
    free(c->held);
    *c = (stiffness_condensed){0};
}
