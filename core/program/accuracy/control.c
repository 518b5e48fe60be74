/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Each attempt is run with its twins, whose errors say which setting is to be refined by how much.
 * An output whose error cannot be brought down is left out, so that it does not take the others
 * with it, unless what is refined for these brings it within reach.
 */
#include "control.h"

#include "choice.h"
#include "doubts.h"
#include "goals.h"
#include "models.h"
#include "settings.h"
#include "twin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A plain first guess: presets are about this exact (docs/validation/error-bars.md), and an error
   of second order is four times as large on each coarser level. */
static const double preset_error = 0.005;
/* A coarser start would leave twins of too few cells. */
static const double coarsest_start = 2;
/* Four times as many cells and steps as by preset: 16 times the work. */
static const double finest = -2;
/* A stage costs little whose model says that it costs at most this share of the dearest one's, or
   says nothing and is not asked for itself. */
static const double little = 0.1;
/* Its settings are finer than those of the dearest stage by so many levels, in every attempt and in
   its twins, too: what all of them sample too coarsely none of them shows. */
static const double ahead = 1;
/* Of the reference, over the goal, when models are held against it: they may move half of a goal
   (choice.c), and its error counts with what they move. */
static const double reference_error = 0.25;
/* In an attempt. A level costs four times as much, so that all attempts before the last cost a
   third of it, and one level too many costs more than they do. */
static const double most_levels = 1;
/* Parts are brought to this share of a goal, so that the next error does not fall just above it. */
static const double reserve = 0.8;
/* An output is left out where settings that the file gives leave less than this of its goal. */
static const double least_part = 0.1;
/* So is one that takes settings finer than they may be by more levels: an order is no better known.
 */
static const double beyond = 0.5;
/* An order below 1 between twins is not relied on: the attempts themselves show it then. */
static const double least_order = 1, most_order = 2;
enum { MOST_ATTEMPTS = 8 };

/* A setting that the file leaves open. */
typedef struct knob {
    const ff_stage *stage; /* of the pipeline that was asked for */
    accuracy_setting setting;
    bool cheap;      /* its stage costs little */
    double level;    /* coarser than the preset by so much, in the next attempt */
    double measured; /* in the best one */
} knob;

/* An output whose error was too large. */
typedef struct target {
    size_t stage, output;
    double error;  /* of the last attempt, but for what no setting brings down */
    bool pursued;  /* the last attempt was refined for it, beyond the presets, */
    double levels; /* by so many levels at most */
    double order;  /* that attempts showed so; INFINITY: none did */
} target;

typedef struct attempt {
    accuracy_twin run;
    accuracy_record record; /* of a doubtful one empty */
    bool doubtful;          /* it is in doubt, and coarser than the presets: no answer */
} attempt;

typedef struct control {
    accuracy_scene scene;
    ff_pipeline *asked;      /* with the models that were chosen, when they are */
    accuracy_choice *choice; /* of models; NULL: not made yet, or the file names them all */
    ff_tree *tree;           /* of the models that were chosen; NULL: those of the file */
    knob *knobs;
    size_t count;
    target *targets;
    size_t target_count;
    attempt best; /* the last one that was good; its run has no pipeline before */
    size_t attempts, twins;
    double seconds; /* s: CPU time of all that was run */
    const char *failure;
    memory_arena arena;
} control;

static double largest_cost(const ff_pipeline *pipeline)
{
    double most = 0;
    for (size_t i = 0; i < pipeline->count; i++)
        if (pipeline->stages[i].needed && pipeline->stages[i].loaded)
            most = fmax(most, ff_model_cost(pipeline->stages[i].loaded->model));
    return most;
}

/* In a loop a stage costs what the others do. One that says nothing may be the dearest where its
   own outputs are asked for. */
static bool costs_little(const ff_stage *stage, double most)
{
    double cost = ff_model_cost(stage->loaded->model);
    bool asked = false;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++)
        asked = asked || stage->results[i].requested;
    return most > 0 && !stage->loop && cost <= little * most && (cost > 0 || !asked);
}

