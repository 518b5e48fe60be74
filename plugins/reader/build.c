/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tables of a view, from the JSON that a run or a study left. */
#include "results.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *ff_results_text(ff_results *results, const json_t *text)
{
    const char *value = json_string_value(text);
    return value ? ff_arena_text(&results->arena, value, strlen(value)) : "";
}

void *ff_results_add(ff_results *results, ff_rows *rows, size_t size)
{
    rows->rows = realloc(rows->rows, (rows->count + 1) * sizeof *rows->rows);
    if (!rows->rows)
        abort();
    return rows->rows[rows->count++] = ff_arena_alloc(&results->arena, size);
}

size_t ff_results_stage(ff_results *results, const char *name, size_t length)
{
    for (size_t i = 0; i < results->stages.count; i++) {
        const ff_view_stage *stage = results->stages.rows[i];
        if (strlen(stage->name) == length && !strncmp(stage->name, name, length))
            return i;
    }
    ff_view_stage *made = ff_results_add(results, &results->stages, sizeof *made);
    *made = (ff_view_stage){.size = sizeof *made,
                            .name = ff_arena_text(&results->arena, name, length),
                            .model = "",
                            .version = "",
                            .build = ""};
    return results->stages.count - 1;
}

void ff_results_cite(ff_results *results, const char *model, const json_t *entry)
{
    const char *reference = ff_results_text(results, json_object_get(entry, "reference"));
    for (size_t i = 0; i < results->citations.count; i++) {
        const ff_view_citation *known = results->citations.rows[i];
        if (!strcmp(known->model, model))
            return;
    }
    if (!*reference)
        return;
    ff_view_citation *made = ff_results_add(results, &results->citations, sizeof *made);
    *made = (ff_view_citation){
        .size = sizeof *made,
        .model = ff_arena_text(&results->arena, model, strlen(model)),
        .reference = reference,
        .bibtex = ff_results_text(results, json_object_get(entry, "bibtex")),
    };
}

static void add_params(ff_results *results, ff_view_stage *stage, json_t *params)
{
    const char *name;
    json_t *param;
    ff_rows rows = {.rows = NULL};
    json_object_foreach(params, name, param)
    {
        ff_view_param *row = ff_results_add(results, &rows, sizeof *row);
        *row = (ff_view_param){
            .size = sizeof *row,
            .name = ff_arena_text(&results->arena, name, strlen(name)),
            .text = ff_results_text(results, json_object_get(param, "text")),
            .origin = ff_results_text(results, json_object_get(param, "origin")),
        };
    }
    stage->param_count = rows.count;
    stage->params = ff_results_keep(results, &rows);
}

static void add_feeders(ff_results *results, ff_view_stage *stage, json_t *wires)
{
    const char *name;
    json_t *wire;
    size_t *feeders = ff_arena_alloc(&results->arena, json_object_size(wires) * sizeof *feeders);
    stage->feeders = feeders;
    json_object_foreach(wires, name, wire)
    {
        const char *from = json_string_value(json_object_get(wire, "stage"));
        if (from)
            feeders[stage->feeder_count++] = ff_results_stage(results, from, strlen(from));
    }
}

static void add_stage(ff_results *results, const json_t *entry)
{
    const char *name = json_string_value(json_object_get(entry, "stage"));
    if (!name)
        return;
    const size_t at = ff_results_stage(results, name, strlen(name));
    ff_view_stage *stage = results->stages.rows[at];
    stage->model = ff_results_text(results, json_object_get(entry, "model"));
    stage->version = ff_results_text(results, json_object_get(entry, "version"));
    stage->build = ff_results_text(results, json_object_get(entry, "build"));
    add_params(results, stage, json_object_get(entry, "parameters"));
    add_feeders(results, stage, json_object_get(entry, "wires"));
    ff_results_cite(results, stage->model, entry);
}

void ff_results_head(ff_results *results, const json_t *root)
{
    const char *name;
    json_t *text, *stage;
    size_t i;
    results->view.title = ff_results_text(results, json_object_get(root, "title"));
    json_object_foreach(json_object_get(root, "facts"), name, text)
    {
        ff_view_fact *fact = ff_results_add(results, &results->facts, sizeof *fact);
        *fact = (ff_view_fact){.size = sizeof *fact,
                               .name = ff_arena_text(&results->arena, name, strlen(name)),
                               .text = ff_results_text(results, text)};
    }
    json_array_foreach(json_object_get(root, "stages"), i, stage)
    {
        const json_t *ran = json_object_get(stage, "ran");
        if (!json_is_false(ran))
            add_stage(results, stage);
    }
}

/* `count` names; "" where there is none. */
static const char *const *copy_names(ff_results *results, const json_t *names, size_t count)
{
    const char **copy = ff_arena_alloc(&results->arena, count * sizeof *copy);
    for (size_t i = 0; i < count; i++)
        copy[i] = ff_results_text(results, json_array_get(names, i));
    return copy;
}

void ff_results_variable(ff_results *results, const char *name, const json_t *entry,
                         const json_t *doc, uint32_t flags)
{
    const json_t *dims = json_object_get(entry, "dims"),
                 *known = json_object_get(results->index, name);
    const char *dot = strchr(name, '.');
    size_t rank = json_array_size(dims);
    if (!dot || rank > 4)
        return;
    ff_view_variable *row = known ? results->variables.rows[json_integer_value(known)] : NULL;
    if (row && row->rank >= rank)
        return;
    if (!row) {
        json_object_set_new(results->index, name,
                            json_integer((json_int_t)results->variables.count));
        row = ff_results_add(results, &results->variables, sizeof *row);
        *row = (ff_view_variable){
            .size = sizeof *row,
            .name = ff_arena_text(&results->arena, name, strlen(name)),
            .output = ff_arena_text(&results->arena, dot + 1, strlen(dot + 1)),
            .stage = ff_results_stage(results, name, (size_t)(dot - name)),
            .unit = ff_results_text(results, json_object_get(entry, "unit")),
            .doc = ff_results_text(results, doc),
            .flags = flags,
        };
    }
    row->rank = (uint32_t)rank;
    row->dims = copy_names(results, dims, rank);
    row->against = copy_names(results, json_object_get(entry, "against"), rank);
}

void ff_results_against(ff_results *results, const char *name, const json_t *entry)
{
    const json_t *known = json_object_get(results->index, name),
                 *against = json_object_get(entry, "against");
    ff_view_variable *row = known ? results->variables.rows[json_integer_value(known)] : NULL;
    if (row && json_array_size(against) == row->rank)
        row->against = copy_names(results, against, row->rank);
}

void ff_results_quality(ff_results *results, ff_rows *rows, const char *stage, const char *name,
                        const json_t *value, const json_t *limit, int verdict, const json_t *text)
{
    ff_view_quality *row = ff_results_add(results, rows, sizeof *row);
    *row = (ff_view_quality){
        .size = sizeof *row,
        .stage = ff_results_stage(results, stage, strlen(stage)),
        .name = ff_arena_text(&results->arena, name, strlen(name)),
        .text = ff_results_text(results, text),
        .value = json_is_number(value) ? json_number_value(value) : (double)NAN,
        .limit = json_is_number(limit) ? json_number_value(limit) : (double)NAN,
        .verdict = verdict,
    };
}
