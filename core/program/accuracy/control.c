/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Counts and tolerances are refined separately: each attempt refines, by one level, the one that
 * contributes more to the error. Earlier, coarser attempts serve as twins, so that all attempts
 * together cost about twice the last one. An output whose error grows, or falls too slowly to meet
 * its goal, no longer demands refinement.
 */
#include "control.h"

#include "choice.h"
#include "doubts.h"
#include "estimate.h"
#include "goals.h"
#include "models.h"
#include "open.h"
#include "settings.h"
#include "twin.h"

#include "../run/run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Share of a goal allowed to the reference model's own error while cheaper models are compared with
   it: they may use half of the goal (choice.c), and this error is added to what they change. */
static const double reference_error = 0.25;
/* One attempt, plus one for each level by which counts and tolerances can be refined. */
enum { MOST_ATTEMPTS = 11 };

typedef struct attempt {
    accuracy_twin run;
    accuracy_record record; /* empty if the attempt was not measured */
    accuracy_levels at;
    bool doubtful; /* coarser than the presets, and either in doubt or without room for twins: it
                      cannot be the answer */
} attempt;

typedef struct control {
    accuracy_scene scene;
    ff_pipeline *asked;          /* with the accepted models, once there are any */
    accuracy_choice *choice;     /* of models; NULL if it was not made yet or the file names all
                                    models */
    ff_run *chosen;              /* the run with the accepted models, not started; NULL while the
                                    file's models are used */
    accuracy_open open;          /* at the levels of the next attempt */
    attempt kept[MOST_ATTEMPTS]; /* attempts with the current models */
    size_t kept_count;
    attempt *best; /* the last good attempt, else the last one; NULL before the first */
    size_t attempts, twins;
    double seconds; /* CPU time of all runs, s */
    const char *failure;
    memory_arena arena;
} control;

static bool leaves_models_open(const ff_pipeline *pipeline)
{
    for (size_t i = 0; i < pipeline->count; i++)
        if (pipeline->stages[i].needed && accuracy_open_use(&pipeline->stages[i]))
            return true;
    return false;
}

/* The accepted models and the current settings as assignments; to be freed. */
static const char **list_sets(control *c, size_t *count)
{
    size_t models = c->chosen ? c->choice->use_count : 0;
    const char **sets = memory_alloc((models + c->open.count + 1) * sizeof *sets);
    *count = models + c->open.count;
    for (size_t i = 0; i < *count; i++)
        sets[i] = i < models ? c->choice->uses[i] : accuracy_open_set(&c->open, i - models);
    return sets;
}

static bool is_coarser_than_presets(accuracy_levels at)
{
    return at.counts > 0 || at.tolerances > 0;
}

/* Measures an attempt's errors; earlier attempts and their twins are reused. */
static void measure(control *c, attempt *a)
{
    const accuracy_twin *runs[MOST_ATTEMPTS * (1 + ACCURACY_OWN)];
    accuracy_known known = {
        .runs = runs, .said = a->run.report, .place = accuracy_place(c->scene.file)};
    for (size_t i = 0; i < c->kept_count; i++) {
        runs[known.count++] = &c->kept[i].run;
        for (size_t k = 0; k < c->kept[i].record.own_count; k++)
            runs[known.count++] = c->kept[i].record.own[k];
    }
    a->record.choice = c->choice;
    a->run.stopped =
        !accuracy_measure(&a->record, a->run.run, c->scene.engine, c->scene.watch, &known);
    c->twins += a->record.twins;
    c->seconds += a->record.seconds;
}

/* Runs and measures the file with the current settings. */
static void try_settings(control *c, attempt *next)
{
    size_t count;
    const char **sets = list_sets(c, &count);
    bool *changed = memory_alloc((c->asked->count + 1) * sizeof *changed);
    const ff_place place = accuracy_place(c->scene.file);
    c->scene.donor = c->best && c->best->run.good ? c->best->run.pipeline : NULL;
    for (size_t i = 0; i < c->open.count; i++)
        changed[c->open.knobs[i].stage - c->asked->stages] = true;
    accuracy_twin_run(&next->run, &c->scene, sets, count, &place, changed);
    accuracy_open_leave_idle(&c->open, next->run.report, place);
    next->at = c->open.at;
    next->doubtful = next->run.good && is_coarser_than_presets(c->open.at) &&
                     (!accuracy_open_has_twins(&c->open) ||
                      accuracy_has_doubts(next->run.pipeline, c->scene.donor));
    if (next->run.good && !next->doubtful)
        measure(c, next);
    next->doubtful |= c->open.at.counts > 0 && next->record.contradicted;
    c->attempts++;
    c->seconds += next->run.work;
    free(changed);
    free(sets);
}

