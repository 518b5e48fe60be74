/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Error estimate from three levels of grid refinement (Roache 1998, Verification and Validation in
 * Computational Science and Engineering, ch. 5; Celik et al. 2008, J. Fluids Eng. 130, 078001). If
 * the error falls by a factor g per level, the error of the finest answer is its difference from
 * the middle answer divided by g - 1, and also the difference of the two coarser answers divided by
 * g (g - 1). The two disagree if the true g is not the assumed one; the larger counts. The error of
 * the middle answer is its difference from the finest times g/(g - 1).
 */
#include "estimate.h"

#include "../memory/memory.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

/* Roache's factor of safety for three levels. */
static const double safety = 1.25;
/* The growth g is limited to the range from order 1/2, where the factor on the difference equals
   Roache's factor for two levels, 3, to order 2. A growth below 0 means an error that changes sign:
   it is taken to fall with order 1/2 to 1. A growth of more than order 4 means that the coarsest
   answer is unrelated to the others: no order can be seen. */
static const double least_growth = 1.4142135623730951, most_growth = 4, unsettled_growth = 2;
/* Errors fall faster between coarse levels than beyond the finest one. The difference of the
 * coarser levels is therefore extrapolated to the finer levels with at most order 4, and from there
 * with at most order 2. */
static const double most_coarse_growth = 16;
/* The error of a series passes through 0 at one point and a difference between levels at another.
   So each point takes the largest estimate within this share of the points. Estimates at untypical
   points do not spread: an instant that moves does not make its neighbours wrong. */
static const double reach = 0.02;

/* Where a load jumps or contact is lost, a short stretch of a series is off by as much as it moves
   and converges slowly. The typical error leaves this stretch out: it applies to this share of the
   length. */
static const double typical_share = 0.95;

typedef struct weighed {
    double value, weight;
} weighed;

/* Length of the axis that point i stands for. */
static double weight_of(const double *at, size_t i, size_t count)
{
    size_t last = count - 1;
    return at ? at[i < last ? i + 1 : last] - at[i > 0 ? i - 1 : 0] : 1;
}

double accuracy_typical(const double *values, const double *at, size_t count)
{
    assert(count > 0);
    weighed *all = memory_alloc(count * sizeof *all);
    double length = 0, sum = 0;
    size_t i = 0;
    for (size_t k = 0; k < count; k++) {
        all[k] = (weighed){values[k], weight_of(at, k, count)};
        length += all[k].weight;
    }
    memory_sort(all, count, sizeof *all);
    for (; i + 1 < count && sum + all[i].weight < typical_share * length; i++)
        sum += all[i].weight;
    double typical = all[i].value;
    free(all);
    return typical;
}

/* Relative difference of two answers in number i. */
static double difference(const accuracy_ladder *l, const double *a, const double *b, size_t i)
{
    return fabs(a[i] - b[i]) / (l->scale ? l->scale[i] : 1);
}

/* Marks the numbers with typical differences. */
static void mark_typical(const accuracy_ladder *l, const double *sizes, bool *typical)
{
    const double limit = accuracy_typical(sizes, l->at, l->count);
    for (size_t i = 0; i < l->count; i++)
        typical[i] = sizes[i] <= limit;
}

/* Root mean square of the differences of two answers at the marked numbers; at all if `marks` is
   NULL. */
static double between(const accuracy_ladder *l, const double *a, const double *b, const bool *marks)
{
    double squares = 0, count = 0;
    for (size_t i = 0; i < l->count; i++) {
        if (marks && !marks[i])
            continue;
        squares += difference(l, a, b, i) * difference(l, a, b, i);
        count++;
    }
    return sqrt(squares / count);
}

/* Root mean square of the differences of two answers at the numbers where the difference is
 * typical. */
static double typical_between(const accuracy_ladder *l, const double *a, const double *b)
{
    double *sizes = memory_alloc(l->count * sizeof *sizes);
    bool *typical = memory_alloc(l->count * sizeof *typical);
    for (size_t i = 0; i < l->count; i++)
        sizes[i] = difference(l, a, b, i);
    mark_typical(l, sizes, typical);
    double root = between(l, a, b, typical);
    free(typical);
    free(sizes);
    return root;
}

/* Growth of the differences from one pair of levels to the next coarser pair. */
static double growth_of(double near, double far, double sign)
{
    return near > 0 ? sign * far / near : far > 0 ? INFINITY : NAN;
}

/* Growth used for the estimate. Observed orders above 2 are not trusted: the higher the observed
 * order, the lower the order that is used, down to 3/2 for a series and to 1 for a single number,
 * which may agree by chance. At an observed order of 4 the bar of a series jumps by a factor
 * of 1.8. */
static double growth_to_use(const accuracy_ladder *l, double observed)
{
    const double settles = l->count > 1 ? unsettled_growth * least_growth : unsettled_growth;
    if (isnan(observed))
        return least_growth;
    if (observed > most_coarse_growth)
        return unsettled_growth;
    if (observed < 0)
        return fmin(fmax(-observed, least_growth), unsettled_growth);
    if (observed > most_growth)
        return fmax(most_coarse_growth / observed, settles);
    return fmax(observed, least_growth);
}

