/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure.h"

#include "axis.h"
#include "choice.h"
#include "compare.h"
#include "estimate.h"
#include "goals.h"
#include "lines.h"
#include "twins.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Ratio of the error bar from one twin two levels coarser to the error, if its order is 2: the bar
 * is 1.25 times the difference from the twin (estimate.c), and the difference is 4^2 - 1 times the
 * error. */
static const double bar_of_two_levels = 1.25 * 15;

/* Smallest error that is stated, as a share of the goal: twins may agree by chance. */
static const double least_error = 0.1;

static void *take(const accuracy_twins *t, size_t count, size_t size)
{
    return memory_arena_alloc(&t->record->arena, count * size + 1);
}

/* True for requested outputs that are not error estimates themselves. */
static bool is_headline(const ff_stage *stage, const ff_result *result)
{
    bool finite = result->data && result->requested && result->rank <= 1 && result->count > 0 &&
                  !accuracy_is_estimate(stage, result);
    for (size_t i = 0; finite && i < result->count; i++)
        finite = isfinite(result->data[i]);
    return finite && !accuracy_is_axis(result);
}

/* Zero point of an output's relative errors, which its row names: for a temperature, that of the
 * oil. */
static double zero_of(const ff_pipeline *answer, const ff_stage *stage, const ff_result *result)
{
    const char *origin = result->row->origin;
    int input = origin ? ff_model_find_input(stage->loaded->model, origin) : -1;
    const ff_result *from = input < 0 ? NULL : ff_feeding_result(answer, stage, (size_t)input);
    return from && from->data && from->rank == 0 ? from->data[0] : 0;
}

/* Lists the outputs to be measured, and requests them from the twins. */
static void list_outputs(accuracy_twins *t)
{
    const ff_pipeline *answer = t->answer;
    accuracy_record *record = t->record;
    char *text = NULL;
    size_t length = 0, most = 0;
    for (size_t s = 0; s < answer->count; s++)
        most += answer->stages[s].ran ? answer->stages[s].loaded->model->output_count : 0;
    record->errors = take(t, most, sizeof *record->errors);
    FILE *out = memory_require(open_memstream(&text, &length));
    fputs("outputs=[", out);
    for (size_t s = 0; s < answer->count; s++) {
        const ff_stage *stage = &answer->stages[s];
        for (size_t i = 0; stage->ran && i < stage->loaded->model->output_count; i++) {
            if (!is_headline(stage, &stage->results[i]))
                continue;
            accuracy_error *e = &record->errors[record->count++];
            *e = (accuracy_error){.stage = stage,
                                  .result = &stage->results[i],
                                  .zero_point = zero_of(answer, stage, &stage->results[i]),
                                  .relative = NAN,
                                  .reached = NAN,
                                  .largest = NAN,
                                  .order = NAN};
            e->goal = accuracy_goal(t->scene.file, stage, e->result, &e->absolute);
            fprintf(out, "%s%s.%s", record->count > 1 ? ", " : "", stage->name,
                    e->result->row->name);
        }
    }
    putc(']', out);
    fclose(out);
    t->scene.outputs = memory_arena_text(&record->arena, text, length);
    free(text);
}

static accuracy_series series_of(const double *at, const accuracy_error *e)
{
    return (accuracy_series){e->result->rank, e->result->count, at,
                             e->result->data, e->zero_point,    e->absolute};
}

/* Computes the relative error of an output: typical along a series, and largest. */
static void find_relative(const double *at, accuracy_error *e)
{
    accuracy_series answer = series_of(at, e);
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
    e->parts = take(t, most, sizeof *e->parts);
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
    const accuracy_series answer = series_of(NULL, e);
    double *scale = take(t, result->count, sizeof *scale);
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
    double *own = take(t, e->result->count, sizeof *own);
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
    double *own = take(t, levels->count, sizeof *own),
           *others = take(t, levels->count, sizeof *own),
           *bar = take(t, levels->count, sizeof *own);
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
    const double **refined = take(t, t->count, sizeof *refined);
    double *shares = take(t, t->count, sizeof *shares);
    accuracy_ladder levels = ladder_of(t, e);
    for (size_t i = 0; i < t->count; i++)
        refined[i] = numbers_of_twin(t, e, t->refined[i]);
    levels.refined = refined;
    levels.refined_count = t->count;
    if (!levels.half && !levels.quarter && !levels.twice)
        return;
    e->by_stage = false;
    e->bar = take(t, levels.count, sizeof *e->bar);
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
        double *bar = take(t, 1, sizeof *bar);
        *bar = bar_of_extreme(number->result->data[0], e);
        if (least > 0 && t->carried && e->by_stage && *bar < number->bar[0])
            accept(t, NULL, bar, number);
    }
}

