/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure.h"

#include "axis.h"
#include "bars.h"
#include "choice.h"
#include "goals.h"
#include "lines.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Ratio of the error bar from one twin two levels coarser to the error, if its order is 2: the bar
 * is 1.25 times the difference from the twin (estimate.c), and the difference is 4^2 - 1 times the
 * error. */
static const double bar_of_two_levels = 1.25 * 15;

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
    record->errors = accuracy_take(t, most, sizeof *record->errors);
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

/* The stage's own estimate of the error in the form of the goal: along a series the typical one,
 * over the numbers with a known error. NaN: there is none. */
static double estimate_of(const accuracy_twins *t, const accuracy_error *e)
{
    const ff_result *result = e->result, *along = accuracy_axis_of(t->answer, e->stage, result);
    const accuracy_series answer = accuracy_series_of(along ? along->data : NULL, e);
    double *own = accuracy_take(t, result->count, sizeof *own), largest;
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
    accuracy_find_bars(t);
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
        accuracy_find_bars(&t);
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
