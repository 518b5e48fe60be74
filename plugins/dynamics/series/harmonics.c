/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "harmonics-samples.h"

#include "../../numerics/room.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NEWTON = 40, MAX_HALVINGS = 6 };

/* Newton's method has converged if the step, relative to the motion, is below `converged`. If
   round-off keeps the residual from decreasing, a step below `nearly_converged` is sufficient. */
static const double converged = 1e-12, nearly_converged = 1e-9;

/* A residual below this value is round-off. Without load the flanks may rest anywhere in the gap;
   Newton's step is not defined there. */
static const double round_off = 1e-15;

dynamics_harmonics *dynamics_harmonics_new(const dynamics_excitation *excitation, size_t harmonics,
                                           size_t samples)
{
    assert(samples % 2 == 0 && samples > 4 * harmonics);
    dynamics_harmonics *b = calloc(1, sizeof *b);
    if (!b)
        return NULL;
    size_t size = 2 * harmonics + 1;
    b->excitation = excitation;
    b->harmonics = harmonics;
    b->samples = samples;
    b->lines = excitation->pieces->lines > 1 ? (size_t)excitation->pieces->lines : 1;
    b->slope = numerics_fftw_array(b->lines * samples, sizeof(double));
    b->offset = numerics_fftw_array(b->lines * samples, sizeof(double));
    b->e = numerics_fftw_array(samples, sizeof(double));
    b->time = numerics_fftw_array(samples, sizeof(double));
    b->edges = malloc(2 * samples * b->lines * sizeof *b->edges);
    b->spectrum = numerics_fftw_array(samples / 2 + 1, sizeof *b->spectrum);
    b->e_series = malloc(size * sizeof(double));
    b->cosine = malloc((2 * harmonics + 1) * sizeof(double));
    b->sine = malloc((2 * harmonics + 1) * sizeof(double));
    b->residual = malloc(size * sizeof(double));
    b->trial = malloc(size * sizeof(double));
    b->try = malloc(size * sizeof(double));
    b->jacobian = malloc(size * size * sizeof(double));
    b->pivot = malloc(size * sizeof *b->pivot);
    if (b->slope && b->e && b->offset && b->time && b->edges && b->spectrum && b->e_series &&
        b->cosine && b->sine && b->residual && b->trial && b->try && b->jacobian && b->pivot &&
        numerics_has_room(numerics_fftw_room(samples))) {
        fftw_make_planner_thread_safe(); /* all plugins of the process share FFTW's planner */
        b->to_time = fftw_plan_dft_c2r_1d((int)samples, b->spectrum, b->time, FFTW_ESTIMATE);
        b->to_spectrum = fftw_plan_dft_r2c_1d((int)samples, b->time, b->spectrum, FFTW_ESTIMATE);
    }
    if (!b->to_time || !b->to_spectrum) {
        dynamics_harmonics_free(b);
        return NULL;
    }
    dynamics_harmonics_sample(b);
    return b;
}

void dynamics_harmonics_free(dynamics_harmonics *b)
{
    if (!b)
        return;
    fftw_destroy_plan(b->to_time);
    fftw_destroy_plan(b->to_spectrum);
    free(b->slope);
    free(b->offset);
    free(b->e);
    free(b->time);
    free(b->edges);
    free(b->spectrum);
    free(b->e_series);
    free(b->cosine);
    free(b->sine);
    free(b->residual);
    free(b->trial);
    free(b->try);
    free(b->jacobian);
    free(b->pivot);
    free(b);
}

size_t dynamics_harmonics_samples(const dynamics_harmonics *b)
{
    return b->samples;
}

/* Returns the number of coefficients of the series. */
static size_t series_size(const dynamics_harmonics *b)
{
    return 2 * b->harmonics + 1;
}

