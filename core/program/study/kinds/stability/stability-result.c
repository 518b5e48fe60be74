/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes the result of a map, its tables and its drawings. */
#include "stability.h"

#include <string.h>

enum {
    MOST_BOUNDARIES = 40, /* boundaries shown for each axis */
    MOST_ROWS = 60        /* cells listed for each slice */
};

static json_t *text_or_null(const char *text)
{
    json_t *json = text ? json_string(text) : NULL;
    return json ? json : json_null();
}

static json_t *number_or_null(double number, bool there)
{
    return there ? study_json_real(number) : json_null();
}

/* Returns the key of a case in the journal; NULL if there is no case. */
static const char *key_of(const study_map *map, int64_t number)
{
    const study_outcome *answer = study_map_outcome(map, number);
    return answer ? answer->key : NULL;
}

/* Returns {path: value} for all axes of a cell but one; `shortened`: with numbers as in
 * study_map_short. */
static json_t *place_of(const study_map *map, const study_cell *cell, size_t without,
                        bool shortened)
{
    json_t *at = json_object();
    for (size_t a = 0; a < map->axis_count; a++) {
        const char *name = cell->settings[a].name;
        if (a != without)
            json_object_set_new(at, map->grid->varied[a].path,
                                text_or_null(shortened ? study_map_short(map, name) : name));
    }
    return at;
}

static json_t *describe_cell(const study_map *map, const study_cell *cell)
{
    bool grid = cell->halved == map->axis_count;
    return json_pack("{s:o, s:b, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:s, s:o}", "set",
                     place_of(map, cell, map->axis_count, false), "grid", (int)grid, "verdict",
                     study_class_names[cell->class], "because", text_or_null(cell->line), "value",
                     number_or_null(cell->value, cell->line), "limit",
                     number_or_null(cell->limit, cell->line), "text", text_or_null(cell->why),
                     "note", text_or_null(cell->note), "output", text_or_null(cell->output),
                     "difference", number_or_null(cell->difference, cell->output), "estimate",
                     number_or_null(cell->estimate, cell->output), "key", key_of(map, cell->number),
                     "twin", text_or_null(key_of(map, cell->twin)));
}

static json_t *describe_boundary(const study_map *map, const study_boundary *b)
{
    const study_cell *low = &map->cells[b->low], *high = &map->cells[b->high];
    const study_cell *worse = low->class > high->class ? low : high;
    return json_pack("{s:s, s:o, s:[o,o], s:[s,s], s:o, s:o}", "axis",
                     map->grid->varied[b->axis].path, "at", place_of(map, low, b->axis, false),
                     "between", text_or_null(low->settings[b->axis].name),
                     text_or_null(high->settings[b->axis].name), "verdicts",
                     study_class_names[low->class], study_class_names[high->class], "because",
                     text_or_null(worse->line), "text", text_or_null(worse->why));
}

/* Returns {verdict: [cells of the grid, cells between]}. */
static json_t *counts_of(const study_map *map)
{
    json_t *counts = json_object();
    for (size_t k = 0; k < STUDY_CLASSES; k++)
        json_object_set_new(
            counts, study_class_names[k],
            json_pack("[I, I]", (json_int_t)map->counts[k], (json_int_t)map->more[k]));
    return counts;
}

static json_t *facts_of(const study_map *map)
{
    return json_pack("{s:I, s:o, s:[I, I]}", "cells", (json_int_t)map->count, "verdicts",
                     counts_of(map), "noted", (json_int_t)map->noted[0], (json_int_t)map->noted[1]);
}

static json_t *value_of(const study_map *map)
{
    json_t *cells = json_array(), *boundaries = json_array(), *axes = json_array();
    for (size_t a = 0; a < map->axis_count; a++) {
        json_t *values = json_array();
        for (size_t i = 0; i < map->grid->points[a]; i++)
            json_array_append_new(values, text_or_null(study_map_value(map, a, i)));
        json_array_append_new(axes, json_pack("{s:s, s:o, s:b}", "path", map->grid->varied[a].path,
                                              "values", values, "log", (int)map->log[a]));
    }
    for (size_t i = 0; i < map->count; i++)
        json_array_append_new(cells, describe_cell(map, &map->cells[i]));
    for (size_t i = 0; i < map->boundary_count; i++)
        json_array_append_new(boundaries, describe_boundary(map, &map->boundaries[i]));
    return json_pack("{s:o, s:o, s:o, s:o}", "axes", axes, "counts", counts_of(map), "boundaries",
                     boundaries, "cells", cells);
}