static void list_knobs(control *c)
{
    const double most = largest_cost(c->asked);
    accuracy_setting settings[ACCURACY_MOST_SETTINGS];
    free(c->knobs);
    c->count = 0;
    c->knobs = memory_alloc((c->asked->count * ACCURACY_MOST_SETTINGS + 1) * sizeof *c->knobs);
    for (size_t i = 0; i < c->asked->count; i++) {
        const ff_stage *stage = &c->asked->stages[c->asked->order[i]];
        size_t count = 0;
        if (stage->needed && stage->loaded)
            count = accuracy_settings(stage, &c->arena, settings);
        for (size_t k = 0; k < count; k++)
            if (settings[k].open && accuracy_setting_at(stage, settings[k].param, 0, &c->arena))
                c->knobs[c->count++] = (knob){
                    .stage = stage, .setting = settings[k], .cheap = costs_little(stage, most)};
    }
}

/* The smallest goal, or 1. */
static double smallest_goal(const control *c)
{
    double least = 1;
    for (size_t i = 0; i < c->asked->count; i++) {
        const ff_stage *stage = &c->asked->stages[i];
        size_t outputs = stage->results ? stage->loaded->model->output_count : 0;
        for (size_t k = 0; k < outputs; k++)
            if (stage->results[k].requested) /* fmin drops NaN */
                least = fmin(least, accuracy_goal(c->scene.tree, stage, &stage->results[k]));
    }
    return least;
}

static const char *set_of(control *c, const knob *k)
{
    return accuracy_setting_at(k->stage, k->setting.param, k->level, &c->arena);
}

static double finest_of(const knob *k)
{
    return k->cheap ? finest - ahead : finest;
}

/* Sets the level, or the next one towards the preset that the limits of the setting allow. */
static void move(control *c, knob *k, double level)
{
    k->level = fmax(level, finest_of(k));
    while (k->level != 0 && !set_of(c, k))
        k->level = fabs(k->level) < 1 ? 0 : k->level - copysign(1, k->level);
}

/* Twins are coarser by two levels. */
static bool has_twins(control *c, const knob *k)
{
    return accuracy_setting_at(k->stage, k->setting.param, k->level + 2, &c->arena);
}

static bool leaves_models_open(const ff_pipeline *pipeline)
{
    for (size_t i = 0; i < pipeline->count; i++)
        if (pipeline->stages[i].needed && accuracy_open_use(&pipeline->stages[i]))
            return true;
    return false;
}

static void start(control *c)
{
    bool open = !c->choice && leaves_models_open(c->asked);
    double error = smallest_goal(c) * (open ? reference_error : 1);
    double levels = fmin(fmax(round(log(error / preset_error) / log(4)), 0), coarsest_start);
    for (size_t i = 0; i < c->count; i++) {
        move(c, &c->knobs[i], levels - (c->knobs[i].cheap ? ahead : 0));
        while (c->knobs[i].level > 0 && !has_twins(c, &c->knobs[i]))
            move(c, &c->knobs[i], c->knobs[i].level - 1);
    }
}

/* The models that were chosen, and the settings as they are; to be freed. */
static const char **list_sets(control *c, size_t *count)
{
    size_t models = c->tree ? c->choice->use_count : 0;
    const char **sets = memory_alloc((models + c->count + 1) * sizeof *sets);
    *count = models + c->count;
    for (size_t i = 0; i < *count; i++)
        sets[i] = i < models ? c->choice->uses[i] : set_of(c, &c->knobs[i - models]);
    return sets;
}

static bool is_coarse(const control *c)
{
    for (size_t i = 0; i < c->count; i++)
        if (c->knobs[i].level > 0)
            return true;
    return false;
}

