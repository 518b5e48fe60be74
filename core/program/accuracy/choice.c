/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Each cheaper model is judged by how far it moves the answer: the answer with it, all else equal,
 * is compared with the answer without it. The comparison is uncertain by the numerical error of the
 * first answer, so this error is added once.
 */
#include "choice.h"

#include "axis.h"
#include "goals.h"
#include "models.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Share of a goal that the errors of cheaper models may take; the rest is left for numerical
 * errors. */
static const double share_of_models = 0.5;

typedef struct trial {
    accuracy_choice *choice;
    accuracy_scene scene;
    const ff_pipeline *base;
    const accuracy_record *measured;
    const char *const *settings;
    size_t setting_count;
    const ff_pipeline *current; /* the answer with which the next one is compared */
    double *moved;              /* by how much the accepted models move each measured output */
} trial;

static size_t place_of(const trial *t, const accuracy_error *e)
{
    return (size_t)(e->stage - t->base->stages);
}

static const char *keep(trial *t, char *text)
{
    const char *kept = memory_arena_text(&t->choice->arena, text, strlen(text));
    free(text);
    return kept;
}

/* Name of the first quality line with which the model reports a doubt; NULL if there is none. */
static const char *doubt_of(const ff_stage *stage)
{
    for (size_t i = 0; i < stage->quality_count; i++)
        if (stage->quality[i].verdict != FF_GOOD)
            return stage->quality[i].name;
    return NULL;
}

/* Computes how far each output moves. Returns NULL if all stay within their share, else the reason
   for rejecting the model. */
static const char *reason_to_reject(trial *t, size_t stage, const accuracy_twin *next,
                                    double *moves)
{
    const char *doubt = next->good ? doubt_of(&next->pipeline->stages[stage]) : NULL;
    if (!next->good)
        return keep(t, memory_print_text("%s", accuracy_twin_reason(next)));
    if (doubt)
        return keep(t, memory_print_text("its quality line %s is doubtful", doubt));
    if (t->measured->count == 0)
        return "no output can be compared";
    for (size_t i = 0; i < t->measured->count; i++) {
        const accuracy_error *e = &t->measured->errors[i];
        double moved = accuracy_between(e, t->base, t->current, next->pipeline, &t->choice->arena),
               most = share_of_models * e->goal;
        moves[i] = moved + (t->choice->differs ? 0 : e->reached);
        if (isnan(e->goal) || t->moved[i] + moves[i] <= most)
            continue;
        if (isnan(moves[i]))
            return keep(t, memory_print_text("%s.%s cannot be compared", e->stage->name,
                                             e->result->row->name));
        return keep(t,
                    memory_print_text("%s.%s may be off by %.2g %%, and models may cause %.2g %%",
                                      e->stage->name, e->result->row->name, 100 * moves[i],
                                      100 * (most - t->moved[i])));
    }
    return NULL;
}

/* True if the setting belongs to a stage whose model has been replaced. */
static bool is_of_other(const trial *t, const char *set, size_t stage)
{
    const accuracy_choice *choice = t->choice;
    for (size_t i = 0; i <= choice->tried_count; i++) {
        bool last = i == choice->tried_count;
        const char *name = t->base->stages[last ? stage : choice->tried[i].stage].name;
        size_t length = strlen(name);
        if ((last || choice->tried[i].accepted) && !strncmp(set, name, length) &&
            set[length] == '.')
            return true;
    }
    return false;
}

/* Runs the file with the model in the stage and with the settings of all stages that keep their
   reference model. */
