/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bars.h"

#include "axis.h"
#include "choice.h"
#include "compare.h"
#include "estimate.h"
#include "lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Smallest error that is stated, as a share of the goal: twins may agree by chance. */
static const double least_error = 0.1;

void *accuracy_take(const accuracy_twins *t, size_t count, size_t size)
{
    return memory_arena_alloc(&t->record->arena, count * size + 1);
}

accuracy_series accuracy_series_of(const double *at, const accuracy_error *e)
{
    return (accuracy_series){e->result->rank, e->result->count, at,
                             e->result->data, e->zero_point,    e->absolute};
}

/* Computes the relative error of an output: typical along a series, and largest. */
static void find_relative(const double *at, accuracy_error *e)
{
    accuracy_series answer = accuracy_series_of(at, e);
    double largest;
    e->reached = accuracy_relative(e->bar, &answer, &largest);
    answer.absolute = false;
    e->relative = accuracy_relative(e->bar, &answer, &e->largest);
    e->reached = fmax(e->reached, least_error * e->goal); /* fmax drops NaN */
    e->relative = e->absolute ? e->relative : fmax(e->relative, least_error * e->goal);
}

static const double *numbers_of_twin(const accuracy_twins *t, const accuracy_error *e,
                                     const accuracy_twin *twin)
{
    return twin && twin->good ? accuracy_numbers_like(t->answer, e->stage, e->result,
                                                      twin->pipeline, &t->record->arena)
                              : NULL;
}

/* Sorts the largest part first. */
static int by_error(const void *a, const void *b)
{
    const accuracy_part *one = a, *other = b;
    return (one->error < other->error) - (one->error > other->error);
}

/* Computes the contributions of the settings to the error. */
static void add_parts(const accuracy_twins *t, const double *shares, accuracy_error *e)
{
    size_t most = t->count + (t->record->choice ? t->record->choice->change_count : 0);
    e->part_count = 0;
    e->parts = accuracy_take(t, most, sizeof *e->parts);
    for (size_t i = 0; i < t->count; i++)
        if (shares[i] > 0)
            e->parts[e->part_count++] =
                (accuracy_part){.stage = &t->answer->stages[t->knobs[i].stage],
                                .setting = t->knobs[i].name,
                                .error = e->relative * shares[i]};
    qsort(e->parts, e->part_count, sizeof *e->parts, by_error);
}

/* Adds the errors that the accepted models cause, which are stated in the form of the goal. */
static void add_changes(const accuracy_twins *t, const accuracy_ladder *levels, accuracy_error *e)
{
    const accuracy_choice *choice = t->record->choice;
    const ff_result *result = e->result;
    const double share = e->absolute ? e->relative / e->reached : 1;
    for (size_t i = 0; choice && i < choice->change_count; i++) {
        const accuracy_change *c = &choice->changes[i];
        if (c->output_stage != (size_t)(e->stage - t->answer->stages) ||
            strcmp(c->output, result->row->name) != 0)
            continue;
        for (size_t k = 0; k < result->count; k++) /* NaN if the answers could not be compared */
            e->bar[k] += c->error * levels->scale[k];
        e->reached += c->error;
        e->relative += share * c->error;
        e->largest += share * c->error;
        e->parts[e->part_count++] = (accuracy_part){
            .stage = &t->answer->stages[c->stage], .setting = "use", .error = share * c->error};
    }
    qsort(e->parts, e->part_count, sizeof *e->parts, by_error);
}

static accuracy_ladder ladder_of(const accuracy_twins *t, const accuracy_error *e)
{
    const ff_result *result = e->result, *along = accuracy_axis_of(t->answer, e->stage, result);
    const accuracy_series answer = accuracy_series_of(NULL, e);
    double *scale = accuracy_take(t, result->count, sizeof *scale);
    accuracy_error_scales(&answer, scale);
    return (accuracy_ladder){.count = result->count,
                             .at = along ? along->data : NULL,
                             .scale = scale,
                             .answer = e->result->data,
                             .half = numbers_of_twin(t, e, t->half),
                             .quarter = numbers_of_twin(t, e, t->quarter),
                             .twice = numbers_of_twin(t, e, t->twice)};
}

/* Order at which the stage's own estimate falls from a coarser twin to the answer; NaN if the twin
 * or the answer has none. */
