/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "open.h"

#include "twin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A stage is cheap if its model states at most this share of the most expensive one's cost, or
   states none and is not requested itself. */
static const double cheap_share = 0.1;
/* Levels by which the settings of cheap stages are finer than those of the most expensive stage, in
   every attempt and twin. If all of them sampled too coarsely, no twin would show it. */
static const double ahead = 1;

static double largest_cost(const ff_pipeline *pipeline)
{
    double most = 0;
    for (size_t i = 0; i < pipeline->count; i++)
        if (pipeline->stages[i].needed && pipeline->stages[i].loaded)
            most = fmax(most, ff_model_cost(pipeline->stages[i].loaded->model));
    return most;
}

/* Stages of a loop cost as much as its most expensive one. A stage that states no cost may be the
   most expensive if its own outputs are requested. */
static bool costs_little(const ff_stage *stage, double most)
{
    double cost = ff_model_cost(stage->loaded->model);
    bool requested = false;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++)
        requested = requested || stage->results[i].requested;
    return most > 0 && !stage->loop && cost <= cheap_share * most && (cost > 0 || !requested);
}

static void note_given(accuracy_open *open, const char *stage, const char *setting)
{
    char *list =
        memory_print_text("%s%s%s.%s", open->fixed, *open->fixed ? ", " : "", stage, setting);
    open->fixed = memory_arena_take(&open->arena, list);
}

void accuracy_open_list(accuracy_open *open, const ff_pipeline *presets)
{
    const double most = largest_cost(presets);
    size_t count;
    accuracy_knob *all = accuracy_knobs(presets, &count, &open->arena);
    open->presets = presets;
    open->knobs = all;
    open->levels = memory_arena_alloc(&open->arena, (count + 1) * sizeof *open->levels);
    open->count = 0;
    open->fixed = "";
    for (size_t i = 0; i < count; i++) {
        const ff_stage *stage = &presets->stages[all[i].stage];
        if (!all[i].open) {
            note_given(open, stage->name, all[i].name);
        } else if (accuracy_setting_at(stage, all[i].param, 0, &open->arena)) {
            open->levels[open->count] = (accuracy_level){.cheap = costs_little(stage, most)};
            open->knobs[open->count++] = all[i];
        }
    }
    accuracy_open_move(open, 0);
}

const char *accuracy_open_set(accuracy_open *open, size_t knob)
{
    const accuracy_knob *k = &open->knobs[knob];
    return accuracy_setting_at(&open->presets->stages[k->stage], k->param, open->levels[knob].level,
                               &open->arena);
}

/* Sets the level. If the setting's limits forbid it, uses the nearest allowed level towards the
 * preset. */
static void move(accuracy_open *open, size_t knob, double level)
{
    accuracy_level *l = &open->levels[knob];
    l->level = fmax(level, accuracy_finest - (l->cheap ? ahead : 0));
    while (l->level != 0 && !accuracy_open_set(open, knob))
        l->level = fabs(l->level) < 1 ? 0 : l->level - copysign(1, l->level);
}

void accuracy_open_freeze_idle(accuracy_open *open, const ff_report *messages, ff_place place)
{
    for (size_t i = 0; i < open->count; i++)
        open->levels[i].idle |= accuracy_is_idle(
            messages, place, open->presets->stages[open->knobs[i].stage].name, open->knobs[i].name);
}

bool accuracy_open_move(accuracy_open *open, double to)
{
    bool moved = false;
    for (size_t i = 0; i < open->count; i++) {
        const accuracy_level before = open->levels[i];
        if (!before.idle)
            move(open, i, to - (before.cheap ? ahead : 0));
        moved = moved || open->levels[i].level != before.level;
    }
    open->at = fmax(to, accuracy_finest);
    return moved;
}

size_t accuracy_open_count(const accuracy_open *open, size_t stage)
{
    size_t count = 0;
    for (size_t i = 0; i < open->count; i++)
        count += open->knobs[i].stage == stage && !open->levels[i].idle;
    return count;
}
