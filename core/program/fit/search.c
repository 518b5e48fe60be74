/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "search.h"

#include "../memory/memory.h"

#include <assert.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_qrng.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* SAMPLES: number of points at which the sum of squares is sampled. STARTS: number of the best of
   them, from which searches start. ITERATIONS: largest number per search. */
enum { SAMPLES = 64, STARTS = 4, ITERATIONS = 200 };

/* REFUSED: residual used where a law refuses its parameters. PENALTY: slope of the penalty beyond a
   limit. */
static const double REFUSED = 1e3, PENALTY = 10;

fit_axis fit_axis_of(const fit_param *param, size_t index)
{
    const ff_param *row = param->row;
    bool limited = row->min < row->max, calibrated = row->low < row->high;
    double min = limited ? ff_unit_to_si(param->unit, row->min) : -HUGE_VAL;
    double max = limited ? ff_unit_to_si(param->unit, row->max) : HUGE_VAL;
    double from = calibrated ? ff_unit_to_si(param->unit, row->low) : min;
    double to = calibrated ? ff_unit_to_si(param->unit, row->high) : max;
    fit_axis axis = {.param = index, .log = min >= 0 && to > 0, .least = min};
    if (!isfinite(from) || !isfinite(to)) {
        from = axis.log ? 0 : -fabs(param->unit->factor);
        to = fabs(param->unit->factor);
    }
    if (axis.log) { /* a range that begins at 0 becomes three decades */
        from = from > 0 ? from : 1e-3 * to;
        min = min > 0 ? min : 1e-9 * from;
        if (row->flags & FF_MIN_OPEN)
            axis.least = min;
        max = isfinite(max) ? max : 1e9 * to;
    }
    axis.low = axis.log ? log(min) : min;
    axis.high = axis.log ? log(max) : max;
    axis.from = axis.log ? log(from) : from;
    axis.to = axis.log ? log(to) : to;
    return axis;
}

double fit_axis_value(const fit_axis *axis, double x)
{
    assert(axis->low <= axis->high);
    x = x > axis->low ? x : axis->low;
    x = x < axis->high ? x : axis->high;
    return axis->log ? exp(x) : x;
}

bool fit_search_residuals(fit_search *s, const double *x, double *out)
{
    const fit_data *d = s->data;
    for (size_t j = 0; j < s->count; j++)
        s->values[s->axes[j].param] = fit_axis_value(&s->axes[j], x[j]);
    if (!fit_law_eval(s->fit, s->law, s->values, d->n, d->p, d->T, s->ln_eta))
        return false;
    for (size_t i = 0; i < d->n; i++) {
        out[i] = d->root[i] * (s->ln_eta[i] - d->ln_eta[i]);
        if (!isfinite(out[i]))
            return false;
    }
    return true;
}

static double step_of(const fit_axis *axis)
{
    return axis->log ? 1e-5 : 1e-5 * (axis->to - axis->from);
}

void fit_search_jacobian(fit_search *s, const double *x, double *out)
{
    size_t n = s->data->n;
    double moved[FIT_MOST_FREE], *side = memory_alloc(3 * n * sizeof *side);
    memset(out, 0, n * s->count * sizeof *out);
    memcpy(moved, x, s->count * sizeof *moved);
    bool here = fit_search_residuals(s, x, side);
    for (size_t j = 0; j < s->count; j++) {
        double h = step_of(&s->axes[j]), *up = side + n, *down = side + 2 * n;
        moved[j] = x[j] + h;
        bool above = fit_search_residuals(s, moved, up);
        moved[j] = x[j] - h;
        bool below = fit_search_residuals(s, moved, down);
        moved[j] = x[j];
        if (above + below + here < 2) /* next to a refused point the difference is one-sided, so
                                         two of the three points are enough */
            continue;
        up = above ? up : side;
        down = below ? down : side;
        for (size_t i = 0; i < n; i++)
            out[i * s->count + j] = (up[i] - down[i]) / ((above + below) * h);
    }
    free(side);
}

/* Returns the distance of x beyond its limits, or 0 inside. */
static double excess(const fit_axis *axis, double x)
{
    return x < axis->low ? x - axis->low : x > axis->high ? x - axis->high : 0;
}

