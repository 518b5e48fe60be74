/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least-squares piecewise cubics over the mesh cycle. */
#include "cubic-fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PIECES = 256, LEAST_SAMPLES = 4 /* per piece */ };

/* Weight of the penalty on the curvature of the pieces, relative to the fit to the samples. The
   penalty matters only if a piece has few samples. */
static const double straightness = 1e-4;

/* A breakpoint between two pieces, and the indices of the unknowns on its lower and upper side. */
typedef struct node {
    size_t point;
    size_t value[2], slope[2];
} node;

typedef struct equations {
    const stiffness_table_phases *points;
    const double *sample;
    const bool *corner;
    size_t nodes, unknowns;
    node *node;
    double *matrix, *x; /* matrix: lower triangle of the normal equations, by rows; x: right-hand
                           side, replaced by the solution */
} equations;

/* Places nodes at corners and jumps, and at every stride-th breakpoint in between. */
static bool place_nodes(equations *s, size_t stride)
{
    size_t since = 0;
    s->nodes = s->unknowns = 0;
    for (size_t i = 0; i < s->points->count; i++, since++) {
        bool jump = stiffness_jumps_at(s->points, s->sample, i), corner = jump || s->corner[i];
        if (i > 0 && !corner && since < stride)
            continue;
        if (s->nodes == MOST_PIECES)
            return false;
        node *n = &s->node[s->nodes++];
        n->point = i;
        n->value[0] = s->unknowns++;
        n->value[1] = jump ? s->unknowns++ : n->value[0];
        n->slope[0] = s->unknowns++;
        n->slope[1] = corner ? s->unknowns++ : n->slope[0];
        since = 0;
    }
    return true;
}

/* Adds (weight (sum c[k] x[at[k]] - y))^2 to the function that is minimised. */
static void add_row(equations *s, const size_t at[4], const double c[4], double y, double weight)
{
    for (int a = 0; a < 4; a++) {
        for (int b = 0; b < 4; b++)
            if (at[b] <= at[a])
                s->matrix[at[a] * s->unknowns + at[b]] += weight * weight * c[a] * c[b];
        s->x[at[a]] += weight * weight * c[a] * y;
    }
}

/* Returns the distance in phase from one breakpoint to a later one, which may lie beyond phase
 * 1. */
static double distance(const stiffness_table_phases *k, size_t from, size_t to)
{
    double d = k->phase[to] - k->phase[from];
    return d > 0 ? d : d + 1;
}

/* Counts the breakpoints between node i and the next node. */
static size_t steps_of(const equations *s, size_t i)
{
    size_t count = s->points->count, from = s->node[i].point,
           to = s->node[(i + 1) % s->nodes].point;
    return to > from ? to - from : to + count - from;
}

/* Adds the piece between the upper side of node i and the lower side of the next node. */
static void add_piece(equations *s, size_t i)
{
    const stiffness_table_phases *k = s->points;
    const node *from = &s->node[i], *to = &s->node[(i + 1) % s->nodes];
    const size_t at[4] = {from->value[1], from->slope[1], to->value[0], to->slope[0]};
    size_t steps = steps_of(s, i);
    double h = distance(k, from->point, to->point);
    for (size_t j = 0; j <= steps; j++) {
        size_t n = (from->point + j) % k->count;
        double t = j == 0 ? 0 : j == steps ? 1 : distance(k, from->point, n) / h, u = 1 - t;
        const double c[4] = {u * u * (1 + 2 * t), t * u * u * h, t * t * (1 + 2 * u),
                             -t * t * u * h};
        add_row(s, at, c, s->sample[j == steps ? k->before[n] : k->after[n]], 1);
    }
    add_row(s, at, (const double[4]){1, h, -1, 0}, 0, straightness);
    add_row(s, at, (const double[4]){1, 0, -1, h}, 0, straightness);
}

