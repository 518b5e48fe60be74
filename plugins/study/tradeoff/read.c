/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the user asks for, as points: levels of the reference, then candidates. */
#include "tradeoff.h"

#include <math.h>

enum { MOST_POINTS = 10000, MOST_REFINEMENTS = 20 };

static bool refuse(const study_tradeoff *t, const ff_written *where, const char *hint,
                   const char *what)
{
    t->desk->refuse(t->desk->ctx, FF_INVALID, where, hint, what);
    return false;
}

/* Number of a knob, a new one at need; STUDY_MOST_KNOBS after an error. */
static size_t find_knob(study_tradeoff *t, const char *path, const ff_written *place)
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

static study_point *add_point(study_tradeoff *t, const ff_written *place)
{
    const ff_study_desk *desk = t->desk;
    if ((t->count & (t->count - 1)) == 0) {
        size_t room = t->count ? 2 * t->count : 1;
        study_point *more = desk->memory(desk->ctx, room * sizeof *more);
        if (t->count)
            memcpy(more, t->points, t->count * sizeof *more);
        t->points = more;
    }
    study_point *p = &t->points[t->count++];
    *p = (study_point){.place = place};
    p->assignments = desk->memory(desk->ctx, STUDY_MOST_KNOBS * sizeof *p->assignments);
    p->values = desk->memory(desk->ctx, STUDY_MOST_KNOBS * sizeof *p->values);
    return p;
}

static bool assign(study_tradeoff *t, study_point *p, const char *path, const char *assignment,
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
    return strcmp(key, "refine") != 0 && strcmp(key, "refinements") != 0;
}

/* Every case of a map from paths to values is a point; an empty map is the file as it stands. */
static bool add_block(study_tradeoff *t, const ff_written *map)
{
    const ff_study_desk *desk = t->desk;
    const char **keys = desk->memory(desk->ctx, (map->count + 1) * sizeof *keys);
    const ff_written **items = desk->memory(desk->ctx, (map->count + 1) * sizeof *items);
    ff_written knobs = {.size = sizeof knobs, .keys = keys, .items = items, .place = map->place};
    for (size_t i = 0; i < map->count; i++)
        if (is_knob(map->keys[i])) {
            keys[knobs.count] = map->keys[i];
            items[knobs.count++] = map->items[i];
        }
    if (knobs.count == 0)
        return add_point(t, map);
    const ff_study_block *block = desk->expand(desk->ctx, &knobs);
    if (block && t->count + block->case_count > MOST_POINTS)
        return refuse(t, map, NULL, "more than 10000 candidates");
    bool good = block != NULL;
    for (size_t i = 0; good && i < block->case_count; i++) {
        study_point *p = add_point(t, map);
        const ff_study_point *points = block->points + i * block->path_count;
        for (size_t k = 0; good && k < block->path_count; k++)
            good = assign(t, p, block->paths[k], points[k].assignment, points[k].name);
    }
    return good;
}

/* How many times as large a knob gets from level to level: 2, or what a map says. */
static bool find_factor(const study_tradeoff *t, const ff_written *refine, const char *path,
                        double *factor)
{
    const char *end;
    *factor = 1;
    for (size_t i = 0; refine && i < refine->count; i++) {
        const ff_written *item = refine->items[i];
        const char *name = refine->keys ? refine->keys[i] : item->text;
        if (!item->text)
            return refuse(
                t, item, NULL,
                "\"refine\" is a list of knobs to double, or a map from knobs to factors");
        if (strcmp(name, path) != 0)
            continue;
        *factor = 2;
        if (refine->keys && (!study_number(item->text, factor, &end) || *end || !(*factor > 0)))
            return refuse(t, item, NULL, "a factor of \"refine\" is a positive number");
    }
    return true;
}

/* Level 0 assigns what the file says; further ones are finer. */
static bool refine_level(study_tradeoff *t, const ff_written *map, const ff_written *refine,
                         size_t level)
{
    for (size_t i = 0; i < map->count; i++) {
        const char *path = map->keys[i], *end;
        double factor, number;
        if (!is_knob(path))
            continue;
        if (!find_factor(t, refine, path, &factor))
            return false;
        if (factor == 1 || level == 0)
            continue;
        if (!map->items[i]->text || !study_number(map->items[i]->text, &number, &end))
            return refuse(t, map->items[i], NULL, "what is refined must be a number");
        const char *value =
            study_keep(t->desk, "%.12g%s", number * pow(factor, (double)level), end);
        if (!assign(t, &t->points[t->count - 1], path, study_keep(t->desk, "%s=%s", path, value),
                    value))
            return false;
    }
    return true;
}

