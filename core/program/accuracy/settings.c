/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "settings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* True if the row's limits, which apply if min < max, allow the value. */
static bool is_allowed(const ff_param *row, double si)
{
    return !(row->min < row->max) || (si >= row->min && si <= row->max);
}

const char *accuracy_setting_at(const ff_stage *stage, size_t param, double levels,
                                memory_arena *arena)
{
    const ff_bound *bound = &stage->params[param];
    const ff_param *row = bound->row;
    char *text = NULL;
    if (row->type == FF_INT) {
        double count = floor((double)bound->value.integer * exp2(-levels) + 1e-6);
        if (count >= 1 && count < 1e15 && is_allowed(row, count))
            text = memory_print_text("%s.%s=%.0f", stage->name, row->name, count);
    } else {
        const ff_unit *unit = &stage->loaded->param_units[param];
        double number =
            ff_unit_from_si(unit, bound->value.real) * pow(accuracy_tolerance_factor, levels);
        if (number > 0 && is_allowed(row, number))
            text = memory_print_text("%s.%s=%.4g%s%s", stage->name, row->name, number,
                                     strcmp(row->unit, "1") ? " " : "",
                                     strcmp(row->unit, "1") ? row->unit : "");
    }
    const char *kept = text ? memory_arena_text(arena, text, strlen(text)) : NULL;
    free(text);
    return kept;
}

static bool is_number(const ff_bound *bound)
{
    return bound->row->flags & FF_TUNABLE && bound->present && !bound->wire &&
           (bound->row->type == FF_INT || bound->row->type == FF_REAL) && !bound->value.text;
}

accuracy_knob *accuracy_knobs(const ff_pipeline *pipeline, size_t *count, memory_arena *arena)
{
    accuracy_knob *list = NULL;
    *count = 0;
    for (size_t n = 0; n < pipeline->count; n++) {
        const size_t at = pipeline->order[n];
        const ff_stage *stage = &pipeline->stages[at];
        const bool runs = stage->needed && stage->loaded && stage->params;
        for (size_t i = 0; runs && i < stage->loaded->model->param_count; i++) {
            if (!is_number(&stage->params[i]))
                continue;
            list = memory_arena_grow(arena, list, *count, sizeof *list);
            list[(*count)++] = (accuracy_knob){.stage = at,
                                               .name = stage->params[i].row->name,
                                               .param = i,
                                               .open = !stage->params[i].place.source};
        }
    }
    return list;
}

const char **accuracy_list_settings(const ff_pipeline *pipeline, size_t *count, memory_arena *arena)
{
    size_t all;
    const accuracy_knob *knobs = accuracy_knobs(pipeline, &all, arena);
    const char **list = memory_arena_alloc(arena, (all + 1) * sizeof *list);
    *count = 0;
    for (size_t i = 0; i < all; i++) {
        const ff_stage *stage = &pipeline->stages[knobs[i].stage];
        const char *set = accuracy_setting_at(stage, knobs[i].param, 0, arena);
        if (set)
            list[(*count)++] = set;
    }
    return list;
}
