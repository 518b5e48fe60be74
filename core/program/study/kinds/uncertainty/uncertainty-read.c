/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the keys of an uncertainty study, and submits the cases that are known beforehand. */
#include "uncertainty.h"

#include "../../../memory/memory.h"
#include "../../cases/yaml.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PATHS = 256 };

/* The paths that cases assign: "sample" is a name of the case, "accuracy" makes it measure its
 * error. */
typedef struct path_list {
    const char *names[MOST_PATHS];
    size_t count;
} path_list;

static bool refuse(const study_uncertainty *u, const ff_node *where, const char *hint,
                   const char *what)
{
    return study_context_refuse(u->context, where, hint, what);
}

/* Returns the index of a path, and adds it if it is new; MOST_PATHS if there are too many. */
static size_t find_path(path_list *paths, const char *name)
{
    size_t k = 0;
    while (k < paths->count && strcmp(paths->names[k], name) != 0)
        k++;
    if (k == paths->count && k < MOST_PATHS)
        paths->names[paths->count++] = name;
    return k;
}

static bool read_outputs(study_uncertainty *u, const ff_node *list)
{
    study_context *context = u->context;
    if (!study_read_outputs(context, list))
        return false;
    const char **bars = memory_arena_alloc(&context->arena, context->output_count * sizeof *bars);
    for (size_t i = 0; i < context->output_count; i++)
        bars[i] = study_context_format(context, "%s_error_bar", context->outputs[i]->text);
    context->extra_count = context->output_count;
    context->extras = bars;
    return true;
}

static bool read_percentiles(study_uncertainty *u, const ff_node *list)
{
    static const double usual[] = {0.05, 0.5, 0.95};
    u->share_count = list ? list->count : 3;
    if (list && (list->kind != FF_SEQUENCE || list->count > UNCERTAINTY_MOST_SHARES))
        return refuse(u, list, "write percentiles: [5 %, 50 %, 95 %]",
                      "\"percentiles\" must be a list of at most 16 shares");
    for (size_t i = 0; i < u->share_count; i++) {
        double *share = &u->shares[i];
        *share = usual[list ? 0 : i];
        if ((list && !study_read_share(study_word(list->items[i]), share)) ||
            !(*share > 0 && *share < 1))
            return refuse(u, list->items[i], NULL, "a percentile must be a share such as 5 %");
    }
    return true;
}

static bool read_condition(study_uncertainty *u, const ff_node *node, uncertainty_condition *c)
{
    const study_context *context = u->context;
    const char *text = study_word(node);
    const study_comparison read = study_read_comparison(u->context, text ? text : "");
    const char sign = read.sign;
    *c = (uncertainty_condition){
        .text = text, .place = node, .above = sign == '>', .limit = read.limit};
    for (; sign && c->output < context->output_count; c->output++)
        if (!strcmp(context->outputs[c->output]->text, read.name))
            return true;
    return refuse(u, node, "write conditions: [\"film.h_min_lowest < 0.1 um\"]",
                  sign ? "a condition must be about one of the outputs of this study"
                       : "a condition must be an output, < or >, and a limit with its unit");
}

static bool read_conditions(study_uncertainty *u, const ff_node *list)
{
    size_t count = list ? list->count : 0;
    u->conditions = memory_arena_alloc(&u->context->arena, (count + 1) * sizeof *u->conditions);
    if (list && list->kind != FF_SEQUENCE)
        return refuse(u, list, "write conditions: [\"film.h_min_lowest < 0.1 um\"]",
                      "\"conditions\" must be a list");
    for (; u->condition_count < count; u->condition_count++)
        if (!read_condition(u, list->items[u->condition_count], &u->conditions[u->condition_count]))
            return false;
    return true;
}

/* Reads the cost of a level, relative to a case with the unchanged file. */
static bool read_cost(const study_uncertainty *u, const ff_node *node, uncertainty_patch *patch)
{
    return (study_read_share(study_word(node), &patch->cost) && patch->cost > 0) ||
           refuse(u, node, NULL,
                  "a cost must be relative to that of a case with the unchanged file, such as 2 %");
}

static bool read_patch(const study_uncertainty *u, const char *name, const ff_node *map,
                       bool costed, path_list *paths, uncertainty_patch *patch)
{
    size_t assigned = 0;
    *patch = (uncertainty_patch){.name = name, .place = map, .cost = (double)NAN};
    patch->assignments =
        memory_arena_alloc(&u->context->arena, MOST_PATHS * sizeof *patch->assignments);
    if (!study_is_map(map))
        return refuse(u, map, "write quick: {film.use: ehl/inlet-analysis}",
                      "expected a map from paths to values");
    for (size_t i = 0; i < map->count; i++) {
        if (costed && !strcmp(map->keys[i], "cost")) {
            if (!read_cost(u, map->items[i], patch))
                return false;
            continue;
        }
        size_t k = find_path(paths, map->keys[i]);
        if (k == MOST_PATHS)
            return refuse(u, map, NULL, "more than 256 paths");
        if (k < u->first_patch)
            return refuse(u, map->items[i], NULL,
                          study_context_format(u->context, "%.80s: it is set by an uncertain input",
                                               map->keys[i]));
        char *text = study_yaml_assignment(map->keys[i], map->items[i]);
        patch->assignments[k] = study_context_format(u->context, "%s", text);
        free(text);
        assigned++;
    }
    return assigned > 0 || refuse(u, map, NULL, "it changes nothing");
}

