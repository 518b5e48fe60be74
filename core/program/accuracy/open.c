/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "open.h"

#include "twin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Levels by which the first attempt is coarser than the presets. */
static const double coarsest = 2;
/* A stage is cheap if its model states at most this share of the most expensive one's cost, or
   states none and is not asked for itself. */
static const double little = 0.1;
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
   most expensive if its own outputs are asked for. */
static bool costs_little(const ff_stage *stage, double most)
{
    double cost = ff_model_cost(stage->loaded->model);
    bool asked = false;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++)
        asked = asked || stage->results[i].requested;
    return most > 0 && !stage->loop && cost <= little * most && (cost > 0 || !asked);
}

static void note_given(accuracy_open *open, const char *stage, const char *setting)
{
    char *list =
        memory_print_text("%s%s%s.%s", open->given, *open->given ? ", " : "", stage, setting);
    open->given = memory_arena_text(&open->arena, list, strlen(list));
    free(list);
}

void accuracy_open_list(accuracy_open *open, const ff_pipeline *asked)
{
    const double most = largest_cost(asked);
    accuracy_setting settings[ACCURACY_MOST_SETTINGS];
    free(open->knobs);
    open->count = 0;
    open->given = "";
    open->knobs = memory_alloc((asked->count * ACCURACY_MOST_SETTINGS + 1) * sizeof *open->knobs);
    for (size_t i = 0; i < asked->count; i++) {
        const ff_stage *stage = &asked->stages[asked->order[i]];
        size_t count = 0;
        if (stage->needed && stage->loaded)
            count = accuracy_settings(stage, settings);
        for (size_t k = 0; k < count; k++) {
            if (!settings[k].open)
                note_given(open, stage->name, settings[k].name);
            else if (accuracy_setting_at(stage, settings[k].param, 0, &open->arena))
                open->knobs[open->count++] = (accuracy_knob){
                    .stage = stage, .setting = settings[k], .cheap = costs_little(stage, most)};
        }
    }
}

const char *accuracy_open_set(accuracy_open *open, size_t knob)
{
    const accuracy_knob *k = &open->knobs[knob];
    return accuracy_setting_at(k->stage, k->setting.param, k->level, &open->arena);
}

/* Sets the level, or the nearest one towards the preset that the setting's limits allow. */
static void move(accuracy_open *open, size_t knob, double level)
{
    accuracy_knob *k = &open->knobs[knob];
    k->level = fmax(level, accuracy_finest - (k->cheap ? ahead : 0));
    while (k->level != 0 && !accuracy_open_set(open, knob))
        k->level = fabs(k->level) < 1 ? 0 : k->level - copysign(1, k->level);
}

/* Twins are coarser: by a level in the tolerances, and by up to two in the counts. */
bool accuracy_open_has_twins(accuracy_open *open)
{
    for (size_t i = 0; i < open->count; i++) {
        const accuracy_knob *k = &open->knobs[i];
        double coarser = k->setting.tolerance ? 1 : 2;
        if (!k->idle &&
            !accuracy_setting_at(k->stage, k->setting.param, k->level + coarser, &open->arena))
            return false;
    }
    return true;
}

/* The level reached: limits may forbid coarser settings, and without an open setting none can
   become finer. */
static double reached(const accuracy_open *open, bool tolerance, double level)
{
    double most = accuracy_finest;
    for (size_t i = 0; i < open->count; i++)
        if (open->knobs[i].setting.tolerance == tolerance && !open->knobs[i].idle)
            most = fmax(most, open->knobs[i].level + (open->knobs[i].cheap ? ahead : 0));
    return level > 0 ? most : fmax(level, accuracy_finest);
}

static void note_levels(accuracy_open *open, accuracy_levels to)
{
    open->at =
        (accuracy_levels){reached(open, false, to.counts), reached(open, true, to.tolerances)};
}

void accuracy_open_leave_idle(accuracy_open *open, const ff_report *said, ff_place place)
{
    for (size_t i = 0; i < open->count; i++) {
        accuracy_knob *k = &open->knobs[i];
        k->idle = k->idle || accuracy_is_idle(said, place, k->stage->name, k->setting.name);
    }
    note_levels(open, open->at);
}

bool accuracy_open_move(accuracy_open *open, accuracy_levels to)
{
    bool moved = false;
    for (size_t i = 0; i < open->count; i++) {
        accuracy_knob *k = &open->knobs[i];
        double before = k->level, level = k->setting.tolerance ? to.tolerances : to.counts;
        if (!k->idle)
            move(open, i, level - (k->cheap ? ahead : 0));
        moved = moved || k->level != before;
    }
    note_levels(open, to);
    return moved;
}

/* First level of the tolerances. A tolerance without a unit is an error itself, so the first level
   is the one nearest to the goal: with larger steps an extreme between two of them would be missing
   from the answer and from every twin. */
static double first_tolerance(const accuracy_open *open, double asked)
{
    double level = coarsest;
    for (size_t i = 0; i < open->count; i++) {
        const accuracy_knob *k = &open->knobs[i];
        const ff_bound *bound = &k->stage->params[k->setting.param];
        bool bare = !strcmp(bound->row->unit, "1") || !strcmp(bound->row->unit, "%");
        if (k->setting.tolerance && bare)
            level =
                fmin(level, round(log(asked / bound->value.real) / log(accuracy_tolerance_factor)));
    }
    return fmax(level, 0);
}

void accuracy_open_begin(accuracy_open *open, double asked)
{
    accuracy_open_move(open, (accuracy_levels){coarsest, first_tolerance(open, asked)});
}

void accuracy_open_free(accuracy_open *open)
{
    free(open->knobs);
    memory_arena_free(&open->arena);
}