static void measure(control *c, attempt *a)
{
    a->record.choice = c->choice;
    a->run.stopped = !accuracy_measure(&a->record, a->run.tree, c->scene.engine, a->run.pipeline,
                                       c->scene.watch);
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
    c->scene.donor = c->best.run.good ? c->best.run.pipeline : NULL;
    for (size_t i = 0; i < c->count; i++)
        changed[c->knobs[i].stage - c->asked->stages] |= c->knobs[i].level != c->knobs[i].measured;
    accuracy_twin_run(&next->run, &c->scene, sets, count, &place, changed);
    next->doubtful =
        next->run.good && is_coarse(c) && accuracy_has_doubts(next->run.pipeline, c->scene.donor);
    if (next->run.good && !next->doubtful)
        measure(c, next);
    c->attempts++;
    c->seconds += next->run.work;
    free(changed);
    free(sets);
}

static void attempt_free(attempt *a)
{
    a->record.choice = NULL; /* all attempts share it */
    accuracy_free(&a->record);
    accuracy_twin_free(&a->run);
}

/* Goes on from an attempt that failed: by a level, to the presets and one beyond. */
static bool recover(control *c)
{
    bool moved = false;
    for (size_t i = 0; i < c->count; i++) {
        double before = c->knobs[i].level;
        if (before > -1)
            move(c, &c->knobs[i], before - 1);
        moved = moved || c->knobs[i].level < before;
    }
    return moved;
}

/* The setting that a part of an error comes from; NULL: the file gives it, or it is as fine as it
   may be. */
static knob *knob_of(control *c, const accuracy_part *part)
{
    size_t stage = (size_t)(part->stage - c->best.run.pipeline->stages);
    for (size_t i = 0; i < c->count; i++) {
        knob *k = &c->knobs[i], finer = *k;
        if (k->stage != &c->asked->stages[stage] || strcmp(k->setting.name, part->setting) != 0)
            continue;
        move(c, &finer, k->measured - 1);
        return finer.level < k->measured ? k : NULL;
    }
    return NULL;
}

/* The order that the last attempt shows; 0: refining did not help. */
static double order_shown(const target *t, double error)
{
    double order = log2(t->error / error) / t->levels;
    return order > 0 ? order : 0; /* NaN is none */
}

/* Levels that bring an error down to a share of it, by the order of its twins; where they show none
   by that of the attempts, if this is less. */
static double levels_for(const accuracy_error *e, const target *t, double share)
{
    double order = isnan(e->order) ? 1 : fmin(fmax(e->order, least_order), most_order);
    if (!(e->order >= least_order))
        order = fmin(order, t->order);
    return share < 1 ? -log2(share) / order : 0;
}

static bool is_in_reach(const knob *k, double levels)
{
    return k->measured - levels >= finest_of(k) - beyond;
}

/* Refines a setting by so many levels, unless another output asked for more; a coarse one to its
   preset at most, where errors are better known. */
static void refine(control *c, knob *k, double levels, target *t)
{
    double most = most_levels + (k->cheap ? 1 : 0);
    double level = k->measured - fmin(levels, most);
    t->pursued = t->pursued && k->measured <= 0;
    t->levels = fmax(t->levels, k->measured - level);
    move(c, k, fmin(k->level, k->measured > 0 ? fmax(level, 0) : level));
}

/* Where the twins did not tell parts apart: the next attempt will. */
static bool refine_all(control *c, const accuracy_error *e, target *t)
{
    bool moved = false;
    for (size_t i = 0; i < c->count; i++) {
        knob *k = &c->knobs[i];
        double levels = levels_for(e, t, reserve * e->goal / e->relative); /* fmin drops NaN */
        refine(c, k, fmin(levels, 1), t);
        moved = moved || k->level < k->measured;
    }
    return moved;
}

/* What the largest parts are cut down to so that all of them are `budget`, the smaller ones as they
   are; the parts that no setting can bring down are taken from it before. Below 0: too little. */
static double cut_of(control *c, const accuracy_error *e, double budget)
{
    double smaller = 0, cut = -1;
    size_t larger = 0;
    for (size_t i = 0; i < e->part_count; i++) {
        if (knob_of(c, &e->parts[i]))
            smaller += e->parts[i].error;
        else
            budget -= e->parts[i].error;
    }
    for (size_t i = 0; i < e->part_count && cut < e->parts[i].error; i++) {
        if (!knob_of(c, &e->parts[i])) /* the largest come first */
            continue;
        smaller -= e->parts[i].error;
        cut = (budget - smaller) / (double)++larger;
    }
    return cut;
}

