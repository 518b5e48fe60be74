/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fills the tables of a view from the JSON files of a run or a study. */
#include "view-tables.h"

#include <assert.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

size_t results_view_point(const results_view *view, size_t index, size_t dimension)
{
    assert(dimension < view->dimension_count);
    size_t d;
    for (d = view->dimension_count; d-- > dimension + 1;)
        index /= view->lengths[d];
    return index % view->lengths[dimension];
}

const char *results_view_text(results_reader *reader, const json_t *text)
{
    const char *value = json_string_value(text);
    return value ? memory_arena_text(&reader->arena, value, strlen(value)) : "";
}

const char *results_view_member(results_reader *reader, const json_t *of, const char *key)
{
    return results_view_text(reader, json_object_get(of, key));
}

const char *results_view_shared_text(results_reader *reader, const char *text)
{
    if (!text)
        return "";
    const json_t *known = json_object_get(reader->texts, text);
    if (known)
        return (const char *)(intptr_t)json_integer_value(known);
    const char *copy = memory_arena_text(&reader->arena, text, strlen(text));
    json_object_set_new(reader->texts, text, json_integer((json_int_t)(intptr_t)copy));
    return copy;
}

json_t *results_view_read_json(const results_reader *reader, const char *name)
{
    json_error_t error;
    errno = 0;
    json_t *root = study_read_json(reader->directory, name, &error);
    if (json_is_object(root))
        return root;
    json_decref(root);
    return NULL;
}

void *results_view_add_row(results_reader *reader, results_rows *rows, size_t size)
{
    rows->rows = memory_resize(rows->rows, (rows->count + 1) * sizeof *rows->rows);
    return rows->rows[rows->count++] = memory_arena_alloc(&reader->arena, size);
}

static void add_limits(results_reader *reader, results_view_case *c, const json_t *list)
{
    results_rows rows = {.rows = NULL};
    const json_t *entry;
    size_t i;
    json_array_foreach(list, i, entry)
    {
        results_view_limit *row = results_view_add_row(reader, &rows, sizeof *row);
        *row = (results_view_limit){
            .output = results_view_member(reader, entry, "output"),
            .asked = results_view_member(reader, entry, "asked"),
            .unit = results_view_member(reader, entry, "unit"),
            .value = study_json_number(json_object_get(entry, "value")),
            .bar = study_json_number(json_object_get(entry, "bar")),
            .at_least = json_is_true(json_object_get(entry, "at_least")),
            .standing =
                (int32_t)limits_standing_of(json_string_value(json_object_get(entry, "standing"))),
        };
    }
    c->limits_text = "";
    if (rows.count == 0) /* a case without limits needs no memory */
        return;
    c->limit_count = rows.count;
    c->limits = results_view_take_rows(reader, &rows);
    char *text = limits_text(list);
    c->limits_text = results_view_shared_text(reader, text);
    free(text);
}

void results_view_judge(results_reader *reader, results_view_case *c, size_t number,
                        const json_t *record)
{
    c->verdict = c->reasons = c->range = "";
    add_limits(reader, c, json_object_get(record, "limits"));
    if (!record)
        return;
    study_judgement judgement;
    study_judgement_read(&judgement, record);
    char *reasons = study_judgement_text(&judgement, STUDY_REASONS),
         *range = study_judgement_text(&judgement, STUDY_RANGE);
    c->verdict = study_verdict_name(judgement.verdict);
    c->reasons = results_view_shared_text(reader, reasons);
    c->range = results_view_shared_text(reader, range);
    free(range);
    free(reasons);
    const char *key = json_string_value(json_object_get(record, "key"));
    study_tally_add(&reader->tally, number, key ? key : "", &judgement);
    study_judgement_free(&judgement);
}

const void *results_view_take_rows(results_reader *reader, results_rows *rows)
{
    size_t size = rows->count * sizeof *rows->rows;
    void *kept = memory_arena_alloc(&reader->arena, size);
    if (size)
        memcpy(kept, rows->rows, size);
    free(rows->rows);
    *rows = (results_rows){.rows = NULL};
    return kept;
}

/* Returns the index of a stage; adds it if it is new. */
static size_t find_stage(results_reader *reader, const char *name, size_t length)
{
    for (size_t i = 0; i < reader->stages.count; i++) {
        const results_view_stage *stage = reader->stages.rows[i];
        if (strlen(stage->name) == length && !strncmp(stage->name, name, length))
            return i;
    }
    results_view_stage *made = results_view_add_row(reader, &reader->stages, sizeof *made);
    *made = (results_view_stage){.name = memory_arena_text(&reader->arena, name, length),
                                 .model = "",
                                 .version = "",
                                 .build = ""};
    return reader->stages.count - 1;
}

void results_view_add_citation(results_reader *reader, const char *model, const json_t *entry)
{
    const char *reference = results_view_member(reader, entry, "reference");
    for (size_t i = 0; i < reader->citations.count; i++) {
        const results_view_citation *known = reader->citations.rows[i];
        if (!strcmp(known->model, model))
            return;
    }
    if (!*reference)
        return;
    results_view_citation *made = results_view_add_row(reader, &reader->citations, sizeof *made);
    *made = (results_view_citation){
        .model = memory_arena_text(&reader->arena, model, strlen(model)),
        .reference = reference,
        .bibtex = results_view_member(reader, entry, "bibtex"),
    };
}

static void add_params(results_reader *reader, results_view_stage *stage, json_t *params)
{
    const char *name;
    json_t *param;
    results_rows rows = {.rows = NULL};
    json_object_foreach(params, name, param)
    {
        results_view_param *row = results_view_add_row(reader, &rows, sizeof *row);
        *row = (results_view_param){
            .name = memory_arena_text(&reader->arena, name, strlen(name)),
            .text = results_view_member(reader, param, "text"),
            .origin = results_view_member(reader, param, "origin"),
        };
    }
    stage->param_count = rows.count;
    stage->params = results_view_take_rows(reader, &rows);
}

