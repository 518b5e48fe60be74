/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the keys of a map: the grid of cells, and the criteria for judging them. */
#include "stability.h"

#include <math.h>
#include <string.h>

enum { MOST_HALVINGS = 40 };

static bool refuse(const study_map *map, const ff_node *where, const char *hint, const char *what)
{
    return study_context_refuse(map->context, where, hint, what);
}

static void *allocate(const study_map *map, size_t count, size_t size)
{
    return memory_arena_alloc(&map->context->arena, (count + 1) * size);
}

static bool is_range(const ff_node *axis)
{
    return ff_node_get(axis, "from");
}

/* Reads the axes, which have the form of a sweep's. */
static bool read_axes(study_map *map)
{
    const ff_node *axes = map->values[MAP_AXES].node;
    if (!study_is_map(axes) || axes->count == 0)
        return refuse(map, axes,
                      "write axes: {duty.torque: {from: 1 N m, to: 1000 N m, points: 7, "
                      "spacing: log}}",
                      "\"axes\" must be a map from paths to ranges or lists");
    map->grid = study_context_expand(map->context, axes);
    map->axis_count = axes->count;
    return map->grid;
}

static bool read_halvings(study_map *map)
{
    const ff_node *axes = map->values[MAP_AXES].node, *bisect = map->values[MAP_BISECT].node;
    map->halvings = allocate(map, axes->count, sizeof *map->halvings);
    map->log = allocate(map, axes->count, sizeof *map->log);
    for (size_t a = 0; a < axes->count; a++) {
        const char *spacing = study_word(ff_node_get(axes->items[a], "spacing"));
        const ff_node *own = study_is_map(bisect) ? ff_node_get(bisect, axes->keys[a]) : bisect;
        const char *text = study_word(own), *end = "";
        double value = 0;
        map->log[a] = is_range(axes->items[a]) && spacing && !strcmp(spacing, "log");
        if (own && (!text || !ff_number_parse(text, &value, &end) || *end || value < 0 ||
                    value != floor(value) || value > MOST_HALVINGS))
            return refuse(map, own, "write bisect: 4, or bisect: {duty.torque: 4}",
                          "\"bisect\" needs whole numbers from 0 to 40");
        map->halvings[a] = is_range(axes->items[a]) ? (size_t)value : 0;
    }
    for (size_t i = 0; study_is_map(bisect) && i < bisect->count; i++) {
        const ff_node *axis = ff_node_get(axes, bisect->keys[i]);
        if (!axis || !is_range(axis))
            return refuse(map, bisect->items[i], NULL,
                          "\"bisect\" must name an axis that has \"from\" and \"to\"");
    }
    return true;
}

static bool read_claims(study_map *map)
{
    study_context *context = map->context;
    const ff_node *estimates = map->values[MAP_ESTIMATES].node;
    if (!study_read_outputs(context, map->values[MAP_OUTPUTS].node))
        return false;
    map->claim_count = context->output_count;
    map->claims = allocate(map, map->claim_count, sizeof *map->claims);
    for (size_t i = 0; i < map->claim_count; i++)
        map->claims[i].output = context->outputs[i]->text;
    for (size_t i = 0; estimates && i < estimates->count; i++) {
        size_t k = 0;
        while (study_is_map(estimates) && k < map->claim_count &&
               strcmp(map->claims[k].output, estimates->keys[i]) != 0)
            k++;
        if (!study_is_map(estimates) || k == map->claim_count)
            return refuse(map, estimates,
                          "write estimates: {film.h_min_lowest: [film.h_min_space_error]}",
                          "\"estimates\" must be a map from outputs of this study to names");
        map->claims[k].estimates = study_read_names(map->context, estimates->items[i], "estimates",
                                                    &map->claims[k].estimate_count);
        if (!map->claims[k].estimates)
            return false;
    }
    return true;
}

static bool read_knobs(study_map *map)
{
    static const char top[] = "pipeline.";
    if (!study_read_factors(map->context, map->values[MAP_REFINE].node, &map->knobs, &map->factors,
                            &map->knob_count))
        return false;
    for (size_t k = 0; k < map->knob_count; k++)
        if (!strncmp(map->knobs[k], top, sizeof top - 1))
            map->knobs[k] += sizeof top - 1;
    return true;
}

static bool read_condition(const study_map *map, const char *text, study_condition *c)
{
    const study_comparison read = study_read_comparison(map->context, text);
    const char *end = "";
    c->name = read.name;
    c->than = read.sign;
    return strchr(c->name, '.') && !strchr(c->name, ' ') &&
           (!read.sign || (ff_number_parse(read.limit, &c->value, &end) && !*end));
}

/* Reads a list of conditions, or a map from conditions to the lines that may warn because of them.
 */
