/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the user asks for, as a grid of cells and what judges them. */
#include "stability.h"

#include <math.h>

enum { MOST_HALVINGS = 40 };

static bool refuse(const study_map *map, const ff_written *where, const char *hint,
                   const char *what)
{
    map->desk->refuse(map->desk->ctx, FF_INVALID, where, hint, what);
    return false;
}

static void *room(const study_map *map, size_t count, size_t size)
{
    return map->desk->memory(map->desk->ctx, (count + 1) * size);
}

static bool is_range(const ff_written *axis)
{
    return axis->keys && study_entry(axis, "from");
}

/* The axes are those of a sweep. */
static bool read_axes(study_map *map)
{
    const ff_written *axes = map->settings[STUDY_AXES];
    if (!axes || !axes->keys || axes->count == 0)
        return refuse(map, axes,
                      "write axes: {duty.torque: {from: 1 N m, to: 1000 N m, points: 7, "
                      "spacing: log}}",
                      "\"axes\" is a map from paths to ranges or lists");
    map->grid = map->desk->expand(map->desk->ctx, axes);
    map->axis_count = axes->count;
    return map->grid;
}

static bool read_halvings(study_map *map)
{
    const ff_written *axes = map->settings[STUDY_AXES], *bisect = map->settings[STUDY_BISECT];
    map->halvings = room(map, axes->count, sizeof *map->halvings);
    map->log = room(map, axes->count, sizeof *map->log);
    for (size_t a = 0; a < axes->count; a++) {
        const ff_written *spacing = study_entry(axes->items[a], "spacing");
        const ff_written *own =
            bisect && bisect->keys ? study_entry(bisect, axes->keys[a]) : bisect;
        double value = 0;
        const char *end = "";
        map->log[a] =
            is_range(axes->items[a]) && spacing && spacing->text && !strcmp(spacing->text, "log");
        if (own && (!own->text || !study_number(own->text, &value, &end) || *end || value < 0 ||
                    value != floor(value) || value > MOST_HALVINGS))
            return refuse(map, own, "write bisect: 4, or bisect: {duty.torque: 4}",
                          "\"bisect\" wants whole numbers from 0 to 40");
        map->halvings[a] = is_range(axes->items[a]) ? (size_t)value : 0;
    }
    for (size_t i = 0; bisect && bisect->keys && i < bisect->count; i++) {
        const ff_written *axis = study_entry(axes, bisect->keys[i]);
        if (!axis || !is_range(axis))
            return refuse(map, bisect->items[i], NULL,
                          "\"bisect\" names an axis that has \"from\" and \"to\"");
    }
    return true;
}

/* The items of a list; a word is a list of one. */
static const ff_written *const *items_of(const ff_written *const *list, size_t *count)
{
    *count = (*list)->text ? 1 : (*list)->count;
    return (*list)->text ? list : (*list)->items;
}

/* NULL after an error. */
static const char **read_names(const study_map *map, const ff_written *list, const char *what,
                               size_t *count)
{
    const ff_written *const *items = items_of(&list, count);
    const char **names = room(map, *count, sizeof *names);
    for (size_t i = 0; i < *count; i++) {
        const char *text = items[i]->text ? items[i]->text : "", *dot = strchr(text, '.');
        if (list->keys || !dot || dot == text || !dot[1]) {
            refuse(
                map, list, NULL,
                study_keep(map->desk, "\"%s\" is a list of names such as film.h_min_lowest", what));
            return NULL;
        }
        names[i] = text;
    }
    return names;
}

