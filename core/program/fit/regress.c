/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Finds parameters and their confidence intervals. The residuals are those of ln(eta), that is
 * relative deviations, since the error of a viscometer is relative.
 */
#include "search.h"

#include "../memory/memory.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_linalg.h>

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Parameters cannot be distinguished if the smallest singular value of the scaled derivatives is
   below RANK times the largest. A parameter is one of them if its component in the corresponding
   singular vector is at least SHARE. */
static const double RANK = 1e-6, SHARE = 0.05;

static const fit_param *param_of(const fit_search *s, size_t param)
{
    return &s->law->params[param];
}

FF_PRINTF(2, 3)
static void add_note(fit_law *law, const char *format, ...)
{
    size_t at = strlen(law->note);
    va_list args;
    if (at && at + 1 < sizeof law->note)
        law->note[at++] = '\n';
    va_start(args, format);
    vsnprintf(law->note + at, sizeof law->note - at, format, args);
    va_end(args);
}

FF_PRINTF(2, 3)
static bool fail(fit_law *law, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(law->why, sizeof law->why, format, args);
    va_end(args);
    return false;
}

/* Prints a value in the row's unit: "1.05 GPa". */
static const char *print_value(const fit_param *param, double si, char out[64])
{
    bool bare = !strcmp(param->row->unit, "1") || !*param->row->unit;
    snprintf(out, 64, "%.4g%s%s", ff_unit_from_si(param->unit, si), bare ? "" : " ",
             bare ? "" : param->row->unit);
    return out;
}

static bool same_group(const ff_param *a, const ff_param *b)
{
    return a->group && b->group && !strcmp(a->group, b->group);
}

/* Returns whether a parameter is to be found: it has no preset, or is the first number of a
   required group, and the user has not set it. */
static bool is_free(const fit_law *law, size_t index)
{
    const fit_param *param = &law->params[index];
    if (param->row->type != FF_REAL || param->asked != FIT_PRESET)
        return param->asked == FIT_FREE;
    bool required = !param->row->preset;
    for (size_t i = 0; i < law->param_count; i++) {
        const fit_param *other = &law->params[i];
        if (i == index || !same_group(param->row, other->row))
            continue;
        if (other->asked != FIT_PRESET || (i < index && other->row->type == FF_REAL))
            return false;
        required = required && !other->row->preset;
    }
    return required;
}

/* Returns whether the parameter would be given by an oil, such as Roelands' s0, and must also be
 * found because the data have several temperatures. */
static bool is_thermal(const fit_data *d, const fit_param *param)
{
    const ff_param *row = param->row;
    return !d->isothermal && param->asked == FIT_PRESET && row->type == FF_REAL && row->instead &&
           row->preset;
}

/* Returns whether the parameter is the reference temperature `at` of a law. Its value is the mean
   temperature of the data. */
static bool is_reference(const fit_data *d, const fit_param *param)
{
    return !d->isothermal && param->asked == FIT_PRESET && param->row->type == FF_REAL &&
           !strcmp(param->row->name, "at");
}

static double mean_temperature(const fit_data *d)
{
    double sum = 0;
    for (size_t i = 0; i < d->n; i++)
        sum += d->T[i];
    return sum / (double)d->n;
}

/* Sets up the free parameters. The law has the values set by the user. pressure_cap is fixed at the
   highest pressure of the data, so that the law itself warns if it is used beyond it. */
static bool choose_free(fit_search *s)
{
    fit_law *law = s->law;
    for (size_t i = 0; i < law->param_count; i++) {
        fit_param *param = &law->params[i];
        s->values[i] = NAN;
        if (param->asked == FIT_FREE && param->row->type != FF_REAL)
            return fail(law, "%s is not a number and cannot be found", param->row->name);
        if (is_free(law, i) || is_thermal(s->data, param)) {
            if (s->count == FIT_MOST_FREE)
                return fail(law, "it has more than %d parameters to find", FIT_MOST_FREE);
            s->axes[s->count++] = fit_axis_of(param, i);
            param->found = FIT_FREE;
        } else if (is_reference(s->data, param)) {
            s->values[i] = param->value = mean_temperature(s->data);
            param->found = FIT_HELD;
        } else if (param->asked == FIT_PRESET && param->row->type == FF_REAL &&
                   !strcmp(param->row->name, "pressure_cap") &&
                   s->data->highest >= ff_unit_to_si(param->unit, param->row->min)) {
            s->values[i] = param->value = s->data->highest;
            param->found = FIT_HELD;
        }
    }
    return s->count > 0 || fail(law, "it has no parameter to find");
}