static bool read_physical(study_map *map)
{
    const ff_node *physical = map->values[MAP_PHYSICAL].node;
    size_t count = 0;
    const ff_node *const *items = physical ? study_items(&physical, &count) : NULL;
    map->physical = allocate(map, count, sizeof *map->physical);
    for (size_t i = 0; i < count; i++) {
        bool by_name = study_is_map(physical);
        const char *text = by_name ? physical->keys[i] : study_word(items[i]);
        study_condition *c = &map->physical[map->physical_count++];
        if (!read_condition(map, text ? text : "", c))
            return refuse(
                map, items[i], NULL,
                "\"physical\" must be a list of quality lines, such as motion.stability, and of "
                "conditions in SI, such as \"motion.stable_motions < 1\", or a map "
                "from them to lists of lines");
        if (by_name &&
            !(c->lines = study_read_names(map->context, items[i], "physical", &c->line_count)))
            return false;
    }
    return true;
}

static bool read_notes(study_map *map)
{
    const ff_node *notes = map->values[MAP_NOTES].node;
    map->notes = allocate(map, notes ? notes->count : 0, sizeof *map->notes);
    for (size_t i = 0; notes && (i == 0 || i < notes->count); i++) {
        study_condition *c = &map->notes[map->note_count];
        const char *words =
            study_is_map(notes) && notes->count ? study_word(notes->items[i]) : NULL;
        if (!words || !read_condition(map, notes->keys[i], c))
            return refuse(
                map, notes, "write notes: {\"motion.stable_motions > 1\": stable motions coexist}",
                "\"notes\" must be a map from quality lines and conditions in SI to words");
        c->words = words;
        map->note_count++;
    }
    return true;
}

static bool read_kinds(study_map *map)
{
    const ff_node *range = map->values[MAP_RANGE].node;
    return (!range ||
            (map->range = study_read_names(map->context, range, "range", &map->range_count))) &&
           read_physical(map) && read_notes(map);
}

/* Lists further results that cells are judged by, if a model has them, and the names whose stages
 * must exist. */
typedef struct wanted {
    const char **extras, **names;
    size_t extra_count, name_count;
} wanted;

static void add_conditions(const study_condition *list, size_t count, wanted *w)
{
    for (size_t i = 0; i < count; i++) {
        if (list[i].than)
            w->extras[w->extra_count++] = list[i].name;
        w->names[w->name_count++] = list[i].name;
        for (size_t k = 0; k < list[i].line_count; k++)
            w->names[w->name_count++] = list[i].lines[k];
    }
}

static void request_outputs(const study_map *map)
{
    study_context *context = map->context;
    size_t conditions = map->physical_count + map->note_count, most = conditions + map->range_count;
    for (size_t i = 0; i < map->claim_count; i++)
        most += map->claims[i].estimate_count;
    for (size_t i = 0; i < map->physical_count; i++)
        most += map->physical[i].line_count;
    wanted w = {.extras = allocate(map, conditions, sizeof(const char *)),
                .names = allocate(map, most, sizeof(const char *))};
    for (size_t i = 0; i < map->claim_count; i++)
        for (size_t k = 0; k < map->claims[i].estimate_count; k++)
            w.names[w.name_count++] = map->claims[i].estimates[k];
    add_conditions(map->physical, map->physical_count, &w);
    add_conditions(map->notes, map->note_count, &w);
    for (size_t i = 0; i < map->range_count; i++)
        w.names[w.name_count++] = map->range[i];
    context->extras = w.extras;
    context->extra_count = w.extra_count;
    context->names = w.names;
    context->name_count = w.name_count;
    context->knobs = map->knobs;
    context->knob_count = map->knob_count;
}

/* Sets the columns of the table: the axes, then the refined parameters that are not axes. */
static void set_columns(const study_map *map)
{
    study_context *context = map->context;
    const char **paths = allocate(map, map->axis_count + map->knob_count, sizeof *paths);
    for (size_t a = 0; a < map->axis_count; a++)
        paths[context->path_count++] = map->grid->varied[a].path;
    for (size_t k = 0; k < map->knob_count; k++) {
        size_t a = 0;
        while (a < map->axis_count && strcmp(paths[a], map->knobs[k]) != 0)
            a++;
        if (a == map->axis_count)
            paths[context->path_count++] = map->knobs[k];
    }
    context->paths = paths;
    context->refined_count = context->path_count - map->axis_count;
}

void *study_map_read(study_context *context, const study_key_value *values)
{
    study_map *map = memory_arena_alloc(&context->arena, sizeof *map);
    map->context = context;
    map->values = values;
    map->tolerance = values[MAP_TOLERANCE].value.real;
    if (!read_axes(map) || !read_halvings(map) || !read_claims(map) || !read_knobs(map) ||
        !read_kinds(map))
        return NULL;
    map->values = NULL;
    context->grid = map->grid;
    context->further = "and as many coarser twins, finer ones where those differ; then halvings";
    set_columns(map);
    request_outputs(map);
    for (size_t i = 0; i < map->grid->count; i++) {
        study_setting *settings = allocate(map, context->path_count, sizeof *settings);
        for (size_t k = 0; k < context->path_count; k++)
            settings[k] = k < map->axis_count ? (study_setting){study_assignment(map->grid, k, i),
                                                                study_value(map->grid, k, i)}
                                              : (study_setting){"", ""};
        study_submit(context, settings, 0, "", NULL);
    }
    return map;
}
