/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "landings.h"

#include <flankfilm/author.h>

#include <math.h>

typedef struct landing {
    double film, film_error, pressure, pressure_error;
} landing;

/* Returns whether the flanks land at a row of the history and then carry load. Sets the row of the
   first maximum of the load. */
static int lands_at(const ehl_history *h, size_t row, size_t *top)
{
    const double *number = h->engagement;
    if (!h->gap || !(h->gap[row - 1] > 0) || h->gap[row] > 0 ||
        (number && number[row] != number[row - 1]))
        return 0;
    *top = row;
    while (*top + 1 < h->count && (!number || number[*top + 1] == number[row]) &&
           !(h->load[*top + 1] < h->load[*top]))
        ++*top;
    return !ehl_is_lost(h, h->load[*top]);
}

static double value(const ehl_results *r, size_t i, uint32_t column)
{
    return r->series.data[i * EHL_SERIES + column];
}

static double error_of(const ehl_results *r, size_t i, uint32_t column, int kind)
{
    return fabs(value(r, i, column) + ehl_space_part(r, i, kind));
}

/* Interpolates the smallest film linearly at the instant of landing. The largest pressure is that
   of all films up to the first one after the maximum of the load. */
static landing look(const ehl_results *r, const ehl_history *h, size_t row, size_t top)
{
    landing x = {.pressure = 0};
    double number = h->engagement ? h->engagement[row] : 0, from = h->time[row], to = h->time[top];
    for (size_t i = 1; i < r->series.count; i++) {
        double before = value(r, i - 1, EHL_TIME), time = value(r, i, EHL_TIME);
        if (value(r, i, EHL_ENGAGEMENT) != number || value(r, i - 1, EHL_ENGAGEMENT) != number ||
            time < from || (before >= to && before > from))
            continue;
        if (before < from) {
            double share = (from - before) / (time - before), h0 = value(r, i - 1, EHL_H_MIN);
            x.film = h0 + share * (value(r, i, EHL_H_MIN) - h0);
            x.film_error = fmax(error_of(r, i - 1, EHL_H_MIN_ERROR, EHL_LEAST),
                                error_of(r, i, EHL_H_MIN_ERROR, EHL_LEAST));
        }
        if (value(r, i, EHL_P_MAX) > x.pressure) {
            x.pressure = value(r, i, EHL_P_MAX);
            x.pressure_error = error_of(r, i, EHL_P_MAX_ERROR, EHL_PEAK);
        }
    }
    return x;
}

ff_status ehl_landings_put(const ehl_results *r, const ehl_history *h)
{
    static const uint64_t all = FF_BIT(EHL_FILM_AT_LANDING) | FF_BIT(EHL_FILM_AT_LANDING_ERROR) |
                                FF_BIT(EHL_P_MAX_AT_LANDING) | FF_BIT(EHL_P_MAX_AT_LANDING_ERROR);
    double *to[EHL_OUTPUTS - EHL_FILM_AT_LANDING] = {NULL};
    size_t count = 0, top, n = 0;
    if (!(r->wanted & all))
        return FF_OK;
    for (size_t row = 1; row < h->count; row++)
        count += lands_at(h, row, &top) != 0;
    for (uint32_t k = EHL_FILM_AT_LANDING; k < EHL_OUTPUTS; k++) {
        double *series = ff_put_series(r->host, k, count);
        to[k - EHL_FILM_AT_LANDING] = series;
        if (!series && count > 0)
            return FF_NOMEM;
    }
    for (size_t row = 1; row < h->count; row++) {
        if (!lands_at(h, row, &top))
            continue;
        landing x = look(r, h, row, top);
        const double values[] = {x.film, x.film_error, x.pressure, x.pressure_error};
        for (size_t k = 0; k < sizeof values / sizeof values[0]; k++)
            to[k][n] = values[k];
        n++;
    }
    return FF_OK;
}