static void add_file(const study_map *map, study_answer *answer)
{
    static const study_column rest[] = {
        {.of = {"verdict"}, .name = "verdict"},
        {.of = {"grid"}, .name = "found", .words = {"between", "grid"}},
        {.of = {"because"}, .name = "because"},
        {.of = {"value"}, .name = "value"},
        {.of = {"limit"}, .name = "limit"},
        {.of = {"output"}, .name = "output"},
        {.of = {"difference"}, .name = "difference"},
        {.of = {"estimate"}, .name = "estimate"},
        {.of = {"key"}, .name = "key"},
        {.of = {"twin"}, .name = "twin"},
        {.of = {"text"}, .name = "text", .quoted = true},
        {.of = {"note"}, .name = "note", .quoted = true},
    };
    const size_t more = sizeof rest / sizeof *rest;
    study_column *columns =
        memory_arena_alloc(&map->context->arena, (map->axis_count + more) * sizeof *columns);
    for (size_t a = 0; a < map->axis_count; a++)
        columns[a] = (study_column){.of = {"set", map->grid->varied[a].path},
                                    .name = map->grid->varied[a].path};
    memcpy(columns + map->axis_count, rest, sizeof rest);
    study_answer_add(answer,
                     &(study_table){.columns = columns,
                                    .column_count = map->axis_count + more,
                                    .rows = json_incref(json_object_get(answer->value, "cells")),
                                    .forms = STUDY_IN_FILE});
}

/* Returns a row of the table of boundaries: "2.976 m/s converged", "3.025 m/s failed", the position
 * on the other axes, and the line or output that decides the worse of both cells. */
static json_t *boundary_row(const study_map *map, const study_boundary *b)
{
    const study_cell *low = &map->cells[b->low], *high = &map->cells[b->high];
    const study_cell *worse = low->class > high->class ? low : high;
    return json_pack(
        "{s:s++, s:s++, s:o, s:o}", "low", study_map_short(map, low->settings[b->axis].name), " ",
        study_class_names[low->class], "high", study_map_short(map, high->settings[b->axis].name),
        " ", study_class_names[high->class], "at", place_of(map, low, b->axis, true), "because",
        text_or_null(worse->line));
}

static void add_boundaries(const study_map *map, study_answer *answer, size_t axis)
{
    const char *path = map->grid->varied[axis].path;
    json_t *rows = json_array();
    size_t count = 0, columns = 0;
    study_column *all =
        memory_arena_alloc(&map->context->arena, (map->axis_count + 3) * sizeof *all);
    all[columns++] = (study_column){.of = {"low"}, .head = "from", .width = -1};
    all[columns++] = (study_column){.of = {"high"}, .head = "to", .width = -1, .before = " | "};
    for (size_t a = 0; a < map->axis_count; a++)
        if (a != axis)
            all[columns++] = (study_column){.of = {"at", map->grid->varied[a].path},
                                            .head = map->grid->varied[a].path,
                                            .width = -1};
    all[columns++] = (study_column){.of = {"because"}, .head = "because of"};
    for (size_t i = 0; i < map->boundary_count; i++)
        if (map->boundaries[i].axis == axis && count++ < MOST_BOUNDARIES)
            json_array_append_new(rows, boundary_row(map, &map->boundaries[i]));
    if (count)
        study_context_print_line(map->context, 0, "");
    study_answer_add(answer, &(study_table){.title = study_context_format(
                                                map->context, "boundaries along %s:", path),
                                            .columns = all,
                                            .column_count = columns,
                                            .rows = rows,
                                            .indent = 2,
                                            .whole = true,
                                            .folded = true,
                                            .forms = STUDY_ON_TERMINAL | STUDY_ON_PAGE});
    if (count > MOST_BOUNDARIES)
        study_answer_say(answer, STUDY_ON_TERMINAL | STUDY_ON_PAGE, 0,
                         "  ... and %zu more along %s, see map.json", count - MOST_BOUNDARIES,
                         path);
}