static void add_stage(results_reader *reader, const json_t *entry)
{
    const char *name = json_string_value(json_object_get(entry, "stage"));
    if (!name)
        return;
    const size_t at = find_stage(reader, name, strlen(name));
    results_view_stage *stage = reader->stages.rows[at];
    stage->model = results_view_member(reader, entry, "model");
    stage->version = results_view_member(reader, entry, "version");
    stage->build = results_view_member(reader, entry, "build");
    add_params(reader, stage, json_object_get(entry, "parameters"));
    results_view_add_citation(reader, stage->model, entry);
}

void results_view_add_head(results_reader *reader, const json_t *root)
{
    const char *name;
    json_t *text, *stage;
    size_t i;
    reader->view.title = results_view_member(reader, root, "title");
    json_object_foreach(json_object_get(root, "facts"), name, text)
    {
        results_view_fact *fact = results_view_add_row(reader, &reader->facts, sizeof *fact);
        *fact = (results_view_fact){.name = memory_arena_text(&reader->arena, name, strlen(name)),
                                    .text = results_view_text(reader, text)};
    }
    json_array_foreach(json_object_get(root, "stages"), i, stage)
    {
        const json_t *ran = json_object_get(stage, "ran");
        if (!json_is_false(ran))
            add_stage(reader, stage);
    }
}

/* Copies `count` names; a missing one becomes "". */
static const char *const *copy_names(results_reader *reader, const json_t *names, size_t count)
{
    const char **copy = memory_arena_alloc(&reader->arena, count * sizeof *copy);
    for (size_t i = 0; i < count; i++)
        copy[i] = results_view_text(reader, json_array_get(names, i));
    return copy;
}

/* Returns the index of the variable, and adds it if it is new; -1 if the entry is not a variable.
 */
static json_int_t add_variable(results_reader *reader, const char *name, const results_entry *entry,
                               uint32_t flags)
{
    const json_t *known = json_object_get(reader->index, name);
    const char *dot = strchr(name, '.');
    size_t rank = json_array_size(entry->dims);
    json_int_t at = known ? json_integer_value(known) : (json_int_t)reader->variables.count;
    results_view_variable *row = known ? reader->variables.rows[at] : NULL;
    if (!dot || rank > 4)
        return -1;
    if (row && row->rank >= rank)
        return at;
    if (!row) {
        json_object_set_new(reader->index, name, json_integer(at));
        row = results_view_add_row(reader, &reader->variables, sizeof *row);
        *row = (results_view_variable){
            .name = memory_arena_text(&reader->arena, name, strlen(name)),
            .output = memory_arena_text(&reader->arena, dot + 1, strlen(dot + 1)),
            .stage = find_stage(reader, name, (size_t)(dot - name)),
            .unit = results_view_text(reader, entry->unit),
            .doc = results_view_text(reader, entry->doc),
            .flags = flags,
            .extremes = {(size_t)json_integer_value(json_array_get(entry->extremes, 0)),
                         (size_t)json_integer_value(json_array_get(entry->extremes, 1))},
            .whole = results_view_text(reader, json_array_get(entry->extremes, 2)),
        };
    }
    row->rank = (uint32_t)rank;
    row->dims = copy_names(reader, entry->dims, rank);
    row->against = copy_names(reader, entry->against, rank);
    return at;
}

results_output *results_view_add_output(results_reader *reader, const char *name,
                                        const results_entry *entry, uint32_t flags)
{
    json_int_t variable = add_variable(reader, name, entry, flags);
    size_t rank = json_array_size(entry->shape);
    if (variable < 0 || rank > 4)
        return NULL;
    if (reader->output_count == reader->output_room) {
        reader->output_room = reader->output_room ? 2 * reader->output_room : 16;
        reader->outputs =
            memory_resize(reader->outputs, reader->output_room * sizeof *reader->outputs);
    }
    size_t *shape = rank ? memory_arena_alloc(&reader->arena, rank * sizeof *shape) : NULL;
    for (size_t i = 0; i < rank; i++)
        shape[i] = (size_t)json_integer_value(json_array_get(entry->shape, i));
    results_output *made = &reader->outputs[reader->output_count++];
    *made =
        (results_output){.variable = (uint32_t)variable, .rank = (uint32_t)rank, .shape = shape};
    return made;
}

void results_view_take_outputs(results_reader *reader, results_case *of)
{
    size_t size = reader->output_count * sizeof *reader->outputs;
    results_output *kept = memory_arena_alloc(&reader->arena, size);
    if (size)
        memcpy(kept, reader->outputs, size);
    of->outputs = kept;
    of->output_count = reader->output_count;
    reader->output_count = 0;
}

void results_view_add_quality(results_reader *reader, results_rows *rows, const char *stage,
                              const char *name, const json_t *line, const char *text,
                              const char *accepted)
{
    results_view_quality *row = results_view_add_row(reader, rows, sizeof *row);
    *row = (results_view_quality){
        .stage = find_stage(reader, stage, strlen(stage)),
        .name = results_view_shared_text(reader, name),
        .text = results_view_shared_text(reader, text),
        .value = study_json_number(json_array_get(line, 0)),
        .limit = study_json_number(json_array_get(line, 1)),
        .verdict = (int32_t)json_integer_value(json_array_get(line, 2)),
        .accepted = results_view_shared_text(reader, accepted),
        .range = study_line_of_range(line),
    };
}
