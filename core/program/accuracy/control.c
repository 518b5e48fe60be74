/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The first attempt uses the presets. If a goal is missed, and the measured errors and orders
 * predict that the finest level meets it, the next attempt is one level finer. A level costs about
 * four times the previous one, so all coarser attempts together, which serve as its twins, cost a
 * third of it. The prediction is repeated after each attempt, so the search ends before the most
 * expensive levels if they would not help. */
#include "control.h"

#include "choice.h"
#include "estimate.h"
#include "goals.h"
#include "lines.h"
#include "models.h"
#include "open.h"
#include "settings.h"
#include "twin.h"

#include "../run/run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Share of a goal allowed to the reference model's own error while cheaper models are compared with
 * it: they may use half of the goal (choice.c), and this error is added to theirs. */
static const double reference_error = 0.25;
/* Two levels show no order, so their error bar assumes order 1/2. A third level may reduce the bar
 * to an eighth (estimate.c). */
static const double less_by_third_level = 8;
/* A series whose error falls with less than this order, the lowest order that estimate.c assumes,
   does not visibly converge. */
static const double least_order = 0.5;
/* The presets and the three finer levels. */
enum { MOST_ATTEMPTS = 4 };

typedef struct attempt {
    const accuracy_twin *run;
    accuracy_record record; /* the errors of the run; empty if the attempt failed */
    double at;              /* levels coarser than the presets */
} attempt;