/* Refines the settings that the error of an output comes from; false: it cannot be brought down. */
static bool refine_for(control *c, const accuracy_error *e, target *t)
{
    t->pursued = true;
    t->levels = 0;
    if (e->part_count == 0)
        return t->order > 0 && refine_all(c, e, t);
    double cut = cut_of(c, e, reserve * e->goal);
    if (cut < least_part * e->goal)
        return false;
    for (size_t i = 0; i < e->part_count; i++) {
        const knob *k = knob_of(c, &e->parts[i]);
        if (k && !is_in_reach(k, levels_for(e, t, cut / e->parts[i].error)))
            return false;
    }
    for (size_t i = 0; i < e->part_count; i++) {
        knob *k = knob_of(c, &e->parts[i]);
        if (k)
            refine(c, k, levels_for(e, t, cut / e->parts[i].error), t);
    }
    return true;
}

static target *target_of(control *c, const accuracy_error *e)
{
    const target key = {.stage = (size_t)(e->stage - c->best.run.pipeline->stages),
                        .output = (size_t)(e->result - e->stage->results),
                        .error = NAN,
                        .order = INFINITY};
    for (size_t i = 0; i < c->target_count; i++)
        if (c->targets[i].stage == key.stage && c->targets[i].output == key.output)
            return &c->targets[i];
    c->targets = memory_resize(c->targets, (c->target_count + 1) * sizeof *c->targets);
    c->targets[c->target_count] = key;
    return &c->targets[c->target_count++];
}

/* What coarse settings make doubtful may be wrong in a way that all twins share: what is in doubt
   is no answer but at the presets. */
static void settle_doubts(control *c)
{
    for (size_t i = 0; i < c->count && c->best.doubtful; i++) {
        knob *k = &c->knobs[i];
        double least = k->cheap ? -ahead : 0;
        if (k->level > least)
            move(c, k, fmax(k->level - most_levels, least));
    }
}

/* The part of an error that refining brings down. */
static double reducible(control *c, const accuracy_error *e)
{
    double sum = 0;
    for (size_t i = 0; i < e->part_count; i++)
        sum += knob_of(c, &e->parts[i]) ? e->parts[i].error : 0;
    return e->part_count ? sum : e->relative;
}

/* Chooses the settings of the next attempt; false: this one is the answer. */
static bool go_on(control *c)
{
    bool moved = false;
    settle_doubts(c);
    for (size_t i = 0; i < c->best.record.count; i++) {
        const accuracy_error *e = &c->best.record.errors[i];
        if (isnan(e->goal))
            continue;
        target *t = target_of(c, e);
        bool missed = !(e->relative <= e->goal);
        if (t->pursued)
            t->order = order_shown(t, reducible(c, e));
        t->error = reducible(c, e);
        t->pursued = false;
        if (missed)
            t->pursued = refine_for(c, e, t) && t->pursued;
    }
    for (size_t i = 0; i < c->count; i++)
        moved = moved || c->knobs[i].level != c->knobs[i].measured;
    return moved;
}

static void take(control *c, attempt *next)
{
    attempt_free(&c->best);
    c->best = *next;
    for (size_t i = 0; i < c->count; i++)
        c->knobs[i].measured = c->knobs[i].level;
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
    attempt_free(&c->best);
    c->best = (attempt){.run = {.good = false}};
    list_knobs(c);
    start(c);
}

/* Chooses the models that the file leaves open, by what they move the first answer that is good.
   False where the observer stopped it. */
static bool choose_models(control *c)
{
    size_t count;
    if (c->choice || c->best.doubtful || !leaves_models_open(c->asked))
        return true;
    const char **sets = list_sets(c, &count);
    c->choice = memory_alloc(sizeof *c->choice);
    c->best.record.choice = c->choice;
    bool finished =
        accuracy_choose(c->choice, &c->scene, &c->best.run, &c->best.record, sets, count);
    free(sets);
    c->twins += c->choice->runs;
    c->seconds += c->choice->seconds;
    if (finished && c->choice->differs)
        begin_with(c, c->choice);
    return finished;
}