static size_t count_distinct(const fit_data *d)
{
    size_t count = 0;
    for (size_t i = 0; i < d->n; i++) {
        size_t k = 0;
        while (k < i && (d->p[k] != d->p[i] || (d->T && d->T[k] != d->T[i])))
            k++;
        count += k == i;
    }
    return count;
}

static bool has_enough_points(const fit_search *s)
{
    size_t points = count_distinct(s->data);
    return (s->data->n >= s->count + 3 && points >= s->count + 1) ||
           fail(s->law,
                "%zu parameters need %zu rows at %zu different pressures at least, but there "
                "are %zu at %zu; fix some with --set",
                s->count, s->count + 3, s->count + 1, s->data->n, points);
}

/* Returns whether the law depends on temperature, that is, gives different viscosities at the
 * lowest and the highest one. */
static bool depends_on_temperature(fit_search *s, const double *x)
{
    const fit_data *d = s->data;
    double p[2] = {0, 0}, T[2] = {d->T[0], d->T[0]}, ln_eta[2];
    for (size_t i = 0; i < d->n; i++) {
        T[0] = fmin(T[0], d->T[i]);
        T[1] = fmax(T[1], d->T[i]);
    }
    for (size_t j = 0; j < s->count; j++)
        s->values[s->axes[j].param] = fit_axis_value(&s->axes[j], x[j]);
    return fit_law_eval(s->fit, s->law, s->values, 2, p, T, ln_eta) &&
           fabs(ln_eta[1] - ln_eta[0]) > 1e-9;
}

/* Fixes a parameter, so that the search no longer varies it. */
static void fix(fit_search *s, size_t axis, double value, fit_state found)
{
    size_t param = s->axes[axis].param;
    s->values[param] = s->law->params[param].value = value;
    s->law->params[param].found = found;
    memmove(&s->axes[axis], &s->axes[axis + 1], (s->count - axis - 1) * sizeof *s->axes);
    s->count--;
}

/* Fixes a parameter whose search ended at a limit. Returns false if there is none. */
static bool fix_at_limit(fit_search *s, const double *x)
{
    char text[64];
    for (size_t j = 0; j < s->count; j++) {
        const fit_axis *axis = &s->axes[j];
        double near = axis->log ? 1e-4 : 1e-4 * (axis->to - axis->from);
        if (x[j] > axis->low + near && x[j] < axis->high - near)
            continue;
        const fit_param *param = param_of(s, axis->param);
        double value = x[j] > axis->low + near ? fit_axis_value(axis, axis->high) : axis->least;
        add_note(s->law,
                 "%s is at its limit, %s: the data fit better beyond it. The intervals hold for "
                 "that value.",
                 param->row->name, print_value(param, value, text));
        fix(s, j, value, FIT_AT_LIMIT);
        return true;
    }
    return false;
}

/* The derivatives as U S V^T, each column scaled to unit length. */
typedef struct decomposition {
    gsl_matrix *U, *V;
    gsl_vector *S;
    double length[FIT_MOST_FREE];
} decomposition;

static void decomposition_free(decomposition *d)
{
    gsl_matrix_free(d->U);
    gsl_matrix_free(d->V);
    gsl_vector_free(d->S);
}

static void decompose(fit_search *s, const double *x, decomposition *d)
{
    size_t n = s->data->n, k = s->count;
    d->U = gsl_matrix_alloc(n, k);
    d->V = gsl_matrix_alloc(k, k);
    d->S = gsl_vector_alloc(k);
    fit_search_jacobian(s, x, d->U->data);
    for (size_t j = 0; j < k; j++) {
        double sum = 0;
        for (size_t i = 0; i < n; i++)
            sum += gsl_matrix_get(d->U, i, j) * gsl_matrix_get(d->U, i, j);
        d->length[j] = sum > 0 ? sqrt(sum) : 1;
        for (size_t i = 0; i < n; i++)
            gsl_matrix_set(d->U, i, j, gsl_matrix_get(d->U, i, j) / d->length[j]);
    }
    gsl_linalg_SV_decomp_jacobi(d->U, d->V, d->S);
}

/* Fixes one of the parameters that the data cannot distinguish: the one with the narrowest
   calibrated range, at the middle of it. Returns false if all can be distinguished. */
