/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes a map as JSON and as a table. */
#include "stability.h"

static json_t *text_or_null(const char *text)
{
    json_t *json = text ? json_string(text) : NULL;
    return json ? json : json_null();
}

static json_t *number_or_null(double number, bool there)
{
    json_t *json = there ? json_real(number)
                         : NULL; /* json_real returns NULL for a number that is not finite */
    return json ? json : json_null();
}

/* Returns the key of a case in the journal; NULL without a case. */
static const char *key_of(const study_map *map, int64_t number)
{
    const study_outcome *answer = study_map_outcome(map, number);
    return answer ? answer->key : NULL;
}

static json_t *describe_cell(const study_map *map, const study_cell *cell)
{
    json_t *set = json_object();
    bool grid = cell->halved == map->axis_count;
    for (size_t a = 0; a < map->axis_count; a++)
        json_object_set_new(set, map->grid->varied[a].path, text_or_null(cell->settings[a].name));
    return json_pack("{s:o, s:b, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:s, s:o}", "set",
                     set, "grid", (int)grid, "verdict", study_class_names[cell->class], "because",
                     text_or_null(cell->line), "value", number_or_null(cell->value, cell->line),
                     "limit", number_or_null(cell->limit, cell->line), "text",
                     text_or_null(cell->why), "note", text_or_null(cell->note), "output",
                     text_or_null(cell->output), "difference",
                     number_or_null(cell->difference, cell->output), "estimate",
                     number_or_null(cell->estimate, cell->output), "key", key_of(map, cell->number),
                     "refined", text_or_null(key_of(map, cell->finer)));
}

static json_t *describe_boundary(const study_map *map, const study_boundary *b)
{
    const study_cell *low = &map->cells[b->low], *high = &map->cells[b->high];
    const study_cell *worse = low->class > high->class ? low : high;
    json_t *at = json_object();
    for (size_t a = 0; a < map->axis_count; a++)
        if (a != b->axis)
            json_object_set_new(at, map->grid->varied[a].path, text_or_null(low->settings[a].name));
    return json_pack("{s:s, s:o, s:[o,o], s:[s,s], s:o, s:o}", "axis",
                     map->grid->varied[b->axis].path, "at", at, "between",
                     text_or_null(low->settings[b->axis].name),
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

json_t *study_map_facts(const study_map *map)
{
    return json_pack("{s:I, s:o, s:[I, I]}", "cells", (json_int_t)map->count, "verdicts",
                     counts_of(map), "noted", (json_int_t)map->noted[0], (json_int_t)map->noted[1]);
}

void study_map_json(const study_map *map, FILE *out)
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
    json_t *whole = json_pack("{s:o, s:o, s:o, s:o}", "axes", axes, "counts", counts_of(map),
                              "boundaries", boundaries, "cells", cells);
    json_dumpf(whole, out, JSON_INDENT(1) | JSON_REAL_PRECISION(9));
    fputc('\n', out);
    json_decref(whole);
}

static void put_number(FILE *out, double number, bool there)
{
    if (there)
        fprintf(out, ",%.6g", number);
    else
        fputc(',', out);
}

void study_map_csv(const study_map *map, FILE *out)
{
    for (size_t a = 0; a < map->axis_count; a++)
        fprintf(out, "%s,", map->grid->varied[a].path);
    fputs("verdict,found,because,value,limit,output,difference,estimate,key,refined,text,note\n",
          out);
    for (size_t i = 0; i < map->count; i++) {
        const study_cell *cell = &map->cells[i];
        bool grid = cell->halved == map->axis_count;
        for (size_t a = 0; a < map->axis_count; a++)
            fprintf(out, "%s,", cell->settings[a].name);
        fprintf(out, "%s,%s,%s", study_class_names[cell->class], grid ? "grid" : "between",
                cell->line ? cell->line : "");
        put_number(out, cell->value, cell->line);
        put_number(out, cell->limit, cell->line);
        fprintf(out, ",%s", cell->output ? cell->output : "");
        put_number(out, cell->difference, cell->output);
        put_number(out, cell->estimate, cell->output);
        const char *finer = key_of(map, cell->finer);
        fprintf(out, ",%s,%s,", key_of(map, cell->number), finer ? finer : "");
        study_write_cell(out, cell->why ? cell->why : "");
        fputc(',', out);
        study_write_cell(out, cell->note ? cell->note : "");
        fputc('\n', out);
    }
}