static double order_of_estimate(const accuracy_twins *t, const accuracy_error *e)
{
    const accuracy_twin *twin = t->half ? t->half : t->quarter;
    const ff_stage *there = twin ? &twin->pipeline->stages[e->stage - t->answer->stages] : NULL;
    const int output =
        there ? ff_model_find_output(there->loaded->model, e->result->row->name) : -1;
    if (output < 0 || there->unread)
        return NAN;
    return log2(accuracy_estimated_share(there, &there->results[output]) /
                accuracy_estimated_share(e->stage, e->result)) /
           (t->half ? 1 : 2);
}

/* Raises the bar of each number of a series to at least the stage's estimate: a stage may know a
 * source of error that the twins do not show. */
static void raise_to_estimate(const accuracy_twins *t, const double *at, accuracy_error *e)
{
    const double measured = e->relative;
    double *own = accuracy_take(t, e->result->count, sizeof *own);
    if (!accuracy_estimate_of(e->stage, e->result))
        return;
    accuracy_fill_estimates(e->stage, e->result, own);
    const bool least = accuracy_is_least(e->stage, e->result);
    for (size_t i = 0; i < e->result->count; i++)
        if (least || isfinite(own[i])) /* else the stage knows none, but the twins do */
            e->bar[i] = fmax(e->bar[i], own[i]);
    find_relative(at, e);
    e->by_stage = e->relative > measured;
    if (e->by_stage)
        e->order = order_of_estimate(t, e);
}

/* Fills in the errors that other stages cause, as their settings in `half` do: two twins show them
 * that are both two levels coarser in the stage itself. 0 if no other stage has settings. False if
 * the twins cannot be compared. */
static bool fill_errors_of_others(const accuracy_twins *t, const accuracy_ladder *levels,
                                  const accuracy_error *e, double *errors)
{
    const accuracy_ladder others = {.count = levels->count,
                                    .at = levels->at,
                                    .scale = levels->scale,
                                    .answer = numbers_of_twin(t, e, t->others_finer),
                                    .half = levels->quarter};
    if (!t->others_finer)
        return true;
    if (!others.answer || !others.half)
        return false;
    accuracy_estimate(&others, errors, NULL);
    return true;
}

/* Raises the bars to the smallest errors that are stated, as shares of the numbers themselves: a
 * film between parted flanks is no scale for the lowest one. */
static void raise_to_least(const accuracy_error *e, double *bar)
{
    const double *data = e->result->data;
    for (size_t i = 0; i < e->result->count; i++) { /* fmax drops NaN */
        const double scale = e->absolute ? 1 : fabs(data[i] - e->zero_point);
        bar[i] = fmax(bar[i], least_error * e->goal * scale);
    }
}

/* Accepts lower bars if they meet the goal; else further twins may show less than they. */
static void accept(const accuracy_twins *t, const double *at, double *bar, accuracy_error *e)
{
    accuracy_error lower = *e;
    lower.bar = bar;
    raise_to_least(e, bar);
    find_relative(at, &lower);
    if (!(lower.reached <= e->goal))
        return;
    if (lower.relative < e->relative) {
        lower.by_stage = true;
        lower.part_count = 0;
        lower.order = order_of_estimate(t, e);
    }
    *e = lower;
}

/* Replaces the bars by the stage's estimates plus the errors due to other stages where that is
 * less: the twins may be too coarse for the stage, and two levels show no order. Where these errors
 * do not explain how far the twin is off, the bar stays. */
static void lower_to_estimate(const accuracy_twins *t, const accuracy_ladder *levels,
                              accuracy_error *e)
{
    const double of_twin = 4; /* the twin's error over that of the answer, at second order */
    double *own = accuracy_take(t, levels->count, sizeof *own),
           *others = accuracy_take(t, levels->count, sizeof *own),
           *bar = accuracy_take(t, levels->count, sizeof *own);
    if (!t->carried || !levels->half || t->estimating != (size_t)(e->stage - t->answer->stages) ||
        !accuracy_fill_estimates(e->stage, e->result, own) ||
        !fill_errors_of_others(t, levels, e, others))
        return;
    for (size_t i = 0; i < levels->count; i++) {
        const double all = own[i] + others[i], off = fabs(levels->half[i] - levels->answer[i]);
        bar[i] = off <= (1 + of_twin) * all ? fmin(all, e->bar[i]) : e->bar[i];
    }
    accept(t, levels->at, bar, e);
}

