/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks the results of laws: the status must be FF_OK or FF_DOMAIN, and numbers must be finite for
   every finite pressure. */
#ifndef NUMERICS_ANSWERS_H
#define NUMERICS_ANSWERS_H

#include <flankfilm/plugin.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* The first wrong result that a law gave to a stage. */
typedef struct numerics_answers {
    ff_status status; /* FF_OK: no wrong result; otherwise FF_BUG, FF_NOCONV, FF_NOMEM */
    const char *wire; /* wire of the law: "viscosity" */
    char text[160];
} numerics_answers;

/* The arguments of one call of a law, and its results. */
typedef struct numerics_answer {
    const char *wire, *name; /* "viscosity", "ln_eta" */
    ff_status status;
    size_t n;
    const double *p;              /* Pa, or NULL */
    const double *value, *slopes; /* arrays of n; slopes may be NULL */
} numerics_answer;

/* Returns the sum of n numbers, computed with several SIMD lanes. It is finite only if all numbers
   are finite. */
static inline double numerics_lane_sum(size_t n, const double *x)
{
    enum { LANES = 8 };
    double lane[LANES] = {0}, sum = 0;
    size_t i = 0;
    for (; i + LANES <= n; i += LANES)
        for (size_t k = 0; k < LANES; k++)
            lane[k] += x[i + k];
    for (size_t k = 0; k < LANES; k++)
        sum += lane[k];
    for (; i < n; i++)
        sum += x[i];
    return sum;
}

/* Returns whether all numbers are finite. The result may also be 0 if only their sum overflows. */
static inline int numerics_are_finite(size_t n, const double *x)
{
    return isfinite(numerics_lane_sum(n, x));
}

/* Stores the first wrong result of a law, and returns the status of the law. A wrong result at a
   pressure that is not finite is no fault of the law. */
static inline ff_status numerics_answer_fault(numerics_answers *a, const numerics_answer *x)
{
    size_t i = 0;
    int lawful = x->status == FF_OK || x->status == FF_DOMAIN;
    ff_status status = x->status == FF_NOCONV || x->status == FF_NOMEM ? x->status : FF_BUG;
    while (lawful && i < x->n &&
           ((isfinite(x->value[i]) && (!x->slopes || isfinite(x->slopes[i]))) ||
            (x->p && !isfinite(x->p[i]))))
        i++;
    if (lawful && i == x->n)
        return x->status;
    if (a->status != FF_OK)
        return a->status;
    a->status = status;
    a->wire = x->wire;
    char at[64] = "", many[64] = "";
    if (x->p && (lawful || x->n == 1))
        snprintf(at, sizeof at, " at %.4g GPa", 1e-9 * x->p[i]);
    else if (x->p && x->n > 1)
        snprintf(at, sizeof at, " among %zu pressures from %.4g GPa on", x->n, 1e-9 * x->p[0]);
    if (lawful)
        snprintf(many, sizeof many, "%s%s %g", isfinite(x->value[i]) ? "the slope of " : "",
                 x->name, isfinite(x->value[i]) ? x->slopes[i] : x->value[i]);
    if (lawful)
        snprintf(a->text, sizeof a->text, "it gave %s%s; a law must give finite numbers", many, at);
    else if (status == FF_NOMEM)
        snprintf(a->text, sizeof a->text, "it ran out of memory%s", at);
    else if (status == FF_NOCONV)
        snprintf(a->text, sizeof a->text, "the law found no %s%s", x->name, at);
    else
        snprintf(a->text, sizeof a->text, "it gave the status %d%s; a law gives FF_OK or FF_DOMAIN",
                 (int)x->status, at);
    return status;
}

static inline ff_status numerics_answer_note(numerics_answers *a, const numerics_answer *x)
{
    if ((x->status == FF_OK || x->status == FF_DOMAIN) && numerics_are_finite(x->n, x->value) &&
        (!x->slopes || numerics_are_finite(x->n, x->slopes)))
        return x->status;
    return numerics_answer_fault(a, x);
}

/* Returns the status of a stage that uses these laws: the status of the laws if one of them
   failed. */
static inline ff_status numerics_answers_end(numerics_answers *a, const ff_host *host,
                                             ff_status status)
{
    return a->status == FF_OK ? status : host->fail(host->ctx, a->status, a->wire, a->text);
}

#endif
