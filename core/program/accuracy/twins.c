/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Twins of one answer, a ladder of levels: all settings of all stages are one level coarser, or two
 * levels. If twins are run one by one, one of these two is run first, and the other only if it is
 * needed. Otherwise further twins have one setting each a level finer than in the coarser twin,
 * which shows the contribution of that setting. These further twins are cheap: all other settings
 * are coarse, and results of stages upstream are reused. If a coarser twin fails because the answer
 * itself is coarse, a finer one takes its place. */
#include "twins.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Lists the settings of all stages on which a measured output depends, without those that change
   nothing. */
static void list_knobs(accuracy_twins *t)
{
    memory_arena *arena = &t->record->arena;
    size_t all;
    t->knobs = accuracy_knobs(t->answer, &all, arena);
    for (size_t i = 0; i < all; i++)
        if (!t->messages ||
            !accuracy_is_idle(t->messages, t->request, t->answer->stages[t->knobs[i].stage].name,
                              t->knobs[i].name))
            t->knobs[t->count++] = t->knobs[i];
    t->refined = memory_arena_alloc(arena, (t->count + 1) * sizeof *t->refined);
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
    return accuracy_setting_at(&t->answer->stages[k->stage], k->param, coarser, &t->record->arena);
}

/* True for a setting that the file gives, not the program. */
static bool is_fixed_by_file(const accuracy_twins *t, const accuracy_knob *k)
{
    const ff_place place = t->answer->stages[k->stage].params[k->param].place;
    return place.source && !(place.source == t->request.source && place.line == t->request.line &&
                             place.column == t->request.column);
}

/* Values in place of the index of a setting: no setting, all settings that the file fixes, or all
   but those of the stage that estimates its errors. */
static const size_t no_setting = SIZE_MAX, fixed_settings = SIZE_MAX - 1,
                    other_settings = SIZE_MAX - 2;

static bool is_one(const accuracy_twins *t, size_t i, size_t which)
{
    return i == which || (which == fixed_settings && is_fixed_by_file(t, &t->knobs[i])) ||
           (which == other_settings && t->knobs[i].stage != t->estimating);
}

/* Fills the assignments of a twin and marks the stages that they change, compared with the run
   whose results it reuses. False if a setting's limits forbid one. */
static bool list_sets(accuracy_twins *t, int at, size_t finer, const char **sets, bool *changed)
{
    for (size_t i = 0; i < t->count; i++) {
        const accuracy_knob *k = &t->knobs[i];
        const bool one = is_one(t, i, finer);
        sets[i] = assignment_at(t, k, one ? half : at);
        changed[k->stage] |= finer == no_setting || one;
        if (sets[i])
            continue;
        char *why = memory_print_text("%s.%s has no %s value within its limits",
                                      t->answer->stages[k->stage].name, k->name,
                                      at < 0 ? "finer" : "coarser");
        note_failure(t, why);
        free(why);
        return false;
    }
    return true;
}

/* Writes the progress text. */
static void write_progress(const accuracy_twins *t, int at)
{
    const accuracy_record *record = t->record;
    const char *which = at < 0 ? "finer" : "coarser";
    if (!record->progress)
        return;
    if (t->checking)
        snprintf(record->progress, ACCURACY_PROGRESS, "a %s twin checks the errors", which);
    else if (record->attempts == 0)
        snprintf(record->progress, ACCURACY_PROGRESS, "a %s twin measures the errors", which);
    else
        snprintf(record->progress, ACCURACY_PROGRESS,
                 "a %s twin measures the errors of attempt %zu", which, record->attempts);
}

/* Runs a twin at the level `at`, except for the settings `finer`, which are a level finer. NULL if
 * a setting's limits forbid it. */
