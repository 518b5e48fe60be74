/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "smooth-piece.h"

#include <math.h>
#include <string.h>

/* A curve is smooth if a polynomial deviates from its nodes by less than `meets` and from the
   midpoints of its lines by less than `between`. Both bounds are relative to the mean stiffness or
   to the unit of length. */
static const double meets = 1e-7, between = 1e-4;

/* Least number of lines per piece: three per fitted coefficient, so that a polynomial cannot fit a
   rough curve by chance. */
enum { FREE = DYNAMICS_DEGREE - 1, LEAST_LINES = 3 * FREE };

/* A fit of one series to the nodes `first` to `last`: the line through both ends plus a correction
   (1 - x^2) (a_0 T_0(x) + ... + a_5 T_5(x)) with Chebyshev polynomials T_n, -1 <= x <= 1. The
   correction is 0 at both ends. */
typedef struct fit {
    const double *phase, *value;
    size_t first, last;
    double unit, a[FREE];
} fit;

static void basis_at(double x, double basis[FREE])
{
    double bubble = 1 - x * x, before = 1, now = x;
    basis[0] = bubble;
    for (int i = 1; i < FREE; i++) {
        double next = 2 * x * now - before;
        basis[i] = bubble * now;
        before = now;
        now = next;
    }
}

static double place_of(const fit *f, double phase)
{
    double from = f->phase[f->first], to = f->phase[f->last];
    return (2 * phase - from - to) / (to - from);
}

static double line_at(const fit *f, double x)
{
    return (0.5 * (1 - x) * f->value[f->first] + 0.5 * (1 + x) * f->value[f->last]) / f->unit;
}

static double fit_at(const fit *f, double x)
{
    double basis[FREE], value = line_at(f, x);
    basis_at(x, basis);
    for (int i = 0; i < FREE; i++)
        value += f->a[i] * basis[i];
    return value;
}

/* Solves the normal equations with matrix n and right-hand side a; the solution replaces a. Returns
   0 if n is singular. The basis is nearly orthogonal, so n is well conditioned. */
static int solve_normal(double n[FREE][FREE], double a[FREE])
{
    for (int j = 0; j < FREE; j++) {
        if (!(n[j][j] > 1e-12))
            return 0;
        for (int i = j + 1; i < FREE; i++) {
            double share = n[i][j] / n[j][j];
            for (int k = j; k < FREE; k++)
                n[i][k] -= share * n[j][k];
            a[i] -= share * a[j];
        }
    }
    for (int j = FREE - 1; j >= 0; j--) {
        for (int k = j + 1; k < FREE; k++)
            a[j] -= n[j][k] * a[k];
        a[j] /= n[j][j];
    }
    return 1;
}

/* Fits by least squares. */
static int fit_nodes(fit *f)
{
    double n[FREE][FREE] = {{0}}, basis[FREE];
    memset(f->a, 0, sizeof f->a);
    for (size_t i = f->first + 1; i < f->last; i++) {
        double x = place_of(f, f->phase[i]), miss = f->value[i] / f->unit - line_at(f, x);
        basis_at(x, basis);
        for (int j = 0; j < FREE; j++) {
            f->a[j] += basis[j] * miss;
            for (int k = 0; k < FREE; k++)
                n[j][k] += basis[j] * basis[k];
        }
    }
    return solve_normal(n, f->a);
}

/* Sets the largest distance of the fit from the nodes, and from the midpoints of the lines. */
static void distances(const fit *f, double *at_nodes, double *from_lines)
{
    *at_nodes = *from_lines = 0;
    for (size_t i = f->first; i < f->last; i++) {
        double x = place_of(f, f->phase[i]), next = place_of(f, f->phase[i + 1]);
        double middle = 0.5 * (f->value[i] + f->value[i + 1]) / f->unit;
        *at_nodes = fmax(*at_nodes, fabs(fit_at(f, x) - f->value[i] / f->unit));
        *from_lines = fmax(*from_lines, fabs(fit_at(f, 0.5 * (x + next)) - middle));
    }
}

/* Converts the fit to powers of the phase since the start, by Clenshaw's recurrence on polynomials
   in t with x = 2 t - 1. */