static bool check_refine(const study_tradeoff *t, const ff_written *map, const ff_written *refine)
{
    for (size_t i = 0; refine && i < refine->count; i++) {
        const char *name = refine->keys ? refine->keys[i] : refine->items[i]->text;
        if (!study_entry(map, name ? name : ""))
            return refuse(t, refine->items[i], NULL,
                          study_keep(t->desk,
                                     "the reference gives no \"%.80s\" that could be refined",
                                     name ? name : ""));
    }
    return true;
}

static bool read_reference(study_tradeoff *t)
{
    const ff_written *map = t->settings[STUDY_REFERENCE], *refine = study_entry(map, "refine");
    const ff_written *times = study_entry(map, "refinements");
    double refinements = 3;
    const char *end = "";
    if (!map || !map->keys)
        return refuse(t, map, "write reference: {film.cells: 2048, refine: [film.cells]}",
                      "\"reference\" is a map from paths to the values of the finest answer");
    if (times &&
        (!times->text || !study_number(times->text, &refinements, &end) || *end ||
         refinements != floor(refinements) || refinements < 0 || refinements > MOST_REFINEMENTS))
        return refuse(t, times, NULL, "\"refinements\" wants a whole number from 0 to 20");
    if (!check_refine(t, map, refine))
        return false;
    t->levels = refine && refine->count ? (size_t)refinements + 1 : 1;
    for (size_t level = 0; level < t->levels; level++)
        if (!add_block(t, map) || !refine_level(t, map, refine, level))
            return false;
        else if (t->count != level + 1)
            return refuse(t, map, NULL, "the reference is one answer: give one value each");
    return true;
}

static bool read_candidates(study_tradeoff *t)
{
    const ff_written *list = t->settings[STUDY_CANDIDATES];
    if (!list || list->keys || list->text || list->count == 0)
        return refuse(t, list,
                      "write candidates: [{film.cells: [128, 256], film.steps: [500, 1000]}]",
                      "\"candidates\" is a list of maps from paths to lists of values");
    for (size_t i = 0; i < list->count; i++) {
        if (!list->items[i]->keys)
            return refuse(t, list->items[i], NULL,
                          "a candidate is a map from paths to lists of values");
        if (!add_block(t, list->items[i]))
            return false;
    }
    t->candidates = t->count - t->levels;
    return true;
}

/* A list of texts, NULL behind the last; NULL after an error. Without a list an empty one. */
static const char **read_texts(const study_tradeoff *t, const ff_written *list, const char *what,
                               size_t *count)
{
    size_t length = list ? list->count : 0;
    const char **texts = t->desk->memory(t->desk->ctx, (length + 1) * sizeof *texts);
    bool good = !list || (!list->text && !list->keys);
    for (size_t i = 0; good && i < length; i++) {
        texts[i] = list->items[i]->text;
        good = texts[i] && *texts[i];
    }
    *count = length;
    if (!good)
        refuse(t, list, NULL, what);
    return good ? texts : NULL;
}

static bool read_claims(study_tradeoff *t, const ff_study_plan *plan)
{
    static const char *const none[] = {NULL};
    const ff_written *map = t->settings[STUDY_ESTIMATES];
    const char *const **claims =
        t->desk->memory(t->desk->ctx, (plan->output_count + 1) * sizeof *claims);
    t->claims = claims;
    if (map && map->text && !strcmp(map->text, "none")) {
        for (size_t k = 0; k < plan->output_count; k++)
            claims[k] = none;
        return true;
    }
    if (map && !map->keys)
        return refuse(t, map, NULL,
                      "\"estimates\" is a map from outputs to lists of names, or none");
    for (size_t i = 0; map && i < map->count; i++) {
        size_t k = 0, count;
        while (k < plan->output_count && strcmp(plan->outputs[k]->text, map->keys[i]) != 0)
            k++;
        if (k == plan->output_count)
            return refuse(
                t, map->items[i], NULL,
                "\"estimates\" is a map from outputs of this trade-off to lists of names");
        claims[k] = read_texts(t, map->items[i],
                               "the estimates of an output are a list of names such as "
                               "[h_min_space_error, h_min_time_error]",
                               &count);
        if (!claims[k])
            return false;
    }
    return true;
}

