/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What needs what: the stages that run, why, and in which order. */
#include "build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void ff_link_from(ff_build *b, size_t first)
{
    ff_pipeline *pipeline = b->pipeline;
    size_t *waiting = ff_alloc((pipeline->count + 1) * sizeof *waiting);
    size_t count = 0;
    if (!pipeline->stages[first].instance->linked)
        waiting[count++] = first;
    pipeline->stages[first].instance->linked = true;
    while (count > 0) {
        ff_stage *stage = &pipeline->stages[waiting[--count]];
        if (!ff_load_stage(b, stage))
            continue;
        ff_link_stage(b, stage);
        for (size_t i = 0; i < stage->wire_count; i++) {
            int from = stage->wires[i].stage;
            if (from < 0 || pipeline->stages[from].instance->linked)
                continue;
            pipeline->stages[from].instance->linked = true;
            waiting[count++] = (size_t)from;
        }
    }
    free(waiting);
}

static size_t count_asked(const ff_stage *stage, const char **first)
{
    size_t asked = 0;
    for (size_t i = 0; stage->loaded && i < stage->loaded->model->output_count; i++) {
        if (stage->results[i].asked && asked++ == 0)
            *first = stage->results[i].row->name;
    }
    return asked;
}

static void say_why(ff_pipeline *pipeline, size_t index)
{
    enum { DEFAULT_NAMES = 3 };
    ff_stage *stage = &pipeline->stages[index];
    const char *first = NULL;
    size_t asked = count_asked(stage, &first), fed = 0;
    char list[256] = "";
    if (!strcmp(stage->why, "feeds no other stage"))
        return;
    if (asked > 0) {
        stage->why = asked == 1
                         ? ff_pipeline_print(pipeline, "%s.%s is requested", stage->name, first)
                         : ff_pipeline_print(pipeline, "%s.%s and %zu more are requested",
                                             stage->name, first, asked - 1);
        return;
    }
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *other = &pipeline->stages[i];
        bool feeds = false;
        for (size_t k = 0; other->needed && k < other->wire_count; k++)
            feeds = feeds || other->wires[k].stage == (int)index;
        size_t used = strlen(list);
        if (feeds && ++fed <= DEFAULT_NAMES)
            snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", other->name);
    }
    if (fed > DEFAULT_NAMES)
        stage->why =
            ff_pipeline_print(pipeline, "feeds %s and %zu more", list, fed - DEFAULT_NAMES);
    else if (fed > 0)
        stage->why = ff_pipeline_print(pipeline, "feeds %s", list);
}

/* The results that a needed stage takes are wanted, and their stages needed. */
static void mark_inputs(ff_pipeline *pipeline, ff_stage *stage, size_t *waiting, size_t *count)
{
    for (size_t i = 0; i < stage->wire_count; i++) {
        int from = stage->wires[i].stage;
        if (from >= 0 && !pipeline->stages[from].needed) {
            pipeline->stages[from].needed = true;
            waiting[(*count)++] = (size_t)from;
        }
    }
    for (size_t i = 0; stage->wire_count && i < stage->loaded->model->input_count; i++) {
        ff_result *result = ff_feeding_result(pipeline, stage, i);
        if (!result)
            continue;
        ff_stage *from = &pipeline->stages[ff_input_wire(stage, i)->stage];
        result->wanted = true;
        if (!(ff_model_input(stage->loaded->model, i)->flags & FF_OPTIONAL))
            from->instance->demanded |= UINT64_C(1) << (result - from->results);
    }
}

void ff_mark_needed(ff_build *b)
{
    ff_pipeline *pipeline = b->pipeline;
    size_t *waiting = ff_alloc((pipeline->count + 1) * sizeof *waiting);
    size_t count = 0;
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[i];
        const char *first;
        if (count_asked(stage, &first) == 0)
            continue;
        for (size_t k = 0; k < stage->loaded->model->output_count; k++)
            stage->results[k].wanted |= stage->results[k].asked;
        stage->needed = true;
        waiting[count++] = i;
    }
    while (count > 0)
        mark_inputs(pipeline, &pipeline->stages[waiting[--count]], waiting, &count);
    for (size_t i = 0; i < pipeline->count; i++)
        say_why(pipeline, i);
    free(waiting);
}

/* Depth first; `path` holds the stages that are being entered. */
typedef struct sorting {
    ff_build *b;
    enum { NEW, ENTERED, DONE } * states;
    size_t *path, depth, sorted;
} sorting;

static void report_cycle(sorting *s, size_t again, ff_place place)
{
    const ff_pipeline *pipeline = s->b->pipeline;
    char text[512] = "";
    size_t from = 0, used = 0;
    while (s->path[from] != again)
        from++;
    for (size_t i = from; i < s->depth && used < sizeof text; i++) {
        pipeline->stages[s->path[i]].instance->broken = true;
        used += (size_t)snprintf(text + used, sizeof text - used, "%s -> ",
                                 pipeline->stages[s->path[i]].name);
    }
    ff_error(s->b->report, FF_EXIT_INPUT, place,
             "each arrow reads \"needs\"; break the circle by another stage on one of the wires",
             "pipeline: the stages wait for each other: %s%s", text, pipeline->stages[again].name);
}

static void visit(sorting *s, size_t index)
{
    ff_stage *stage = &s->b->pipeline->stages[index];
    s->states[index] = ENTERED;
    s->path[s->depth++] = index;
    for (size_t i = 0; i < stage->wire_count; i++) {
        const ff_wire *wire = &stage->wires[i];
        if (wire->stage >= 0 && s->states[wire->stage] == ENTERED)
            report_cycle(s, (size_t)wire->stage, wire->place);
        else if (wire->stage >= 0 && s->states[wire->stage] == NEW)
            visit(s, (size_t)wire->stage);
    }
    s->depth--;
    s->states[index] = DONE;
    s->b->pipeline->order[s->sorted++] = index;
}

void ff_sort_stages(ff_build *b)
{
    size_t count = b->pipeline->count;
    sorting s = {.b = b};
    s.states = ff_alloc(count * sizeof *s.states);
    s.path = ff_alloc(count * sizeof *s.path);
    for (size_t i = 0; i < count; i++)
        if (s.states[i] == NEW)
            visit(&s, i);
    free(s.states);
    free(s.path);
}
