/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Twins of one answer, a ladder of levels. All settings of all stages are one level coarser in the
 * first twin and two levels coarser in the second. Then, unless earlier runs are known, each
 * setting in turn is one level finer than in the second, which shows its part of the error. These
 * are cheap: all else is coarse, and stages upstream are known. If a coarser twin fails because the
 * answer itself is coarse, a finer one takes its place.
 */
#include "twins.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Lists the settings of all stages on which a measured output depends. */
static void list_knobs(accuracy_twins *t)
{
    accuracy_setting settings[ACCURACY_MOST_SETTINGS];
    const ff_pipeline *answer = t->answer;
    memory_arena *arena = &t->record->arena;
    t->knobs =
        memory_arena_alloc(arena, answer->count * ACCURACY_MOST_SETTINGS * sizeof *t->knobs + 1);
    for (size_t i = 0; i < answer->count; i++) {
        size_t at = answer->order[i];
        const ff_stage *stage = &answer->stages[at];
        size_t count = 0;
        if (stage->needed && stage->loaded)
            count = accuracy_settings(stage, settings);
        for (size_t k = 0; k < count; k++)
            if (!t->known ||
                !accuracy_is_idle(t->known->said, t->known->place, stage->name, settings[k].name))
                t->knobs[t->count++] = (accuracy_knob){at, settings[k]};
    }
    t->refined = memory_arena_alloc(arena, t->count * sizeof *t->refined + 1);
}

static void note_failure(accuracy_twins *t, const char *why)
{
    if (!t->record->failure)
        t->record->failure = memory_arena_text(&t->record->arena, why, strlen(why));
}

/* Levels by which a twin's settings are coarser. */
static const int half = 1, quarter = 2, twice = -1;

/* NULL if the setting's limits forbid it. */
static const char *assignment_at(const accuracy_twins *t, const accuracy_knob *k, int coarser)
{
    return accuracy_setting_at(&t->answer->stages[k->stage], k->setting.param, coarser,
                               &t->record->arena);
}

/* Fills the assignments of a twin and marks the stages that they change. False if a setting's
   limits forbid one. */
static bool list_sets(accuracy_twins *t, int at, size_t finer, const char **sets, bool *changed)
{
    for (size_t i = 0; i < t->count; i++) {
        const accuracy_knob *k = &t->knobs[i];
        sets[i] = assignment_at(t, k, i == finer ? half : at);
        changed[k->stage] |= finer == SIZE_MAX || i == finer;
        if (sets[i])
            continue;
        char *why = memory_print_text("%s.%s has no %s value within its limits",
                                      t->answer->stages[k->stage].name, k->setting.name,
                                      at < 0 ? "finer" : "coarser");
        note_failure(t, why);
        free(why);
        return false;
    }
    return true;
}

/* Says what is being run. */
static void tell_twin(const accuracy_twins *t, int at)
{
    const accuracy_record *record = t->record;
    const char *which = at < 0 ? "finer" : "coarser";
    if (!record->now)
        return;
    if (t->checking)
        snprintf(record->now, ACCURACY_NOW, "a %s twin checks the errors", which);
    else if (record->attempts == 0)
        snprintf(record->now, ACCURACY_NOW, "a %s twin tells the errors", which);
    else
        snprintf(record->now, ACCURACY_NOW, "a %s twin tells the errors of attempt %zu", which,
                 record->attempts);
}

/* Runs a twin. The setting `finer` is at the level of `half`; SIZE_MAX: none is. */
static void run_twin(accuracy_twins *t, int at, size_t finer, accuracy_twin *twin)
{
    const char **sets = memory_alloc((t->count + 1) * sizeof *sets);
    bool *changed = memory_alloc((t->answer->count + 1) * sizeof *changed);
    tell_twin(t, at);
    t->scene.donor = finer == SIZE_MAX ? t->answer : t->quarter->pipeline;
    if (list_sets(t, at, finer, sets, changed)) {
        accuracy_twin_run(twin, &t->scene, sets, t->count, NULL, changed);
        t->record->twins++;
        t->record->seconds += twin->work;
        t->stopped = twin->stopped;
        if (!twin->good)
            note_failure(t, accuracy_twin_reason(twin));
    }
    free(changed);
    free(sets);
}

/* True if an answer has the settings of the twin. */
static bool is_twin(const accuracy_twins *t, int at, const ff_pipeline *answer)
{
    bool same = answer->count == t->answer->count;
    for (size_t i = 0; same && i < answer->count; i++)
        same = answer->stages[i].loaded == t->answer->stages[i].loaded;
    for (size_t i = 0; same && i < t->count; i++) {
        const accuracy_knob *k = &t->knobs[i];
        const char *has = accuracy_setting_at(&answer->stages[k->stage], k->setting.param, 0,
                                              &t->record->arena),
                   *wanted = assignment_at(t, k, at);
        same = has && wanted && !strcmp(has, wanted);
    }
    return same;
}

/* A twin from earlier runs, good or not; NULL if there is none. */
static const accuracy_twin *known_twin(const accuracy_twins *t, int at)
{
    for (size_t i = 0; i < t->record->own_count; i++)
        if (t->record->own[i]->pipeline && is_twin(t, at, t->record->own[i]->pipeline))
            return t->record->own[i];
    for (size_t i = 0; t->known && i < t->known->count; i++)
        if (t->known->runs[i]->pipeline && is_twin(t, at, t->known->runs[i]->pipeline))
            return t->known->runs[i];
    return NULL;
}

/* Finds or runs a twin; NULL if there can be none. */
static const accuracy_twin *find_twin(accuracy_twins *t, int at)
{
    const accuracy_twin *known = known_twin(t, at);
    if (known)
        return known->good ? known : NULL;
    if (t->stopped || t->record->own_count == ACCURACY_OWN)
        return NULL;
    accuracy_twin *own = t->record->own[t->record->own_count++] = memory_alloc(sizeof *own);
    run_twin(t, at, SIZE_MAX, own);
    return own->good ? own : NULL;
}

/* Runs the second twin, and those that tell the settings apart. */
static void run_quarter(accuracy_twins *t)
{
    t->quarter = t->half ? find_twin(t, quarter) : NULL;
    for (size_t i = 0; !t->known && t->count > 1 && t->quarter && i < t->count && !t->stopped; i++)
        run_twin(t, quarter, i, &t->refined[i]);
}

bool accuracy_twins_find(accuracy_twins *t)
{
    if (t->half || t->twice) { /* a second call */
        if (t->quarter || t->twice || !t->half)
            return false;
        run_quarter(t);
        return t->quarter != NULL;
    }
    list_knobs(t);
    if (t->record->count == 0)
        return false;
    t->half = find_twin(t, half);
    if (t->half && !t->known)
        run_quarter(t);
    if (!t->half || (!t->known && !t->quarter))
        t->twice = find_twin(t, twice);
    return t->half || t->twice;
}

const accuracy_twin *accuracy_twins_find_finer(accuracy_twins *t, accuracy_twin *own)
{
    list_knobs(t);
    const accuracy_twin *known = t->count > 0 ? known_twin(t, twice) : NULL;
    t->checking = true;
    if (!known)
        run_twin(t, twice, SIZE_MAX, own);
    return known ? known : own;
}

void accuracy_twins_free(accuracy_twins *t)
{
    for (size_t i = 0; i < t->count; i++)
        accuracy_twin_free(&t->refined[i]);
}
