/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Static condensation of a sector by a sparse Cholesky factorisation. */
#include "condense.h"

#include "../../numerics/room.h"

#include <f77blas.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/cholmod.h>

typedef struct work {
    const stiffness_sector *sector;
    /* Index of the first degree of freedom of each node: first the inner nodes, then those on the
       left and on the right side; STIFFNESS_NO_NODE for a fixed node. */
    size_t *freedom;
    size_t inside, side;
    cholmod_common common;
    cholmod_triplet *triplets;
    cholmod_factor *factor;
    size_t *place;                  /* position of each degree of freedom in the ordering of the
                                       factor */
    double *corner;                 /* block L_ss of the Cholesky factor L for the sides s,
                                       column-major, in the factor's order */
    cholmod_dense *load, *solution; /* one column for each load, in the factor's order */
    cholmod_dense *spare[2];
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

/* Adds the stiffness of one element to the matrix, whose lower half is stored. */
static void add_element(work *w, size_t element, double k[16][16])
{
    size_t at[16];
    for (size_t n = 0; n < 16; n++) {
        size_t first = w->freedom[w->sector->element[element][n / 2]];
        at[n] = first == STIFFNESS_NO_NODE ? STIFFNESS_NO_NODE : first + n % 2;
    }
    for (size_t a = 0; a < 16; a++)
        for (size_t b = 0; b < 16; b++)
            if (at[a] != STIFFNESS_NO_NODE && at[b] != STIFFNESS_NO_NODE && at[b] <= at[a])
                add_triplet(w->triplets, at[a], at[b], k[a][b]);
}

static double *column_of(const cholmod_dense *matrix, size_t column)
{
    return (double *)matrix->x + column * matrix->d;
}

/* Analyses and factorises the matrix. The degrees of freedom on the sides come last. */
static int factorise_ordered(work *w, cholmod_sparse *matrix, int *behind, int *order)
{
    for (size_t i = 0; i < matrix->nrow; i++)
        behind[i] = i >= w->inside;
    if (!cholmod_camd(matrix, NULL, 0, behind, order, &w->common))
        return 0;
    w->factor = cholmod_analyze_p(matrix, order, NULL, 0, &w->common);
    return w->factor && cholmod_factorize(matrix, w->factor, &w->common);
}

static int factorise(work *w)
{
    cholmod_sparse *matrix = cholmod_triplet_to_sparse(w->triplets, w->triplets->nnz, &w->common);
    size_t all = w->inside + 2 * w->side;
    int *behind = malloc(all * sizeof *behind), *order = malloc(all * sizeof *order);
    int done = matrix && behind && order && factorise_ordered(w, matrix, behind, order);
    cholmod_free_sparse(&matrix, &w->common);
    free(behind);
    free(order);
    if (!done)
        return STIFFNESS_CONDENSE_MEMORY;
    const int *permutation = w->factor->Perm;
    for (size_t i = 0; i < all; i++)
        w->place[permutation[i]] = i;
    return w->common.status == CHOLMOD_OK ? STIFFNESS_CONDENSED : STIFFNESS_CONDENSE_SINGULAR;
}

/* Multiplies an m x k matrix, or its transpose ('T'), by a k x n matrix. The Fortran symbol is
   called because in a program linked with GSL the C symbol is GSL's own, much slower function. */
static void multiply(char a_form, char b_form, int m, int n, int k, double *a, int a_rows,
                     double *b, int b_rows, double *product)
{
    double one = 1, zero = 0;
    BLASFUNC(dgemm)
    (&a_form, &b_form, &m, &n, &k, &one, a, &a_rows, b, &b_rows, &zero, product, &m);
}

/* Copies L_ss out of the supernodes. Their columns contain the rows of L in order, the diagonal
   first. */
static void copy_corner(const work *w)
{
    const cholmod_factor *f = w->factor;
    const int *super = f->super, *rows = f->s, *first_row = f->pi, *first_value = f->px;
    size_t both = 2 * w->side, inside = w->inside;
    for (size_t k = 0; k < f->nsuper; k++) {
        size_t first = (size_t)super[k], height = (size_t)(first_row[k + 1] - first_row[k]);
        for (size_t j = first; j < (size_t)super[k + 1]; j++) {
            const double *x = (double *)f->x + first_value[k] + (j - first) * height;
            for (size_t i = j - first; j >= inside && i < height; i++)
                w->corner[(j - inside) * both + (size_t)rows[first_row[k] + (int)i] - inside] =
                    x[i];
        }
    }
}

static void set_loads(work *w, size_t parts, const stiffness_nodal *part)
{
    for (size_t p = 0; p < parts; p++) {
        double *to = column_of(w->load, part[p].load);
        for (int k = 0; k < 3; k++) {
            size_t at = w->freedom[part[p].node[k]];
            if (at == STIFFNESS_NO_NODE || at >= w->inside)
                continue;
            to[w->place[at]] += part[p].weight[k] * part[p].direction.x;
            to[w->place[at + 1]] += part[p].weight[k] * part[p].direction.y;
        }
    }
}

static int solve(work *w, int system, cholmod_dense *known)
{
    return cholmod_solve2(system, w->factor, known, NULL, &w->solution, NULL, &w->spare[0],
                          &w->spare[1], &w->common);
}

/* Copies the matrix `from` to `to` in natural order. In `from` the rows, and if it is square also
   the columns, are the degrees of freedom of the sides in the factor's order. */
static void put_in_order(const work *w, const double *from, size_t columns, int square, double *to)
{
    size_t both = 2 * w->side;
    for (size_t k = 0; k < columns; k++) {
        const double *column = from + (square ? w->place[w->inside + k] - w->inside : k) * both;
        for (size_t i = 0; i < both; i++)
            to[k * both + i] = column[w->place[w->inside + i] - w->inside];
    }
}

/* Solves L y = f for the loads f. Computes the forces on the sides, L_ss y_s, and the compliance x'
   f with x = L_ii'^-1 y_i. */
static int condense_loads(work *w, stiffness_condensed *c, double *product)
{
    size_t both = 2 * w->side, all = w->inside + both;
    int n = (int)both, loads = (int)c->loads, rows = (int)all;
    if (!solve(w, CHOLMOD_L, w->load))
        return 0;
    cholmod_dense *y = w->solution;
    w->solution = NULL;
    multiply('N', 'N', n, loads, n, w->corner, n, column_of(y, 0) + w->inside, rows, product);
    put_in_order(w, product, c->loads, 0, c->pull);
    for (size_t k = 0; k < c->loads; k++)
        memset(column_of(y, k) + w->inside, 0, both * sizeof(double));
    int done = solve(w, CHOLMOD_Lt, y);
    if (done)
        multiply('T', 'N', loads, loads, rows, column_of(w->solution, 0), rows,
                 column_of(w->load, 0), rows, c->held);
    cholmod_free_dense(&y, &w->common);
    return done;
}

/* Static condensation (Guyan 1965); i: inner nodes, s: sides, f: loads. Stiffness: K_ss - K_si
   K_ii^-1 K_is = L_ss L_ss' (George & Liu 1981, Computer solution of large sparse positive definite
   systems). Forces on the sides: -K_si K_ii^-1 f. Compliance: f' K_ii^-1 f. */
static int condense(work *w, stiffness_condensed *c)
{
    size_t both = 2 * w->side;
    int n = (int)both;
    double *product = malloc(both * (both > c->loads ? both : c->loads) * sizeof *product);
    int done = product != NULL;
    if (done) {
        copy_corner(w);
        multiply('N', 'T', n, n, n, w->corner, n, w->corner, n, product);
        put_in_order(w, product, both, 1, c->stiffness);
        done = condense_loads(w, c, product);
    }
    free(product);
    return done ? STIFFNESS_CONDENSED : STIFFNESS_CONDENSE_MEMORY;
}

static int allocate(work *w, stiffness_condensed *c)
{
    size_t both = 2 * w->side, all = w->inside + both;
    /* an element has 16 x 16 entries, 136 of them in the lower half */
    w->triplets =
        cholmod_allocate_triplet(all, all, 136 * w->sector->elements, -1, CHOLMOD_REAL, &w->common);
    w->load = cholmod_zeros(all, c->loads, CHOLMOD_REAL, &w->common);
    w->place = malloc(all * sizeof *w->place);
    w->corner = calloc(both * both, sizeof *w->corner);
    c->stiffness = calloc(both * both, sizeof *c->stiffness);
    c->pull = calloc(both * c->loads, sizeof *c->pull);
    c->held = calloc(c->loads * c->loads, sizeof *c->held);
    return w->triplets && w->load && w->place && w->corner && c->stiffness && c->pull && c->held;
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
    /* uses the given order without trying others; L is read as supernodes */
    w.common.nmethods = 1;
    w.common.method[0].ordering = CHOLMOD_GIVEN;
    w.common.supernodal = CHOLMOD_SUPERNODAL;
    if (!number_freedoms(&w) || !allocate(&w, c) || !numerics_has_room(numerics_openmp_room()))
        goto out;
    c->side = w.side;
    for (size_t e = 0; e < sector->elements; e++) {
        stiffness_sector_stiffness(sector, e, material, k);
        add_element(&w, e, k);
    }
    result = factorise(&w);
    if (result == STIFFNESS_CONDENSED) {
        set_loads(&w, parts, part);
        result = condense(&w, c);
    }
out:
    cholmod_free_factor(&w.factor, &w.common);
    cholmod_free_dense(&w.solution, &w.common);
    cholmod_free_dense(&w.spare[0], &w.common);
    cholmod_free_dense(&w.spare[1], &w.common);
    cholmod_free_dense(&w.load, &w.common);
    cholmod_free_triplet(&w.triplets, &w.common);
    cholmod_finish(&w.common);
    free(w.place);
    free(w.corner);
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