static void attempt_free(attempt *a)
{
    a->record.choice = NULL; /* shared by all attempts */
    accuracy_free(&a->record);
    accuracy_twin_free(&a->run);
}

/* The goal of an error, tightened while models are to be chosen, since the answer is their
   reference. */
static double goal_of(const control *c, const accuracy_error *e)
{
    bool choosing = !c->choice && leaves_models_open(c->asked);
    return e->goal * (choosing ? reference_error : 1);
}

static bool is_missed(const control *c, const accuracy_error *e)
{
    return !isnan(e->goal) && !(e->relative <= goal_of(c, e));
}

/* Order at which the counts' part of an error falls, from the twins; 0 if it grows. An error that
   comes from settings fixed by the file falls in the twins but not in the attempts, so the last two
   attempts limit the order. */
static double order_of(const control *c, size_t error)
{
    const accuracy_error *e = &c->best->record.errors[error];
    const attempt *before = c->best > c->kept ? c->best - 1 : NULL;
    double order = isnan(e->order) ? 1 : e->order;
    if (*c->open.given && before && before->at.counts <= 0 && before->record.count > error)
        order = fmin(order, log2(before->record.errors[error].relative / e->relative));
    return fmax(order, 0);
}

/* True if the finest settings can meet the goal. Two levels show no order: the estimate then
   assumes second order at best, and a third level may lower the error to an eighth (estimate.c). */
static bool is_in_reach(const control *c, size_t error)
{
    const accuracy_error *e = &c->best->record.errors[error];
    double counts = e->relative - e->by_tolerances, left = c->open.at.counts - accuracy_finest;
    if (c->best->record.two_levels && isnan(e->order))
        return left > 0 && counts <= goal_of(c, e) * exp2(3 + 2 * left);
    return counts * exp2(-left * order_of(c, error)) +
               e->by_tolerances *
                   pow(accuracy_tolerance_factor, accuracy_finest - c->open.at.tolerances) <=
           goal_of(c, e);
}

/* Levels of the next attempt for an error above its goal: the larger part is refined by a level.
   Tolerances wait until the counts suffice, which not every output reaches. A part already at its
   finest leaves the refinement to the other. */
static accuracy_levels finer_for(const control *c, const accuracy_error *e)
{
    const double counts = e->relative - e->by_tolerances;
    accuracy_levels next = c->open.at;
    const bool by_tolerances = counts <= goal_of(c, e) && counts < e->by_tolerances;
    if ((by_tolerances && c->open.at.tolerances > accuracy_finest) ||
        c->open.at.counts <= accuracy_finest)
        next.tolerances -= 1;
    else
        next.counts -= 1;
    return next;
}

/* Sets the settings of the next attempt; false if the present one is the answer. If no output has a
   measured error, as when all turn out to be fields, the answer is that of the presets. */
static bool go_on(control *c)
{
    const accuracy_record *record = &c->best->record;
    const double finer = fmax(c->open.at.counts, c->open.at.tolerances) - 1;
    accuracy_levels next = c->open.at;
    if (!c->best->run.good && finer >= -1) /* if the presets fail, a finer attempt may succeed */
        next = (accuracy_levels){fmin(next.counts, finer), fmin(next.tolerances, finer)};
    if (c->best->run.good && (c->best->doubtful || record->count == 0)) {
        next.counts -= c->open.at.counts > 0 ? 1 : 0;
        next.tolerances -= c->open.at.counts > 0 ? 0 : fmax(c->open.at.tolerances, 0);
    }
    for (size_t i = 0; i < record->count; i++)
        if (is_missed(c, &record->errors[i]) && (c->open.at.counts > 0 || is_in_reach(c, i))) {
            accuracy_levels wanted = finer_for(c, &record->errors[i]);
            next.counts = fmin(next.counts, wanted.counts);
            next.tolerances = fmin(next.tolerances, wanted.tolerances);
        }
    return accuracy_open_move(&c->open, next);
}

