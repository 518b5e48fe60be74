/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "parted.h"

#include <flankfilm/author.h>

#include <math.h>
#include <string.h>

int ehl_is_parted(const ehl_history *h)
{
    return !(h->load_max > 0);
}

/* Returns the value of an output at a row of flanks that are apart; NaN: it has no value. Outputs
 * without a rule of their own are pressures, losses, errors and counts, which are 0. */
static double value_of(const char *name, const ehl_history *h, size_t row, double roughness,
                       double temperature)
{
    static const char *const films[] = {"h_min",        "h_central", "separation",
                                        "h_min_lowest", "film",      "h_min_lowest_mean"};
    static const char *const unknown[] = {"alpha_star", "film_fraction", "roughness",
                                          "rq_left_out"};
    const double gap = h->gap[row];
    for (size_t i = 0; i < sizeof films / sizeof films[0]; i++)
        if (!strcmp(name, films[i]))
            return gap;
    for (size_t i = 0; i < sizeof unknown / sizeof unknown[0]; i++)
        if (!strcmp(name, unknown[i]))
            return NAN;
    if (!strncmp(name, "lambda_ratio", strlen("lambda_ratio")))
        return roughness > 0 ? gap / roughness : NAN;
    if (!strcmp(name, "bulk_temperature") || !strncmp(name, "temperature", strlen("temperature")))
        return temperature > 0 ? temperature : NAN;
    if (!strcmp(name, "time"))
        return h->time[row];
    if (!strcmp(name, "roll_angle") || !strcmp(name, "h_min_lowest_at"))
        return h->roll ? h->roll[row] : NAN;
    if (!strcmp(name, "engagement"))
        return h->engagement ? h->engagement[row] : 0;
    return 0;
}

/* Returns the first row at which the flanks are nearest to each other. */
static size_t nearest_row(const ehl_history *h)
{
    size_t nearest = 0;
    for (size_t i = 1; i < h->count; i++)
        nearest = h->gap[i] < h->gap[nearest] ? i : nearest;
    return nearest;
}

/* Asks for the array of an output. A contact without load has no width, so that a field has one
 * place, x = 0. */
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

ff_status ehl_put_parted(const ff_host *host, const ff_port *outputs, size_t count, uint64_t wanted,
                         const ehl_history *h, double roughness, double temperature)
{
    const size_t nearest = nearest_row(h);
    for (uint32_t k = 0; k < count; k++) {
        size_t rows;
        if (!(wanted & FF_BIT(k)))
            continue;
        double *to = claim(host, k, outputs[k].dims, h, &rows);
        if (!to && rows > 0)
            return FF_NOMEM;
        for (size_t i = 0; i < rows; i++) {
            to[i] = value_of(outputs[k].name, h, rows > 1 ? i : nearest, roughness, temperature);
            if (isnan(to[i]))
                return ff_failf(host, FF_UNSUPPORTED, outputs[k].name,
                                "the contact is never loaded, and without load this output has no "
                                "value");
        }
    }
    host->quality(host->ctx, "parted", h->gap[nearest], 0, FF_GOOD,
                  "the contact is never loaded: the film is the gap between the flanks, without "
                  "pressure and without a loss; the value is the least of it");
    return FF_OK;
}