/* Solves by Cholesky's method, in place. */
static void solve(equations *s)
{
    size_t n = s->unknowns;
    double *m = s->matrix, *x = s->x;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j <= i; j++) {
            double sum = m[i * n + j];
            for (size_t k = 0; k < j; k++)
                sum -= m[i * n + k] * m[j * n + k];
            m[i * n + j] = i == j ? sqrt(sum) : sum / m[j * n + j];
        }
        for (size_t k = 0; k < i; k++)
            x[i] -= m[i * n + k] * x[k];
        x[i] /= m[i * n + i];
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; k++)
            x[i] -= m[k * n + i] * x[k];
        x[i] /= m[i * n + i];
    }
}

/* Evaluates values and slopes of the cubics at the breakpoints of one piece. */
static void evaluate_piece(const equations *s, size_t i, stiffness_cubic_fit *fit)
{
    const stiffness_table_phases *k = s->points;
    const node *from = &s->node[i], *to = &s->node[(i + 1) % s->nodes];
    double h = distance(k, from->point, to->point);
    double a = s->x[from->value[1]], da = s->x[from->slope[1]] * h;
    double b = s->x[to->value[0]], db = s->x[to->slope[0]] * h;
    fit->value[k->after[from->point]] = a;
    fit->after[from->point] = da / h;
    fit->value[k->before[to->point]] = b;
    fit->before[to->point] = db / h;
    for (size_t j = 1; j < steps_of(s, i); j++) {
        size_t n = (from->point + j) % k->count;
        double t = distance(k, from->point, n) / h, u = 1 - t;
        fit->value[k->before[n]] = fit->value[k->after[n]] =
            u * u * (1 + 2 * t) * a + t * t * (1 + 2 * u) * b + t * u * (u * da - t * db);
        fit->before[n] = fit->after[n] =
            (6 * t * u * (b - a) + u * (1 - 3 * t) * da + t * (1 - 3 * u) * db) / h;
    }
}

static double range_of(const double *value, size_t count)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, value[i]);
        high = fmax(high, value[i]);
    }
    return high - low;
}

static bool fit_once(equations *s, size_t samples, stiffness_cubic_fit *fit)
{
    double worst = 0, range = range_of(s->sample, samples);
    s->matrix = calloc(s->unknowns * s->unknowns, sizeof *s->matrix);
    s->x = calloc(s->unknowns, sizeof *s->x);
    bool made = s->matrix && s->x;
    if (made) {
        for (size_t i = 0; i < s->nodes; i++)
            add_piece(s, i);
        solve(s);
        for (size_t i = 0; i < s->nodes; i++)
            evaluate_piece(s, i, fit);
        for (size_t i = 0; i < s->points->count; i++) {
            size_t a = s->points->before[i], b = s->points->after[i];
            worst = fmax(worst, fmax(fabs(fit->value[a] - s->sample[a]),
                                     fabs(fit->value[b] - s->sample[b])));
        }
        fit->error = range > 0 ? worst / range : 0;
    }
    free(s->matrix);
    free(s->x);
    return made;
}

bool stiffness_cubic_fit_make(stiffness_cubic_fit *fit, const stiffness_table_phases *points,
                              size_t samples, const double *value, const bool *corner,
                              double tolerance)
{
    equations s = {.points = points, .sample = value, .corner = corner};
    *fit = (stiffness_cubic_fit){.value = malloc(samples * sizeof *fit->value),
                                 .before = calloc(points->count, sizeof *fit->before),
                                 .after = calloc(points->count, sizeof *fit->after),
                                 .error = INFINITY};
    s.node = malloc(MOST_PIECES * sizeof *s.node);
    bool made = fit->value && fit->before && fit->after && s.node;
    if (made)
        memcpy(fit->value, value, samples * sizeof *fit->value);
    for (size_t stride = points->count; made; stride = (stride + 1) / 2) {
        if (!place_nodes(&s, stride))
            break;
        made = fit_once(&s, samples, fit);
        if (fit->error <= tolerance || stride <= LEAST_SAMPLES)
            break;
    }
    free(s.node);
    return made;
}

void stiffness_cubic_fit_free(stiffness_cubic_fit *fit)
{
    free(fit->value);
    free(fit->before);
    free(fit->after);
    *fit = (stiffness_cubic_fit){0};
}