/* Adds the cells of a slice that are not converged, with the reasons. */
static void add_cells(const study_map *map, size_t slice, study_answer *answer, json_t *figure)
{
    static const study_column why[] = {
        {.of = {"verdict"}, .head = "verdict"}, {.of = {"because"}, .head = "because of"},
        {.of = {"value"}, .head = "value"},     {.of = {"limit"}, .head = "limit"},
        {.of = {"text"}, .head = "reason"},     {.of = {"note"}, .head = "note"}};
    const size_t sides = map->axis_count > 1 ? 2 : 1, more = sizeof why / sizeof *why;
    study_column *columns =
        memory_arena_alloc(&map->context->arena, (sides + more) * sizeof *columns);
    json_t *rows = json_array();
    size_t count = 0;
    for (size_t a = 0; a < sides; a++)
        columns[a] = (study_column){.of = {"at", map->grid->varied[sides - 1 - a].path},
                                    .head = map->grid->varied[sides - 1 - a].path};
    memcpy(columns + sides, why, sizeof why);
    for (size_t r = 0; r < study_map_rows(map); r++)
        for (size_t c = 0; c < study_map_columns(map); c++) {
            const study_cell *cell = &map->cells[study_map_cell(map, slice, c, r)];
            if ((cell->class == STUDY_CONVERGED && !cell->note) || count++ >= MOST_ROWS)
                continue;
            json_t *row = describe_cell(map, cell);
            json_object_set_new(row, "at", place_of(map, cell, map->axis_count, true));
            json_array_append_new(rows, row);
        }
    study_answer_add(
        answer, &(study_table){
                    .title = count > MOST_ROWS
                                 ? study_context_format(map->context,
                                                        "the first %d of the %zu cells that are "
                                                        "not converged, and why; map.csv has all",
                                                        MOST_ROWS, count)
                                 : "the cells that are not converged, and why",
                    .columns = columns,
                    .column_count = sides + more,
                    .rows = rows,
                    .folded = true,
                    .forms = STUDY_ON_PAGE,
                    .figure = figure});
}

/* Returns the cells of a slice for the page's figure: their classes, and the reasons of those that
 * are not converged. */
static json_t *cells_of(const study_map *map, size_t slice)
{
    json_t *cells = json_array();
    for (size_t r = 0; r < study_map_rows(map); r++)
        for (size_t c = 0; c < study_map_columns(map); c++) {
            const study_cell *cell = &map->cells[study_map_cell(map, slice, c, r)];
            json_array_append_new(
                cells,
                cell->class == STUDY_CONVERGED && !cell->note
                    ? json_pack("[i]", (int)cell->class)
                    : json_pack("[i, o, o, o, o, o]", (int)cell->class, text_or_null(cell->line),
                                study_json_real(cell->value), study_json_real(cell->limit),
                                text_or_null(cell->why), text_or_null(cell->note)));
        }
    return cells;
}

/* Returns the boundaries of a slice: axis, column and row, and the two values between which each
 * lies. */
static json_t *boundaries_of(const study_map *map, size_t slice)
{
    json_t *list = json_array();
    for (size_t i = 0; i < map->boundary_count; i++) {
        const study_boundary *b = &map->boundaries[i];
        if (b->slice == slice && b->axis < 2)
            json_array_append_new(list, json_pack("[I, I, I, f, f]", (json_int_t)b->axis,
                                                  (json_int_t)b->column, (json_int_t)b->row,
                                                  map->cells[b->low].at[b->axis],
                                                  map->cells[b->high].at[b->axis]));
    }
    return list;
}

static json_t *draw(const study_map *map, size_t slice, study_answer *answer)
{
    const study_setting *settings = map->cells[study_map_cell(map, slice, 0, 0)].settings;
    const char *title = NULL;
    json_t *axes = json_array(), *classes = json_array();
    for (size_t a = 0; a < map->axis_count; a++)
        if (a < 2)
            json_array_append(axes, json_array_get(json_object_get(answer->value, "axes"), a));
        else
            title = study_context_format(map->context, title ? "%s, %s" : "%s%s",
                                         title ? title : "", settings[a].name);
    for (size_t k = 0; k < STUDY_CLASSES; k++)
        json_array_append_new(classes, json_pack("{s:s, s:s, s:s%}", "name", study_class_names[k],
                                                 "text", study_class_texts[k], "letter",
                                                 &study_class_letters[k], (size_t)1));
    return study_answer_draw(answer,
                             json_pack("{s:s, s:s, s:o, s:o, s:o, s:o}", "sort", "trust", "title",
                                       title ? title : "Where the pipeline can be trusted", "axes",
                                       axes, "classes", classes, "cells", cells_of(map, slice),
                                       "boundaries", boundaries_of(map, slice)));
}

void study_map_reduce(void *study, study_answer *answer)
{
    const study_map *map = study;
    answer->value = value_of(map);
    answer->digits = 9;
    answer->facts = facts_of(map);
    study_map_print(map);
    add_file(map, answer);
    for (size_t a = 0; a < map->axis_count; a++)
        add_boundaries(map, answer, a);
    for (size_t i = 0; i < study_map_slices(map); i++)
        add_cells(map, i, answer, draw(map, i, answer));
    study_context_print_line(map->context, 0, "");
    /* finding failed cells is the purpose of a map, so only silent failures make it bad */
    map->context->verdict = map->counts[STUDY_SILENT] + map->more[STUDY_SILENT] ? FF_BAD : FF_GOOD;
}