/* Growth of the differences, over the typical points and over all. */
typedef struct convergence {
    double typical, all;
    double coarse_limit; /* largest difference of the coarser levels at typical points */
} convergence;

static bool uses_coarser(const accuracy_ladder *l)
{
    return (l->half && l->quarter) || !l->twice;
}

/* Returns the level from whose difference to the answer the error is estimated. */
static const double *nearest(const accuracy_ladder *l)
{
    return !uses_coarser(l) ? l->twice : l->half ? l->half : l->quarter;
}

static convergence convergence_of(const accuracy_ladder *l, const bool *typical)
{
    const double *a = uses_coarser(l) ? l->answer : l->twice,
                 *b = uses_coarser(l) ? l->half : l->answer,
                 *c = uses_coarser(l) ? l->quarter : l->half;
    if (!a || !b || !c)
        return (convergence){NAN, NAN, INFINITY};
    /* Only a single number can overshoot. */
    double sign = l->count == 1 && (c[0] - b[0]) * (b[0] - a[0]) < 0 ? -1 : 1;
    return (convergence){growth_of(between(l, b, a, typical), typical_between(l, c, b), sign),
                         growth_of(between(l, b, a, NULL), between(l, c, b, NULL), sign), INFINITY};
}

/* Difference of the coarser levels in number i: the larger of the difference for all settings at
 * once and the sum over single settings, since the errors of two settings may cancel in one file
 * but not in another. */
static double coarse_difference(const accuracy_ladder *l, size_t i)
{
    double sum = 0;
    for (size_t k = 0; l->quarter && k < l->refined_count; k++)
        sum += l->refined[k] ? difference(l, l->refined[k], l->quarter, i) : 0;
    return l->half && l->quarter ? fmax(difference(l, l->quarter, l->half, i), sum) : sum;
}

static double coarse_limit(const accuracy_ladder *l)
{
    double *all = memory_alloc(l->count * sizeof *all);
    for (size_t i = 0; i < l->count; i++)
        all[i] = coarse_difference(l, i);
    double limit = accuracy_typical(all, l->at, l->count);
    free(all);
    return limit;
}

/* Marks the numbers where the difference of two levels is typical. */
static void mark_answer(const accuracy_ladder *l, bool *typical)
{
    double *sizes = memory_alloc(l->count * sizeof *sizes);
    for (size_t i = 0; i < l->count; i++)
        sizes[i] = difference(l, nearest(l), l->answer, i);
    mark_typical(l, sizes, typical);
    free(sizes);
}

/* Relative error of number i. */
static double error_at(const accuracy_ladder *l, size_t i, bool typical, const convergence *c)
{
    double observed = typical ? c->typical : c->all, growth = growth_to_use(l, observed);
    double coarse = fmax(growth, fmin(fabs(observed), most_coarse_growth)); /* fmax and fmin drop
                                                                               NaN */
    double near = difference(l, nearest(l), l->answer, i), far = coarse_difference(l, i);
    if (!uses_coarser(l))
        return safety * near * growth / (growth - 1);
    if (!l->half)
        return safety * near / (growth * growth - 1);
    if (typical) /* if only the coarser levels move much, this is no error of the answer */
        far = fmin(far, c->coarse_limit);
    return safety * fmax(near, far / coarse) / (growth - 1);
}

static void find_shares(const accuracy_ladder *l, double *shares)
{
    double all = 0;
    for (size_t k = 0; k < l->refined_count; k++) {
        bool known = l->quarter && l->refined[k];
        shares[k] = known ? typical_between(l, l->refined[k], l->quarter) : 0;
        all += shares[k];
    }
    for (size_t k = 0; k < l->refined_count && all > 0; k++)
        shares[k] /= all;
}

/* Raises each relative error to the largest one nearby, from typical points to typical points
   only. */
static void raise_to_largest(const accuracy_ladder *l, const double *all, const bool *typical,
                             double *largest)
{
    const size_t near = l->count > 1 ? 1 + (size_t)(reach / 2 * (double)l->count) : 0;
    for (size_t i = 0; i < l->count; i++) {
        largest[i] = 0;
        for (size_t k = i > near ? i - near : 0; k < l->count && k <= i + near; k++)
            if (!typical[i] || typical[k])
                largest[i] = fmax(largest[i], all[k]);
    }
}

double accuracy_estimate(const accuracy_ladder *l, double *error, double *shares)
{
    assert(l->answer && (l->half || l->quarter || l->twice));
    assert(l->refined_count == 0 || l->refined);
    double *all = memory_alloc(l->count * sizeof *all);
    bool *typical = memory_alloc(l->count * sizeof *typical);
    mark_answer(l, typical);
    convergence c = convergence_of(l, typical);
    c.coarse_limit = coarse_limit(l);
    for (size_t i = 0; i < l->count; i++)
        all[i] = error_at(l, i, typical[i], &c);
    raise_to_largest(l, all, typical, error);
    for (size_t i = 0; i < l->count; i++)
        error[i] *= l->scale ? l->scale[i] : 1;
    free(typical);
    free(all);
    find_shares(l, shares);
    double observed = c.typical;
    return isfinite(observed) && observed != 0 ? log2(fabs(observed)) : NAN;
}
