/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "inline-cases.h"

#include "spectrum.h"
#include "yaml.h"

#include <string.h>

bool study_listed_is(const ff_node *cases)
{
    return cases->kind == FF_SEQUENCE && cases->count > 0 && cases->items[0]->kind == FF_MAP;
}

/* Returns the column of a path, adding it if it is new. */
static study_varied *find_column(study_definition *study, const ff_node *cases, size_t row,
                                 size_t key)
{
    const char *path = cases->items[row]->keys[key];
    for (size_t k = 0; k < study->varied_count; k++)
        if (!strcmp(study->varied[k].path, path))
            return &study->varied[k];
    study_varied *v = &study->varied[study->varied_count++];
    ff_node *values = memory_arena_alloc(&study->arena, sizeof *values);
    *values = (ff_node){.kind = FF_SEQUENCE, .place = cases->place, .count = cases->count};
    values->items = memory_arena_alloc(&study->arena, cases->count * sizeof *values->items);
    v->path = path;
    v->place = cases->items[row]->key_places[key];
    v->values = values;
    v->assignments = memory_arena_alloc(&study->arena, cases->count * sizeof *v->assignments);
    for (size_t i = 0; i < cases->count; i++) {
        v->assignments[i] = "";
        values->items[i] = cases->items[i];
    }
    return v;
}

/* Returns the assignment of a value. The path of a file is made relative to the file that names
 * it. */
static char *assignment_of(const char *path, const ff_node *value)
{
    if (strcmp(path, "include") != 0 || value->kind != FF_SCALAR)
        return study_yaml_assignment(path, value);
    ff_node file = *value;
    file.text = ff_path_beside(value->place.source->directory, value->text);
    file.quoted = true;
    char *text = study_yaml_assignment(path, &file);
    ff_free(file.text);
    return text;
}

static bool check_row(study_definition *study, const ff_node *map, bool timed, bool *empty,
                      ff_report *report)
{
    const ff_node *time = ff_node_get(map, study_time_name);
    if (map->kind != FF_MAP || map->count == (time != NULL))
        return ff_error(report, FF_FAULT_INPUT, map->place,
                        "write - {duty.torque: 250 N m, duty.speed: 1500 rpm}",
                        "study: cases: expected a map from paths to values");
    if (timed != (time != NULL))
        return ff_error(report, FF_FAULT_INPUT, map->place, NULL,
                        "study: cases: either all rows have a time or none");
    return !time || study_spectrum_add(study, time->kind == FF_SCALAR ? time->text : "",
                                       time->place, empty, report);
}

static void read_row(study_definition *study, const ff_node *cases, size_t row)
{
    const ff_node *map = cases->items[row], *time = ff_node_get(map, study_time_name);
    for (size_t i = 0; i < map->count; i++) {
        if (map->items[i] == time || !strncmp(map->keys[i], "x-", 2))
            continue;
        study_varied *v = find_column(study, cases, row, i);
        v->assignments[row] =
            memory_arena_take(&study->arena, assignment_of(map->keys[i], map->items[i]));
        v->values->items[row] = map->items[i];
    }
}

bool study_listed_read(study_definition *study, const ff_node *cases, ff_report *report)
{
    size_t errors = ff_report_errors(report), paths = 0;
    bool timed = ff_node_get(cases->items[0], study_time_name) != NULL;
    for (size_t i = 0; i < cases->count; i++)
        paths += cases->items[i]->kind == FF_MAP ? cases->items[i]->count : 0;
    study->varied = memory_arena_alloc(&study->arena, (paths + 1) * sizeof *study->varied);
    study->points = memory_arena_alloc(&study->arena, sizeof *study->points);
    study->axis_count = study->followed = study->direction = 1;
    ff_node rows = *cases; /* a temporary copy */
    rows.items = memory_arena_alloc(&study->arena, cases->count * sizeof *rows.items);
    rows.count = 0;
    for (size_t i = 0; i < cases->count; i++) {
        bool empty = false;
        if (check_row(study, cases->items[i], timed, &empty, report) && !empty)
            rows.items[rows.count++] = cases->items[i];
    }
    study->points[0] = study->count = rows.count;
    for (size_t i = 0; i < rows.count; i++)
        read_row(study, &rows, i);
    if (ff_report_errors(report) == errors && rows.count == 0)
        ff_error(report, FF_FAULT_INPUT, cases->place, NULL,
                 "study: cases: all rows have the time 0");
    else if (ff_report_errors(report) == errors && study->varied_count == 0)
        ff_error(report, FF_FAULT_INPUT, cases->place, NULL,
                 "study: cases: no row names a path of the pipeline");
    return ff_report_errors(report) == errors;
}