static bool fix_undetermined(fit_search *s, const decomposition *d)
{
    size_t last = s->count - 1, narrowest = 0;
    char names[300] = "", text[64];
    double least = HUGE_VAL;
    if (gsl_vector_get(d->S, last) > RANK * gsl_vector_get(d->S, 0))
        return false;
    for (size_t j = 0; j < s->count; j++) {
        const fit_axis *axis = &s->axes[j];
        double middle = (axis->from + axis->to) / 2;
        double width = (axis->to - axis->from) / (axis->log ? 1 : fabs(middle));
        if (fabs(gsl_matrix_get(d->V, j, last)) < SHARE)
            continue;
        size_t at = strlen(names);
        snprintf(names + at, sizeof names - at, "%s%s", at ? ", " : "",
                 param_of(s, axis->param)->row->name);
        if (width < least) {
            least = width;
            narrowest = j;
        }
    }
    const fit_axis *axis = &s->axes[narrowest];
    const fit_param *param = param_of(s, axis->param);
    double value = fit_axis_value(axis, (axis->from + axis->to) / 2);
    print_value(param, value, text);
    if (strchr(names, ','))
        add_note(
            s->law,
            "%s is fixed at %s: these data cannot distinguish %s. Fix what you know with --set.",
            param->row->name, text, names);
    else
        add_note(s->law, "%s is fixed at %s: the data do not determine it.", param->row->name,
                 text);
    fix(s, narrowest, value, FIT_HELD);
    return true;
}

/* Returns the covariance of two parameters in the coordinates of the search, without the variance
   of the data: (J^T J)^-1 = V S^-2 V^T. */
static double covariance(const decomposition *d, size_t i, size_t j)
{
    double sum = 0;
    for (size_t m = 0; m < d->S->size; m++) {
        double s = gsl_vector_get(d->S, m);
        sum += gsl_matrix_get(d->V, i, m) * gsl_matrix_get(d->V, j, m) / (s * s);
    }
    return sum / (d->length[i] * d->length[j]);
}

/* Sets the values, their intervals by Student's t with n - k degrees of freedom, and correlations.
 */
static void estimate_intervals(const fit_search *s, const double *x, const decomposition *d,
                               double sum)
{
    size_t k = s->count;
    double freedom = (double)(s->data->n - k), variance = sum / freedom;
    double t = gsl_cdf_tdist_Pinv(0.975, freedom);
    for (size_t i = 0; i < k; i++) {
        const fit_axis *axis = &s->axes[i];
        fit_param *param = &s->law->params[axis->param];
        double half = t * sqrt(variance * covariance(d, i, i));
        param->value = fit_axis_value(axis, x[i]);
        param->low = fit_axis_value(axis, x[i] - half);
        param->high = fit_axis_value(axis, x[i] + half);
        for (size_t j = 0; j < k; j++)
            s->law->correlation[axis->param * s->law->param_count + s->axes[j].param] =
                covariance(d, i, j) / sqrt(covariance(d, i, i) * covariance(d, j, j));
    }
}

/* Adds a remark for each parameter with an interval wider than 1.5 times its value, and names the
   parameter with which it is most correlated. */
static void note_loose(const fit_search *s)
{
    for (size_t i = 0; i < s->count; i++) {
        const fit_axis *axis = &s->axes[i];
        const fit_param *param = param_of(s, axis->param), *partner = NULL;
        double strongest = 0;
        for (size_t j = 0; j < s->count; j++) {
            double c = s->law->correlation[axis->param * s->law->param_count + s->axes[j].param];
            if (j != i && fabs(c) > fabs(strongest)) {
                strongest = c;
                partner = param_of(s, s->axes[j].param);
            }
        }
        if (param->high - param->low <= 1.5 * fabs(param->value))
            continue;
        if (partner && fabs(strongest) > 0.9)
            add_note(s->law, "%s is badly determined; its correlation with %s is %.4f.",
                     param->row->name, partner->row->name, strongest);
        else
            add_note(s->law, "%s is badly determined.", param->row->name);
    }
}

static void note_range(const fit_search *s)
{
    for (size_t i = 0; i < s->count; i++) {
        const fit_axis *axis = &s->axes[i];
        const fit_param *param = param_of(s, axis->param);
        double number = ff_unit_from_si(param->unit, param->value);
        const ff_param *row = param->row;
        if (row->low < row->high && (number < row->low || number > row->high))
            add_note(s->law, "%s is outside its calibrated range, %g to %g%s%s.", row->name,
                     row->low, row->high, strcmp(row->unit, "1") ? " " : "",
                     strcmp(row->unit, "1") ? row->unit : "");
    }
}

typedef struct point {
    double p, residual;
} point;

/* Counts runs of residuals with one sign along the pressure (Wald & Wolfowitz 1940). If there
   are fewer runs than in 99 % of random sequences, the form of the law differs from that of the
   data. */
