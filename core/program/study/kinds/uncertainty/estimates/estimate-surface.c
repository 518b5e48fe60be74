/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Shares of the inputs in a variance, from a surface through samples. The surface is a sum of
 * products of polynomials, each orthonormal for the distribution of its input (polynomial chaos:
 * Sudret 2008, Reliab. Eng. Syst. Saf. 93, 964). Its variance is the sum of its squared
 * coefficients, and a coefficient belongs to the inputs of its product. Regression determines the
 * coefficients; the surface with the least error at left-out samples is used. Missing terms are
 * orthogonal to the terms of the surface, so the true share exceeds the share in the surface at
 * most by the remaining variance.
 *
 * The terms have mean 0, so their part can be subtracted from values without changing the mean. The
 * part of each value comes from a surface through the other values, so that the mean stays
 * unbiased.
 */
#include "estimate.h"

#include "../../../../memory/memory.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* With more samples than MOST_ROWS, further terms would be needed. */
enum { MOST_ROWS = 1024, MOST_TERMS = 160, MOST_DEGREE = 8, SPARE = 4 };

/* Limits of a surface: the degree of its polynomials, and the number of samples for each term. For
   a mean a higher degree is not used, since its terms are so large at the rarest samples that these
   samples would dominate. */
typedef struct limits {
    size_t degree;
    double samples_each;
} limits;

static const limits for_shares = {MOST_DEGREE, 4 / 3.}, for_means = {2, ESTIMATE_SAMPLES_EACH};
static const size_t no_input = SIZE_MAX;

/* A polynomial of one input, or a product of two. */
typedef struct term {
    size_t a, b; /* inputs; b is no_input if there is only one */
    size_t a_degree, b_degree;
} term;

typedef struct surface {
    size_t count;
    term terms[MOST_TERMS];
    /* coefficients, and their squared errors */
    double coefficient[MOST_TERMS], variance[MOST_TERMS];
    double rest;    /* mean square of the residuals, for the remaining degrees of freedom */
    double missing; /* mean square of the residual at a sample that was left out of the fit */
    double freedom;
    double growth;
    double error; /* mean squares over the distribution: of the missing terms, and of the errors of
                   * the coefficients */
} surface;

/* Recurrence of orthonormal polynomials: step[j + 1] p[j + 1] = (x - middle[j]) p[j] - step[j]
   p[j - 1]. */
typedef struct recurrence {
    size_t degree;
    double middle[MOST_DEGREE + 1], step[MOST_DEGREE + 1];
} recurrence;

/* Recurrence for discrete values of equal probability: Stieltjes' procedure (Gautschi 2004,
 * Orthogonal Polynomials, 2.2). */
static recurrence recurrence_of_steps(const estimate_input *input)
{
    recurrence r = {0};
    double n = (double)input->steps, *p = memory_alloc(input->steps * sizeof *p),
           *before = memory_alloc(input->steps * sizeof *before);
    for (size_t i = 0; i < input->steps; i++) {
        p[i] = 1;
        before[i] = 0;
    }
    for (r.degree = 0;; r.degree++) {
        double squares = 0, middle = 0;
        for (size_t i = 0; i < input->steps; i++)
            middle += (double)input->step[i] * p[i] * p[i] / n;
        r.middle[r.degree] = middle;
        for (size_t i = 0; i < input->steps; i++) {
            double next = ((double)input->step[i] - middle) * p[i] - r.step[r.degree] * before[i];
            before[i] = p[i];
            p[i] = next;
            squares += next * next / n;
        }
        if (r.degree == MOST_DEGREE || !(squares > 1e-18))
            break;
        r.step[r.degree + 1] = sqrt(squares);
        for (size_t i = 0; i < input->steps; i++)
            p[i] /= sqrt(squares);
    }
    free(p);
    free(before);
    return r;
}

/* Recurrence of Hermite's polynomials for a normal number, or of Legendre's for one uniform from -1
 * to 1. */
