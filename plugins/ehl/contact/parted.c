/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "parted.h"

#include "ports.h"

#include <flankfilm/author.h>

#include <math.h>
#include <string.h>

int ehl_is_parted(const ehl_history *h)
{
    return !(h->load_max > 0);
}

/* Rules for the outputs of separated flanks. NOTHING applies to pressures, losses, errors and
   counts, which are 0. */
enum { NOTHING, GAP, UNKNOWN, LAMBDA, TEMPERATURE, TIME, ROLL, ENGAGEMENT };

static const unsigned char of_solvers[EHL_OUTPUTS] = {
    [EHL_TIME] = TIME,
    [EHL_ROLL_ANGLE] = ROLL,
    [EHL_ENGAGEMENT] = ENGAGEMENT,
    [EHL_H_MIN] = GAP,
    [EHL_H_CENTRAL] = GAP,
    [EHL_LAMBDA_RATIO] = LAMBDA,
    [EHL_TEMPERATURE_MAX] = TEMPERATURE,
    [EHL_SEPARATION] = GAP,
    [EHL_FILM] = GAP,
    [EHL_FILM_FRACTION] = UNKNOWN,
    [EHL_ROUGHNESS] = UNKNOWN,
    [EHL_TEMPERATURE] = TEMPERATURE,
    [EHL_H_MIN_LOWEST] = GAP,
    [EHL_H_MIN_LOWEST_AT] = ROLL,
    [EHL_H_MIN_LOWEST_MEAN] = GAP,
    [EHL_LAMBDA_RATIO_LOWEST] = LAMBDA,
    [EHL_RQ_LEFT_OUT] = UNKNOWN,
    [EHL_ALPHA_STAR] = UNKNOWN,
    [EHL_BULK_TEMPERATURE] = TEMPERATURE,
};

static const unsigned char of_estimates[EHL_ESTIMATE_OUTPUTS] = {
    [EHL_ESTIMATE_TIME] = TIME,
    [EHL_ESTIMATE_ROLL_ANGLE] = ROLL,
    [EHL_ESTIMATE_ENGAGEMENT] = ENGAGEMENT,
    [EHL_ESTIMATE_H_MIN] = GAP,
    [EHL_ESTIMATE_H_CENTRAL] = GAP,
    [EHL_ESTIMATE_LAMBDA_RATIO] = LAMBDA,
    [EHL_ESTIMATE_FILM] = GAP,
    [EHL_ESTIMATE_H_MIN_LOWEST] = GAP,
    [EHL_ESTIMATE_H_MIN_LOWEST_AT] = ROLL,
    [EHL_ESTIMATE_LAMBDA_RATIO_LOWEST] = LAMBDA,
    [EHL_ESTIMATE_H_MIN_LOWEST_MEAN] = GAP,
    [EHL_ESTIMATE_ALPHA_STAR] = UNKNOWN,
    [EHL_ESTIMATE_BULK_TEMPERATURE] = TEMPERATURE,
};

/* Returns the value of an output of separated flanks at a row, or NaN if the output has no
   value. */
static double value_of(int rule, const ehl_history *h, size_t row, double roughness,
                       double temperature)
{
    switch (rule) {
    case GAP:
        return h->gap[row];
    case UNKNOWN:
        return NAN;
    case LAMBDA:
        return roughness > 0 ? h->gap[row] / roughness : NAN;
    case TEMPERATURE:
        return temperature > 0 ? temperature : NAN;
    case TIME:
        return h->time[row];
    case ROLL:
        return h->roll ? h->roll[row] : NAN;
    case ENGAGEMENT:
        return h->engagement ? h->engagement[row] : 0;
    default:
        return 0;
    }
}

/* Returns the first row at which the gap is smallest. */
static size_t nearest_row(const ehl_history *h)
{
    size_t nearest = 0;
    for (size_t i = 1; i < h->count; i++)
        nearest = h->gap[i] < h->gap[nearest] ? i : nearest;
    return nearest;
}

/* Allocates the array of an output. A contact without load has no width, so a field has a single
   point, x = 0. */
static double *claim(const ff_host *host, uint32_t row, const char *dims, const ehl_history *h,
                     size_t *rows)
{
    const size_t field[] = {h->count, 1};
    *rows = !strcmp(dims, "t") || !strcmp(dims, "t x") ? h->count : 1;
    if (!strcmp(dims, "t x"))
        return host->output(host->ctx, row, 2, field);
    if (!strcmp(dims, ""))
        return host->output(host->ctx, row, 0, NULL);
    *rows = !strcmp(dims, "landing") ? 0 : *rows;
    return ff_put_series(host, row, *rows);
}

ff_status ehl_put_parted(const ff_host *host, int estimate, uint64_t wanted, const ehl_history *h,
                         double roughness, double temperature)
{
    const ff_port *outputs = estimate ? ehl_estimate_outputs : ehl_outputs;
    const unsigned char *rules = estimate ? of_estimates : of_solvers;
    const size_t count = estimate ? EHL_ESTIMATE_OUTPUTS : EHL_OUTPUTS;
    const size_t nearest = nearest_row(h);
    for (uint32_t k = 0; k < count; k++) {
        size_t rows;
        if (!(wanted & FF_BIT(k)))
            continue;
        double *to = claim(host, k, outputs[k].dims, h, &rows);
        if (!to && rows > 0)
            return FF_NOMEM;
        for (size_t i = 0; i < rows; i++) {
            to[i] = value_of(rules[k], h, rows > 1 ? i : nearest, roughness, temperature);
            if (isnan(to[i]))
                return ff_failf(host, FF_UNSUPPORTED, outputs[k].name,
                                "the contact is never loaded, and without load this output has no "
                                "value");
        }
    }
    host->quality(host->ctx, "parted", h->gap[nearest], 0, FF_GOOD,
                  "the contact is never loaded: the film is the gap between the flanks, without "
                  "pressure and loss; the value is its smallest thickness");
    return FF_OK;
}