/* Writes the samples of s - e to b->time. */
static void sample_motion(dynamics_harmonics *b, const double *x)
{
    size_t half = b->samples / 2;
    b->spectrum[0] = x[0];
    for (size_t n = 1; n <= half; n++)
        b->spectrum[n] = n <= b->harmonics ? 0.5 * (x[2 * n - 1] - I * x[2 * n]) : 0;
    fftw_execute(b->to_time);
    for (size_t i = 0; i < b->samples; i++)
        b->time[i] -= b->e[i];
}

/* Writes the harmonics of the samples in b->time to b->spectrum: the mean, then (a_n - i b_n)/2. */
static void transform_samples(dynamics_harmonics *b)
{
    fftw_execute(b->to_spectrum);
    double scale = 1 / (double)b->samples;
    for (size_t n = 0; n <= b->samples / 2; n++)
        b->spectrum[n] *= scale;
}

/* Returns the deflection of the mesh spring, which is in series with the dead zone (Li & Kahraman
   2011, eq. 2b). */
static double bend(const dynamics_excitation *excitation, double delta)
{
    double h = excitation->half_gap;
    return delta > h ? delta - h : delta < -h ? delta + h : 0;
}

/* Returns the force of a line minus the force of the previous line, at sample i (spring.h). */
static double excess(const dynamics_harmonics *b, size_t line, size_t i, double bend)
{
    size_t at = line * b->samples + i, below = at - b->samples;
    return (b->slope[at] - b->slope[below]) * bend -
           (b->offset[at] - (line > 1 ? b->offset[below] : 0));
}

/* Returns the slope of the force at sample i. */
static double slope_at(const dynamics_harmonics *b, size_t i, double bend)
{
    size_t line = 0;
    while (line + 1 < b->lines && excess(b, line + 1, i, fabs(bend)) > 0)
        line++;
    return b->slope[line * b->samples + i];
}

static double spring_force(const dynamics_harmonics *b, size_t i, double bend)
{
    double more = 0, there = 1;
    for (size_t line = 1; line < b->lines && there > 0; line++) {
        there = excess(b, line, i, fabs(bend));
        more += there > 0 ? there : 0;
    }
    return b->slope[i] * bend + (more > 0 ? (bend < 0 ? -more : more) : 0);
}

/* Makes the dynamics_harmonics_edge between the samples i and j at which a force of slope `slope`
   begins or ends. The force is proportional to a distance that changes from `from` to `to`. By the
   Euler-Maclaurin formula a kink at the fraction t of a step gives the trapezoidal rule an error of
   (t (1 - t)/2 - 1/12) times the change of slope. */
static dynamics_harmonics_edge edge_between(size_t i, size_t j, double from, double to,
                                            double slope)
{
    double a = fabs(from), z = fabs(to), sum = a + z;
    dynamics_harmonics_edge e = {.i = i, .j = j, .area = -slope * (0.5 * a * z / sum - sum / 12)};
    e.after_i = -slope * (0.5 * z * z / (sum * sum) - 1.0 / 12) * (from > 0 ? 1 : -1);
    e.after_j = -slope * (0.5 * a * a / (sum * sum) - 1.0 / 12) * (to > 0 ? 1 : -1);
    return e;
}

/* Finds where the motion, sampled in b->time, crosses the dynamics_harmonics_edge of the gap on one
   side between sample i and the next one. Returns 0 if it does not. */
static int find_edge(const dynamics_harmonics *b, size_t i, int side, dynamics_harmonics_edge *e)
{
    size_t j = (i + 1) % b->samples;
    double from = b->time[i] - side * b->excitation->half_gap;
    double to = b->time[j] - side * b->excitation->half_gap;
    if ((from > 0) == (to > 0) || b->excitation->half_gap == 0)
        return 0;
    *e = edge_between(i, j, from, to, 0.5 * (b->slope[i] + b->slope[j]) * side);
    return 1;
}

/* Finds where the motion crosses the knee at which `line` begins. The distance from the knee is the
   excess of the line's force. Returns 0 if it does not cross. */