static const accuracy_twin *run_twin(accuracy_twins *t, int at, size_t finer)
{
    const accuracy_twin *twin = NULL;
    const char **sets = memory_alloc((t->count + 1) * sizeof *sets);
    bool *changed = memory_alloc((t->answer->count + 1) * sizeof *changed);
    write_progress(t, at);
    t->scene.estimates = t->estimates && at == half;
    t->scene.reuse_from = finer == no_setting ? t->answer : t->quarter->pipeline;
    if (list_sets(t, at, finer, sets, changed)) {
        twin = accuracy_twin_run(&t->scene, sets, t->count, NULL, changed);
        t->stopped = twin->stopped;
        if (!twin->good)
            note_failure(t, accuracy_twin_reason(twin));
    }
    free(changed);
    free(sets);
    return twin;
}

/* True if an answer has the settings of the twin. */
static bool is_twin(const accuracy_twins *t, int at, const ff_pipeline *answer)
{
    bool same = answer->count == t->answer->count;
    for (size_t i = 0; same && i < answer->count; i++)
        same = answer->stages[i].loaded == t->answer->stages[i].loaded;
    for (size_t i = 0; same && i < t->count; i++) {
        const accuracy_knob *k = &t->knobs[i];
        const char *has = accuracy_setting_at(&answer->stages[k->stage], k->param, 0,
                                              &t->record->arena),
                   *wanted = assignment_at(t, k, at);
        same = has && wanted && !strcmp(has, wanted);
    }
    return same;
}

/* A twin from earlier runs, good or not; NULL if there is none. */
static const accuracy_twin *known_twin(const accuracy_twins *t, int at)
{
    const accuracy_runs *runs = t->scene.runs;
    for (size_t i = 0; i < runs->count; i++)
        if (runs->list[i]->pipeline && is_twin(t, at, runs->list[i]->pipeline))
            return runs->list[i];
    return NULL;
}

/* Finds or runs a twin; NULL if there is no good one. */
static const accuracy_twin *find_twin(accuracy_twins *t, int at)
{
    const accuracy_twin *twin = known_twin(t, at);
    if (!twin && !t->stopped)
        twin = run_twin(t, at, no_setting);
    return twin && twin->good ? twin : NULL;
}

/* Runs the twins that separate the contributions of the settings. */
static void run_refined(accuracy_twins *t)
{
    for (size_t i = 0; t->count > 1 && t->quarter && i < t->count && !t->stopped; i++)
        t->refined[i] = run_twin(t, quarter, i);
}

bool accuracy_twins_find(accuracy_twins *t)
{
    const bool again = t->half || t->quarter;
    if (t->twice || (t->half && t->quarter))
        return false;
    if (!again)
        list_knobs(t);
    if (t->record->count == 0)
        return false;
    if (t->one_by_one && (again ? t->half != NULL : t->far_first)) {
        t->quarter = find_twin(t, quarter);
        if (t->quarter || again)
            return t->quarter != NULL;
    }
    t->half = find_twin(t, half);
    if (!t->one_by_one && t->half) {
        t->quarter = find_twin(t, quarter);
        run_refined(t);
    }
    if (!t->half || (!t->one_by_one && !t->quarter))
        t->twice = find_twin(t, twice);
    return t->half || t->twice;
}

const accuracy_twin *accuracy_twins_find_finer(accuracy_twins *t)
{
    list_knobs(t);
    const accuracy_twin *known = t->count > 0 ? known_twin(t, twice) : NULL;
    t->checking = true;
    return known ? known : run_twin(t, twice, no_setting);
}

void accuracy_twins_run_fixed(accuracy_twins *t)
{
    bool some = false;
    for (size_t i = 0; i < t->count; i++)
        some = some || is_fixed_by_file(t, &t->knobs[i]);
    const accuracy_twin *twin = some ? run_twin(t, quarter, fixed_settings) : NULL;
    t->fixed_finer = twin && twin->good ? twin : NULL;
}

bool accuracy_twins_have_others(const accuracy_twins *t)
{
    bool some = false;
    for (size_t i = 0; i < t->count; i++)
        some = some || t->knobs[i].stage != t->estimating;
    return some;
}

void accuracy_twins_run_others(accuracy_twins *t)
{
    const accuracy_twin *twin = run_twin(t, quarter, other_settings);
    t->others_finer = twin && twin->good ? twin : NULL;
}
