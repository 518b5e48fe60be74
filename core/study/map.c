/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A map as files: map.json for programs, map.csv for tables, map.svg for people. */
#include "map.h"

#include "private.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static json_t *text_or_null(const char *text)
{
    json_t *json = text ? json_string(text) : NULL;
    return json ? json : json_null();
}

static json_t *number_or_null(double number, bool there)
{
    json_t *json = there ? json_real(number) : NULL; /* NULL for what is not finite */
    return json ? json : json_null();
}

static json_t *describe_cell(const ff_map *map, const ff_cell *cell)
{
    json_t *set = json_object();
    bool grid = cell->halved == map->study->axis_count;
    for (size_t a = 0; a < map->study->axis_count; a++)
        json_object_set_new(set, ff_map_axis(map->study, a)->path, text_or_null(cell->names[a]));
    return json_pack("{s:o, s:b, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:s, s:o}", "set", set,
                     "grid", (int)grid, "verdict", ff_class_names[cell->class], "because",
                     text_or_null(cell->line), "value", number_or_null(cell->value, cell->line),
                     "limit", number_or_null(cell->limit, cell->line), "text",
                     text_or_null(cell->why), "output", text_or_null(cell->output), "difference",
                     number_or_null(cell->difference, cell->output), "estimate",
                     number_or_null(cell->estimate, cell->output), "key", cell->key, "refined",
                     text_or_null(*cell->refined ? cell->refined : NULL));
}

static json_t *describe_boundary(const ff_map *map, const ff_boundary *b)
{
    const ff_cell *low = &map->cells[b->low], *high = &map->cells[b->high];
    const ff_cell *worse = low->class > high->class ? low : high;
    json_t *at = json_object();
    for (size_t a = 0; a < map->study->axis_count; a++)
        if (a != b->axis)
            json_object_set_new(at, ff_map_axis(map->study, a)->path, text_or_null(low->names[a]));
    return json_pack("{s:s, s:o, s:[o,o], s:[s,s], s:o, s:o}", "axis",
                     ff_map_axis(map->study, b->axis)->path, "at", at, "between",
                     text_or_null(low->names[b->axis]), text_or_null(high->names[b->axis]),
                     "verdicts", ff_class_names[low->class], ff_class_names[high->class], "because",
                     text_or_null(worse->line), "text", text_or_null(worse->why));
}

json_t *ff_map_counts(const ff_map *map)
{
    json_t *counts = json_object();
    for (size_t k = 0; k < FF_CLASSES; k++)
        json_object_set_new(
            counts, ff_class_names[k],
            json_pack("[I, I]", (json_int_t)map->counts[k], (json_int_t)map->more[k]));
    return counts;
}

static void write_json(const ff_map *map, FILE *out)
{
    json_t *cells = json_array(), *boundaries = json_array(), *axes = json_array();
    for (size_t a = 0; a < map->study->axis_count; a++) {
        const ff_varied *varied = ff_map_axis(map->study, a);
        json_t *values = json_array();
        for (size_t i = 0; i < map->study->points[a]; i++)
            json_array_append_new(values, text_or_null(ff_varied_value(varied, i)));
        json_array_append_new(axes, json_pack("{s:s, s:o, s:b}", "path", varied->path, "values",
                                              values, "log", (int)map->study->stability->log[a]));
    }
    for (size_t i = 0; i < map->count; i++)
        json_array_append_new(cells, describe_cell(map, &map->cells[i]));
    for (size_t i = 0; i < map->boundary_count; i++)
        json_array_append_new(boundaries, describe_boundary(map, &map->boundaries[i]));
    json_t *whole = json_pack("{s:o, s:o, s:o, s:o}", "axes", axes, "counts", ff_map_counts(map),
                              "boundaries", boundaries, "cells", cells);
    json_dumpf(whole, out, JSON_INDENT(1) | JSON_REAL_PRECISION(9));
    fputc('\n', out);
    json_decref(whole);
}

static void put_cell_text(FILE *out, const char *text)
{
    fputs(",\"", out);
    for (; text && *text; text++)
        fputs(*text == '"' ? "\"\"" : (char[]){*text == '\n' ? ' ' : *text, '\0'}, out);
    fputc('"', out);
}

static void put_number(FILE *out, double number, bool there)
{
    if (there)
        fprintf(out, ",%.6g", number);
    else
        fputc(',', out);
}

static void write_csv(const ff_map *map, FILE *out)
{
    for (size_t a = 0; a < map->study->axis_count; a++)
        fprintf(out, "%s,", ff_map_axis(map->study, a)->path);
    fputs("verdict,found,because,value,limit,output,difference,estimate,key,refined,text\n", out);
    for (size_t i = 0; i < map->count; i++) {
        const ff_cell *cell = &map->cells[i];
        bool grid = cell->halved == map->study->axis_count;
        for (size_t a = 0; a < map->study->axis_count; a++)
            fprintf(out, "%s,", cell->names[a]);
        fprintf(out, "%s,%s,%s", ff_class_names[cell->class], grid ? "grid" : "between",
                cell->line ? cell->line : "");
        put_number(out, cell->value, cell->line);
        put_number(out, cell->limit, cell->line);
        fprintf(out, ",%s", cell->output ? cell->output : "");
        put_number(out, cell->difference, cell->output);
        put_number(out, cell->estimate, cell->output);
        fprintf(out, ",%s,%s", cell->key, cell->refined);
        put_cell_text(out, cell->why);
        fputc('\n', out);
    }
}

static bool write_file(const ff_map *map, const char *directory, const char *name,
                       void (*put)(const ff_map *, FILE *), ff_report *report)
{
    char *path = ff_print_text("%s/%s", directory, name);
    char *part = ff_print_text("%s.part", path);
    FILE *out = fopen(part, "we");
    if (out)
        put(map, out);
    bool good = out && fflush(out) == 0 && !ferror(out);
    if (out)
        good = fclose(out) == 0 && good;
    good = good && rename(part, path) == 0;
    if (!good)
        ff_error(report, FF_EXIT_FAILED, FF_NOWHERE,
                 "the journal has all cases; the same command writes the map",
                 "%s could not be written: %s", path, strerror(errno));
    free(path);
    free(part);
    return good;
}

bool ff_map_write(const ff_map *map, const char *directory, ff_report *report)
{
    return write_file(map, directory, "map.json", write_json, report) &&
           write_file(map, directory, "map.csv", write_csv, report) &&
           write_file(map, directory, "map.svg", ff_map_svg, report);
}