static int find_knee(const dynamics_harmonics *b, size_t line, size_t i, int side,
                     dynamics_harmonics_edge *e)
{
    size_t j = (i + 1) % b->samples;
    const double *above = b->slope + line * b->samples, *below = above - b->samples;
    double from = excess(b, line, i, side * b->time[i] - b->excitation->half_gap);
    double to = excess(b, line, j, side * b->time[j] - b->excitation->half_gap);
    if ((from > 0) == (to > 0))
        return 0;
    *e = edge_between(i, j, from, to, side);
    e->after_i *= side * (above[i] - below[i]);
    e->after_j *= side * (above[j] - below[j]);
    return 1;
}

/* Collects the crossings of edges and knees on both sides. Returns their number. */
static size_t find_edges(dynamics_harmonics *b)
{
    size_t count = 0;
    for (size_t i = 0; i < b->samples; i++)
        for (int side = -1; side <= 1; side += 2) {
            count += find_edge(b, i, side, &b->edges[count]) ? 1 : 0;
            for (size_t line = 1; line < b->lines; line++)
                count += find_knee(b, line, i, side, &b->edges[count]) ? 1 : 0;
        }
    return count;
}

/* Writes the harmonics of the mesh spring force to b->spectrum. */
static void force_spectrum(dynamics_harmonics *b, const double *x)
{
    sample_motion(b, x);
    size_t count = find_edges(b);
    for (size_t i = 0; i < b->samples; i++)
        b->time[i] = spring_force(b, i, bend(b->excitation, b->time[i]));
    for (size_t n = 0; n < count; n++) {
        b->time[b->edges[n].i] += 0.5 * b->edges[n].area;
        b->time[b->edges[n].j] += 0.5 * b->edges[n].area;
    }
    transform_samples(b);
}

/* Computes the harmonics of the derivative of the force with respect to s: the slope in contact,
   and 0 in the gap. Returns the number of edges. */
static size_t stiffness_spectrum(dynamics_harmonics *b, const double *x)
{
    double h = b->excitation->half_gap;
    sample_motion(b, x);
    size_t count = find_edges(b);
    for (size_t i = 0; i < b->samples; i++)
        b->time[i] =
            h == 0 || fabs(b->time[i]) > h ? slope_at(b, i, bend(b->excitation, b->time[i])) : 0;
    transform_samples(b);
    for (size_t n = 0; n <= 2 * b->harmonics; n++) {
        b->cosine[n] = creal(b->spectrum[n]);
        b->sine[n] = -cimag(b->spectrum[n]);
    }
    return count;
}

/* Adds a times (1, cos n theta, sin n theta, ...) at a sample. */
static void add_basis(const dynamics_harmonics *b, size_t sample, double a, double *sum)
{
    double theta = 2 * M_PI * (double)sample / (double)b->samples;
    sum[0] += a;
    for (size_t n = 1; n <= b->harmonics; n++) {
        sum[2 * n - 1] += a * cos((double)n * theta);
        sum[2 * n] += a * sin((double)n * theta);
    }
}

/* Adds the edges to the Jacobian; each is an outer product. */
static void add_edges(dynamics_harmonics *b, size_t count, double *jacobian, size_t stride)
{
    size_t size = series_size(b);
    double *rows = b->trial, *columns = b->try, share = 1 / (double)b->samples;
    for (size_t k = 0; k < count; k++) {
        const dynamics_harmonics_edge *e = &b->edges[k];
        memset(rows, 0, size * sizeof *rows);
        memset(columns, 0, size * sizeof *columns);
        add_basis(b, e->i, share, rows);
        add_basis(b, e->j, share, rows);
        rows[0] *= 0.5;
        add_basis(b, e->i, e->after_i, columns);
        add_basis(b, e->j, e->after_j, columns);
        for (size_t n = 0; n < size; n++)
            for (size_t m = 0; m < size; m++)
                jacobian[n * stride + m] += rows[m] * columns[n];
    }
}