static bool read_patches(study_uncertainty *u, const ff_node *map, const char *key, bool costed,
                         path_list *paths, uncertainty_patch *patches, size_t most, size_t *count)
{
    if (map && (!study_is_map(map) || map->count > most - *count))
        return refuse(u, map, NULL,
                      study_context_format(u->context,
                                           "\"%s\" must be a map from at most %zu names to maps",
                                           key, most - *count));
    for (size_t i = 0; map && i < map->count; i++)
        if (!read_patch(u, map->keys[i], map->items[i], costed, paths, &patches[(*count)++]))
            return false;
    return true;
}

/* Submits the samples level by level, so that a worker can reuse its models. */
static void submit_pilot(study_uncertainty *u)
{
    double *numbers = variates_draw(&u->inputs, u->seed, u->pilot);
    u->first_pilot = u->context->list.count;
    for (size_t k = 0; k < u->level_count; k++)
        for (size_t i = 0; i < u->pilot; i++)
            study_uncertainty_submit(
                u, study_context_format(u->context, "pilot %zu, %s", i + 1, u->levels[k].name),
                numbers + i * u->inputs.count, &u->levels[k], false);
    free(numbers);
}

/* Refuses too many cases before any is made. The number that a ladder will choose is not known yet.
 */
static bool check_count(const study_uncertainty *u)
{
    size_t samples = u->level_count > 1 ? u->level_count * u->pilot : u->samples;
    size_t count = 2 + u->model_count + (samples > u->sensitivity ? samples : u->sensitivity);
    return count <= STUDY_MOST_SUBMITTED ||
           refuse(u, ff_node_get(ff_node_get(u->context->root, "study"), u->context->name), NULL,
                  "more than 1000000 cases; choose fewer samples");
}

static void submit_planned(study_uncertainty *u)
{
    u->nominal = study_uncertainty_submit(u, "medians", NULL, NULL, false);
    u->measured = study_uncertainty_submit(u, "medians, measured", NULL, NULL, true);
    u->first_model = u->context->list.count;
    for (size_t i = 0; i < u->model_count; i++)
        study_uncertainty_submit(u,
                                 study_context_format(u->context, "medians, %s", u->models[i].name),
                                 NULL, &u->models[i], false);
    if (u->level_count == 1)
        u->pilot = 0;
    submit_pilot(u);
    u->first_main = u->context->list.count;
}

/* Reads the keys with a type. */
static void read_values(study_uncertainty *u, const study_key_value *values)
{
    u->samples = (size_t)values[UNCERTAINTY_SAMPLES].value.integer;
    u->seed = (uint64_t)values[UNCERTAINTY_SEED].value.integer;
    u->pilot = (size_t)values[UNCERTAINTY_PILOT].value.integer;
    u->sensitivity = (size_t)values[UNCERTAINTY_SENSITIVITY].value.integer;
    u->aim = (estimate_aim)values[UNCERTAINTY_AIM].value.integer;
    u->levels[0] = (uncertainty_patch){.name = "the unchanged file", .cost = 1};
    u->level_count = 1;
}

void *study_uncertainty_read(study_context *context, const study_key_value *values)
{
    study_uncertainty *u = memory_arena_alloc(&context->arena, sizeof *u);
    path_list *paths = memory_arena_alloc(&context->arena, sizeof *paths);
    u->context = context;
    read_values(u, values);
    if (!read_outputs(u, values[UNCERTAINTY_OUTPUTS].node) ||
        !variates_read(&u->inputs, context, values[UNCERTAINTY_INPUTS].node,
                       values[UNCERTAINTY_CORRELATIONS].node) ||
        !read_percentiles(u, values[UNCERTAINTY_PERCENTILES].node) ||
        !read_conditions(u, values[UNCERTAINTY_CONDITIONS].node))
        return NULL;
    study_uncertainty_shapes(u);
    find_path(paths, "sample");
    for (size_t i = 0; i < u->inputs.count; i++)
        for (size_t k = 0; k < u->inputs.all[i].path_count; k++)
            if (find_path(paths, u->inputs.all[i].paths[k]) == MOST_PATHS) {
                refuse(u, values[UNCERTAINTY_INPUTS].node, NULL, "more than 256 paths");
                return NULL;
            }
    u->first_patch = paths->count;
    if (!read_patches(u, values[UNCERTAINTY_LADDER].node, "ladder", true, paths, u->levels,
                      ESTIMATE_MOST_LEVELS, &u->level_count) ||
        !read_patches(u, values[UNCERTAINTY_MODELS].node, "models", false, paths, u->models,
                      UNCERTAINTY_MOST_MODELS, &u->model_count) ||
        !check_count(u))
        return NULL;
    find_path(paths, "accuracy");
    context->paths = paths->names;
    context->path_count = paths->count;
    context->further =
        u->level_count > 1
            ? "then as many samples as the pilot shows to be worthwhile"
            : study_context_format(context, "then %zu samples",
                                   u->samples > u->sensitivity ? u->samples : u->sensitivity);
    submit_planned(u);
    context->opened = 1; /* the medians must be a valid case; a sample need not be */
    context->first_compared = u->first_model;
    context->compared_count = u->model_count;
    context->compared = memory_arena_alloc(&context->arena, (u->model_count + 1) * sizeof(char *));
    for (size_t i = 0; i < u->model_count; i++)
        context->compared[i] = u->models[i].name;
    return u;
}