static bool read_claims(study_map *map)
{
    const ff_written *outputs = map->settings[STUDY_OUTPUTS],
                     *estimates = map->settings[STUDY_ESTIMATES];
    if (!outputs || (!outputs->text && outputs->count == 0))
        return refuse(map, outputs, "write outputs: [film.h_min_lowest]",
                      "\"outputs\" names the scalars that must be right");
    const char **names = read_names(map, outputs, "outputs", &map->claim_count);
    if (!names)
        return false;
    map->claims = room(map, map->claim_count, sizeof *map->claims);
    for (size_t i = 0; i < map->claim_count; i++)
        map->claims[i].output = names[i];
    for (size_t i = 0; estimates && i < estimates->count; i++) {
        size_t k = 0;
        while (estimates->keys && k < map->claim_count &&
               strcmp(map->claims[k].output, estimates->keys[i]) != 0)
            k++;
        if (!estimates->keys || k == map->claim_count)
            return refuse(map, estimates,
                          "write estimates: {film.h_min_lowest: [film.h_min_space_error]}",
                          "\"estimates\" is a map from outputs of this study to names");
        map->claims[k].estimates =
            read_names(map, estimates->items[i], "estimates", &map->claims[k].estimate_count);
        if (!map->claims[k].estimates)
            return false;
    }
    return true;
}

/* A list of knobs to double, or a map from knobs to factors. */
static bool read_knobs(study_map *map)
{
    const ff_written *refine = map->settings[STUDY_REFINE];
    size_t count = refine ? refine->count : 0;
    map->knobs = room(map, count, sizeof *map->knobs);
    map->factors = room(map, count, sizeof *map->factors);
    for (size_t i = 0; i < count; i++) {
        const ff_written *item = refine->items[i];
        const char *path = refine->keys ? refine->keys[i] : item->text, *end;
        double factor = 2;
        if (!item->text || !strchr(path, '.') ||
            (refine->keys && (!study_number(item->text, &factor, &end) || *end || !(factor > 0))))
            return refuse(map, item, "write refine: [film.cells] or {motion.tolerance: 0.01}",
                          "\"refine\" is a list of parameters to double, or a map from parameters "
                          "to factors");
        map->factors[map->knob_count] = factor;
        map->knobs[map->knob_count++] = !strncmp(path, "pipeline.", 9) ? path + 9 : path;
    }
    return !refine || count > 0 ||
           refuse(map, refine, NULL, "\"refine\" names at least one parameter");
}

static bool read_condition(const study_map *map, const char *text, study_condition *c)
{
    const char *end = "";
    size_t length = strcspn(text, " <>");
    const char *at = text + length + strspn(text + length, " ");
    c->name = study_keep(map->desk, "%.*s", (int)length, text);
    c->than = *at;
    bool good = strchr(c->name, '.') != NULL;
    if (good && *at) {
        at += 1 + strspn(at + 1, " ");
        good = (c->than == '<' || c->than == '>') && study_number(at, &c->value, &end) && !*end;
    }
    return good;
}

/* A list, or a map to the lines that warn because of it. */
static bool read_physical(study_map *map)
{
    const ff_written *physical = map->settings[STUDY_PHYSICAL_ROWS];
    size_t count = 0;
    const ff_written *const *items = physical ? items_of(&physical, &count) : NULL;
    map->physical = room(map, count, sizeof *map->physical);
    for (size_t i = 0; i < count; i++) {
        const char *text = physical->keys ? physical->keys[i] : items[i]->text;
        study_condition *c = &map->physical[map->physical_count++];
        if (!read_condition(map, text ? text : "", c))
            return refuse(
                map, items[i], NULL,
                "\"physical\" is a list of lines of quality, such as motion.stability, "
                "and of conditions in SI, such as \"motion.stable_motions < 1\", or a map "
                "from them to lists of lines");
        if (physical->keys && !(c->lines = read_names(map, items[i], "physical", &c->line_count)))
            return false;
    }
    return true;
}

static bool read_notes(study_map *map)
{
    const ff_written *notes = map->settings[STUDY_NOTES];
    map->notes = room(map, notes ? notes->count : 0, sizeof *map->notes);
    for (size_t i = 0; notes && (i == 0 || i < notes->count); i++) {
        study_condition *c = &map->notes[map->note_count];
        if (!notes->keys || !notes->items[i]->text || !read_condition(map, notes->keys[i], c))
            return refuse(map, notes,
                          "write notes: {\"motion.stable_motions > 1\": stable motions coexist}",
                          "\"notes\" is a map from lines of quality and conditions in SI to words");
        c->words = notes->items[i]->text;
        map->note_count++;
    }
    return true;
}

