/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "anderson.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A stored change of g is not used if the part of it that is linearly independent of the newer
   changes is below this share. */
static const double parallel = 1e-6;

int ehl_anderson_create(ehl_anderson *m, size_t size)
{
    *m = (ehl_anderson){.size = size};
    double *next = m->memory = calloc((2 + 3 * (size_t)EHL_ANDERSON_DEPTH) * size, sizeof *next);
    if (!next)
        return 0;
    m->y = next;
    m->g = next + size;
    next += 2 * size;
    for (size_t k = 0; k < EHL_ANDERSON_DEPTH; k++, next += 3 * size) {
        m->dy[k] = next;
        m->dg[k] = next + size;
        m->basis[k] = next + 2 * size;
    }
    return 1;
}

void ehl_anderson_destroy(ehl_anderson *m)
{
    free(m->memory);
    m->memory = NULL;
}

void ehl_anderson_begin(ehl_anderson *m)
{
    m->count = 0;
    m->started = 0;
}

static double dot(const double *restrict a, const double *restrict b, size_t n)
{
    double s0 = 0, s1 = 0;
    size_t i = 0;
    for (; i + 2 <= n; i += 2) {
        s0 += a[i] * b[i];
        s1 += a[i + 1] * b[i + 1];
    }
    return s0 + s1 + (i < n ? a[i] * b[i] : 0);
}

static void add(double *restrict y, double factor, const double *restrict x, size_t n)
{
    for (size_t i = 0; i < n; i++)
        y[i] += factor * x[i];
}

static void remember(ehl_anderson *m, const double *y, const double *g)
{
    m->newest = (m->newest + 1) % EHL_ANDERSON_DEPTH;
    m->count += m->count < EHL_ANDERSON_DEPTH;
    double *dy = m->dy[m->newest], *dg = m->dg[m->newest];
    for (size_t i = 0; i < m->size; i++) {
        dy[i] = y[i] - m->y[i];
        dg[i] = g[i] - m->g[i];
    }
}

/* Orthogonalises the changes dG of g by Gram-Schmidt, the newest change first and each change
   twice. Sets r to R of dG = Q R. Returns the number of independent columns. */
static size_t factorise(ehl_anderson *m, double r[EHL_ANDERSON_DEPTH][EHL_ANDERSON_DEPTH],
                        size_t used[EHL_ANDERSON_DEPTH])
{
    size_t n = m->size, rank = 0;
    for (size_t k = 0; k < m->count; k++) {
        size_t from = (m->newest + EHL_ANDERSON_DEPTH - k) % EHL_ANDERSON_DEPTH;
        double *q = m->basis[rank];
        memcpy(q, m->dg[from], n * sizeof *q);
        double whole = sqrt(dot(q, q, n));
        for (size_t j = 0; j < rank; j++)
            r[j][rank] = 0;
        for (int twice = 0; twice < 2; twice++)
            for (size_t j = 0; j < rank; j++) {
                double part = dot(m->basis[j], q, n);
                r[j][rank] += part;
                add(q, -part, m->basis[j], n);
            }
        double rest = sqrt(dot(q, q, n));
        if (!(rest > parallel * whole))
            continue;
        for (size_t i = 0; i < n; i++)
            q[i] /= rest;
        r[rank][rank] = rest;
        used[rank++] = from;
    }
    return rank;
}

void ehl_anderson_step(ehl_anderson *m, const double *y, const double *g, double *change)
{
    double r[EHL_ANDERSON_DEPTH][EHL_ANDERSON_DEPTH], share[EHL_ANDERSON_DEPTH];
    size_t n = m->size, used[EHL_ANDERSON_DEPTH];
    if (m->started)
        remember(m, y, g);
    m->started = 1;
    memcpy(m->y, y, n * sizeof *y);
    memcpy(m->g, g, n * sizeof *g);
    memcpy(change, g, n * sizeof *g);
    size_t rank = factorise(m, r, used);
    for (size_t k = 0; k < rank; k++)
        share[k] = dot(m->basis[k], g, n);
    for (size_t k = rank; k-- > 0;) {
        for (size_t j = k + 1; j < rank; j++)
            share[k] -= r[k][j] * share[j];
        share[k] /= r[k][k];
        add(change, -share[k], m->dy[used[k]], n);
        add(change, -share[k], m->dg[used[k]], n);
    }
}
