/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Grid refinement by three levels (Roache 1998, Verification and Validation in Computational
 * Science and Engineering, ch. 5; Celik et al. 2008, J. Fluids Eng. 130, 078001). Where an error
 * falls to 1/g from level to level, the finest of three answers is off by what lies between it and
 * the next one, over g - 1, and by what lies between the two coarser ones, over g (g - 1). The
 * larger of both counts: they differ where g is not what the levels show. The middle one of three
 * is off by g/(g - 1) of what lies between it and the finest.
 */
#include "estimate.h"

#include <math.h>

/* Roache's factor of safety with three levels. */
static const double safety = 1.25;
/* The growth is taken between that of order 1/2, where the factor on the difference of two levels
   is Roache's for those, 3, and that of order 2. Below 0 the error changes its sign. */
static const double least_growth = 1.4142135623730951, most_growth = 4, unsettled_growth = 2;
/* On coarse levels errors fall faster than they do from the finest on: what lies between those is
   brought to the next level by up to order 4, and from there by order 2. */
static const double most_coarse_growth = 16;
/* A single number may stay where it is by chance: from order 3 on another level is asked for. */
static const double chance_growth = 8;
/* The error of a series passes through 0 where it changes its sign, and a difference between two
   levels does so elsewhere: what counts is the largest within this share of the points. */
static const double reach = 0.02;

static double norm(const double *a, const double *b, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(sum);
}

/* Growth of the differences over three levels, finest first; below 0 where a number overshoots. */
static double observed_growth(const double *a, const double *b, const double *c, size_t count)
{
    if (!a || !b || !c)
        return NAN;
    double near = norm(b, a, count), far = norm(c, b, count);
    double sign = count == 1 && (c[0] - b[0]) * (b[0] - a[0]) < 0 ? -1 : 1;
    return near > 0 ? sign * far / near : far > 0 ? INFINITY : NAN;
}

static double growth_to_use(double observed)
{
    if (isnan(observed))
        return least_growth;
    if (observed < 0)
        return unsettled_growth;
    return fmin(fmax(observed, least_growth), most_growth);
}

/* How the differences of a ladder grow. */
typedef struct growths {
    double observed, used;
    double coarse; /* between the coarser levels */
} growths;

static bool goes_down(const accuracy_ladder *l)
{
    return (l->half && l->quarter) || !l->twice;
}

static growths growths_of(const accuracy_ladder *l)
{
    double observed = goes_down(l) ? observed_growth(l->answer, l->half, l->quarter, l->count)
                                   : observed_growth(l->twice, l->answer, l->half, l->count);
    double used = growth_to_use(observed);
    /* fmin and fmax drop NaN */
    return (growths){observed, used, fmax(used, fmin(fabs(observed), most_coarse_growth))};
}

bool accuracy_may_be_chance(const accuracy_ladder *l)
{
    return l->count == 1 && l->half && l->quarter && fabs(growths_of(l).observed) > chance_growth;
}

/* The error of number i alone. */
static double error_at(const accuracy_ladder *l, size_t i, growths g)
{
    if (!goes_down(l))
        return safety * fabs(l->answer[i] - l->twice[i]) * g.used / (g.used - 1);
    double near = fabs(l->half[i] - l->answer[i]) / (g.used - 1), far = 0, apart = 0;
    if (l->between)
        near = fmax(near, fabs(l->between[i] - l->answer[i]) / (sqrt(g.used) - 1));
    if (l->quarter)
        far = fabs(l->quarter[i] - l->half[i]);
    for (size_t k = 0; l->quarter && k < l->refined_count; k++)
        apart += l->refined[k] ? fabs(l->refined[k][i] - l->quarter[i]) : 0;
    /* errors of two settings may cancel in the answers, and not in the next scene */
    return safety * fmax(near, fmax(far, apart) / (g.coarse * (g.used - 1)));
}

static void find_shares(const accuracy_ladder *l, double *shares)
{
    double all = 0;
    for (size_t k = 0; k < l->refined_count; k++) {
        bool known = l->quarter && l->refined[k];
        shares[k] = known ? norm(l->refined[k], l->quarter, l->count) : 0;
        all += shares[k];
    }
    for (size_t k = 0; k < l->refined_count && all > 0; k++)
        shares[k] /= all;
}

double accuracy_estimate(const accuracy_ladder *l, double *error, double *shares)
{
    const growths g = growths_of(l);
    const size_t near = l->count > 1 ? 1 + (size_t)(reach / 2 * (double)l->count) : 0;
    for (size_t i = 0; i < l->count; i++) {
        size_t from = i > near ? i - near : 0;
        error[i] = 0;
        for (size_t k = from; k < l->count && k <= i + near; k++)
            error[i] = fmax(error[i], error_at(l, k, g));
    }
    find_shares(l, shares);
    return isfinite(g.observed) && g.observed != 0 ? log2(fabs(g.observed)) : NAN;
}