static bool read_measure(study_tradeoff *t, ff_study_plan *plan)
{
    const ff_written *outputs = t->settings[STUDY_OUTPUTS];
    size_t count;
    if (!outputs || outputs->text || outputs->keys || outputs->count == 0)
        return refuse(t, outputs, NULL,
                      "\"outputs\" is a list of the outputs that matter, such as [film.h_min]");
    if (!read_texts(t, outputs, "\"outputs\" is a list of STAGE.OUTPUT", &count))
        return false;
    for (size_t i = 0; i < outputs->count; i++)
        if (strchr(outputs->items[i]->text, '*'))
            return refuse(t, outputs->items[i], NULL, "name each output that matters");
    plan->outputs = outputs->items;
    plan->output_count = outputs->count;
    plan->along = t->along;
    t->counts = read_texts(t, t->settings[STUDY_COUNTS], "\"counts\" is a list of STAGE.NAME",
                           &t->count_count);
    plan->stages = read_texts(t, t->settings[STUDY_STAGES], "\"stages\" is a list of stages",
                              &plan->stage_count);
    if (!t->counts || !plan->stages || !read_claims(t, plan))
        return false;
    study_tradeoff_extras(t, plan);
    return true;
}

/* Whole files and pipelines say nothing by their path. */
static bool are_whole(const study_tradeoff *t)
{
    static const char *const whole[] = {"include=", "pipeline=", "accuracy="};
    for (size_t i = 0; i < t->count; i++)
        for (size_t k = 0; k < t->knob_count; k++)
            for (size_t w = 0; t->points[i].assignments[k] && w < 3; w++)
                if (!strncmp(t->points[i].assignments[k], whole[w], strlen(whole[w])))
                    return true;
    return false;
}

/* "film.use=kind/name, film.cells=512": "name, cells 512". */
static const char *label_of(const study_tradeoff *t, const study_point *p, bool whole)
{
    study_line line = {0};
    for (size_t k = 0; k < t->knob_count; k++) {
        const char *dot = strrchr(t->knobs[k], '.'), *word = dot ? dot + 1 : t->knobs[k];
        const char *value = p->values[k];
        if (!value)
            continue;
        const char *slash = strchr(value, '/');
        bool use = dot && !strcmp(word, "use") && slash;
        study_put(&line, "%s%s%s%s", line.used ? ", " : "", use || whole ? "" : word,
                  use || whole ? "" : " ", use ? slash + 1 : value);
    }
    return line.used ? study_keep(t->desk, "%s", line.text) : "as the file stands";
}

size_t study_tradeoff_case(const study_tradeoff *t, size_t point, size_t repeat)
{
    bool past = point == t->count; /* one behind the last case */
    return past ? t->levels + t->candidates * (size_t)t->repeats
                : point + (point < t->levels ? 0 : repeat * t->candidates);
}

/* The cases in this order: levels once, candidates `repeats` times. */
static void ask(const study_tradeoff *t, size_t point, size_t repeat)
{
    const ff_study_desk *desk = t->desk;
    const study_point *p = &t->points[point];
    ff_study_point *points = desk->memory(desk->ctx, (t->knob_count + 1) * sizeof *points);
    points[0] =
        (ff_study_point){"", point < t->levels ? study_keep(desk, "reference %zu", point)
                                               : study_keep(desk, "repeat %zu", repeat + 1)};
    for (size_t k = 0; k < t->knob_count; k++)
        points[k + 1] = (ff_study_point){p->assignments[k] ? p->assignments[k] : "",
                                         p->values[k] ? p->values[k] : ""};
    desk->ask(desk->ctx, &(ff_study_case){.size = sizeof(ff_study_case),
                                          .points = points,
                                          .repeat = repeat,
                                          .label = p->label,
                                          .place = p->place});
}

ff_status study_tradeoff_plan(void *self, const ff_study_desk *desk, ff_study_plan *plan)
{
    study_tradeoff *t = self;
    t->desk = desk;
    t->plan = plan;
    if (!read_measure(t, plan) || !read_reference(t) || !read_candidates(t))
        return FF_INVALID;
    bool whole = are_whole(t);
    const char **paths = desk->memory(desk->ctx, (t->knob_count + 1) * sizeof *paths);
    paths[0] = "measured";
    for (size_t k = 0; k < t->knob_count; k++)
        paths[k + 1] = t->knobs[k];
    plan->flags = FF_STUDY_STRICT | FF_STUDY_COSTS;
    plan->paths = paths;
    plan->path_count = t->knob_count + 1;
    for (size_t i = 0; i < t->count; i++)
        t->points[i].label = label_of(t, &t->points[i], whole);
    for (size_t i = 0; i < t->levels; i++)
        ask(t, i, 0);
    for (size_t repeat = 0; repeat < (size_t)t->repeats; repeat++)
        for (size_t c = 0; c < t->candidates; c++)
            ask(t, t->levels + c, repeat);
    return FF_OK;
}
