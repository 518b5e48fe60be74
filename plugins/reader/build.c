/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tables of a view, from the JSON that a run or a study left. */
#include "results.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *results_text(results_reader *results, const json_t *text)
{
    const char *value = json_string_value(text);
    return value ? results_arena_text(&results->arena, value, strlen(value)) : "";
}

void *results_add(results_reader *results, results_rows *rows, size_t size)
{
    rows->rows = realloc(rows->rows, (rows->count + 1) * sizeof *rows->rows);
    if (!rows->rows)
        abort();
    return rows->rows[rows->count++] = results_arena_alloc(&results->arena, size);
}

size_t results_stage(results_reader *results, const char *name, size_t length)
{
    for (size_t i = 0; i < results->stages.count; i++) {
        const ff_view_stage *stage = results->stages.rows[i];
        if (strlen(stage->name) == length && !strncmp(stage->name, name, length))
            return i;
    }
    ff_view_stage *made = results_add(results, &results->stages, sizeof *made);
    *made = (ff_view_stage){.size = sizeof *made,
                            .name = results_arena_text(&results->arena, name, length),
                            .model = "",
                            .version = "",
                            .build = ""};
    return results->stages.count - 1;
}

void results_cite(results_reader *results, const char *model, const json_t *entry)
{
    const char *reference = results_text(results, json_object_get(entry, "reference"));
    for (size_t i = 0; i < results->citations.count; i++) {
        const ff_view_citation *known = results->citations.rows[i];
        if (!strcmp(known->model, model))
            return;
    }
    if (!*reference)
        return;
    ff_view_citation *made = results_add(results, &results->citations, sizeof *made);
    *made = (ff_view_citation){
        .size = sizeof *made,
        .model = results_arena_text(&results->arena, model, strlen(model)),
        .reference = reference,
        .bibtex = results_text(results, json_object_get(entry, "bibtex")),
    };
}

static void add_params(results_reader *results, ff_view_stage *stage, json_t *params)
{
    const char *name;
    json_t *param;
    results_rows rows = {.rows = NULL};
    json_object_foreach(params, name, param)
    {
        ff_view_param *row = results_add(results, &rows, sizeof *row);
        *row = (ff_view_param){
            .size = sizeof *row,
            .name = results_arena_text(&results->arena, name, strlen(name)),
            .text = results_text(results, json_object_get(param, "text")),
            .origin = results_text(results, json_object_get(param, "origin")),
        };
    }
    stage->param_count = rows.count;
    stage->params = results_keep(results, &rows);
}

static void add_feeders(results_reader *results, ff_view_stage *stage, json_t *wires)
{
    const char *name;
    json_t *wire;
    size_t *feeders =
        results_arena_alloc(&results->arena, json_object_size(wires) * sizeof *feeders);
    stage->feeders = feeders;
    json_object_foreach(wires, name, wire)
    {
        const char *from = json_string_value(json_object_get(wire, "stage"));
        if (from)
            feeders[stage->feeder_count++] = results_stage(results, from, strlen(from));
    }
}

static void add_stage(results_reader *results, const json_t *entry)
{
    const char *name = json_string_value(json_object_get(entry, "stage"));
    if (!name)
        return;
    const size_t at = results_stage(results, name, strlen(name));
    ff_view_stage *stage = results->stages.rows[at];
    stage->model = results_text(results, json_object_get(entry, "model"));
    stage->version = results_text(results, json_object_get(entry, "version"));
    stage->build = results_text(results, json_object_get(entry, "build"));
    add_params(results, stage, json_object_get(entry, "parameters"));
    add_feeders(results, stage, json_object_get(entry, "wires"));
    results_cite(results, stage->model, entry);
}

void results_head(results_reader *results, const json_t *root)
{
    const char *name;
    json_t *text, *stage;
    size_t i;
    results->view.title = results_text(results, json_object_get(root, "title"));
    json_object_foreach(json_object_get(root, "facts"), name, text)
    {
        ff_view_fact *fact = results_add(results, &results->facts, sizeof *fact);
        *fact = (ff_view_fact){.size = sizeof *fact,
                               .name = results_arena_text(&results->arena, name, strlen(name)),
                               .text = results_text(results, text)};
    }
    json_array_foreach(json_object_get(root, "stages"), i, stage)
    {
        const json_t *ran = json_object_get(stage, "ran");
        if (!json_is_false(ran))
            add_stage(results, stage);
    }
}

/* `count` names; "" where there is none. */
static const char *const *copy_names(results_reader *results, const json_t *names, size_t count)
{
    const char **copy = results_arena_alloc(&results->arena, count * sizeof *copy);
    for (size_t i = 0; i < count; i++)
        copy[i] = results_text(results, json_array_get(names, i));
    return copy;
}

void results_variable(results_reader *results, const char *name, const json_t *entry,
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
        row = results_add(results, &results->variables, sizeof *row);
        *row = (ff_view_variable){
            .size = sizeof *row,
            .name = results_arena_text(&results->arena, name, strlen(name)),
            .output = results_arena_text(&results->arena, dot + 1, strlen(dot + 1)),
            .stage = results_stage(results, name, (size_t)(dot - name)),
            .unit = results_text(results, json_object_get(entry, "unit")),
            .doc = results_text(results, doc),
            .flags = flags,
        };
    }
    row->rank = (uint32_t)rank;
    row->dims = copy_names(results, dims, rank);
    row->against = copy_names(results, json_object_get(entry, "against"), rank);
}

void results_against(results_reader *results, const char *name, const json_t *entry)
{
    const json_t *known = json_object_get(results->index, name),
                 *against = json_object_get(entry, "against");
    ff_view_variable *row = known ? results->variables.rows[json_integer_value(known)] : NULL;
    if (row && json_array_size(against) == row->rank)
        row->against = copy_names(results, against, row->rank);
}

void results_quality(results_reader *results, results_rows *rows, const char *stage,
                     const char *name, const json_t *value, const json_t *limit, int verdict,
                     const json_t *text)
{
    ff_view_quality *row = results_add(results, rows, sizeof *row);
    *row = (ff_view_quality){
        .size = sizeof *row,
        .stage = results_stage(results, stage, strlen(stage)),
        .name = results_arena_text(&results->arena, name, strlen(name)),
        .text = results_text(results, text),
        .value = json_is_number(value) ? json_number_value(value) : (double)NAN,
        .limit = json_is_number(limit) ? json_number_value(limit) : (double)NAN,
        .verdict = verdict,
    };
}