static void take(control *c, const attempt *next)
{
    c->best = &c->kept[c->kept_count++];
    *c->best = *next;
}

static void drop_attempts(control *c)
{
    for (size_t i = 0; i < c->kept_count; i++)
        attempt_free(&c->kept[i]);
    c->kept_count = 0;
    c->best = NULL;
}

/* The smallest goal. */
static double least_goal(const control *c)
{
    double least = INFINITY;
    for (size_t i = 0; i < c->asked->count; i++) {
        const ff_stage *stage = &c->asked->stages[i];
        for (size_t k = 0; stage->results && k < stage->loaded->model->output_count; k++)
            if (stage->results[k].requested)
                least = fmin(least, accuracy_goal(c->scene.file, stage, &stage->results[k]));
    }
    return least;
}

/* Starts again with the accepted models. */
static void begin_with(control *c, const accuracy_choice *choice)
{
    const ff_place place = accuracy_place(c->scene.file);
    c->chosen = run_copy(c->scene.file);
    for (size_t i = 0; i < choice->use_count; i++)
        run_set(c->chosen, choice->uses[i], &place, &place);
    c->asked = run_build(c->chosen, false); /* as for a try, so that it repeats no message */
    accuracy_hand_states(c->scene.start, c->asked);
    c->scene.start = c->asked;
    drop_attempts(c);
    accuracy_open_list(&c->open, c->asked);
    accuracy_open_begin(&c->open, least_goal(c));
}

/* Measures a doubtful attempt if nothing better exists; false if the observer stopped it. */
static bool measure_doubtful(control *c)
{
    if (c->best->doubtful && c->best->record.count == 0 && !c->best->run.stopped)
        measure(c, c->best);
    return !c->best->run.stopped;
}

/* Chooses models where the file leaves them open. Returns true if there is more to do. */
static bool choose_models(control *c)
{
    size_t count;
    accuracy_open_move(&c->open, c->best->at); /* not the levels of a failed attempt */
    if (!measure_doubtful(c))
        return false;
    const char **sets = list_sets(c, &count);
    c->choice = memory_alloc(sizeof *c->choice);
    c->best->record.choice = c->choice;
    c->best->run.stopped =
        !accuracy_choose(c->choice, &c->scene, &c->best->run, &c->best->record, sets, count);
    free(sets);
    c->twins += c->choice->runs;
    c->seconds += c->choice->seconds;
    if (c->best->run.stopped)
        return false;
    if (!c->choice->differs)
        return !c->failure && go_on(c);
    begin_with(c, c->choice);
    return true;
}

/* Makes an attempt. False if it was stopped, or failed although a coarser one had succeeded. */
static bool try_next(control *c)
{
    attempt next = {.run = {.good = false}};
    try_settings(c, &next);
    if (next.run.stopped || next.run.good || !c->best || !c->best->run.good) {
        take(c, &next);
        return !next.run.stopped;
    }
    const char *why = accuracy_twin_reason(&next.run);
    c->failure = memory_arena_text(&c->arena, why, strlen(why));
    c->kept[c->kept_count++] = next;
    return false;
}

static size_t count_kept(const control *c, const attempt *a)
{
    size_t kept = 0;
    for (size_t i = 0; a->run.good && !a->doubtful && i < a->record.count; i++)
        kept += !isnan(a->record.errors[i].goal) && !is_missed(c, &a->record.errors[i]);
    return kept;
}

/* Moves the best attempt to the end: the one that meets most goals, and the latest among equals.
   Finer settings for one output can reveal a larger error in another, so the best is not always the
   last. */
static void choose_best(control *c)
{
    attempt *best = c->best, *last = &c->kept[c->kept_count - 1];
    for (attempt *a = best; a-- > c->kept;)
        if (count_kept(c, a) > count_kept(c, best))
            best = a;
    const attempt chosen = *best;
    *best = *last;
    *last = chosen;
    c->best = last;
}