static recurrence recurrence_of(const estimate_input *input)
{
    recurrence r = {.degree = MOST_DEGREE};
    if (input->shape == ESTIMATE_STEPS)
        return recurrence_of_steps(input);
    for (size_t j = 1; j <= MOST_DEGREE; j++) {
        double n = (double)j;
        r.step[j] = input->shape == ESTIMATE_EVEN ? n / sqrt(4 * n * n - 1) : sqrt(n);
    }
    return r;
}

/* Returns the variable of an input's polynomials at a standard normal number. */
static double coordinate(const estimate_input *input, double z)
{
    double share = gsl_cdf_ugaussian_P(z);
    size_t at = (size_t)(share * (double)input->steps);
    if (input->shape == ESTIMATE_STEPS)
        return (double)input->step[at < input->steps ? at : input->steps - 1];
    return input->shape == ESTIMATE_EVEN ? 2 * share - 1 : z;
}

/* Samples to which surfaces are fitted: the known values, and the polynomials of the inputs. */
typedef struct rows {
    size_t count, inputs, width; /* width: polynomials of a row */
    recurrence of[ESTIMATE_MOST_INPUTS];
    const estimate_input *input;
    double *value, *polynomial;
    size_t *sample; /* index of each sample */
} rows;

/* Fills the polynomials of all inputs at the numbers of a sample. */
static void evaluate(const rows *of, const double *numbers, double *polynomial)
{
    for (size_t k = 0; k < of->inputs; k++) {
        const recurrence *r = &of->of[k];
        double x = coordinate(&of->input[k], numbers[k]), *p = polynomial + k * (MOST_DEGREE + 1);
        p[0] = 1;
        for (size_t j = 0; j < r->degree; j++)
            p[j + 1] =
                ((x - r->middle[j]) * p[j] - (j ? r->step[j] * p[j - 1] : 0)) / r->step[j + 1];
    }
}

/* Leaves out samples with unknown values. */
static rows rows_open(const double *values, const double *numbers, size_t count,
                      const estimate_input *inputs, size_t input_count)
{
    size_t most = count < MOST_ROWS ? count : MOST_ROWS;
    rows of = {.inputs = input_count, .width = input_count * (MOST_DEGREE + 1), .input = inputs};
    of.value = memory_alloc((most + 1) * sizeof *of.value);
    of.sample = memory_alloc((most + 1) * sizeof *of.sample);
    of.polynomial = memory_alloc((most * of.width + 1) * sizeof *of.polynomial);
    for (size_t k = 0; k < input_count; k++)
        of.of[k] = recurrence_of(&inputs[k]);
    for (size_t i = 0; i < count && of.count < most; i++) {
        if (!isfinite(values[i]))
            continue;
        evaluate(&of, numbers + i * input_count, of.polynomial + of.count * of.width);
        of.value[of.count] = values[i];
        of.sample[of.count++] = i;
    }
    return of;
}

static void rows_close(rows *of)
{
    free(of->value);
    free(of->sample);
    free(of->polynomial);
}

/* Fills a row of the regression: 1, then the terms. */
static void fill(const surface *s, const double *polynomial, double *x)
{
    x[0] = 1;
    for (size_t t = 0; t < s->count; t++) {
        const term *one = &s->terms[t];
        x[t + 1] = polynomial[one->a * (MOST_DEGREE + 1) + one->a_degree];
        if (one->b != no_input)
            x[t + 1] *= polynomial[one->b * (MOST_DEGREE + 1) + one->b_degree];
    }
}

/* Replaces the lower half of a matrix by its Cholesky factor; false if columns depend on each
   other. */
