/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What stands under `tradeoff:`, as the points of one axis. */
#include "private.h"

#include "../value/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_KNOBS = 64, MOST_POINTS = 10000, MOST_REFINEMENTS = 20 };

/* A level or a candidate: what it assigns along each knob. */
typedef struct point {
    const char **assignments; /* MOST_KNOBS of them; NULL: none */
    const char **values;
    const char *label;
    ff_place place;
} point;

typedef struct reading {
    ff_study *study;
    ff_measure *measure;
    ff_tradeoff *tradeoff;
    ff_report *report;
    const char *knobs[MOST_KNOBS]; /* paths, or names of choices */
    size_t knob_count;
    point *points;
    size_t count;
} reading;

static bool refuse(reading *r, ff_place place, const char *hint, const char *what)
{
    return ff_error(r->report, FF_EXIT_INPUT, place, hint, "tradeoff: %s", what);
}

static const char *keep(reading *r, char *text)
{
    const char *kept = ff_arena_text(&r->study->arena, text, strlen(text));
    free(text);
    return kept;
}

/* A whole number under the key; without it the one that `count` has. */
static bool read_count(reading *r, const ff_node *map, const char *key, int64_t least, int64_t most,
                       size_t *count)
{
    const ff_node *node = ff_node_get(map, key);
    int64_t value = (int64_t)*count;
    char why[200];
    if (node && (node->kind != FF_SCALAR || !ff_integer_parse(node->text, &value, why, sizeof why)))
        value = least - 1;
    *count = value >= 0 ? (size_t)value : 0;
    return (value >= least && value <= most) ||
           ff_error(r->report, FF_EXIT_INPUT, node->place, NULL,
                    "tradeoff: \"%s\" wants a whole number from %d to %d", key, (int)least,
                    (int)most);
}