/* Makes attempts until one is the answer; false if the observer stopped one. */
static bool search(control *c)
{
    accuracy_open_begin(&c->open, least_goal(c));
    for (bool again = true; again;) {
        again = try_next(c) && go_on(c) && c->kept_count < MOST_ATTEMPTS;
        if (!again && c->best->run.good && !c->best->run.stopped && !c->choice &&
            leaves_models_open(c->asked))
            again = choose_models(c) && c->kept_count < MOST_ATTEMPTS;
    }
    if (!measure_doubtful(c))
        return false;
    choose_best(c);
    return true;
}

static void note_spent(const accuracy_twin *run, accuracy_record *record)
{
    accuracy_spent *spent = &record->spent[record->spent_count];
    accuracy_setting settings[ACCURACY_MOST_SETTINGS];
    if (!run->pipeline)
        return;
    *spent = (accuracy_spent){.seconds = run->work};
    size_t most = run->pipeline->count * ACCURACY_MOST_SETTINGS;
    spent->settings = memory_arena_alloc(&record->arena, most * sizeof *spent->settings + 1);
    for (size_t i = 0; i < run->pipeline->count; i++) {
        const ff_stage *stage = &run->pipeline->stages[i];
        size_t count = stage->needed && stage->loaded ? accuracy_settings(stage, settings) : 0;
        for (size_t k = 0; k < count; k++) {
            const char *set = accuracy_setting_at(stage, settings[k].param, 0, &record->arena);
            if (set)
                spent->settings[spent->setting_count++] = set;
        }
    }
    record->spent_count++;
}

/* Lists the attempts with the current models, and their twins. */
static void list_spent(const control *c, accuracy_record *record)
{
    size_t most = c->kept_count * (1 + ACCURACY_OWN);
    record->spent = memory_arena_alloc(&record->arena, most * sizeof *record->spent);
    for (size_t i = 0; i < c->kept_count; i++) {
        const attempt *a = &c->kept[i];
        note_spent(&a->run, record);
        for (size_t k = 0; k < a->record.own_count; k++)
            note_spent(a->record.own[k], record);
    }
}

/* Makes the best attempt the answer. */
static void adopt(control *c, accuracy_record *record)
{
    ff_pipeline *asked = record->answer;
    accuracy_open_move(&c->open, c->best->at);
    *record = c->best->record;
    list_spent(c, record);
    record->twin = memory_alloc(sizeof *record->twin);
    *record->twin = c->best->run;
    record->answer = c->best->run.pipeline ? c->best->run.pipeline : asked;
    c->kept_count--; /* the best one is the last */
    drop_attempts(c);
    record->choice = c->choice;
    c->choice = NULL;
    record->attempts = c->attempts;
    record->twins = c->twins;
    record->seconds = c->seconds - record->twin->work;
    if (c->failure)
        record->failure = memory_arena_text(&record->arena, c->failure, strlen(c->failure));
    record->given = memory_arena_text(&record->arena, c->open.given, strlen(c->open.given));
    size_t models = record->choice ? record->choice->use_count : 0;
    record->chosen =
        memory_arena_alloc(&record->arena, (models + c->open.count + 1) * sizeof *record->chosen);
    for (size_t i = 0; i < models; i++)
        record->chosen[record->chosen_count++] = record->choice->uses[i];
    for (size_t i = 0; i < c->open.count; i++) {
        if (c->open.knobs[i].idle)
            continue;
        const char *set = accuracy_open_set(&c->open, i);
        record->chosen[record->chosen_count++] =
            memory_arena_text(&record->arena, set, strlen(set));
    }
}

bool accuracy_control(accuracy_record *record, const ff_run *run, ff_engine *engine,
                      const ff_observer *watch, ff_report *report)
{
    ff_pipeline *pipeline = ff_run_pipeline(run);
    control c = {.scene = {.file = run, .engine = engine, .start = pipeline, .watch = watch},
                 .asked = pipeline};
    accuracy_open_list(&c.open, pipeline);
    bool finished = search(&c);
    if (finished) {
        adopt(&c, record);
        accuracy_twin_hand_on(record->twin, accuracy_place(run), watch, report);
    }
    bool good = finished && record->twin->good;
    drop_attempts(&c);
    if (c.choice)
        accuracy_choice_free(c.choice);
    free(c.choice);
    ff_run_close(c.chosen);
    accuracy_open_free(&c.open);
    memory_arena_free(&c.arena);
    return good;
}