/* Fills the columns of the Jacobian for a_n and b_n with the derivatives of the spring force: the
   product of the stiffness, with harmonics P and Q, and cos n theta or sin n theta. */
static void fill_columns(const dynamics_harmonics *b, size_t n, double *a, double *z)
{
    const double *P = b->cosine, *Q = b->sine;
    a[0] = P[n];
    z[0] = Q[n];
    for (size_t m = 1; m <= b->harmonics; m++) {
        size_t apart = m > n ? m - n : n - m;
        double q = m > n ? Q[apart] : -Q[apart];
        a[2 * m - 1] = P[apart] + P[m + n];
        a[2 * m] = Q[m + n] + q;
        z[2 * m - 1] = Q[m + n] - q;
        z[2 * m] = P[apart] - P[m + n];
    }
}

static void fill_jacobian(dynamics_harmonics *b, double w, const double *x, double *jacobian,
                          size_t stride)
{
    size_t edges = stiffness_spectrum(b, x);
    jacobian[0] = b->cosine[0];
    for (size_t m = 1; m <= b->harmonics; m++) {
        jacobian[2 * m - 1] = 2 * b->cosine[m];
        jacobian[2 * m] = 2 * b->sine[m];
    }
    for (size_t n = 1; n <= b->harmonics; n++) {
        double *a = jacobian + (2 * n - 1) * stride, *z = a + stride, nw = (double)n * w;
        fill_columns(b, n, a, z);
        a[2 * n - 1] -= nw * nw;
        a[2 * n] -= 2 * b->excitation->zeta * nw;
        z[2 * n - 1] += 2 * b->excitation->zeta * nw;
        z[2 * n] -= nw * nw;
    }
    add_edges(b, edges, jacobian, stride);
}

void dynamics_harmonics_residual(dynamics_harmonics *b, double w, const double *x, double *residual,
                                 double *after_w, double *jacobian, size_t stride)
{
    force_spectrum(b, x);
    residual[0] = creal(b->spectrum[0]) - b->excitation->load;
    if (after_w)
        after_w[0] = 0;
    for (size_t n = 1; n <= b->harmonics; n++) {
        size_t i = 2 * n - 1, j = 2 * n;
        double nw = (double)n * w, c = 2 * b->excitation->zeta * nw;
        double damper_i = c * (x[j] - b->e_series[j]), damper_j = -c * (x[i] - b->e_series[i]);
        residual[i] = 2 * creal(b->spectrum[n]) - nw * nw * x[i] + damper_i;
        residual[j] = -2 * cimag(b->spectrum[n]) - nw * nw * x[j] + damper_j;
        if (after_w) {
            after_w[i] = -2 * nw * nw * x[i] + damper_i;
            after_w[j] = -2 * nw * nw * x[j] + damper_j;
        }
    }
    if (jacobian)
        fill_jacobian(b, w, x, jacobian, stride);
}

static double largest_of(const double *x, size_t count)
{
    double largest = 0;
    for (size_t i = 0; i < count; i++)
        largest = fmax(largest, fabs(x[i]));
    return largest;
}

static double norm_of(const double *x, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += x[i] * x[i];
    return sqrt(sum);
}

/* Solves for Newton's correction, which replaces the residual. The correction is to be subtracted
   from the series. */
static int solve_correction(dynamics_harmonics *b)
{
    lapack_int size = (lapack_int)series_size(b);
    return LAPACKE_dgesv(LAPACK_COL_MAJOR, size, 1, b->jacobian, size, b->pivot, b->residual,
                         size) == 0 &&
           isfinite(norm_of(b->residual, series_size(b)));
}

/* Subtracts the correction, and halves it until the residual decreases. */
static int search_line(dynamics_harmonics *b, double w, double *x, double before)
{
    size_t size = series_size(b);
    double share = 1;
    for (int n = 0; n <= MAX_HALVINGS; n++, share *= 0.5) {
        for (size_t i = 0; i < size; i++)
            b->try[i] = x[i] - share * b->residual[i];
        dynamics_harmonics_residual(b, w, b->try, b->trial, NULL, NULL, 0);
        if (norm_of(b->trial, size) < before) {
            memcpy(x, b->try, size * sizeof *x);
            return 1;
        }
    }
    return 0;
}

