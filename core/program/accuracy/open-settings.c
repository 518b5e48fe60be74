/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "open-settings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A stage costs little whose model says that it costs at most this share of the dearest one's, or
   says nothing and is not asked for itself. */
static const double little = 0.1;
/* Its settings are finer than those of the dearest stage by so many levels, in every attempt and in
   its twins, too: what all of them sample too coarsely none of them shows. */
static const double ahead = 1;

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

static void note_given(accuracy_open *open, const char *stage, const char *setting)
{
    char *list =
        memory_print_text("%s%s%s.%s", open->given, *open->given ? ", " : "", stage, setting);
    open->given = memory_arena_text(open->arena, list, strlen(list));
    free(list);
}

void accuracy_open_list(accuracy_open *open, const ff_pipeline *pipeline)
{
    const double most = largest_cost(pipeline);
    accuracy_setting settings[ACCURACY_MOST_SETTINGS];
    free(open->all);
    open->count = 0;
    open->given = "";
    open->all = memory_alloc((pipeline->count * ACCURACY_MOST_SETTINGS + 1) * sizeof *open->all);
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[pipeline->order[i]];
        size_t count = 0;
        if (stage->needed && stage->loaded)
            count = accuracy_settings(stage, open->arena, settings);
        for (size_t k = 0; k < count; k++) {
            if (!settings[k].open)
                note_given(open, stage->name, settings[k].name);
            else if (accuracy_setting_at(stage, settings[k].param, 0, open->arena))
                open->all[open->count++] = (accuracy_open_setting){
                    .stage = stage,
                    .setting = settings[k],
                    .cheap = costs_little(stage, most),
                    .dearest = most > 0 && ff_model_cost(stage->loaded->model) >= most};
        }
    }
}

void accuracy_open_free(accuracy_open *open)
{
    free(open->all);
    open->all = NULL;
}

const char *accuracy_open_set(const accuracy_open *open, size_t i)
{
    const accuracy_open_setting *s = &open->all[i];
    return accuracy_setting_at(s->stage, s->setting.param, s->level, open->arena);
}

bool accuracy_open_move(accuracy_open *open, double level)
{
    bool moved = false;
    for (size_t i = 0; i < open->count; i++) {
        accuracy_open_setting *s = &open->all[i];
        double before = s->level, lead = s->cheap ? ahead : 0;
        s->level = fmax(level + s->behind, accuracy_finest) - lead;
        while (s->level != 0 && !accuracy_open_set(open, i)) /* towards the preset */
            s->level = fabs(s->level) < 1 ? 0 : s->level - copysign(1, s->level);
        moved = moved || s->level != before;
    }
    return moved;
}

bool accuracy_open_have_twins(const accuracy_open *open)
{
    for (size_t i = 0; i < open->count; i++) {
        const accuracy_open_setting *s = &open->all[i];
        if (!accuracy_setting_at(s->stage, s->setting.param, s->level + 2, open->arena))
            return false;
    }
    return true;
}