static void conclude(const accuracy_twins *t)
{
    accuracy_record *record = t->record;
    for (size_t i = 0; i < record->count; i++)
        measure_output(t, &record->errors[i]);
    for (size_t i = 0; i < record->count; i++)
        compare_with_series(t, &record->errors[i]);
}

/* The stage's own estimate of the error in the form of the goal: along a series the typical one,
 * over the numbers with a known error. NaN: there is none. */
static double estimate_of(const accuracy_twins *t, const accuracy_error *e)
{
    const ff_result *result = e->result, *along = accuracy_axis_of(t->answer, e->stage, result);
    const accuracy_series answer = series_of(along ? along->data : NULL, e);
    double *own = take(t, result->count, sizeof *own), largest;
    if (!accuracy_fill_estimates(e->stage, result, own))
        return NAN;
    if (accuracy_is_least(e->stage, result))
        return INFINITY;
    for (size_t i = 0; i < result->count; i++)
        own[i] = isfinite(own[i]) ? own[i] : 0;
    return accuracy_relative(own, &answer, &largest);
}

/* Whether the estimate `of` a series, or of the number itself, is above the goal of `e`. */
static bool misses_by_estimate(const accuracy_twins *t, const accuracy_error *e,
                               const accuracy_error *of)
{
    const bool same = of == e || (of->stage == e->stage && !of->absolute && !e->absolute &&
                                  !strcmp(of->result->row->unit, e->result->row->unit));
    return same && estimate_of(t, of) > e->goal; /* false if one is NaN */
}

/* True if a stage's own estimate is above a goal. */
static bool some_misses_by_estimate(const accuracy_twins *t)
{
    const accuracy_record *record = t->record;
    bool some = false;
    for (size_t i = 0; i < record->count; i++)
        for (size_t k = 0; k < record->count; k++)
            some = some || misses_by_estimate(t, &record->errors[i], &record->errors[k]);
    return some;
}

/* The stage that estimates errors of its own; SIZE_MAX if there is none, or several, whose errors a
 * twin would have to tell apart. */
static size_t find_estimating(const accuracy_twins *t)
{
    size_t found = SIZE_MAX;
    for (size_t i = 0; i < t->record->count; i++) {
        const accuracy_error *e = &t->record->errors[i];
        const size_t stage = (size_t)(e->stage - t->answer->stages);
        if (isnan(estimate_of(t, e)))
            continue;
        if (found != SIZE_MAX && found != stage)
            return SIZE_MAX;
        found = stage;
    }
    return found;
}

/* True if stages estimate errors of series, and all these errors are so small that a twin two
 * levels coarser is expected to show that the goals are met. A stage that estimates some of its
 * errors must estimate those of all its series: losses converge more slowly than films. */
static bool suit_far_twin(const accuracy_twins *t)
{
    const accuracy_record *record = t->record;
    bool some = false, all = true;
    for (size_t i = 0; i < record->count; i++) {
        const accuracy_error *e = &record->errors[i];
        const bool series = accuracy_estimate_of(e->stage, e->result),
                   without = !series && e->result->rank > 0 &&
                             t->estimating == (size_t)(e->stage - t->answer->stages);
        some = some || series;
        all = all && !without && !(series && estimate_of(t, e) > e->goal / bar_of_two_levels);
    }
    return some && all;
}

/* True if another twin may lower the bar of an error that is above its goal, or determine an
 * unknown error. No twin lowers a bar below the stage's own estimate. */
static bool misses(const accuracy_record *record)
{
    bool missed = false;
    for (size_t i = 0; i < record->count; i++) {
        const accuracy_error *e = &record->errors[i];
        missed = missed || isnan(e->reached) || (e->reached > e->goal && !e->by_stage);
    }
    return missed;
}

/* True if the twins' bars miss goals that the stages' own estimates meet. */
static bool misses_by_twins(const accuracy_twins *t)
{
    const accuracy_record *record = t->record;
    bool some = false;
    for (size_t i = 0; i < record->count; i++) {
        const accuracy_error *e = &record->errors[i];
        some = some || (e->bar && !(e->reached <= e->goal) && estimate_of(t, e) <= e->goal);
    }
    return some;
}

/* Lowers such bars to the estimates, as soon as it is known what other stages add to them. */
static void carry(accuracy_twins *t)
{
    const bool others = accuracy_twins_have_others(t);
    if (t->estimating == SIZE_MAX || t->carried || !t->half || (others && !t->quarter) ||
        !misses_by_twins(t))
        return;
    if (others)
        accuracy_twins_run_others(t);
    t->carried = !others || t->others_finer;
    conclude(t);
}

