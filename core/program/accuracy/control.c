/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * All settings become finer together: an attempt that is finer by a level than the one before, and
 * that by one than the one before it, has both as its twins, and what is spent on all of them is
 * little more than the last one costs. A setting of the dearest stage that adds little to the error
 * stays as it is, for which a coarse twin is tried. An output whose error grows, or falls too
 * slowly to come below what is asked for, is left out, so that it does not take the others with it.
 */
#include "control.h"

#include "axis.h"
#include "choice.h"
#include "compare.h"
#include "doubts.h"
#include "goals.h"
#include "models.h"
#include "open-settings.h"
#include "twin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* From the first attempt on, which is coarser than the presets by so many levels, each is finer by
   one, so that those before are its twins; a level costs four times as much, and all before a third
   of the last. */
static const double coarsest = 2;
/* Of the reference, over the goal, when models are held against it: they may move half of a goal
   (choice.c), and its error counts with what they move. */
static const double reference_error = 0.25;
/* A setting of the dearest stage whose share of the error is at most this stays as it is when the
   others become finer: their errors fall to a quarter, and it then adds at most half of that. */
static const double minor = 0.125;
enum { MOST_ATTEMPTS = 8 };

typedef struct attempt {
    accuracy_twin run;
    accuracy_record record;                       /* of a doubtful one empty */
    accuracy_twin trials[ACCURACY_MOST_SETTINGS]; /* one setting is a level coarser in each */
    size_t trial_count;
    double level;
    double *levels; /* of the open settings */
    bool doubtful; /* coarser than the presets, and in doubt or without room for twins: no answer */
} attempt;