typedef struct control {
    accuracy_scene scene;
    ff_pipeline *pipeline;       /* the file's pipeline, or the one with the accepted models */
    accuracy_choice *choice;     /* the choice of models; NULL if it was not made yet, or if the
                                  * file names all models */
    ff_run *chosen;              /* the run with the accepted models, not started; NULL while the
                                    file's models are used */
    accuracy_open open;          /* the open settings, at the levels of the next attempt */
    attempt kept[MOST_ATTEMPTS]; /* attempts with the current models */
    size_t kept_count;
    attempt *best; /* the last good attempt, else the last one; NULL before the first */
    size_t attempts;
    bool stopped; /* by the observer */
    const char *failure;
    char *progress; /* text for the progress line */
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

/* The share of a goal that an error must meet: less while models are to be chosen, since the answer
   is their reference. */
static double goal_share(const control *c)
{
    return !c->choice && leaves_models_open(c->pipeline) ? reference_error : 1;
}

static double goal_of(const control *c, const accuracy_error *e)
{
    return e->goal * goal_share(c);
}

static bool is_missed(const control *c, const accuracy_error *e)
{
    return !isnan(e->goal) && !(e->reached <= goal_of(c, e));
}

static size_t count_kept(const control *c, const attempt *a)
{
    size_t kept = 0;
    for (size_t i = 0; a->run->good && i < a->record.count; i++)
        kept += !isnan(a->record.errors[i].goal) && !is_missed(c, &a->record.errors[i]);
    return kept;
}

/* Predicts the cost of the next attempt relative to the one with the presets: each open setting of
 * a stage doubles the CPU time of the stage. */
static double predict_cost(const control *c)
{
    const ff_pipeline *last = c->best->run->pipeline;
    const double presets = c->kept[0].run->work;
    double next = 0;
    for (size_t i = 0; i < last->count; i++)
        next += last->stages[i].work * exp2((double)accuracy_open_count(&c->open, i));
    return presets > 0 ? next / presets : 1;
}

/* Writes the progress text: the number and the predicted cost of the attempt that begins, how many
 * goals the previous one met, and which output is farthest from its goal. */
static void write_progress(const control *c)
{
    const accuracy_error *worst = NULL;
    size_t goals = 0;
    if (!c->progress)
        return;
    snprintf(c->progress, ACCURACY_PROGRESS, "attempt %zu, with the presets", c->attempts + 1);
    for (size_t i = 0; c->best && c->best->run->good && i < c->best->record.count; i++) {
        const accuracy_error *e = &c->best->record.errors[i];
        goals += isnan(e->goal) ? 0 : 1;
        if (is_missed(c, e) && (!worst || e->reached / e->goal > worst->reached / worst->goal))
            worst = e;
    }
    if (!worst)
        return;
    char *reached = accuracy_print_reached(worst), *goal = accuracy_print_goal(worst);
    snprintf(c->progress, ACCURACY_PROGRESS,
             "attempt %zu at %.2g times the cost: %zu of %zu goals reached, %.40s has %s, goal %s",
             c->attempts + 1, predict_cost(c), count_kept(c, c->best), goals,
             worst->result->row->name, reached, goal);
    free(goal);
    free(reached);
}

/* Measures an attempt's errors. */
static void measure(control *c, attempt *a)
{
    a->record.choice = c->choice;
    a->record.progress = c->progress;
    a->record.attempts = c->attempts + 1;
    c->stopped = !accuracy_measure(&a->record, &c->scene, a->run,
                                   goal_share(c) < 1 ? ACCURACY_ORDER : ACCURACY_ENOUGH);
}

/* Runs and measures the file with the current settings. */
static void try_settings(control *c, attempt *next)
{
    size_t count;
    const char **sets = list_sets(c, &count);
    bool *changed = memory_alloc((c->pipeline->count + 1) * sizeof *changed);
    const ff_place place = accuracy_place(c->scene.file);
    c->scene.reuse_from = c->best && c->best->run->good ? c->best->run->pipeline : NULL;
    for (size_t i = 0; i < c->open.count; i++)
        changed[c->open.knobs[i].stage] = true;
    write_progress(c);
    next->run = accuracy_twin_run(&c->scene, sets, count, &place, changed);
    c->stopped = next->run->stopped;
    accuracy_open_freeze_idle(&c->open, next->run->report, place);
    next->at = c->open.at;
    if (next->run->good)
        measure(c, next);
    c->attempts++;
    free(changed);
    free(sets);
}

/* Order at which an error falls; 0 if it grows. */
static double order_of(const accuracy_error *e)
{
    return isnan(e->order) ? 1 : fmin(fmax(e->order, 0), 2);
}

/* True if the output is a single number, and a series of the same stage and unit does not converge:
 * the observed order of the number is then accidental. */
static bool is_by_chance(const control *c, const accuracy_error *e)
{
    const accuracy_record *record = &c->best->record;
    bool chance = false;
    for (size_t i = 0; i < record->count && e->result->rank == 0; i++) {
        const accuracy_error *series = &record->errors[i];
        chance = chance || (series->stage == e->stage && series->result->rank == 1 &&
                            !strcmp(series->result->row->unit, e->result->row->unit) &&
                            is_missed(c, series) && order_of(series) < least_order);
    }
    return chance;
}

/* True if an error above its goal is expected to meet the goal at the finest level, where the part
 * that is due to settings of the file stays. False if the stage estimates the error itself and the
 * file fixes all settings that could lower it. */
static bool is_promising(const control *c, const accuracy_error *e)
{
    const size_t stage = (size_t)(e->stage - c->best->run->pipeline->stages);
    const bool two = c->best->record.two_levels && !e->by_stage;
    const double order = two ? 2 : order_of(e), levels = c->open.at - accuracy_finest;
    const double error = e->reached / (two ? less_by_third_level : 1);
    if ((e->by_stage && accuracy_open_count(&c->open, stage) == 0) || is_by_chance(c, e))
        return false;
    return e->fixed_part + (error - e->fixed_part) * exp2(-order * levels) <= goal_of(c, e);
}

/* Sets the level of the next attempt; false if the present one is the answer. */
static bool set_next_level(control *c)
{
    const accuracy_record *record = &c->best->record;
    bool promising = !c->best->run->good && c->kept_count == 1; /* finer settings may succeed */
    for (size_t i = 0; c->best->run->good && i < record->count; i++)
        promising =
            promising || (is_missed(c, &record->errors[i]) && is_promising(c, &record->errors[i]));
    return promising && c->open.at > accuracy_finest &&
           accuracy_open_move(&c->open, c->open.at - 1);
}

static void drop_attempts(control *c)
{
    for (size_t i = 0; i < c->kept_count; i++)
        memory_arena_free(&c->kept[i].record.arena);
    c->kept_count = 0;
    c->best = NULL;
}

/* Starts again with the accepted models. */
static void begin_with(control *c, const accuracy_choice *choice)
{
    const ff_place place = accuracy_place(c->scene.file);
    c->chosen = run_copy(c->scene.file);
    for (size_t i = 0; i < choice->use_count; i++)
        run_set(c->chosen, choice->uses[i], &place, &place);
    c->pipeline = run_build(c->chosen, false); /* as for a try, so that it repeats no message */
    accuracy_copy_states(c->scene.start, c->pipeline);
    c->scene.start = c->pipeline;
    drop_attempts(c);
    accuracy_open_list(&c->open, c->pipeline);
}

/* Chooses models where the file leaves them open. Returns true if there is more to do. */
static bool choose_models(control *c)
{
    size_t count;
    accuracy_open_move(&c->open, c->best->at); /* not the levels of a failed attempt */
    const char **sets = list_sets(c, &count);
    c->choice = memory_alloc(sizeof *c->choice);
    c->best->record.choice = c->choice;
    c->stopped =
        !accuracy_choose(c->choice, &c->scene, c->best->run, &c->best->record, sets, count);
    free(sets);
    if (c->stopped)
        return false;
    if (!c->choice->differs)
        return !c->failure && set_next_level(c);
    begin_with(c, c->choice);
    return true;
}

/* Makes an attempt. False if it was stopped, or failed although a coarser one had succeeded. */
static bool try_next(control *c)
{
    attempt next = {.run = NULL};
    try_settings(c, &next);
    const bool better = next.run->good || !c->best || !c->best->run->good;
    c->kept[c->kept_count++] = next;
    if (c->stopped || better)
        c->best = &c->kept[c->kept_count - 1];
    else
        c->failure = accuracy_twin_reason(next.run);
    return better && !c->stopped;
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
    for (bool again = true; again;) {
        again = try_next(c) && set_next_level(c) && c->kept_count < MOST_ATTEMPTS;
        if (!again && !c->stopped && c->best->run->good && !c->choice &&
            leaves_models_open(c->pipeline))
            again = choose_models(c) && c->kept_count < MOST_ATTEMPTS;
    }
    if (!c->stopped)
        choose_best(c);
    return !c->stopped;
}

/* Makes the best attempt the answer. */
static void adopt(control *c, accuracy_record *record)
{
    const accuracy_record request = *record;
    accuracy_open_move(&c->open, c->best->at);
    *record = c->best->record;
    record->progress = request.progress;
    record->runs = request.runs;
    record->twin = c->best->run;
    record->answer = c->best->run->pipeline ? c->best->run->pipeline : request.answer;
    c->kept_count--; /* the best one is the last */
    record->choice = c->choice;
    c->choice = NULL;
    record->attempts = c->attempts;
    record->failure = c->failure ? c->failure : record->failure;
    record->fixed = memory_arena_text(&record->arena, c->open.fixed, strlen(c->open.fixed));
    size_t models = record->choice ? record->choice->use_count : 0;
    record->chosen =
        memory_arena_alloc(&record->arena, (models + c->open.count + 1) * sizeof *record->chosen);
    for (size_t i = 0; i < models; i++)
        record->chosen[record->chosen_count++] = record->choice->uses[i];
    for (size_t i = 0; i < c->open.count; i++) {
        if (c->open.levels[i].idle)
            continue;
        const char *set = accuracy_open_set(&c->open, i);
        record->chosen[record->chosen_count++] =
            memory_arena_text(&record->arena, set, strlen(set));
    }
}

bool accuracy_control(accuracy_record *record, const accuracy_scene *scene, ff_report *report)
{
    control c = {.scene = *scene, .pipeline = record->answer, .progress = record->progress};
    accuracy_open_list(&c.open, c.pipeline);
    bool finished = search(&c);
    if (finished) {
        adopt(&c, record);
        accuracy_twin_copy_messages(record->twin, accuracy_place(scene->file), scene->watch,
                                    report);
    }
    bool good = finished && record->twin->good;
    drop_attempts(&c);
    if (c.choice)
        accuracy_choice_free(c.choice);
    free(c.choice);
    ff_run_close(c.chosen);
    memory_arena_free(&c.open.arena);
    return good;
}
