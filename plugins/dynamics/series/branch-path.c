/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "branch-path.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Arc lengths: ln w, and the series relative to its size. */
static const double first_step = 0.01, longest_step = 0.05, shortest_step = 1e-8;

/* The least cosine between the tangents of neighbouring points. Steps below short_step may turn
   more: where the flanks first part, each sample that loses contact turns the branch suddenly. */
static const double straight = 0.97, short_step = 1e-4;

/* Corrections after which a step counts as too long. */
enum { MAX_CORRECTIONS = 9 };

typedef dynamics_branch_path path;

int dynamics_branch_path_init(path *p, const dynamics_continuation_request *request)
{
    /* with little damping the branch shows every sample that gains or loses contact */
    size_t samples = request->excitation->zeta < 1e-3 ? 16384 : 2048;
    while (samples < 16 * request->harmonics)
        samples *= 2;
    *p = (path){.request = request, .n = 2 * request->harmonics + 1};
    size_t size = p->n + 1;
    p->b = dynamics_harmonics_new(request->excitation, request->harmonics, samples);
    p->z = calloc(size, sizeof(double));
    p->next = calloc(size, sizeof(double));
    p->tangent = calloc(size, sizeof(double));
    p->row = calloc(size, sizeof(double));
    p->rhs = calloc(size, sizeof(double));
    p->matrix = calloc(size * size, sizeof(double));
    p->pivot = calloc(size, sizeof *p->pivot);
    p->time = calloc(samples, sizeof(double));
    return p->b && p->z && p->next && p->tangent && p->row && p->rhs && p->matrix && p->pivot &&
           p->time;
}

void dynamics_branch_path_free(path *p)
{
    dynamics_harmonics_free(p->b);
    free(p->z);
    free(p->next);
    free(p->tangent);
    free(p->row);
    free(p->rhs);
    free(p->matrix);
    free(p->pivot);
    free(p->time);
}

/* The scalar product, with the series in units of the motion. */
static double dot(const path *p, const double *u, const double *v)
{
    double sum = 0;
    for (size_t i = 0; i < p->n; i++)
        sum += u[i] * v[i];
    return sum / (p->scale * p->scale) + u[p->n] * v[p->n];
}

/* Solves the linear equations of motion at p->next, bordered by the direction `tangent`. p->rhs
   holds the right side, or with_residual its last number alone, and gets the solution. */
static int solve_bordered(path *p, int with_residual)
{
    size_t size = p->n + 1;
    double w = exp(p->next[p->n]), *last = p->matrix + p->n * size, keep = p->rhs[p->n];
    dynamics_harmonics_residual(p->b, w, p->next, p->rhs, last, p->matrix, size);
    if (!with_residual)
        memset(p->rhs, 0, p->n * sizeof *p->rhs);
    p->rhs[p->n] = keep;
    for (size_t i = 0; i < p->n; i++)
        p->matrix[i * size + p->n] = p->tangent[i] / (p->scale * p->scale);
    last[p->n] = p->tangent[p->n];
    lapack_int order = (lapack_int)size;
    if (LAPACKE_dgesv(LAPACK_COL_MAJOR, order, 1, p->matrix, order, p->pivot, p->rhs, order))
        return 0;
    return isfinite(dot(p, p->rhs, p->rhs));
}

/* Finds the tangent at p->next that goes on from the old one, and puts it into p->row; returns the
   cosine between the two, 0: there is none. */
static double find_tangent(path *p)
{
    memset(p->rhs, 0, p->n * sizeof *p->rhs);
    p->rhs[p->n] = 1;
    if (!solve_bordered(p, 0))
        return 0;
    double length = sqrt(dot(p, p->rhs, p->rhs)), old = dot(p, p->tangent, p->tangent);
    if (!(length > 0))
        return 0;
    for (size_t i = 0; i <= p->n; i++)
        p->row[i] = p->rhs[i] / length;
    return dot(p, p->row, p->tangent) / sqrt(old);
}

/* Newton's method on the plane across the tangent at the distance ds along it; returns the number
   of corrections, 0: it failed. */
static int correct_point(path *p)
{
    for (size_t i = 0; i <= p->n; i++)
        p->next[i] = p->z[i] + p->ds * p->tangent[i];
    double first = 0;
    for (int n = 1; n <= MAX_CORRECTIONS; n++) {
        p->rhs[p->n] = 0;
        if (!solve_bordered(p, 1))
            return 0;
        double change = sqrt(dot(p, p->rhs, p->rhs));
        if (n == 1)
            first = change;
        if (!(change <= 2 * first) || change > 4 * p->ds)
            return 0;
        for (size_t i = 0; i <= p->n; i++)
            p->next[i] -= p->rhs[i];
        if (change < 1e-9)
            return n;
    }
    return 0;
}

int dynamics_branch_path_begin(path *p)
{
    p->scale = 1 + dynamics_fourier_rms(p->z, p->request->harmonics);
    memset(p->tangent, 0, p->n * sizeof *p->tangent);
    p->tangent[p->n] = p->direction;
    memcpy(p->next, p->z, (p->n + 1) * sizeof *p->z);
    p->ds = first_step;
    if (find_tangent(p) == 0)
        return 0;
    memcpy(p->tangent, p->row, (p->n + 1) * sizeof *p->row);
    return 1;
}

int dynamics_branch_path_step(path *p)
{
    for (; p->ds > shortest_step; p->ds *= 0.5) {
        int corrections = correct_point(p);
        double along = corrections ? find_tangent(p) : 0;
        if (along == 0 || (along < straight && p->ds > short_step))
            continue;
        double faster = corrections <= 4 ? 1.5 : corrections >= 7 ? 0.6 : 1;
        p->ds = fmin(p->ds * faster, longest_step);
        return 1;
    }
    return 0;
}

void dynamics_branch_path_accept(path *p)
{
    memcpy(p->z, p->next, (p->n + 1) * sizeof *p->z);
    p->scale = 1 + dynamics_fourier_rms(p->z, p->request->harmonics);
    double length = sqrt(dot(p, p->row, p->row));
    for (size_t i = 0; i <= p->n; i++)
        p->tangent[i] = p->row[i] / length;
}

int dynamics_branch_path_end(path *p, double end)
{
    double share = (end - p->z[p->n]) / (p->next[p->n] - p->z[p->n]), step;
    double way = 0, off = 0;
    for (size_t i = 0; i < p->n; i++) {
        p->rhs[i] = p->z[i] + share * (p->next[i] - p->z[i]);
        way += (p->next[i] - p->z[i]) * (p->next[i] - p->z[i]);
        p->row[i] = p->rhs[i];
    }
    if (dynamics_harmonics_solve(p->b, exp(end), p->rhs, &step) != DYNAMICS_NEWTON_DONE)
        return 0;
    for (size_t i = 0; i < p->n; i++)
        off += (p->rhs[i] - p->row[i]) * (p->rhs[i] - p->row[i]);
    if (sqrt(off) > sqrt(way) + 1e-6 * p->scale)
        return 0;
    memcpy(p->z, p->rhs, p->n * sizeof *p->z);
    p->z[p->n] = end;
    return 1;
}

int dynamics_branch_path_shorten(path *p)
{
    p->ds *= 0.25;
    return p->ds >= shortest_step;
}