static void powers_of(const fit *f, double c[DYNAMICS_DEGREE + 1])
{
    double now[DYNAMICS_DEGREE + 2] = {0}, after[DYNAMICS_DEGREE + 2] = {0};
    double length = f->phase[f->last] - f->phase[f->first], scale = 1;
    double from = f->value[f->first] / f->unit, to = f->value[f->last] / f->unit;
    for (int i = FREE - 1; i >= 0; i--) {
        double next[DYNAMICS_DEGREE + 2] = {0}, twice = i > 0 ? 2 : 1;
        for (int k = 0; k < FREE; k++) {
            next[k] -= twice * now[k] + after[k];
            next[k + 1] += 2 * twice * now[k];
        }
        next[0] += f->a[i];
        memcpy(after, now, sizeof after);
        memcpy(now, next, sizeof now);
    }
    memset(c, 0, (DYNAMICS_DEGREE + 1) * sizeof *c);
    for (int k = 0; k < FREE; k++) { /* 1 - x^2 = 4 t - 4 t^2 */
        c[k + 1] += 4 * now[k];
        c[k + 2] -= 4 * now[k];
    }
    c[0] = from;
    c[1] += to - from;
    for (int k = 0; k <= DYNAMICS_DEGREE; k++, scale *= length)
        c[k] /= scale;
}

/* Fits one series between two nodes. Returns 0 if the series is not smooth there. */
static int fit_series(const dynamics_mesh_curves *x, const double *value, double unit,
                      const size_t ends[2], double distance[2], double *coefficients)
{
    fit f = {x->phase, value, ends[0], ends[1], unit, {0}};
    if (!fit_nodes(&f))
        return 0;
    distances(&f, &distance[0], &distance[1]);
    if (distance[0] > meets || distance[1] > between)
        return 0;
    powers_of(&f, coefficients);
    return 1;
}

/* Fits all curves between two nodes. Returns 0 if one is not smooth there. */
static int fit_piece(const dynamics_excitation *excitation, const dynamics_mesh_curves *x,
                     const dynamics_spring_nodes *spring, size_t first, size_t last,
                     dynamics_piece *piece, double distance[2])
{
    const size_t ends[2] = {first, last};
    double of_others[2], unit = excitation->stiffness, length = excitation->length;
    *piece = (dynamics_piece){.start = x->phase[first],
                              .length = x->phase[last] - x->phase[first],
                              .degree = DYNAMICS_DEGREE,
                              .lines = spring ? (int)spring->lines : 0};
    if (!fit_series(x, x->stiffness, unit, ends, distance, piece->k) ||
        (x->error && !fit_series(x, x->error, length, ends, of_others, piece->e)))
        return 0;
    for (int i = 0; i < piece->lines; i++) {
        const dynamics_spring_row row = dynamics_spring_row_of(spring, (size_t)i);
        if (!fit_series(x, row.slope, unit, ends, of_others, piece->line[i].slope) ||
            !fit_series(x, row.offset, unit * length, ends, of_others, piece->line[i].offset))
            return 0;
    }
    return 1;
}

size_t dynamics_smooth_piece(const dynamics_excitation *excitation, const dynamics_mesh_curves *x,
                             const dynamics_spring_nodes *spring, size_t first, size_t last,
                             dynamics_piece *piece, dynamics_representation *represented)
{
    size_t most = last - first, good = 0, bad = most + 1;
    double distance[2], best[2] = {0};
    dynamics_piece trial;
    /* doubles the number of lines as long as the piece is smooth, then bisects */
    for (size_t lines = LEAST_LINES; lines <= most && bad - good > 1;) {
        if (fit_piece(excitation, x, spring, first, first + lines, &trial, distance)) {
            good = lines;
            *piece = trial;
            memcpy(best, distance, sizeof best);
        } else {
            bad = lines;
            if (!good)
                return 0;
        }
        lines = bad > most && 2 * lines < most ? 2 * lines : bad > most ? most : (good + bad) / 2;
    }
    if (!good)
        return 0;
    /* shortens the piece so that the rest has enough lines for a piece of its own */
    if (good < most && most - good < LEAST_LINES && most >= 2 * LEAST_LINES) {
        size_t lines = most - LEAST_LINES;
        if (fit_piece(excitation, x, spring, first, first + lines, &trial, distance)) {
            good = lines;
            *piece = trial;
            memcpy(best, distance, sizeof best);
        }
    }
    represented->at_nodes = fmax(represented->at_nodes, best[0]);
    represented->between = fmax(represented->between, best[1]);
    return first + good;
}

double dynamics_smooth_series(const double *phase, const double *value, size_t count, double unit,
                              double coefficients[DYNAMICS_DEGREE + 1])
{
    fit f = {phase, value, 0, count - 1, unit, {0}};
    double at_nodes, from_lines;
    if (!fit_nodes(&f))
        return INFINITY;
    distances(&f, &at_nodes, &from_lines);
    powers_of(&f, coefficients);
    return at_nodes;
}
