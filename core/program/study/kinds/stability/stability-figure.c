/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Describes a map: a figure for each slice. Cells have colours that the colour-blind tell apart
   (Okabe & Ito 2008), and a letter for print without colour. */
#include "stability.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ROWS = 60 }; /* of the table of reasons */

/* The colours are light enough for a black letter. */
static const char *const colours[STUDY_CLASSES] = {"#009e73", "#56b4e9", "#cc79a7", "#f0f0f0",
                                                   "#f0e442", "#ffffff", "#d55e00", "#999999"};

static json_t *classes(void)
{
    json_t *list = json_array();
    for (size_t k = 0; k < STUDY_CLASSES; k++)
        json_array_append_new(list, json_pack("{s:s, s:s, s:s, s:s}", "name", study_class_names[k],
                                              "text", study_class_texts[k], "colour", colours[k],
                                              "letter", (char[]){study_class_letters[k], '\0'}));
    return list;
}

/* Returns "1.77827941004 m/s" with four digits and without its unit. */
static json_t *number_of(const char *text)
{
    double number;
    char rounded[32];
    const char *end;
    if (!ff_number_parse(text, &number, &end))
        return json_string(text);
    snprintf(rounded, sizeof rounded, "%.4g", number);
    return json_real(strtod(rounded, NULL));
}

static json_t *side(const study_map *map, size_t axis, size_t points)
{
    double number;
    const char *end = "";
    json_t *at = json_array();
    char label[200] = "";
    if (axis < map->axis_count) {
        bool known = ff_number_parse(study_map_value(map, axis, 0), &number, &end);
        const char *unit = known ? end + strspn(end, " ") : "";
        const char *path = map->grid->varied[axis].path, *dot = strrchr(path, '.');
        snprintf(label, sizeof label, *unit ? "%.150s (%.40s)" : "%.150s", dot ? dot + 1 : path,
                 unit);
        for (char *at_space = strchr(label, '_'); at_space; at_space = strchr(at_space, '_'))
            *at_space = ' ';
    }
    for (size_t i = 0; i < points; i++)
        json_array_append_new(at, axis < map->axis_count ? number_of(study_map_value(map, axis, i))
                                                         : json_string(""));
    return json_pack("{s:s, s:o}", "label", label, "at", at);
}

static json_t *reason(const study_cell *cell)
{
    char text[600], value[32];
    snprintf(value, sizeof value, isfinite(cell->value) ? "%.4g" : "not known", cell->value);
    int length = snprintf(text, sizeof text, "%s", study_class_names[cell->class]);
    if (cell->line)
        length += snprintf(text + length, sizeof text - (size_t)length,
                           "; %.150s = %s, held to %.4g", cell->line, value, cell->limit);
    if (cell->why)
        length += snprintf(text + length, sizeof text - (size_t)length, "; %.150s", cell->why);
    if (cell->note)
        snprintf(text + length, sizeof text - (size_t)length, "; %.100s", cell->note);
    json_t *json = json_string(text);
    return json ? json : json_string(study_class_names[cell->class]);
}

/* Returns where a cell between two points lies, in steps of the axis from its first point. */
static double position(const study_map *map, size_t axis, const study_cell *cell)
{
    size_t points = map->grid->points[axis];
    double first, last, at = cell->at[axis];
    const char *end;
    ff_number_parse(study_map_value(map, axis, 0), &first, &end);
    ff_number_parse(study_map_value(map, axis, points - 1), &last, &end);
    double share =
        map->log[axis] ? log10(at / first) / log10(last / first) : (at - first) / (last - first);
    return share * (double)(points - 1) + 0.5;
}

/* The boundaries of a slice, each a line across a cell where the halvings found it. */
static json_t *edges_of(const study_map *map, size_t slice)
{
    json_t *edges = json_array();
    for (size_t i = 0; i < map->boundary_count; i++) {
        const study_boundary *b = &map->boundaries[i];
        if (b->slice != slice || b->axis > 1)
            continue;
        double place = (position(map, b->axis, &map->cells[b->low]) +
                        position(map, b->axis, &map->cells[b->high])) /
                       2;
        double x = (double)b->column, y = (double)b->row;
        json_array_append_new(edges, b->axis == 0
                                         ? json_pack("[f, f, f, f]", place, y, place, y + 1)
                                         : json_pack("[f, f, f, f]", x, place, x + 1, place));
    }
    return edges;
}

/* Adds the cells of a slice, and a row of the table for each that is not converged. */
static void add_cells(const study_map *map, size_t slice, json_t *cells, json_t *reasons,
                      json_t *rows)
{
    for (size_t r = 0; r < study_map_rows(map); r++)
        for (size_t c = 0; c < study_map_columns(map); c++) {
            const study_cell *cell = &map->cells[study_map_cell(map, slice, c, r)];
            json_t *words = reason(cell);
            json_array_append_new(cells, json_integer(cell->class));
            json_array_append(reasons, words);
            if ((cell->class != STUDY_CONVERGED || cell->note) && json_array_size(rows) < MOST_ROWS)
                json_array_append_new(
                    rows, json_pack("{s:o, s:o, s:O}", "y",
                                    map->axis_count > 1 ? number_of(study_map_value(map, 1, r))
                                                        : json_string(""),
                                    "x", number_of(study_map_value(map, 0, c)), "reason", words));
            json_decref(words);
        }
}

static const char *label_of(const study_map *map, const json_t *of)
{
    return study_context_format(map->context, "%s", study_text_of(of, "label"));
}

void study_map_draw(const study_map *map, size_t slice, study_answer *answer)
{
    json_t *cells = json_array(), *reasons = json_array(), *rows = json_array();
    size_t columns = study_map_columns(map), rank = study_map_rows(map);
    char title[400] = "";
    size_t length = 0;
    for (size_t a = 2; a < map->axis_count; a++)
        length +=
            (size_t)snprintf(title + length, sizeof title - length, "%s%.60s", a > 2 ? ", " : "",
                             map->cells[study_map_cell(map, slice, 0, 0)].settings[a].name);
    add_cells(map, slice, cells, reasons, rows);
    json_t *x = side(map, 0, columns), *y = side(map, 1, rank);
    int height = (int)(rank < 5    ? 230 /* the name of the rows is as long as they are high */
                       : rank < 8  ? 34 * rank + 70
                       : rank < 20 ? 22 * rank + 60
                                   : 440);
    study_column *all = memory_arena_alloc(&map->context->arena, 3 * sizeof *all);
    all[0] = (study_column){.of = {"y"}, .head = label_of(map, y)};
    all[1] = (study_column){.of = {"x"}, .head = label_of(map, x)};
    all[2] = (study_column){.of = {"reason"}, .head = "verdict and reason"};
    json_t *figure = json_pack("{s:s, s:s, s:i, s:o, s:o, s:o, s:o, s:o, s:o}", "sort", "classes",
                               "title", *title ? title : "Where the pipeline can be trusted",
                               "height", height, "x", x, "y", y, "classes", classes(), "cells",
                               cells, "reasons", reasons, "edges", edges_of(map, slice));
    study_answer_add(answer, &(study_table){.title = "the cells that are not converged, and why",
                                            .columns = all,
                                            .column_count = 3,
                                            .rows = rows,
                                            .folded = true,
                                            .forms = STUDY_ON_PAGE,
                                            .figure = study_answer_draw(answer, figure)});
}
