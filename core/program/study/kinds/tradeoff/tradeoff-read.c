/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the keys of a trade-off into points: levels of the reference, then candidates. */
#include "tradeoff.h"

#include <math.h>
#include <string.h>

enum { MOST_POINTS = 10000, MOST_REFINEMENTS = 20 };

static bool refuse(const study_tradeoff *t, const ff_node *where, const char *hint,
                   const char *what)
{
    return study_context_refuse(t->context, where, hint, what);
}

/* Returns the index of a knob, and adds it if it is new; STUDY_MOST_KNOBS after an error. */
static size_t find_knob(study_tradeoff *t, const char *path, const ff_node *place)
{
    size_t k = 0;
    while (k < t->knob_count && strcmp(t->knobs[k], path) != 0)
        k++;
    if (k == STUDY_MOST_KNOBS)
        refuse(t, place, NULL, "more than 64 knobs");
    else if (k == t->knob_count)
        t->knobs[t->knob_count++] = path;
    return k;
}

static study_point *add_point(study_tradeoff *t, const ff_node *place)
{
    study_context *context = t->context;
    t->points = memory_arena_grow(&context->arena, t->points, t->count, sizeof *t->points);
    study_point *p = &t->points[t->count++];
    *p = (study_point){.place = place};
    p->assignments = memory_arena_alloc(&context->arena, STUDY_MOST_KNOBS * sizeof *p->assignments);
    p->values = memory_arena_alloc(&context->arena, STUDY_MOST_KNOBS * sizeof *p->values);
    return p;
}

static bool assign_knob(study_tradeoff *t, study_point *p, const char *path, const char *assignment,
                        const char *value)
{
    size_t knob = find_knob(t, path, p->place);
    if (knob == STUDY_MOST_KNOBS)
        return false;
    p->assignments[knob] = assignment;
    p->values[knob] = value;
    return true;
}

static bool is_knob(const char *key)
{
    return strcmp(key, "refine") != 0 && strcmp(key, "refinements") != 0 &&
           strcmp(key, "name") != 0;
}

/* Returns the map without the keys that are not knobs. */
static const ff_node *knobs_of(study_context *context, const ff_node *map)
{
    ff_node *knobs = memory_arena_alloc(&context->arena, sizeof *knobs);
    size_t room = map->count + 1;
    *knobs = (ff_node){.kind = FF_MAP, .place = map->place};
    knobs->keys = memory_arena_alloc(&context->arena, room * sizeof *knobs->keys);
    knobs->items = memory_arena_alloc(&context->arena, room * sizeof *knobs->items);
    knobs->key_places = memory_arena_alloc(&context->arena, room * sizeof *knobs->key_places);
    for (size_t i = 0; i < map->count; i++) {
        if (!is_knob(map->keys[i]))
            continue;
        knobs->keys[knobs->count] = map->keys[i];
        knobs->key_places[knobs->count] = map->key_places[i];
        knobs->items[knobs->count++] = map->items[i];
    }
    return knobs;
}

/* Adds a point for every case of a map from paths to values. An empty map gives one point, the
 * unchanged file. */
static bool add_block(study_tradeoff *t, const ff_node *map)
{
    const ff_node *knobs = knobs_of(t->context, map), *name = ff_node_get(map, "name");
    const char *named = study_word(name);
    if (name && !named)
        return refuse(t, name, NULL, "\"name\" must be a text, the name of the candidate's points");
    if (knobs->count == 0) {
        add_point(t, map)->name = named;
        return true;
    }
    const study_definition *block = study_context_expand(t->context, knobs);
    if (block && t->count + block->count > MOST_POINTS)
        return refuse(t, map, NULL, "more than 10000 candidates");
    bool good = block != NULL;
    for (size_t i = 0; good && i < block->count; i++) {
        study_point *p = add_point(t, map);
        p->name = named;
        p->alone = block->count == 1;
        for (size_t k = 0; good && k < block->varied_count; k++)
            good = assign_knob(t, p, block->varied[k].path, study_assignment(block, k, i),
                               study_value(block, k, i));
    }
    return good;
}

/* Parameters that are refined from level to level, and their factors. */
typedef struct growth {
    const char **names;
    double *factors;
    size_t count;
} growth;