static bool factorise(double *m, size_t n)
{
    double whole[MOST_TERMS + 1];
    for (size_t j = 0; j < n; j++)
        whole[j] = m[j * n + j];
    gsl_matrix_view view = gsl_matrix_view_array(m, n, n);
    gsl_error_handler_t *before = gsl_set_error_handler_off(); /* GSL's handler would end the
                                                                * process */
    bool good = gsl_linalg_cholesky_decomp1(&view.matrix) == GSL_SUCCESS;
    gsl_set_error_handler(before);
    for (size_t j = 0; good && j < n; j++)
        good = m[j * n + j] * m[j * n + j] > 1e-10 * whole[j];
    return good;
}

static void solve(const double *m, size_t n, double *x)
{
    gsl_matrix_const_view factor = gsl_matrix_const_view_array(m, n, n);
    gsl_vector_view of = gsl_vector_view_array(x, n);
    gsl_linalg_cholesky_svx(&factor.matrix, &of.vector);
}

static double product(const double *a, const double *b, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

/* Returns the variance of the constant term, relative to the variance of a mean of independent
 * residuals. */
static double growth_of(const rows *of, size_t n, const double *gain, const double *ahead)
{
    double constant = 0, mean = 0;
    for (size_t i = 0; i < of->count; i++) {
        constant += pow(gain[i * n] * ahead[i], 2);
        mean += pow(ahead[i] / (double)of->count, 2);
    }
    return mean > 0 ? fmax(1, constant / mean) : 1;
}

/* Computes the errors of the coefficients from the residual at each sample if it is left out of the
 * fit (HC3: MacKinnon & White 1985, J. Econometrics 29, 305). These errors are valid both for noise
 * and for terms that the fit lacks. `x` and `gain` have a row for each sample; a coefficient is the
 * sum of gain and value. `part`, unless it is NULL, receives the part of each value that the terms
 * explain in a fit to all other values: beta_(-i) = beta - A^-1 x_i e_i / (1 - h_i) (Sherman &
 * Morrison 1950). */
static bool judge(const rows *of, surface *s, const double *x, const double *gain, double *part)
{
    size_t n = s->count + 1;
    double all[MOST_TERMS + 1] = {0}, ahead[MOST_ROWS], squares = 0, sum = 0;
    for (size_t i = 0; i < of->count; i++)
        for (size_t t = 0; t < n; t++)
            all[t] += gain[i * n + t] * of->value[i];
    for (size_t i = 0; i < of->count; i++) {
        double rest = of->value[i] - product(all, x + i * n, n);
        double free = 1 - product(gain + i * n, x + i * n, n);
        if (!(free > 1e-6))
            return false;
        squares += rest * rest;
        ahead[i] = rest / free;
        sum += ahead[i] * ahead[i];
        if (part)
            part[i] = product(all + 1, x + i * n + 1, s->count) -
                      ahead[i] * product(gain + i * n + 1, x + i * n + 1, s->count);
        for (size_t t = 1; t < n; t++)
            s->variance[t - 1] += pow(gain[i * n + t] * ahead[i], 2);
    }
    memcpy(s->coefficient, all + 1, s->count * sizeof *all);
    s->freedom = (double)(of->count - n);
    s->rest = squares / s->freedom;
    s->error = s->missing = sum / (double)of->count;
    s->growth = growth_of(of, n, gain, ahead);
    for (size_t t = 0; t < s->count; t++)
        s->error += s->variance[t];
    return true;
}

/* Returns false if there are too few samples for the terms. */
static bool fit(const rows *of, surface *s, double samples_each, double *part)
{
    size_t n = s->count + 1;
    if (of->count < n + SPARE || (double)of->count < samples_each * (double)n)
        return false;
    double *m = memory_alloc(n * n * sizeof *m), *x = memory_alloc(of->count * n * sizeof *x),
           *gain = memory_alloc(of->count * n * sizeof *gain);
    memset(m, 0, n * n * sizeof *m);
    memset(s->variance, 0, sizeof s->variance);
    for (size_t i = 0; i < of->count; i++) {
        double *own = x + i * n;
        fill(s, of->polynomial + i * of->width, own);
        for (size_t a = 0; a < n; a++)
            for (size_t b = 0; b <= a; b++)
                m[a * n + b] += own[a] * own[b];
    }
    bool good = factorise(m, n);
    memcpy(gain, x, of->count * n * sizeof *gain);
    for (size_t i = 0; good && i < of->count; i++)
        solve(m, n, gain + i * n);
    good = good && judge(of, s, x, gain, part);
    free(m);
    free(x);
    free(gain);
    return good;
}

static bool add(surface *s, term one)
{
    if (s->count == MOST_TERMS)
        return false;
    s->terms[s->count++] = one;
    return true;
}

/* Lists the terms: powers of every single input up to a degree, and products of the first inputs of
 * `ranks` up to a degree. */
static bool list_terms(const rows *of, surface *s, size_t degree, size_t joint, size_t first,
                       const size_t *ranks)
{
    s->count = 0;
    for (size_t k = 0; k < of->inputs; k++)
        for (size_t j = 1; j <= degree && j <= of->of[k].degree; j++)
            if (!add(s, (term){k, no_input, j, 0}))
                return false;
    for (size_t k = 0; k < first && k < of->inputs; k++)
        for (size_t l = 0; l < k; l++)
            for (size_t i = 1; i < joint && i <= of->of[ranks[k]].degree; i++)
                for (size_t j = 1; i + j <= joint && j <= of->of[ranks[l]].degree; j++)
                    if (!add(s, (term){ranks[k], ranks[l], i, j}))
                        return false;
    return true;
}

/* Ranks the inputs by their effect alone. */
static void rank(const rows *of, const surface *s, size_t *ranks)
{
    double part[ESTIMATE_MOST_INPUTS] = {0};
    for (size_t t = 0; t < s->count; t++)
        if (s->terms[t].b == no_input)
            part[s->terms[t].a] += s->coefficient[t] * s->coefficient[t];
    for (size_t k = 0; k < of->inputs; k++) {
        size_t at = k;
        for (; at > 0 && part[ranks[at - 1]] < part[k]; at--)
            ranks[at] = ranks[at - 1];
        ranks[at] = k;
    }
}

/* Chooses a surface with more terms if its error is at least a tenth smaller. Returns false if no
 * surface is better than the mean of the samples. */
static bool find_surface(const rows *of, const limits *most, surface *best)
{
    static const size_t degrees[] = {1, 2, 3, 4, 6, MOST_DEGREE},
                        firsts[] = {2, 4, ESTIMATE_MOST_INPUTS};
    const double less = 0.9, nothing = 1e-20;
    surface next = {0};
    best->count = 0;
    size_t ranks[ESTIMATE_MOST_INPUTS] = {0};
    if (!fit(of, &next, most->samples_each, NULL))
        return false;
    double all = next.error;
    best->error = all;
    for (size_t d = 0; d < sizeof degrees / sizeof *degrees && degrees[d] <= most->degree &&
                       best->error > nothing * all;
         d++) {
        if (!list_terms(of, &next, degrees[d], 0, 0, ranks) ||
            !fit(of, &next, most->samples_each, NULL))
            break;
        rank(of, &next, ranks);
        if (next.error < less * best->error)
            *best = next;
        for (size_t joint = 2; joint <= degrees[d] || joint == 2; joint++)
            for (size_t f = 0; f < sizeof firsts / sizeof *firsts; f++)
                if (list_terms(of, &next, degrees[d], joint, firsts[f], ranks) &&
                    fit(of, &next, most->samples_each, NULL) && next.error < less * best->error)
                    *best = next;
    }
    return best->count > 0;
}

/* The sum of squared coefficients for a share, or for all others: without the contribution of
 * chance, and with both ends of its interval. */
typedef struct portion {
    double squares, errors, value;
} portion;

static void join(portion *p, double coefficient, double variance)
{
    p->squares += coefficient * coefficient;
    p->errors += variance;
    p->value += fmax(0, coefficient * coefficient - variance);
}

static double end_of(const portion *p, double reach)
{
    return pow(fmax(0, sqrt(p->squares) + reach * sqrt(p->errors)), 2);
}

/* Computes a share and its interval. The ends of both sums are combined as in MOVER (Newcombe 1998,
 * Stat. Med. 17, 873). The missing variance may belong to the share. */
static estimate share_of(const surface *s, const portion *own, const portion *others)
{
    const double nothing = 1e-12;
    double t = gsl_cdf_tdist_Pinv(0.975, s->freedom), rest = others->value + s->rest;
    double whole = own->value + rest, least = end_of(own, -t), most = end_of(own, t);
    double value = own->value > nothing * whole ? own->value / whole : 0;
    double less = end_of(others, -t) + s->rest, more = end_of(others, t) + s->missing;
    double down =
        hypot(value - least / (least + rest), value - value * whole / (value * whole + more));
    double up = hypot(most / (most + rest) - value, value * whole / (value * whole + less) - value);
    if (value == 0)
        up = fmax(0, most > nothing * whole ? most / (most + rest) : 0);
    return (estimate){value, fmax(0, value - down), fmin(1, value + up + s->missing / whole),
                      (double)NAN};
}

size_t estimate_shares(const double *values, const double *numbers, size_t count,
                       const estimate_input *inputs, size_t input_count, size_t groups,
                       estimate *first, estimate *total)
{
    rows of = rows_open(values, numbers, count, inputs, input_count);
    surface *best = memory_alloc(sizeof *best);
    bool found = find_surface(&of, &for_shares, best);
    for (size_t g = 0; g < groups; g++) {
        portion alone = {0}, not_alone = {0}, with = {0}, without = {0};
        first[g] = total[g] = (estimate){(double)NAN, (double)NAN, (double)NAN, (double)NAN};
        for (size_t t = 0; found && t < best->count; t++) {
            const term *one = &best->terms[t];
            bool a = inputs[one->a].group == g,
                 b = one->b == no_input ? a : inputs[one->b].group == g;
            double c = best->coefficient[t], v = best->variance[t];
            join(a && b ? &alone : &not_alone, c, v);
            join(a || b ? &with : &without, c, v);
        }
        if (found) {
            first[g] = share_of(best, &alone, &not_alone);
            total[g] = share_of(best, &with, &without);
        }
    }
    free(best);
    rows_close(&of);
    return of.count;
}

estimate_explanation estimate_explained(const double *values, const double *numbers, size_t count,
                                        const estimate_input *inputs, size_t input_count,
                                        double *part)
{
    estimate_explanation found = {1, 1, 0};
    estimate_moments m = estimate_pairs(values, values, count, NULL, 0);
    for (size_t i = 0; i < count; i++)
        part[i] = isfinite(values[i]) ? 0 : (double)NAN;
    if (input_count == 0 || !(m.aa > 0))
        return found;
    rows of = rows_open(values, numbers, count, inputs, input_count);
    surface *best = memory_alloc(sizeof *best);
    double *polynomial = memory_alloc(of.width * sizeof *polynomial), x[MOST_TERMS + 1],
           *own = memory_alloc((of.count + 1) * sizeof *own);
    if (find_surface(&of, &for_means, best) && fit(&of, best, for_means.samples_each, own)) {
        found = (estimate_explanation){fmin(1, best->missing * best->growth * (m.count - 1) / m.aa),
                                       best->growth, best->count};
        for (size_t i = of.sample[of.count - 1] + 1; i < count; i++) {
            evaluate(&of, numbers + i * input_count, polynomial);
            fill(best, polynomial, x);
            part[i] += product(best->coefficient, x + 1, best->count);
        }
        for (size_t i = 0; i < of.count; i++)
            part[of.sample[i]] = own[i];
    }
    free(polynomial);
    free(own);
    free(best);
    rows_close(&of);
    return found;
}
