/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates the errors of a film from a second one on half the cells and half the steps. */
#include "twin.h"

#include "../time/start.h"

#include <math.h>

/* Bars of h_min and h_central of one row: relative, positive if the film is too thick. */
typedef struct bars {
    double of[EHL_PEAK];
} bars;

static double *row_of(const ehl_results *r, size_t row)
{
    return r->series.data + row * EHL_SERIES;
}

/* Compares the newest film of the twin with a row of the run. If errors fall with the power p of
 * cells and steps, the difference of both films is 2^p - 1 times the error of the finer one. On two
 * grids p is not measured: the bar is not less than the difference, which is the error for p = 1.
 * The position of the film's end within its cell may hide an error, so that the bar is that of the
 * larger difference, or of that position. If a film is not finite, its errors are unknown. */
static bars compare(const ehl_run *run, ehl_run *twin, size_t row)
{
    ehl_reynolds *eq = &twin->reynolds;
    const ehl_march *m = &twin->march;
    const double order = fmin(ehl_space_order(eq), m->scheme == EHL_EULER ? 1 : 2);
    const double factor = fmax(1, EHL_CAUTION / (exp2(order) - 1));
    const double film[] = {row_of(&run->results, row)[EHL_H_MIN],
                           row_of(&run->results, row)[EHL_H_CENTRAL]};
    size_t node;
    ehl_reynolds_gap(eq, m->step.radius, &m->state[0].film);
    const double coarse[] = {ehl_least_film(eq, &node), ehl_central_film(&twin->grid, eq)};
    const double off[] = {coarse[EHL_LEAST] / film[EHL_LEAST] - 1,
                          coarse[EHL_CENTRAL] / film[EHL_CENTRAL] - 1};
    const double end = ehl_error_of_end(m) / 4, /* of second order */
        larger = fmax(end, fmax(fabs(off[EHL_LEAST]), fabs(off[EHL_CENTRAL])));
    bars b;
    for (int k = EHL_LEAST; k <= EHL_CENTRAL; k++)
        b.of[k] = isfinite(off[EHL_LEAST] + off[EHL_CENTRAL]) ? copysign(factor * larger, off[k])
                                                              : (double)INFINITY;
    return b;
}

/* Puts the bars into a row whose errors count. */
static void put(ehl_run *run, size_t row, const bars *b)
{
    ehl_results *r = &run->results;
    const double *here = row_of(r, row), film[] = {here[EHL_H_MIN], here[EHL_H_CENTRAL]};
    for (int k = EHL_LEAST; k <= EHL_CENTRAL; k++) {
        double *part = &r->space.data[row * EHL_SPACE + (size_t)k];
        if (fabs(*part) > 0)
            *part = ehl_known_error(b->of[k]) * film[k];
    }
}

/* Marches over every second row from `first` to the one before `end`. A row between two films has
 * the larger bars of both. */
static ff_status march(ehl_run *run, ehl_run *twin, size_t first, size_t end, int equal)
{
    enum { EVERY = 2, BETWEEN = 16 };
    const ff_host *host = run->results.host;
    ff_status status = ehl_march_start(&twin->march);
    if (status != FF_OK)
        return status;
    bars before = compare(run, twin, first);
    put(run, first, &before);
    status = ehl_step_control_create(&twin->control, &twin->march, 0, equal);
    for (size_t row = first + 1, k = 1; row < end && status == FF_OK; row++, k++) {
        size_t next = row + EVERY - 1 < end ? row + EVERY - 1 : end - 1;
        status = k % BETWEEN == 0 && host->progress(host->ctx, 1)
                     ? FF_STOPPED
                     : ehl_step_control_to(&twin->control, &twin->march,
                                           row_of(&run->results, next)[EHL_TIME]);
        if (status != FF_OK)
            break;
        const bars now = compare(run, twin, next),
                   *larger = fabs(before.of[0]) > fabs(now.of[0]) ? &before : &now;
        for (; row < next; row++)
            put(run, row, larger);
        put(run, next, &now);
        before = now;
    }
    ehl_step_control_destroy(&twin->control);
    return status;
}

/* Says nothing of the twin. */
static void note_nothing(void *ctx, const char *name, double value, double limit, int32_t verdict,
                         const char *text)
{
    (void)ctx, (void)name, (void)value, (void)limit, (void)verdict, (void)text;
}

static ff_status fail_silently(void *ctx, ff_status status, const char *item, const char *text)
{
    (void)ctx, (void)item, (void)text;
    return status;
}

/* Marches through all engagements of the run; rows of one that fails stay unknown. */
static ff_status march_all(ehl_run *run, ehl_run *twin, int equal)
{
    ff_status status = FF_OK;
    const ehl_results *r = &run->results;
    const ehl_history whole = run->whole;
    for (size_t row = 0, first = 0, end; first < r->series.count; first = end) {
        const double number = row_of(r, first)[EHL_ENGAGEMENT];
        for (end = first; end < r->series.count; end++)
            if (fabs(row_of(r, end)[EHL_ENGAGEMENT] - number) > 0)
                break;
        row = ehl_history_engagement(&whole, row, &run->history);
        twin->history = run->history;
        ehl_march_restart(&twin->march);
        if (twin->march.thermal)
            ehl_thermal_restart(&twin->march);
        status = march(run, twin, first, end, equal);
        if (status == FF_NOMEM || status == FF_STOPPED)
            return status;
    }
    return FF_OK;
}

ff_status ehl_twin_errors(ehl_model *m, const ff_array *in, ehl_run *run)
{
    const numerics_answers answers = m->isothermal.answers;
    ff_host quiet = *m->host;
    quiet.quality = note_nothing;
    quiet.fail = fail_silently;
    ehl_model half = *m;
    half.host = &quiet;
    half.cells = m->cells / 2;
    ehl_run twin = {.history = run->whole, .like = &run->grid};
    ff_status status = ehl_run_create(&half, 0, in, &twin);
    if (status == FF_OK)
        status = ehl_stage_heat(&half, in, &twin.march, &twin.heat, &twin.thermal);
    if (status == FF_OK)
        status = march_all(run, &twin, m->steps > 0);
    ehl_run_destroy(&twin);
    m->isothermal.answers = answers; /* a law that fails for the twin alone leaves errors unknown */
    return status == FF_NOMEM || status == FF_STOPPED ? status : FF_OK;
}