static const accuracy_twin *run(trial *t, size_t stage, const char *use)
{
    const accuracy_choice *choice = t->choice;
    const char **sets = memory_alloc((choice->use_count + t->setting_count + 1) * sizeof *sets);
    bool *changed = memory_alloc((t->base->count + 1) * sizeof *changed);
    const ff_place place = accuracy_place(t->scene.file);
    size_t count = 0;
    for (size_t i = 0; i < choice->use_count; i++)
        sets[count++] = choice->uses[i];
    sets[count++] = use;
    for (size_t i = 0; i < t->setting_count; i++)
        if (!is_of_other(t, t->settings[i], stage))
            sets[count++] = t->settings[i];
    changed[stage] = true;
    t->scene.reuse_from = t->current;
    const accuracy_twin *next = accuracy_twin_run(&t->scene, sets, count, &place, changed);
    free(changed);
    free(sets);
    return next;
}

/* Accepts the model: adds its changes to the record and continues from its answer. */
static void accept_model(trial *t, size_t stage, const double *moves, const accuracy_twin *next)
{
    accuracy_choice *choice = t->choice;
    for (size_t i = 0; i < t->measured->count; i++) {
        const accuracy_error *e = &t->measured->errors[i];
        t->moved[i] += moves[i];
        choice->changes[choice->change_count++] = (accuracy_change){
            .stage = stage,
            .output_stage = place_of(t, e),
            .output = e->result->row->name,
            .error = moves[i],
        };
    }
    t->current = next->pipeline;
    choice->differs = true;
}

/* Returns true if the model was accepted. */
static bool try_model(trial *t, size_t stage, const char *model, bool *stopped)
{
    accuracy_choice *choice = t->choice;
    double *moves = memory_alloc((t->measured->count + 1) * sizeof *moves);
    const char *use = keep(t, memory_print_text("%s.use=%s", t->base->stages[stage].name, model));
    const accuracy_twin *next = run(t, stage, use);
    *stopped = next->stopped;
    const char *reason = *stopped ? "" : reason_to_reject(t, stage, next, moves);
    choice->tried[choice->tried_count++] =
        (accuracy_tried){.stage = stage, .model = model, .accepted = !reason, .reason = reason};
    if (!reason) {
        accept_model(t, stage, moves, next);
        choice->uses[choice->use_count++] = use;
    }
    free(moves);
    return !reason;
}

static void make_room(accuracy_choice *choice, const trial *t)
{
    size_t ids, stages = t->base->count, errors = t->measured->count;
    ff_engine_ids(t->scene.engine, &ids);
    choice->uses = memory_arena_alloc(&choice->arena, (stages + 1) * sizeof *choice->uses);
    choice->tried = memory_arena_alloc(&choice->arena, (stages * ids + 1) * sizeof *choice->tried);
    choice->changes =
        memory_arena_alloc(&choice->arena, (stages * errors + 1) * sizeof *choice->changes);
}

bool accuracy_choose(accuracy_choice *choice, const accuracy_scene *scene,
                     const accuracy_twin *base, const accuracy_record *measured,
                     const char *const *settings, size_t setting_count)
{
    trial t = {.choice = choice,
               .scene = *scene,
               .base = base->pipeline,
               .measured = measured,
               .settings = settings,
               .setting_count = setting_count,
               .current = base->pipeline};
    bool stopped = false;
    t.moved = memory_alloc((measured->count + 1) * sizeof *t.moved);
    make_room(choice, &t);
    for (size_t n = 0; n < scene->start->count && !stopped; n++) {
        size_t at = scene->start->order[n];
        const ff_stage *stage = &scene->start->stages[at];
        if (!stage->needed || !accuracy_open_use(stage))
            continue;
        const char **ids = accuracy_candidates(stage, scene->engine, &choice->arena);
        bool accepted = false;
        for (; *ids && !accepted && !stopped; ids++)
            accepted = try_model(&t, at, *ids, &stopped);
        if (!accepted)
            choice->uses[choice->use_count++] =
                keep(&t, memory_print_text("%s.use=%s", stage->name, stage->use));
    }
    free(t.moved);
    return !stopped;
}

void accuracy_choice_free(accuracy_choice *choice)
{
    memory_arena_free(&choice->arena);
}