/* Returns the difference of an output between two twins. */
static double between_twins(const accuracy_twins *t, const accuracy_error *e,
                            const accuracy_twin *one, const accuracy_twin *other)
{
    return accuracy_between(e, t->answer, one->pipeline, other->pipeline, &t->record->arena);
}

/* Finds which part of each error above its goal is due to settings of the file: their share of the
 * difference between the two coarser twins. */
static void find_fixed_part(accuracy_twins *t)
{
    accuracy_twins_run_fixed(t);
    for (size_t i = 0; t->fixed_finer && i < t->record->count; i++) {
        accuracy_error *e = &t->record->errors[i];
        const double all = between_twins(t, e, t->quarter, t->half);
        const double share = between_twins(t, e, t->quarter, t->fixed_finer) / all;
        if (all > 0 && e->reached > e->goal && !e->by_stage) /* NaN: not comparable */
            e->fixed_part = e->reached * fmin(fmax(share, 0), 1);
    }
}

/* Returns the twins for the answer of an attempt, or of the file's own run. */
static accuracy_twins twins_of(accuracy_record *record, const accuracy_scene *scene,
                               const accuracy_twin *attempt)
{
    const ff_run *run = attempt ? attempt->run : scene->file;
    accuracy_twins t = {.record = record,
                        .scene = *scene,
                        .answer = ff_run_pipeline(run),
                        .messages = attempt ? attempt->report : NULL,
                        .request = accuracy_place(scene->file)};
    t.scene.file = run;
    t.scene.start = t.answer;
    t.scene.outputs = NULL;
    return t;
}

bool accuracy_measure(accuracy_record *record, const accuracy_scene *scene,
                      const accuracy_twin *attempt, enum accuracy_effort effort)
{
    accuracy_twins t = twins_of(record, scene, attempt);
    t.one_by_one = effort != ACCURACY_PARTS;
    list_outputs(&t);
    t.estimating = find_estimating(&t);
    t.estimates = effort == ACCURACY_ORDER || some_misses_by_estimate(&t);
    t.far_first = t.one_by_one && !t.estimates && suit_far_twin(&t);
    for (bool missed = true; missed && accuracy_twins_find(&t) && !t.stopped;) {
        conclude(&t);
        if (effort == ACCURACY_ENOUGH)
            carry(&t);
        missed = effort == ACCURACY_ORDER || (effort == ACCURACY_ENOUGH && misses(record));
    }
    if (t.one_by_one && t.half && t.quarter && !t.stopped && misses(record))
        find_fixed_part(&t);
    record->two_levels = t.half && !t.quarter;
    return !t.stopped;
}

bool accuracy_check_twin(accuracy_record *record, const accuracy_scene *scene)
{
    accuracy_twins t = twins_of(record, scene, record->twin);
    const size_t before = scene->runs->count;
    const char *failure = record->failure;
    record->failure = NULL;
    const accuracy_twin *finer = accuracy_twins_find_finer(&t);
    const bool good = finer && finer->good;
    record->checked = true;
    record->from_finer = finer && scene->runs->count == before;
    if (!good)
        record->check_failure = finer ? accuracy_twin_reason(finer) : record->failure;
    record->failure = failure ? failure : record->failure;
    for (size_t i = 0; i < record->count; i++) {
        accuracy_error *e = &record->errors[i];
        e->twin_difference =
            good ? accuracy_between(e, t.answer, t.answer, finer->pipeline, &record->arena)
                 : (double)NAN;
    }
    return !t.stopped;
}

size_t accuracy_twin_count(const accuracy_record *record)
{
    return record->runs.count - record->attempts;
}

double accuracy_seconds(const accuracy_record *record)
{
    double seconds = 0;
    for (size_t i = 0; i < record->runs.count; i++)
        seconds += record->runs.list[i] == record->twin ? 0 : record->runs.list[i]->work;
    return seconds;
}

void accuracy_free(accuracy_record *record)
{
    accuracy_runs_free(&record->runs);
    if (record->choice)
        accuracy_choice_free(record->choice);
    free(record->choice);
    memory_arena_free(&record->arena);
    *record = (accuracy_record){.count = 0};
}

const accuracy_error *accuracy_find(const accuracy_record *record, const ff_result *result)
{
    for (size_t i = 0; record && i < record->count; i++)
        if (record->errors[i].result == result)
            return &record->errors[i];
    return NULL;
}