static bool read_kinds(study_map *map)
{
    const ff_written *range = map->settings[STUDY_RANGE];
    return (!range || (map->range = read_names(map, range, "range", &map->range_count))) &&
           read_physical(map) && read_notes(map);
}

static bool read_tolerance(study_map *map)
{
    const ff_written *tolerance = map->settings[STUDY_TOLERANCE];
    map->tolerance = 0.01;
    return !tolerance || (study_share(tolerance->text, &map->tolerance) && map->tolerance > 0) ||
           refuse(map, tolerance, NULL, "\"tolerance\" is a share such as 1 %");
}

/* What judges beside the outputs, where a model has it, and names whose stages must be there. */
typedef struct wanted {
    const char **extras, **names;
    size_t extra_count, name_count;
} wanted;

static void put_conditions(const study_condition *list, size_t count, wanted *w)
{
    for (size_t i = 0; i < count; i++) {
        if (list[i].than)
            w->extras[w->extra_count++] = list[i].name;
        w->names[w->name_count++] = list[i].name;
        for (size_t k = 0; k < list[i].line_count; k++)
            w->names[w->name_count++] = list[i].lines[k];
    }
}

static void put_wanted(const study_map *map, ff_study_plan *plan)
{
    size_t conditions = map->physical_count + map->note_count, most = conditions + map->range_count;
    for (size_t i = 0; i < map->claim_count; i++)
        most += map->claims[i].estimate_count;
    for (size_t i = 0; i < map->physical_count; i++)
        most += map->physical[i].line_count;
    wanted w = {.extras = room(map, conditions, sizeof(const char *)),
                .names = room(map, most, sizeof(const char *))};
    for (size_t i = 0; i < map->claim_count; i++)
        for (size_t k = 0; k < map->claims[i].estimate_count; k++)
            w.names[w.name_count++] = map->claims[i].estimates[k];
    put_conditions(map->physical, map->physical_count, &w);
    put_conditions(map->notes, map->note_count, &w);
    for (size_t i = 0; i < map->range_count; i++)
        w.names[w.name_count++] = map->range[i];
    plan->outputs = items_of(&map->settings[STUDY_OUTPUTS], &plan->output_count);
    plan->extras = w.extras;
    plan->extra_count = w.extra_count;
    plan->names = w.names;
    plan->name_count = w.name_count;
    plan->knobs = map->knobs;
    plan->knob_count = map->knob_count;
}

/* The axes, then the knobs that are none. */
static void put_paths(const study_map *map, ff_study_plan *plan)
{
    const char **paths = room(map, map->axis_count + map->knob_count, sizeof *paths);
    memcpy(paths, map->grid->paths, map->axis_count * sizeof *paths);
    plan->path_count = map->axis_count;
    for (size_t k = 0; k < map->knob_count; k++) {
        size_t a = 0;
        while (a < map->axis_count && strcmp(paths[a], map->knobs[k]) != 0)
            a++;
        if (a == map->axis_count)
            paths[plan->path_count++] = map->knobs[k];
    }
    plan->paths = paths;
}

ff_status study_map_plan(void *self, const ff_study_desk *desk, ff_study_plan *plan)
{
    study_map *map = self;
    map->desk = desk;
    map->plan = plan;
    if (!read_axes(map) || !read_halvings(map) || !read_claims(map) || !read_knobs(map) ||
        !read_kinds(map) || !read_tolerance(map))
        return FF_INVALID;
    plan->flags = FF_STUDY_SCALARS;
    plan->grid = map->grid;
    plan->cases = "cells of the grid";
    plan->further = "and as many refined at most; then halvings";
    put_paths(map, plan);
    put_wanted(map, plan);
    for (size_t i = 0; i < map->grid->case_count; i++) {
        ff_study_point *points = room(map, plan->path_count, sizeof *points);
        for (size_t k = 0; k < plan->path_count; k++)
            points[k] = k < map->axis_count ? map->grid->points[i * map->axis_count + k]
                                            : (ff_study_point){"", ""};
        const ff_study_case one = {.size = sizeof one, .points = points, .label = ""};
        desk->ask(desk->ctx, &one);
    }
    return FF_OK;
}