/* Makes attempts until one is the answer; false where the observer stopped one. */
static bool search(control *c)
{
    start(c);
    for (bool again = true; again;) {
        attempt next = {.run = {.good = false}};
        try_settings(c, &next);
        if (next.run.stopped) {
            attempt_free(&next);
            return false;
        }
        again = c->attempts < MOST_ATTEMPTS;
        if (next.run.good) {
            take(c, &next);
            if (!choose_models(c))
                return false;
            again = (!c->best.run.good || go_on(c)) && again;
        } else if (!c->best.run.good) {
            take(c, &next);
            again = recover(c) && again;
        } else { /* a finer one failed */
            const char *why = accuracy_twin_reason(&next.run);
            c->failure = memory_arena_text(&c->arena, why, strlen(why));
            attempt_free(&next);
            again = false;
        }
    }
    if (c->best.doubtful) /* nothing better was had */
        measure(c, &c->best);
    return !c->best.run.stopped;
}

/* Whether the setting changes nothing, as a tolerance of steps that the file gives. */
static bool is_idle(const knob *k, const ff_report *report, ff_place chosen)
{
    char *start = memory_print_text("%s.%s changes nothing", k->stage->name, k->setting.name);
    bool idle = false;
    for (size_t i = 0; i < ff_report_count(report) && !idle; i++)
        idle = accuracy_is_about(ff_report_at(report, i), chosen) &&
               !strncmp(ff_report_at(report, i)->text, start, strlen(start));
    free(start);
    return idle;
}

/* Makes the best attempt the answer. */
static void adopt(control *c, accuracy_record *record)
{
    ff_pipeline *asked = record->answer;
    *record = c->best.record;
    record->twin = memory_alloc(sizeof *record->twin);
    *record->twin = c->best.run;
    record->answer = c->best.run.pipeline ? c->best.run.pipeline : asked;
    record->choice = c->choice;
    c->choice = NULL;
    record->attempts = c->attempts;
    record->twins = c->twins;
    record->seconds = c->seconds - c->best.run.work;
    if (c->failure)
        record->failure = memory_arena_text(&record->arena, c->failure, strlen(c->failure));
    size_t models = record->choice ? record->choice->use_count : 0;
    record->chosen =
        memory_arena_alloc(&record->arena, (models + c->count + 1) * sizeof *record->chosen);
    for (size_t i = 0; i < models; i++)
        record->chosen[record->chosen_count++] = record->choice->uses[i];
    for (size_t i = 0; i < c->count; i++) {
        if (is_idle(&c->knobs[i], c->best.run.report, accuracy_place(c->scene.tree)))
            continue;
        c->knobs[i].level = c->knobs[i].measured;
        const char *set = set_of(c, &c->knobs[i]);
        record->chosen[record->chosen_count++] =
            memory_arena_text(&record->arena, set, strlen(set));
    }
}

bool accuracy_control(accuracy_record *record, const ff_tree *tree, ff_engine *engine,
                      ff_pipeline *pipeline, const ff_observer *watch, ff_report *report)
{
    control c = {.scene = {.tree = tree, .engine = engine, .start = pipeline, .watch = watch},
                 .asked = pipeline};
    list_knobs(&c);
    bool finished = search(&c);
    if (finished) {
        adopt(&c, record);
        accuracy_twin_hand_on(record->twin, accuracy_place(tree), watch, report);
    } else {
        attempt_free(&c.best);
    }
    bool good = finished && record->twin->good;
    if (c.choice)
        accuracy_choice_free(c.choice);
    free(c.choice);
    if (c.tree)
        ff_pipeline_free(c.asked);
    ff_tree_free(c.tree);
    free(c.knobs);
    free(c.targets);
    memory_arena_free(&c.arena);
    return good;
}