/* Refines a level relative to the file; level 0 is left as it is. */
static bool refine_level(study_tradeoff *t, const ff_node *map, const growth *g, size_t level)
{
    for (size_t i = 0; level > 0 && i < g->count; i++) {
        const ff_node *item = ff_node_get(map, g->names[i]);
        const char *text = study_word(item), *end;
        double number;
        if (!text || !ff_number_parse(text, &number, &end))
            return refuse(t, item, NULL, "a refined parameter must be a number");
        const char *value = study_context_format(t->context, "%.12g%s",
                                                 number * pow(g->factors[i], (double)level), end);
        if (!assign_knob(t, &t->points[t->count - 1], g->names[i],
                         study_context_format(t->context, "%s=%s", g->names[i], value), value))
            return false;
    }
    return true;
}

static bool read_growth(const study_tradeoff *t, const ff_node *map, growth *g)
{
    const ff_node *refine = ff_node_get(map, "refine");
    *g = (growth){.count = 0};
    if (refine && refine->count == 0)
        return true;
    if (!study_read_factors(t->context, refine, &g->names, &g->factors, &g->count))
        return false;
    for (size_t i = 0; i < g->count; i++)
        if (!ff_node_get(map, g->names[i]))
            return refuse(t, refine->items[i], NULL,
                          study_context_format(t->context,
                                               "the reference gives no \"%.80s\" to refine",
                                               g->names[i]));
    return true;
}

static bool read_reference(study_tradeoff *t, const ff_node *map)
{
    const ff_node *times = ff_node_get(map, "refinements");
    const char *text = study_word(times), *end = "";
    double refinements = 3;
    if (!study_is_map(map))
        return refuse(t, map, "write reference: {film.cells: 2048, refine: [film.cells]}",
                      "\"reference\" must be a map from paths to the values of the finest answer");
    if (times &&
        (!text || !ff_number_parse(text, &refinements, &end) || *end ||
         refinements != floor(refinements) || refinements < 0 || refinements > MOST_REFINEMENTS))
        return refuse(t, times, NULL, "\"refinements\" needs a whole number from 0 to 20");
    growth g;
    if (!read_growth(t, map, &g))
        return false;
    t->levels = g.count ? (size_t)refinements + 1 : 1;
    for (size_t level = 0; level < t->levels; level++)
        if (!add_block(t, map) || !refine_level(t, map, &g, level))
            return false;
        else if (t->count != level + 1)
            return refuse(t, map, NULL, "the reference is one answer: give each path one value");
    return true;
}

static bool read_candidates(study_tradeoff *t, const ff_node *list)
{
    if (!list || list->kind != FF_SEQUENCE || list->count == 0)
        return refuse(t, list,
                      "write candidates: [{film.cells: [128, 256], film.steps: [500, 1000]}]",
                      "\"candidates\" must be a list of maps from paths to lists of values");
    for (size_t i = 0; i < list->count; i++) {
        if (!study_is_map(list->items[i]))
            return refuse(t, list->items[i], NULL,
                          "a candidate must be a map from paths to lists of values");
        if (!add_block(t, list->items[i]))
            return false;
    }
    t->candidates = t->count - t->levels;
    return true;
}

/* Reads the names under a key; an empty list if it is missing. NULL after an error. */
static const char **names_of(const study_tradeoff *t, const ff_node *list, const char *key,
                             size_t *count)
{
    static const char *none[1];
    *count = 0;
    return list ? study_read_names(t->context, list, key, count) : none;
}

static bool read_measure(study_tradeoff *t, const study_key_value *values)
{
    study_context *context = t->context;
    t->counts = names_of(t, values[TRADEOFF_COUNTS].node, "counts", &t->count_count);
    const ff_node *list = values[TRADEOFF_STAGES].node;
    const ff_node *const *items = list ? study_items(&list, &context->stage_count) : NULL;
    const char **stages =
        memory_arena_alloc(&context->arena, (context->stage_count + 1) * sizeof *stages);
    for (size_t i = 0; i < context->stage_count; i++)
        if (!(stages[i] = study_word(items[i])))
            return refuse(t, list, NULL, "\"stages\" must be a list of stages");
    context->stages = stages;
    if (!t->counts || !study_read_outputs(context, values[TRADEOFF_OUTPUTS].node))
        return false;
    context->extra_count = t->count_count + context->output_count;
    const char **extras =
        memory_arena_alloc(&context->arena, (context->extra_count + 1) * sizeof *extras);
    for (size_t i = 0; i < context->extra_count; i++)
        extras[i] = i < t->count_count
                        ? t->counts[i]
                        : study_context_format(context, "%s_error",
                                               context->outputs[i - t->count_count]->text);
    context->extras = extras;
    return true;
}