static void note_pattern(const fit_data *d, fit_law *law)
{
    point *points = memory_alloc(d->n * sizeof *points);
    double plus = 0, minus = 0, runs = 1;
    for (size_t i = 0; i < d->n; i++)
        points[i] = (point){d->p[i], law->residual[i]};
    memory_sort(points, d->n, sizeof *points);
    for (size_t i = 0; i < d->n; i++) {
        bool up = points[i].residual > 0;
        plus += up;
        minus += !up;
        runs += i > 0 && up != (points[i - 1].residual > 0);
    }
    free(points);
    double n = plus + minus, mean = 2 * plus * minus / n + 1;
    double variance = (mean - 1) * (mean - 2) / (n - 1);
    if (law->rms > 1e-6 && n > 7 && (variance <= 0 || runs < mean - 2.33 * sqrt(variance)))
        add_note(law,
                 "The residuals follow a pattern: the law has another form than the data, and its "
                 "intervals mean little.");
}

/* Computes the deviation of the data from the law, eta/eta_law - 1, and Akaike's corrected
   criterion AICc, which counts the variance as a parameter (Hurvich & Tsai 1989). */
static void measure(const fit_search *s, const double *weighted)
{
    fit_law *law = s->law;
    const fit_data *d = s->data;
    double sum = 0, squares = 0, n = (double)d->n, k = (double)s->count + 1;
    for (size_t i = 0; i < d->n; i++) {
        law->residual[i] = -weighted[i] / d->root[i];
        double off = expm1(law->residual[i]);
        squares += off * off;
        sum += weighted[i] * weighted[i];
        if (fabs(off) > fabs(law->largest) || i == 0) {
            law->largest = off;
            law->largest_row = d->row[i];
        }
    }
    law->rms = sqrt(squares / n);
    law->criterion = n * log(fmax(sum / n, 1e-24)) + 2 * k + 2 * k * (k + 1) / (n - k - 1);
    if (d->uncertain) {
        double times = sqrt(sum / (n - k + 1)) / d->uncertainty;
        if (times > 1.5 || times < 0.67)
            add_note(law, "The residuals are %.2g times the stated uncertainty.", times);
    }
}

static bool take_result(fit_search *s, const double *x, const decomposition *d)
{
    fit_law *law = s->law;
    double sum = 0, *weighted = memory_alloc(s->data->n * sizeof *weighted);
    if (!fit_search_residuals(s, x, weighted)) {
        free(weighted);
        return fail(law, "no parameters were found");
    }
    for (size_t i = 0; i < s->data->n; i++)
        sum += weighted[i] * weighted[i];
    law->free_count = s->count;
    estimate_intervals(s, x, d, sum);
    note_loose(s);
    note_range(s);
    measure(s, weighted);
    note_pattern(s->data, law);
    free(weighted);
    double p = s->fit->at[FIT_PRESSURE], T = s->data->temperature;
    if (!isnan(p) && !s->data->isothermal)
        add_note(law,
                 "Its viscosity at that pressure also depends on temperature: add another --at.");
    if (!isnan(p) && s->data->isothermal &&
        fit_law_eval(s->fit, law, s->values, 1, &p, isnan(T) ? NULL : &T, &law->asked))
        law->asked = exp(law->asked);
    return true;
}

/* Searches until no parameter is at a limit and all free ones can be distinguished. */
static bool search(fit_search *s)
{
    fit_law *law = s->law;
    double x[FIT_MOST_FREE];
    while (s->count > 0) {
        if (!fit_search_run(s, x))
            return fail(law, "the search for the least squares did not converge%s%s",
                        law->refusal ? ": " : "", law->refusal ? law->refusal : "");
        if (!s->data->isothermal && !depends_on_temperature(s, x))
            return fail(law,
                        "it does not depend on temperature, but the data have several; choose one, "
                        "such as --at \"%g degC\"",
                        s->data->T[0] - 273.15);
        if (fix_at_limit(s, x))
            continue;
        decomposition d;
        decompose(s, x, &d);
        bool undetermined = fix_undetermined(s, &d);
        bool good = !undetermined && take_result(s, x, &d);
        decomposition_free(&d);
        if (!undetermined)
            return good;
    }
    return fail(law, "the data determine none of its parameters");
}

bool fit_regress(fit *f, fit_law *law)
{
    size_t params = law->param_count;
    fit_search s = {.fit = f,
                    .data = &f->data,
                    .law = law,
                    .values = memory_alloc((params + 1) * sizeof(double)),
                    .ln_eta = memory_alloc((f->data.n + 1) * sizeof(double))};
    law->correlation = memory_alloc((params * params + 1) * sizeof(double));
    law->residual = memory_alloc((f->data.n + 1) * sizeof(double));
    for (size_t i = 0; i < params * params; i++)
        law->correlation[i] = NAN;
    bool good = choose_free(&s) && has_enough_points(&s) && search(&s);
    free(s.values);
    free(s.ln_eta);
    return good;
}