/* Computes the n residuals, then one penalty per axis that drives x back within its limits. */
static int residuals_with_penalties(const gsl_vector *x, void *params, gsl_vector *f)
{
    fit_search *s = params;
    size_t n = s->data->n;
    if (!fit_search_residuals(s, x->data, f->data))
        for (size_t i = 0; i < n; i++)
            f->data[i] = REFUSED;
    for (size_t j = 0; j < s->count; j++)
        f->data[n + j] = PENALTY * excess(&s->axes[j], x->data[j]);
    return GSL_SUCCESS;
}

static int jacobian_with_penalties(const gsl_vector *x, void *params, gsl_matrix *J)
{
    fit_search *s = params;
    size_t n = s->data->n;
    gsl_matrix_set_zero(J);
    fit_search_jacobian(s, x->data, J->data);
    for (size_t j = 0; j < s->count; j++)
        if (excess(&s->axes[j], x->data[j]) != 0)
            gsl_matrix_set(J, n + j, j, PENALTY);
    return GSL_SUCCESS;
}

/* Minimises by the Levenberg-Marquardt method with a trust region, starting from x, and writes the
   minimum to x. Returns the sum of squares, or infinity. */
static double minimise(fit_search *s, double *x)
{
    gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_fdf system = {.f = residuals_with_penalties,
                                       .df = jacobian_with_penalties,
                                       .n = s->data->n + s->count,
                                       .p = s->count,
                                       .params = s};
    gsl_multifit_nlinear_workspace *w =
        gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, system.n, system.p);
    gsl_vector_view start = gsl_vector_view_array(x, s->count);
    double sum = HUGE_VAL;
    int why = 0;
    if (w && gsl_multifit_nlinear_init(&start.vector, &system, w) == GSL_SUCCESS) {
        int status = gsl_multifit_nlinear_driver(ITERATIONS, 1e-9, 1e-12, 0, NULL, NULL, &why, w);
        const gsl_vector *f = gsl_multifit_nlinear_residual(w);
        /* GSL_ENOPROG: the steps are below the resolution of the differences */
        if (status == GSL_SUCCESS || status == GSL_ENOPROG) {
            sum = 0;
            for (size_t i = 0; i < f->size; i++)
                sum += f->data[i] * f->data[i];
            memcpy(x, gsl_multifit_nlinear_position(w)->data, s->count * sizeof *x);
        }
    }
    if (w)
        gsl_multifit_nlinear_free(w);
    return sum < REFUSED * REFUSED ? sum : HUGE_VAL;
}

typedef struct start {
    double x[FIT_MOST_FREE];
    double sum;
} start;

static void keep_best(start best[STARTS], const start *one)
{
    start next = *one;
    for (int k = 0; k < STARTS; k++)
        if (next.sum < best[k].sum) {
            start worse = best[k];
            best[k] = next;
            next = worse;
        }
}

/* Keeps the best points of a Sobol sequence over the calibrated ranges. */
static void sample_starts(fit_search *s, start best[STARTS], double *residuals)
{
    double point[FIT_MOST_FREE];
    gsl_qrng *sequence = gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)s->count);
    for (int k = 0; sequence && k < SAMPLES; k++) {
        start one = {.sum = 0};
        gsl_qrng_get(sequence, point);
        for (size_t j = 0; j < s->count; j++)
            one.x[j] = s->axes[j].from + point[j] * (s->axes[j].to - s->axes[j].from);
        if (!fit_search_residuals(s, one.x, residuals))
            continue;
        for (size_t i = 0; i < s->data->n; i++)
            one.sum += residuals[i] * residuals[i];
        keep_best(best, &one);
    }
    if (sequence)
        gsl_qrng_free(sequence);
}

bool fit_search_run(fit_search *s, double *x)
{
    assert(s->count > 0 && s->data->n > 0);
    start best[STARTS];
    double least = HUGE_VAL, *residuals = memory_alloc(s->data->n * sizeof *residuals);
    for (int k = 0; k < STARTS; k++)
        best[k].sum = DBL_MAX;
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    sample_starts(s, best, residuals);
    for (int k = 0; k < STARTS && best[k].sum < DBL_MAX; k++) {
        double sum = minimise(s, best[k].x);
        if (sum < least) {
            least = sum;
            memcpy(x, best[k].x, s->count * sizeof *x);
        }
    }
    gsl_set_error_handler(handler);
    free(residuals);
    return least < HUGE_VAL;
}