/* Reads the keys with a type. */
static void read_values(study_tradeoff *t, const study_key_value *values)
{
    const char *along = values[TRADEOFF_ALONG].value.text;
    t->repeats = (size_t)values[TRADEOFF_REPEATS].value.integer;
    t->accuracy = values[TRADEOFF_ACCURACY].value.real;
    t->context->along = along ? study_context_format(t->context, "%s", along) : NULL;
}

/* Whether a point assigns a whole file or pipeline. Labels then leave out the paths, which would
 * not help. */
static bool assigns_whole_files(const study_tradeoff *t)
{
    static const char *const whole[] = {"include=", "pipeline=", "accuracy="};
    for (size_t i = 0; i < t->count; i++)
        for (size_t k = 0; k < t->knob_count; k++)
            for (size_t w = 0; t->points[i].assignments[k] && w < 3; w++)
                if (!strncmp(t->points[i].assignments[k], whole[w], strlen(whole[w])))
                    return true;
    return false;
}

/* Returns "model, cells 512" for "film.use=kind/model, film.cells=512", after the name that the
 * file gives, if any. For a single point the name alone is used. */
static const char *label_of(const study_tradeoff *t, const study_point *p, bool whole)
{
    study_line line = {0};
    if (p->name)
        study_line_add(&line, "%s", p->name);
    for (size_t k = 0; k < t->knob_count; k++) {
        const char *dot = strrchr(t->knobs[k], '.'), *word = dot ? dot + 1 : t->knobs[k];
        const char *value = p->values[k];
        if (!value || (p->name && p->alone))
            continue;
        const char *slash = strchr(value, '/');
        bool use = dot && !strcmp(word, "use") && slash;
        study_line_add(&line, "%s%s%s%s", line.used ? ", " : "", use || whole ? "" : word,
                       use || whole ? "" : " ", use ? slash + 1 : value);
    }
    return line.used ? study_context_format(t->context, "%s", line.text) : "the unchanged file";
}

size_t study_tradeoff_case(const study_tradeoff *t, size_t point, size_t repeat)
{
    bool past = point == t->count; /* the number after the last case */
    return past ? t->levels + t->candidates * t->repeats
                : point + (point < t->levels ? 0 : repeat * t->candidates);
}

/* Submits a case of a point, in the order that study_tradeoff_case expects. */
static void submit_point(const study_tradeoff *t, size_t point, size_t repeat)
{
    study_context *context = t->context;
    const study_point *p = &t->points[point];
    study_setting *settings =
        memory_arena_alloc(&context->arena, context->path_count * sizeof *settings);
    settings[0] = (study_setting){
        "", point < t->levels ? study_context_format(context, "reference %zu", point)
                              : study_context_format(context, "repeat %zu", repeat + 1)};
    for (size_t k = 0; k < t->knob_count; k++)
        settings[k + 1] = (study_setting){p->assignments[k] ? p->assignments[k] : "",
                                          p->values[k] ? p->values[k] : ""};
    study_submit(context, settings, repeat, p->label, p->place);
}

void *study_tradeoff_read(study_context *context, const study_key_value *values)
{
    study_tradeoff *t = memory_arena_alloc(&context->arena, sizeof *t);
    t->context = context;
    read_values(t, values);
    if (!read_measure(t, values) || !read_reference(t, values[TRADEOFF_REFERENCE].node) ||
        !read_candidates(t, values[TRADEOFF_CANDIDATES].node))
        return NULL;
    bool whole = assigns_whole_files(t);
    const char **paths = memory_arena_alloc(&context->arena, (t->knob_count + 1) * sizeof *paths);
    paths[0] = "measured";
    for (size_t k = 0; k < t->knob_count; k++)
        paths[k + 1] = t->knobs[k];
    context->measured = true;
    context->paths = paths;
    context->path_count = t->knob_count + 1;
    for (size_t i = 0; i < t->count; i++)
        t->points[i].label = label_of(t, &t->points[i], whole);
    for (size_t i = 0; i < t->levels; i++)
        submit_point(t, i, 0);
    for (size_t repeat = 0; repeat < t->repeats; repeat++)
        for (size_t c = 0; c < t->candidates; c++)
            submit_point(t, t->levels + c, repeat);
    context->opened = context->list.count;
    return t;
}