dynamics_newton dynamics_harmonics_solve(dynamics_harmonics *b, double w, double *x, double *step)
{
    size_t size = series_size(b);
    for (int n = 0; n < MAX_NEWTON; n++) {
        dynamics_harmonics_residual(b, w, x, b->residual, NULL, b->jacobian, size);
        double before = norm_of(b->residual, size);
        *step = 0;
        if (before <= round_off)
            return DYNAMICS_NEWTON_DONE;
        if (!isfinite(before))
            return DYNAMICS_NEWTON_FAILED;
        if (!solve_correction(b))
            return DYNAMICS_NEWTON_SINGULAR;
        double unit = 1 + largest_of(x, size);
        *step = largest_of(b->residual, size);
        if (!search_line(b, w, x, before))
            return *step < nearly_converged * unit ? DYNAMICS_NEWTON_DONE : DYNAMICS_NEWTON_FAILED;
        if (*step < converged * unit)
            return DYNAMICS_NEWTON_DONE;
    }
    return DYNAMICS_NEWTON_FAILED;
}

dynamics_newton dynamics_harmonics_correction(dynamics_harmonics *b, double w, const double *x,
                                              double *largest)
{
    dynamics_harmonics_residual(b, w, x, b->residual, NULL, b->jacobian, series_size(b));
    *largest = 0;
    if (norm_of(b->residual, series_size(b)) <= round_off)
        return DYNAMICS_NEWTON_DONE;
    if (!solve_correction(b))
        return DYNAMICS_NEWTON_SINGULAR;
    *largest = largest_of(b->residual, series_size(b));
    return DYNAMICS_NEWTON_DONE;
}

double dynamics_harmonics_neglected(dynamics_harmonics *b, double w, const double *x)
{
    double sum = 0, zeta = b->excitation->zeta;
    force_spectrum(b, x);
    for (size_t n = b->harmonics + 1; n <= 2 * b->harmonics; n++) {
        double nw = (double)n * w;
        sum += 2 * cabs(b->spectrum[n]) / fmax(hypot(nw * nw - 1, 2 * zeta * nw), 1e-6);
    }
    return sum;
}

void dynamics_harmonics_analyse(dynamics_harmonics *b, const double *s, double *x)
{
    memcpy(b->time, s, b->samples * sizeof *s);
    transform_samples(b);
    x[0] = creal(b->spectrum[0]);
    for (size_t n = 1; n <= b->harmonics; n++) {
        x[2 * n - 1] = 2 * creal(b->spectrum[n]);
        x[2 * n] = -2 * cimag(b->spectrum[n]);
    }
}

void dynamics_fourier_at(const double *x, size_t harmonics, double theta, double *s, double *slope)
{
    double turn_x = cos(theta), turn_y = sin(theta), c = 1, d = 0;
    *s = x[0];
    *slope = 0;
    for (size_t n = 1; n <= harmonics; n++) {
        double m = (double)n, a = x[2 * n - 1], z = x[2 * n], keep = c;
        c = n % 64 ? keep * turn_x - d * turn_y : cos(m * theta);
        d = n % 64 ? keep * turn_y + d * turn_x : sin(m * theta);
        *s += a * c + z * d;
        *slope += m * (z * c - a * d);
    }
}

void dynamics_fourier_resize(const double *from, size_t from_harmonics, double *to,
                             size_t to_harmonics)
{
    size_t size = 2 * to_harmonics + 1, had = 2 * from_harmonics + 1;
    for (size_t i = 0; i < size; i++)
        to[i] = i < had ? from[i] : 0;
}

double dynamics_fourier_rms(const double *x, size_t harmonics)
{
    return norm_of(x + 1, 2 * harmonics) / sqrt(2);
}