static bool check_keys(reading *r, const ff_node *map, const char *const *known, size_t count)
{
    bool good = true;
    for (size_t i = 0; i < map->count; i++) {
        size_t k = 0;
        while (k < count && strcmp(map->keys[i], known[k]) != 0)
            k++;
        const char *near = ff_nearest(map->keys[i], known, count);
        if (k == count && strncmp(map->keys[i], "x-", 2) != 0)
            good = ff_error(r->report, FF_EXIT_INPUT, map->key_places[i], NULL,
                            "tradeoff: unknown key \"%.80s\"%s%s%s", map->keys[i],
                            near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
    }
    return good;
}

/* Number of a knob, a new one at need; MOST_KNOBS after an error. */
static size_t find_knob(reading *r, const char *path, ff_place place)
{
    size_t k = 0;
    while (k < r->knob_count && strcmp(r->knobs[k], path) != 0)
        k++;
    if (k == MOST_KNOBS)
        refuse(r, place, NULL, "more than 64 knobs");
    else if (k == r->knob_count)
        r->knobs[r->knob_count++] = ff_arena_text(&r->study->arena, path, strlen(path));
    return k;
}

/* The stage in which an assignment makes cases differ. */
static void add_stage(reading *r, const char *assignment)
{
    ff_measure *m = r->measure;
    if (!strncmp(assignment, "pipeline.", 9))
        assignment += 9;
    size_t length = strcspn(assignment, ".="), i = 0;
    for (const char *const *top = ff_pipeline_top_keys; *top; top++)
        m->all = m->all || (strlen(*top) == length && !strncmp(*top, assignment, length));
    while (i < m->knob_count &&
           (strlen(m->knobs[i]) != length || strncmp(m->knobs[i], assignment, length) != 0))
        i++;
    if (i == m->knob_count && i < MOST_KNOBS)
        m->knobs[m->knob_count++] = ff_arena_text(&r->study->arena, assignment, length);
}

static point *add_point(reading *r, ff_place place)
{
    r->points = ff_resize(r->points, (r->count + 1) * sizeof *r->points);
    point *p = &r->points[r->count++];
    *p = (point){.place = place};
    p->assignments = ff_arena_alloc(&r->study->arena, MOST_KNOBS * sizeof *p->assignments);
    p->values = ff_arena_alloc(&r->study->arena, MOST_KNOBS * sizeof *p->values);
    return p;
}

static bool assign(reading *r, point *p, const char *path, const char *assignment,
                   const char *value)
{
    size_t knob = find_knob(r, path, p->place);
    if (knob == MOST_KNOBS)
        return false;
    p->assignments[knob] = ff_arena_text(&r->study->arena, assignment, strlen(assignment));
    p->values[knob] = ff_arena_text(&r->study->arena, value, strlen(value));
    add_stage(r, assignment);
    return true;
}

/* A sweep block: every case of it is a point. */
static bool add_sweep(reading *r, const ff_node *block)
{
    char name[] = "sweep", *keys[] = {name};
    ff_node copy = *block, *items[] = {&copy};
    ff_place places[] = {block->place};
    ff_node wrapped = {.kind = FF_MAP,
                       .place = block->place,
                       .count = 1,
                       .items = items,
                       .keys = keys,
                       .key_places = places};
    ff_study *swept = ff_study_read(&wrapped, r->report);
    if (!swept)
        return false;
    bool good = swept->followed == swept->axis_count && r->count + swept->count <= MOST_POINTS;
    if (!good)
        refuse(r, block->place, NULL,
               swept->followed < swept->axis_count
                   ? "candidates stand alone: \"follow\" is for sweeps"
                   : "more than 10000 candidates");
    for (size_t i = 0; good && i < swept->count; i++) {
        point *p = add_point(r, block->place);
        for (size_t k = 0; good && k < swept->varied_count; k++)
            good = assign(r, p, swept->varied[k].path, ff_study_assignment(swept, k, i),
                          ff_study_value(swept, k, i));
    }
    ff_study_free(swept);
    return good;
}

static bool is_knob(const char *key)
{
    return strcmp(key, "refine") != 0 && strcmp(key, "refinements") != 0;
}

/* The same, but a value alone stands for a list of one. */
static bool add_block(reading *r, const ff_node *map)
{
    ff_node block = {.kind = FF_MAP, .place = map->place};
    ff_node *lists = ff_alloc((map->count + 1) * sizeof *lists);
    block.items = ff_alloc((map->count + 1) * sizeof(ff_node *));
    block.keys = ff_alloc((map->count + 1) * sizeof(char *));
    block.key_places = ff_alloc((map->count + 1) * sizeof *block.key_places);
    for (size_t i = 0; i < map->count; i++) {
        if (!is_knob(map->keys[i]))
            continue;
        lists[i] = (ff_node){.kind = FF_SEQUENCE,
                             .place = map->items[i]->place,
                             .count = 1,
                             .items = &map->items[i]};
        block.items[block.count] = map->items[i]->kind == FF_SCALAR ? &lists[i] : map->items[i];
        block.keys[block.count] = map->keys[i];
        block.key_places[block.count++] = map->key_places[i];
    }
    bool good = block.count ? add_sweep(r, &block) /* else the file as it stands */
                            : add_point(r, map->place) != NULL;
    free(lists);
    free(block.items);
    free(block.keys);
    free(block.key_places);
    return good;
}

/* "film.use=kind/name, film.cells=512": "name, cells 512". */
static void put_label(reading *r, point *p)
{
    char *text = NULL;
    size_t length = 0;
    bool first = true;
    FILE *out = open_memstream(&text, &length);
    if (!out)
        abort();
    for (size_t k = 0; k < r->knob_count; k++) {
        const char *dot = strrchr(r->knobs[k], '.'), *word = dot ? dot + 1 : r->knobs[k];
        const char *value = p->values[k];
        if (!value)
            continue;
        const char *slash = strchr(value, '/');
        bool use = dot && !strcmp(word, "use") && slash;
        if (use || r->measure->all)
            fprintf(out, "%s%s", first ? "" : ", ", use ? slash + 1 : value);
        else
            fprintf(out, "%s%s %s", first ? "" : ", ", word, value);
        first = false;
    }
    fputs(first ? "as the file stands" : "", out);
    fclose(out);
    p->label = keep(r, text);
}

/* How many times as large a knob gets from level to level: 2, or what a map says. */
static bool find_factor(reading *r, const ff_node *refine, const char *path, double *factor)
{
    *factor = 1;
    const char *end;
    for (size_t i = 0; refine && i < refine->count; i++) {
        bool map = refine->kind == FF_MAP;
        const ff_node *item = refine->items[i];
        const char *name = map ? refine->keys[i] : item->text;
        if (item->kind != FF_SCALAR)
            return refuse(r, item->place, NULL,
                          "\"refine\" is a list of knobs to double, or a "
                          "map from knobs to factors");
        if (strcmp(name, path) != 0)
            continue;
        *factor = 2;
        if (map && (!ff_number_parse(item->text, factor, &end) || *end || !(*factor > 0)))
            return refuse(r, item->place, NULL, "a factor of \"refine\" is a positive number");
    }
    return true;
}

/* Level 0 assigns what the file says; further ones are finer. */
static bool refine_level(reading *r, const ff_node *map, const ff_node *refine, size_t level)
{
    point *p = &r->points[r->count - 1];
    for (size_t i = 0; i < map->count; i++) {
        const char *path = map->keys[i], *end;
        double factor, number;
        if (!is_knob(path))
            continue;
        if (!find_factor(r, refine, path, &factor))
            return false;
        if (factor == 1 || level == 0)
            continue;
        if (!ff_number_parse(map->items[i]->text, &number, &end))
            return refuse(r, map->items[i]->place, NULL, "what is refined must be a number");
        char *value = ff_print_text("%.12g%s", number * pow(factor, (double)level), end);
        char *text = ff_print_text("%s=%s", path, value);
        bool good = assign(r, p, path, text, value);
        free(value);
        free(text);
        if (!good)
            return false;
    }
    return true;
}

static bool check_refine(reading *r, const ff_node *map, const ff_node *refine)
{
    for (size_t i = 0; refine && i < refine->count; i++) {
        const char *name = refine->kind == FF_MAP ? refine->keys[i] : refine->items[i]->text;
        if (!ff_node_get(map, name))
            return ff_error(r->report, FF_EXIT_INPUT, refine->items[i]->place, NULL,
                            "tradeoff: the reference gives no \"%.80s\" that could be refined",
                            name);
    }
    return true;
}

static bool read_reference(reading *r, const ff_node *tradeoff)
{
    const ff_node *map = ff_node_get(tradeoff, "reference"), *refine = ff_node_get(map, "refine");
    size_t refinements = 3;
    if (!map || map->kind != FF_MAP)
        return refuse(r, map ? map->place : tradeoff->place,
                      "write reference: {film.cells: 2048, refine: [film.cells]}",
                      "\"reference\" is a map from paths to the values of the finest answer");
    if (!check_refine(r, map, refine) ||
        !read_count(r, map, "refinements", 0, MOST_REFINEMENTS, &refinements))
        return false;
    r->tradeoff->levels = refine && refine->count ? refinements + 1 : 1;
    for (size_t level = 0; level < r->tradeoff->levels; level++)
        if (!add_block(r, map) || !refine_level(r, map, refine, level))
            return false;
        else if (r->count != level + 1)
            return refuse(r, map->place, NULL, "the reference is one answer: give one value each");
    return true;
}

static bool read_candidates(reading *r, const ff_node *tradeoff)
{
    const ff_node *list = ff_node_get(tradeoff, "candidates");
    if (!list || list->kind != FF_SEQUENCE || list->count == 0)
        return refuse(r, list ? list->place : tradeoff->place,
                      "write candidates: [{film.cells: [128, 256], film.steps: [500, 1000]}]",
                      "\"candidates\" is a list of maps from paths to lists of values");
    for (size_t i = 0; i < list->count; i++) {
        if (list->items[i]->kind != FF_MAP)
            return refuse(r, list->items[i]->place, NULL,
                          "a candidate is a map from paths to lists of values");
        if (!add_block(r, list->items[i]))
            return false;
    }
    r->tradeoff->candidates = r->count - r->tradeoff->levels;
    return true;
}

/* A list of texts, NULL-terminated; NULL after an error. */
static const char **read_texts(reading *r, const ff_node *list, const char *what, size_t *count)
{
    const char **texts = ff_arena_alloc(&r->study->arena, (list->count + 1) * sizeof *texts);
    *count = list->count;
    for (size_t i = 0; i < list->count || list->kind != FF_SEQUENCE; i++) {
        if (list->kind != FF_SEQUENCE || list->items[i]->kind != FF_SCALAR ||
            !list->items[i]->text[0]) {
            refuse(r, list->place, NULL, what);
            return NULL;
        }
        texts[i] =
            ff_arena_text(&r->study->arena, list->items[i]->text, strlen(list->items[i]->text));
    }
    return texts;
}

static bool read_claims(reading *r, const ff_node *map)
{
    ff_measure *m = r->measure;
    const ff_node *outputs = m->request;
    size_t count;
    static const char *const none[] = {NULL};
    m->claims = ff_arena_alloc(&r->study->arena, m->output_count * sizeof *m->claims);
    if (map && map->kind == FF_SCALAR && !strcmp(map->text, "none")) {
        for (size_t k = 0; k < m->output_count; k++)
            m->claims[k] = none;
        return true;
    }
    if (map && map->kind != FF_MAP)
        return refuse(r, map->place, NULL,
                      "\"estimates\" is a map from outputs to lists of names, or none");
    for (size_t i = 0; map && i < map->count; i++) {
        size_t k = 0;
        while (k < m->output_count && strcmp(outputs->items[k]->text, map->keys[i]) != 0)
            k++;
        if (k == m->output_count)
            return refuse(
                r, map->key_places[i], NULL,
                "\"estimates\" is a map from outputs of this trade-off to lists of names");
        m->claims[k] = read_texts(r, map->items[i],
                                  "the estimates of an output are a list of names such as "
                                  "[h_min_space_error, h_min_time_error]",
                                  &count);
        if (!m->claims[k])
            return false;
    }
    return true;
}

/* Stages whose work counts although no knob touches them. */
static bool read_stages(reading *r, const ff_node *list)
{
    size_t count;
    const char **names = read_texts(r, list, "\"stages\" is a list of stages", &count);
    for (size_t i = 0; names && i < count; i++)
        add_stage(r, names[i]);
    return names != NULL;
}

static bool read_measure(reading *r, const ff_node *node)
{
    ff_measure *m = r->measure;
    const ff_node *outputs = ff_node_get(node, "outputs"), *along = ff_node_get(node, "along");
    const ff_node *counts = ff_node_get(node, "counts"), *stages = ff_node_get(node, "stages");
    if (!outputs || outputs->kind != FF_SEQUENCE || outputs->count == 0)
        return refuse(r, outputs ? outputs->place : node->place, NULL,
                      "\"outputs\" is a list of the outputs that matter, such as [film.h_min]");
    if (!read_texts(r, outputs, "\"outputs\" is a list of STAGE.OUTPUT", &m->output_count))
        return false;
    for (size_t i = 0; i < outputs->count; i++)
        if (strchr(outputs->items[i]->text, '*'))
            return refuse(r, outputs->items[i]->place, NULL, "name each output that matters");
    m->request = outputs;
    if (along && (along->kind != FF_SCALAR || !along->text[0]))
        return refuse(r, along->place, NULL, "\"along\" is the name of a series, such as phase");
    m->along = along ? ff_arena_text(&r->study->arena, along->text, strlen(along->text)) : NULL;
    m->counts = counts
                    ? read_texts(r, counts, "\"counts\" is a list of STAGE.NAME", &m->count_count)
                    : NULL;
    if (stages && !read_stages(r, stages))
        return false;
    return (!counts || m->counts) && read_claims(r, ff_node_get(node, "estimates"));
}

static bool read_accuracy(reading *r, const ff_node *node)
{
    ff_unit one;
    char why[200];
    ff_unit_parse("1", &one, why, sizeof why);
    r->tradeoff->accuracy = 0.005;
    return !node ||
           (node->kind == FF_SCALAR &&
            ff_quantity_parse(node->text, &one, "1", &r->tradeoff->accuracy, why, sizeof why) &&
            r->tradeoff->accuracy > 0) ||
           refuse(r, node->place, NULL,
                  "\"accuracy\" is the smallest error that is sought, such as 0.5 %");
}

/* Case number i of the study: levels once, candidates `repeats` times. */
static size_t point_of(const ff_tradeoff *t, size_t i)
{
    return i < t->levels ? i : t->levels + (i - t->levels) % t->candidates;
}

static ff_varied *add_varied(reading *r, const char *path)
{
    ff_study *study = r->study;
    ff_varied *varied = &study->varied[study->varied_count++];
    varied->path = path;
    varied->axis = 0;
    varied->assignments = ff_arena_alloc(&study->arena, study->count * sizeof *varied->assignments);
    varied->names = ff_arena_alloc(&study->arena, study->count * sizeof *varied->names);
    return varied;
}

/* The points become the one axis of the study. */
static void lay_out(reading *r)
{
    ff_study *study = r->study;
    ff_tradeoff *t = r->tradeoff;
    study->count = t->levels + t->candidates * t->repeats;
    study->axis_count = 1;
    study->points[0] = study->count;
    study->followed = study->way = 1;
    size_t *repeat = ff_arena_alloc(&study->arena, study->count * sizeof *repeat);
    const char **roles = (const char **)(size_t)add_varied(r, "measured")->names;
    for (size_t i = 0; i < study->count; i++) {
        repeat[i] = i < t->levels ? 0 : (i - t->levels) / t->candidates;
        roles[i] = keep(r, i < t->levels ? ff_print_text("reference %zu", i)
                                         : ff_print_text("repeat %zu", repeat[i] + 1));
        study->varied[0].assignments[i] = "";
    }
    for (size_t k = 0; k < r->knob_count; k++) {
        ff_varied *varied = add_varied(r, r->knobs[k]);
        const char **names = (const char **)(size_t)varied->names;
        for (size_t i = 0; i < study->count; i++) {
            const point *p = &r->points[point_of(t, i)];
            varied->assignments[i] = p->assignments[k] ? p->assignments[k] : "";
            names[i] = p->values[k] ? p->values[k] : "";
        }
    }
    t->labels = ff_arena_alloc(&study->arena, r->count * sizeof *t->labels);
    t->places = ff_arena_alloc(&study->arena, r->count * sizeof *t->places);
    for (size_t i = 0; i < r->count; i++) {
        put_label(r, &r->points[i]);
        t->labels[i] = r->points[i].label;
        t->places[i] = r->points[i].place;
    }
    r->measure->repeat = repeat;
    study->measure = r->measure;
    study->tradeoff = t;
}

bool ff_tradeoff_read(ff_study *study, const ff_node *node, ff_report *report)
{
    static const char *const known[] = {"outputs", "reference", "candidates",
                                        "repeats", "estimates", "counts",
                                        "along",   "accuracy",  "stages"};
    reading r = {.study = study, .report = report};
    r.measure = ff_arena_alloc(&study->arena, sizeof *r.measure);
    r.tradeoff = ff_arena_alloc(&study->arena, sizeof *r.tradeoff);
    r.measure->knobs = ff_arena_alloc(&study->arena, MOST_KNOBS * sizeof *r.measure->knobs);
    study->varied = ff_arena_alloc(&study->arena, (MOST_KNOBS + 1) * sizeof *study->varied);
    study->points = ff_arena_alloc(&study->arena, sizeof *study->points);
    r.tradeoff->repeats = 5;
    bool good =
        node->kind == FF_MAP ||
        refuse(&r, node->place, NULL, "expected a map with outputs, reference and candidates");
    good = good && check_keys(&r, node, known, sizeof known / sizeof *known) &&
           read_measure(&r, node) && read_accuracy(&r, ff_node_get(node, "accuracy")) &&
           read_count(&r, node, "repeats", 1, 100, &r.tradeoff->repeats) &&
           read_reference(&r, node) && read_candidates(&r, node);
    if (good)
        lay_out(&r);
    free(r.points);
    return good;
}