static void measure_output(const accuracy_twins *t, accuracy_error *e)
{
    const double **refined = accuracy_take(t, t->count, sizeof *refined);
    double *shares = accuracy_take(t, t->count, sizeof *shares);
    accuracy_ladder levels = ladder_of(t, e);
    for (size_t i = 0; i < t->count; i++)
        refined[i] = numbers_of_twin(t, e, t->refined[i]);
    levels.refined = refined;
    levels.refined_count = t->count;
    if (!levels.half && !levels.quarter && !levels.twice)
        return;
    e->by_stage = false;
    e->bar = accuracy_take(t, levels.count, sizeof *e->bar);
    e->order = accuracy_estimate(&levels, e->bar, shares);
    raise_to_least(e, e->bar);
    find_relative(levels.at, e);
    add_parts(t, shares, e);
    raise_to_estimate(t, levels.at, e);
    lower_to_estimate(t, &levels, e);
    add_changes(t, &levels, e);
}

/* Widens the bar of a number to the bar of the series from which it is picked; the contributions of
   the settings keep their ratios, and the order is at most the order of the series. */
static void widen(accuracy_error *number, double bar, const accuracy_error *series)
{
    if (!(bar > number->bar[0] && isfinite(bar)) || number->result->data[0] == 0)
        return;
    double factor = bar / number->bar[0];
    number->bar[0] = bar;
    number->order = fmin(number->order, series->order); /* drops NaN */
    number->by_stage = series->by_stage;
    find_relative(NULL, number);
    for (size_t i = 0; isfinite(factor) && i < number->part_count; i++)
        number->parts[i].error *= factor;
}

/* Largest bar of the series at the points where the series has its maximum or minimum, if the
 * number equals that extreme; 0 if it equals neither. */
static double bar_at_extreme(const ff_result *number, const accuracy_error *series)
{
    const double value = number->data[0], *data = series->result->data;
    size_t above = 0, below = 0;
    double bar = 0;
    for (size_t i = 0; i < series->result->count; i++) {
        above += data[i] > value;
        below += data[i] < value;
        if (data[i] == value)
            bar = fmax(bar, series->bar[i]);
    }
    return above > 0 && below > 0 ? 0 : bar;
}

/* How far the maximum, or the minimum, of the series may be off by the bars of its points. */
static double bar_of_extreme(double value, const accuracy_error *series)
{
    const double *data = series->result->data;
    double least = INFINITY, most = -INFINITY, highest = -INFINITY, lowest = INFINITY;
    for (size_t i = 0; i < series->result->count; i++) {
        least = fmin(least, data[i] - series->bar[i]);
        most = fmax(most, data[i] + series->bar[i]);
        highest = fmax(highest, data[i] - series->bar[i]);
        lowest = fmin(lowest, data[i] + series->bar[i]);
    }
    const bool maximum = value >= highest;
    return maximum ? fmax(most - value, value - highest) : fmax(value - least, lowest - value);
}

/* Gives a number that is the extreme of a series at least the bar of the series at that point: a
 * single number may agree on two levels by chance. If the stage's estimates have lowered the bars
 * of the series, the number gets what these allow. */
static void compare_with_series(const accuracy_twins *t, accuracy_error *number)
{
    if (number->result->rank != 0 || !number->bar)
        return;
    for (size_t i = 0; i < t->record->count; i++) {
        const accuracy_error *e = &t->record->errors[i];
        if (e->stage != number->stage || e->result->rank != 1 || !e->bar ||
            strcmp(e->result->row->unit, number->result->row->unit) != 0)
            continue;
        const double least = bar_at_extreme(number->result, e);
        widen(number, least, e);
        double *bar = accuracy_take(t, 1, sizeof *bar);
        *bar = bar_of_extreme(number->result->data[0], e);
        if (least > 0 && t->carried && e->by_stage && *bar < number->bar[0])
            accept(t, NULL, bar, number);
    }
}

void accuracy_find_bars(const accuracy_twins *t)
{
    accuracy_record *record = t->record;
    for (size_t i = 0; i < record->count; i++)
        measure_output(t, &record->errors[i]);
    for (size_t i = 0; i < record->count; i++)
        compare_with_series(t, &record->errors[i]);
}