typedef struct control {
    accuracy_scene scene;
    ff_pipeline *asked;      /* with the models that were chosen, when they are */
    accuracy_choice *choice; /* of models; NULL: not made yet, or the file names them all */
    ff_tree *tree;           /* of the models that were chosen; NULL: those of the file */
    accuracy_open open;
    double level;                /* of the next attempt */
    attempt kept[MOST_ATTEMPTS]; /* with the models as they are */
    size_t kept_count;
    attempt *best; /* the last one, good if any was; NULL: none was made */
    size_t attempts, twins;
    double seconds; /* s: CPU time of all that was run */
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

static bool set_level(control *c, double level)
{
    c->level = level;
    return accuracy_open_move(&c->open, level);
}

/* The models that were chosen, and the settings as they are; to be freed. */
static const char **list_sets(control *c, size_t *count)
{
    size_t models = c->tree ? c->choice->use_count : 0;
    const char **sets = memory_alloc((models + c->open.count + 1) * sizeof *sets);
    *count = models + c->open.count;
    for (size_t i = 0; i < *count; i++)
        sets[i] = i < models ? c->choice->uses[i] : accuracy_open_set(&c->open, i - models);
    return sets;
}

/* What was run before serves as twins. */
static void measure(control *c, attempt *a)
{
    const accuracy_twin *runs[MOST_ATTEMPTS * (1 + ACCURACY_OWN + ACCURACY_MOST_SETTINGS)];
    accuracy_known known = {.runs = runs};
    for (size_t i = 0; i < c->kept_count; i++) {
        runs[known.count++] = &c->kept[i].run;
        for (size_t k = 0; k < c->kept[i].trial_count; k++)
            runs[known.count++] = &c->kept[i].trials[k];
        for (size_t k = 0; k < ACCURACY_OWN; k++)
            if (c->kept[i].record.own[k])
                runs[known.count++] = c->kept[i].record.own[k];
    }
    a->record.choice = c->choice;
    a->run.stopped = !accuracy_measure(&a->record, a->run.tree, c->scene.engine, a->run.pipeline,
                                       c->scene.watch, &known);
    c->twins += a->record.twins;
    c->seconds += a->record.seconds;
}

/* Runs and measures the file with the settings as they are. */
static void try_settings(control *c, attempt *next)
{
    size_t count;
    const char **sets = list_sets(c, &count);
    bool *changed = memory_alloc((c->asked->count + 1) * sizeof *changed);
    const ff_place place = accuracy_place(c->scene.tree);
    c->scene.donor = c->best && c->best->run.good ? c->best->run.pipeline : NULL;
    for (size_t i = 0; i < c->open.count; i++)
        changed[c->open.all[i].stage - c->asked->stages] = true;
    accuracy_twin_run(&next->run, &c->scene, sets, count, &place, changed);
    next->level = c->level;
    next->levels = memory_arena_alloc(&c->arena, (c->open.count + 1) * sizeof *next->levels);
    for (size_t i = 0; i < c->open.count; i++)
        next->levels[i] = c->open.all[i].level;
    next->doubtful = next->run.good && c->level > 0 &&
                     (!accuracy_open_have_twins(&c->open) ||
                      accuracy_has_doubts(next->run.pipeline, c->scene.donor));
    if (next->run.good && !next->doubtful)
        measure(c, next);
    c->attempts++;
    c->seconds += next->run.work;
    free(changed);
    free(sets);
}

static void free_trials(attempt *a)
{
    for (size_t i = 0; i < a->trial_count; i++)
        accuracy_twin_free(&a->trials[i]);
}

static void attempt_free(attempt *a)
{
    a->record.choice = NULL; /* all attempts share it */
    accuracy_free(&a->record);
    free_trials(a);
    accuracy_twin_free(&a->run);
}

/* While models are to be chosen the answer that they are held against has to be more exact. */
static double goal_of(const control *c, const accuracy_error *e)
{
    bool choosing = !c->choice && leaves_models_open(c->asked);
    return e->goal * (choosing ? reference_error : 1);
}

static bool is_missed(const control *c, const accuracy_error *e)
{
    return !isnan(e->goal) && !(e->relative <= goal_of(c, e));
}

/* The order at which an error falls, below 0 where it grows: that of its twins. What settings that
   the file gives make of it falls in twins, too, but in no attempt. */
static double order_of(const control *c, size_t error)
{
    const accuracy_error *e = &c->best->record.errors[error];
    const attempt *before = c->best > c->kept ? c->best - 1 : NULL;
    double order = isnan(e->order) ? 1 : e->order;
    if (*c->open.given && before && before->level <= 0 && before->record.count > error)
        order = fmin(order, log2(before->record.errors[error].relative / e->relative));
    return order;
}

/* Whether the finest settings will do for an error that is too large. Two levels show no order. */
static bool is_in_reach(const control *c, size_t error)
{
    const accuracy_error *e = &c->best->record.errors[error];
    double order = order_of(c, error);
    if (isnan(e->order) && c->best->record.half && !c->best->record.quarter)
        return c->level > accuracy_finest;
    return order > 0 && log2(e->relative / goal_of(c, e)) / order <= c->level - accuracy_finest;
}

/* Whether the setting changed nothing, as a tolerance of steps where the file gives these. */
static bool is_idle(const control *c, const accuracy_open_setting *s, const ff_report *report)
{
    const ff_place chosen = accuracy_place(c->scene.tree);
    char *start = memory_print_text("%s.%s changes nothing", s->stage->name, s->setting.name);
    bool idle = false;
    for (size_t i = 0; i < ff_report_count(report) && !idle; i++)
        idle = accuracy_is_about(ff_report_at(report, i), chosen) &&
               !strncmp(ff_report_at(report, i)->text, start, strlen(start));
    free(start);
    return idle;
}

/* What lies between an output of two twins, over that of the best attempt; NaN: they cannot be
   compared. */
static double apart(control *c, const accuracy_error *e, const accuracy_twin *one,
                    const accuracy_twin *other)
{
    const ff_pipeline *answer = c->best->run.pipeline;
    const ff_result *result = e->result, *along = accuracy_axis_of(answer, e->stage, result);
    const accuracy_series at = {result->rank, result->count, along ? along->data : NULL,
                                result->data};
    const double *a = accuracy_numbers_like(answer, e->stage, result, one->pipeline, &c->arena);
    const double *b = accuracy_numbers_like(answer, e->stage, result, other->pipeline, &c->arena);
    double *off = memory_arena_alloc(&c->arena, result->count * sizeof *off), largest;
    for (size_t i = 0; a && b && i < result->count; i++)
        off[i] = fabs(a[i] - b[i]);
    return a && b ? accuracy_relative(off, &at, &largest) : NAN;
}

/* Settings are tried on the two coarsest of the answers to the scene. */
static const accuracy_twin *tried_on(const control *c)
{
    const accuracy_record *record = &c->best->record;
    return record->quarter ? record->half : &c->best->run;
}

/* Whether what a setting moves by a level is a small part of what all move, in each output that
   takes another attempt. */
static bool is_minor(control *c, const accuracy_twin *trial)
{
    const accuracy_record *record = &c->best->record;
    const accuracy_twin *coarser = record->quarter ? record->quarter : record->half;
    bool small = trial->good;
    for (size_t i = 0; small && i < record->count; i++) {
        const accuracy_error *e = &record->errors[i];
        if (is_missed(c, e) && is_in_reach(c, i))
            small = apart(c, e, tried_on(c), trial) <= minor * apart(c, e, tried_on(c), coarser);
    }
    return small;
}

/* Where the setting stays as it is, this is a twin of the next attempt. */
static const accuracy_twin *try_coarser(control *c, const accuracy_open_setting *tried)
{
    accuracy_twin *trial = &c->best->trials[c->best->trial_count++];
    const ff_place place = accuracy_place(c->scene.tree);
    const double level = c->best->record.quarter ? 1 : 0;
    bool *changed = memory_alloc((c->asked->count + 1) * sizeof *changed);
    size_t count;
    for (size_t i = 0; i < c->open.count; i++)
        c->open.all[i].level += level + (&c->open.all[i] == tried ? 1 : 0);
    const char **sets = list_sets(c, &count);
    for (size_t i = 0; i < c->open.count; i++)
        c->open.all[i].level = c->best->levels[i];
    changed[tried->stage - c->asked->stages] = true;
    c->scene.donor = tried_on(c)->pipeline;
    accuracy_twin_run(trial, &c->scene, sets, count, &place, changed);
    c->twins++;
    c->seconds += trial->work;
    free(changed);
    free(sets);
    return trial;
}

/* Finds a setting of the dearest stage that need not become finer; its first one always does. */
static void leave_behind(control *c)
{
    const ff_report *report = c->best->run.report;
    bool first = true, found = false;
    for (size_t i = 0; i < c->open.count && !found && !c->best->run.stopped; i++) {
        accuracy_open_setting *s = &c->open.all[i];
        if (!s->dearest || is_idle(c, s, report))
            continue;
        if (!first) {
            const accuracy_twin *trial = try_coarser(c, s);
            c->best->run.stopped = trial->stopped;
            found = is_minor(c, trial);
            s->behind += found ? 1 : 0;
        }
        first = false;
    }
}

/* Chooses the settings of the next attempt; false: this one is the answer. Where no error is told,
   as of outputs that turn out to be fields, that is one by the presets. */
static bool go_on(control *c)
{
    const accuracy_record *record = &c->best->record;
    bool missed = !c->best->run.good || c->best->doubtful || record->count == 0, reached = false;
    for (size_t i = 0; i < record->count; i++)
        if (is_missed(c, &record->errors[i])) {
            missed = true;
            reached = reached || is_in_reach(c, i);
        }
    if (c->level <= 0) /* where the presets fail something finer may do */
        missed = c->best->run.good ? reached : c->level > -1;
    if (missed && reached && record->half && !*c->open.given)
        leave_behind(c);
    return missed && !c->best->run.stopped && set_level(c, c->level - 1);
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

/* Begins anew with the models that were chosen. */
static void begin_with(control *c, const accuracy_choice *choice)
{
    const ff_place place = accuracy_place(c->scene.tree);
    ff_report *unused = ff_report_new(); /* a try was built from the same */
    c->tree = ff_tree_copy(c->scene.tree);
    for (size_t i = 0; i < choice->use_count; i++)
        ff_tree_set(c->tree, choice->uses[i], &place, &place, unused);
    c->asked = ff_pipeline_build(c->tree, c->scene.engine, false, unused);
    ff_report_free(unused);
    accuracy_hand_states(c->scene.start, c->asked);
    c->scene.start = c->asked;
    drop_attempts(c);
    accuracy_open_list(&c->open, c->asked);
    set_level(c, coarsest);
}

/* Chooses the models that the file leaves open, by what they move the answer. Returns whether there
   is more to do. */
static bool choose_models(control *c)
{
    size_t count;
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
        return go_on(c);
    begin_with(c, c->choice);
    return true;
}

/* Makes an attempt; false where it was stopped, or failed where a coarser one did not. */
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
    attempt_free(&next);
    return false;
}

/* Makes attempts until one is the answer; false where the observer stopped one. */
static bool search(control *c)
{
    set_level(c, coarsest);
    for (bool again = true; again;) {
        again = try_next(c) && go_on(c) && c->kept_count < MOST_ATTEMPTS;
        if (!again && c->best->run.good && !c->best->run.stopped && !c->choice &&
            leaves_models_open(c->asked))
            again = choose_models(c) && c->kept_count < MOST_ATTEMPTS;
    }
    if (c->best->doubtful && !c->best->run.stopped) /* nothing better was had */
        measure(c, c->best);
    return !c->best->run.stopped;
}

/* Makes the best attempt the answer. */
static void adopt(control *c, accuracy_record *record)
{
    ff_pipeline *asked = record->answer;
    for (size_t i = 0; i < c->open.count; i++)
        c->open.all[i].level = c->best->levels[i];
    *record = c->best->record;
    record->half = record->quarter = NULL;
    record->twin = memory_alloc(sizeof *record->twin);
    *record->twin = c->best->run;
    record->answer = c->best->run.pipeline ? c->best->run.pipeline : asked;
    free_trials(c->best);
    c->kept_count--; /* the last one is the best */
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
        if (is_idle(c, &c->open.all[i], record->twin->report))
            continue;
        const char *set = accuracy_open_set(&c->open, i);
        record->chosen[record->chosen_count++] =
            memory_arena_text(&record->arena, set, strlen(set));
    }
}

bool accuracy_control(accuracy_record *record, const ff_tree *tree, ff_engine *engine,
                      ff_pipeline *pipeline, const ff_observer *watch, ff_report *report)
{
    control c = {.scene = {.tree = tree, .engine = engine, .start = pipeline, .watch = watch},
                 .asked = pipeline};
    c.open.arena = &c.arena;
    accuracy_open_list(&c.open, c.asked);
    bool finished = search(&c);
    if (finished) {
        adopt(&c, record);
        accuracy_twin_hand_on(record->twin, accuracy_place(tree), watch, report);
    }
    bool good = finished && record->twin->good;
    drop_attempts(&c);
    if (c.choice)
        accuracy_choice_free(c.choice);
    free(c.choice);
    if (c.tree)
        ff_pipeline_free(c.asked);
    ff_tree_free(c.tree);
    accuracy_open_free(&c.open);
    memory_arena_free(&c.arena);
    return good;
}
