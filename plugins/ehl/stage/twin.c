/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates the errors of a film from a second one on half the cells and half the steps. */
#include "twin.h"

#include "../time/start.h"

#include <math.h>

/* A row whose errors the twin tells: relative, positive if the film is too thick. */
typedef struct told {
    double error[EHL_PEAK];
} told;

static double *row_of(const ehl_results *r, size_t row)
{
    return r->series.data + row * EHL_SERIES;
}

/* Compares the newest film of the twin with a row of the run. Of an error that falls as the power p
 * of cells and steps, the films differ by 2^p - 1 times that of the finer one. */
static told compare(const ehl_run *run, ehl_run *twin, size_t row)
{
    ehl_reynolds *eq = &twin->reynolds;
    const ehl_march *m = &twin->march;
    const double order = fmin(ehl_space_order(eq), m->scheme == EHL_EULER ? 1 : 2);
    const double film[] = {row_of(&run->results, row)[EHL_H_MIN],
                           row_of(&run->results, row)[EHL_H_CENTRAL]};
    size_t node;
    ehl_reynolds_gap(eq, m->step.radius, &m->state[0].film);
    const double coarse[] = {ehl_least_film(eq, &node), ehl_central_film(&twin->grid, eq)};
    told t;
    for (int k = EHL_LEAST; k <= EHL_CENTRAL; k++)
        t.error[k] = (coarse[k] / film[k] - 1) / (exp2(order) - 1);
    return t;
}

/* Puts the errors into a row whose errors count. Two grids do not tell what the place of the film's
 * end within its cell does to one output, so that each error counts as the larger one of both. */
static void put(ehl_run *run, size_t row, const told *t)
{
    ehl_results *r = &run->results;
    const double *here = row_of(r, row), film[] = {here[EHL_H_MIN], here[EHL_H_CENTRAL]};
    const double bar = EHL_CAUTION * fmax(fabs(t->error[EHL_LEAST]), fabs(t->error[EHL_CENTRAL]));
    for (int k = EHL_LEAST; k <= EHL_CENTRAL; k++) {
        double *part = &r->space.data[row * EHL_SPACE + (size_t)k];
        if (fabs(*part) > 0)
            *part = copysign(ehl_known_error(bar), t->error[k]) * film[k];
    }
}

/* Returns the larger errors of both. */
static told larger(const told *a, const told *b)
{
    told t;
    for (int k = EHL_LEAST; k <= EHL_CENTRAL; k++)
        t.error[k] = fabs(a->error[k]) > fabs(b->error[k]) ? a->error[k] : b->error[k];
    return t;
}

/* Marches over every second row from `first` to the one before `end`. A row between two films has
 * the larger errors of both. */
static ff_status march(ehl_run *run, ehl_run *twin, size_t first, size_t end, int equal)
{
    enum { EVERY = 2, BETWEEN = 16 };
    const ff_host *host = run->results.host;
    ff_status status = ehl_march_start(&twin->march);
    if (status != FF_OK)
        return status;
    told before = compare(run, twin, first);
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
        const told now = compare(run, twin, next), between = larger(&before, &now);
        for (; row < next; row++)
            put(run, row, &between);
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

ff_status ehl_twin_errors(const ehl_model *m, const ff_array *in, ehl_run *run)
{
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
    return status == FF_NOMEM || status == FF_STOPPED ? status : FF_OK;
}
