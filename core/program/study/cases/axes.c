/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the map under `study:` into axes with their points. */
#include "inline-cases.h"
#include "rows.h"
#include "spectrum.h"
#include "yaml.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CASES = 1000000 };

typedef struct reading {
    study_definition *study;
    ff_report *report;
    bool single;        /* whether a single value counts as a list of one */
    bool sampled;       /* whether ranges without "points" are sampled, on axis 0 */
    uint32_t dimension; /* next free dimension of the sample */
    uint64_t seed;
    ff_place place; /* place of the path that is being read */
} reading;

static bool refuse(reading *r, ff_place place, const char *hint, const char *what, const char *name)
{
    return ff_error(r->report, FF_FAULT_INPUT, place, hint, "study: %.80s%s%s", name,
                    *name ? ": " : "", what);
}

/* Makes room for a path along the newest axis; the caller fills in the assignments. */
static study_varied *add_varied(reading *r, const char *path, size_t axis)
{
    study_definition *study = r->study;
    study_varied *varied = &study->varied[study->varied_count++];
    varied->path = path;
    varied->place = r->place;
    varied->axis = axis;
    varied->assignments =
        memory_arena_alloc(&study->arena, study->points[axis] * sizeof *varied->assignments);
    return varied;
}

static size_t add_axis(reading *r, size_t points)
{
    r->study->points[r->study->axis_count] = points;
    return r->study->axis_count++;
}

static const char *assignment_of(reading *r, const char *path, const ff_node *value)
{
    return memory_arena_take(&r->study->arena, study_yaml_assignment(path, value));
}

/* Adds a list, or a map whose keys name the values. */
static void add_list(reading *r, const char *path, const ff_node *list, size_t axis)
{
    study_varied *varied = add_varied(r, path, axis);
    for (size_t i = 0; i < list->count; i++)
        varied->assignments[i] = assignment_of(r, path, list->items[i]);
    varied->values = list;
    if (list->kind == FF_MAP)
        varied->names = (const char **)list->keys;
}

/* Returns a name for a file: without directories and extension if no other file of the list has
   that name, otherwise its whole path. */
static char *file_name(const ff_node *list, size_t at)
{
    char *name = NULL;
    for (size_t i = list->count + 1; i-- > 0;) { /* the file's own path is compared first */
        const char *path = list->items[i < list->count ? i : at]->text;
        const char *slash = strrchr(path, '/'), *stem = slash ? slash + 1 : path;
        size_t length = strcspn(stem, ".");
        if (!name)
            name = memory_copy_text(stem, length);
        else if (i != at && strlen(name) == length && !strncmp(name, stem, length)) {
            free(name);
            return memory_print_text("%s", list->items[at]->text);
        }
    }
    return name;
}

/* Adds files that are included after the file of the study, one in each case. `path` is only a name
   for the choice. */
static bool add_files(reading *r, const char *path, const ff_node *map)
{
    const ff_node *list = map->items[0];
    bool good = map->count == 1 && list->kind == FF_SEQUENCE && list->count > 0;
    for (size_t i = 0; good && i < list->count; i++)
        good = list->items[i]->kind == FF_SCALAR && *list->items[i]->text;
    if (!good)
        return refuse(r, map->place, "write oil_card: {include: [a.yaml, b.yaml]}",
                      "expected a list of files, one for each case", path);
    study_varied *varied = add_varied(r, path, add_axis(r, list->count));
    const char **names = memory_arena_alloc(&r->study->arena, list->count * sizeof *names);
    varied->names = names;
    for (size_t i = 0; i < list->count; i++) {
        ff_node file = *list->items[i];
        file.text = ff_path_beside(file.place.source->directory, file.text);
        file.quoted = true;
        varied->assignments[i] = assignment_of(r, "include", &file);
        names[i] = memory_arena_take(&r->study->arena, file_name(list, i));
        ff_free(file.text);
    }
    return true;
}

/* Reads the direction of the chains along the next axis. "up" runs towards larger values. */
static bool read_follow(reading *r, const ff_node *node, const char *path, bool falling)
{
    study_definition *study = r->study;
    bool word = node->kind == FF_SCALAR, up = word && !strcmp(node->text, "up");
    bool down = word && !strcmp(node->text, "down"), both = word && !strcmp(node->text, "both");
    if (!up && !down && !both)
        return refuse(r, node->place, NULL, "\"follow\" must be up, down or both", path);
    if (study->followed != SIZE_MAX)
        return refuse(r, node->place, NULL, "only one range of a study can be followed", path);
    study->backwards = down != falling;
    if (both) {
        study->direction = add_axis(r, 2);
        study_varied *varied = add_varied(r, "follow", study->direction);
        varied->assignments[0] = varied->assignments[1] = "";
        varied->names = memory_arena_alloc(&study->arena, 2 * sizeof *varied->names);
        varied->names[0] = "up";
        varied->names[1] = "down";
    }
    study->followed = study->axis_count;
    return true;
}

/* A range of values: the numbers `from` and `to`, both in the unit of `from`. */
typedef struct span {
    double from, to;
    const char *unit;
    bool log;
} span;

static bool read_end(reading *r, const ff_node *node, const char *path, double *number,
                     const char **unit)
{
    char why[200];
    ff_unit parsed;
    if (!node || node->kind != FF_SCALAR || !ff_number_parse(node->text, number, unit))
        return refuse(r, node ? node->place : FF_NOWHERE, "write {from: 400 Hz, to: 4000 Hz, ...}",
                      "\"from\" and \"to\" must be numbers with units", path);
    *unit += strspn(*unit, " ");
    return ff_unit_parse(*unit, &parsed, why, sizeof why) ||
           ff_error(r->report, FF_FAULT_INPUT, node->place, NULL,
                    "study: %s: the unit \"%.40s\" %s", path, *unit, why);
}

static bool read_span(reading *r, const ff_node *map, const char *path, span *s)
{
    const ff_node *from = ff_node_get(map, "from"), *to = ff_node_get(map, "to");
    const ff_node *spacing = ff_node_get(map, "spacing");
    const char *unit;
    char why[200];
    ff_unit a, b;
    if (!from || !to)
        return refuse(r, map->place, "write {from: 400 Hz, to: 4000 Hz, points: 10}",
                      "a range needs \"from\" and \"to\"", path);
    if (!read_end(r, from, path, &s->from, &s->unit) || !read_end(r, to, path, &s->to, &unit))
        return false;
    ff_unit_parse(s->unit, &a, why, sizeof why);
    ff_unit_parse(unit, &b, why, sizeof why);
    if (!ff_unit_same_dimension(&a, &b))
        return refuse(r, to->place, NULL, "\"from\" and \"to\" have units of different dimensions",
                      path);
    if (strcmp(unit, s->unit) != 0)
        s->to = ff_unit_from_si(&a, ff_unit_to_si(&b, s->to));
    s->log = spacing && spacing->kind == FF_SCALAR && !strcmp(spacing->text, "log");
    if (spacing && !s->log && (spacing->kind != FF_SCALAR || strcmp(spacing->text, "linear") != 0))
        return refuse(r, spacing->place, NULL, "\"spacing\" is either linear or log", path);
    if (s->log && !(s->from > 0 && s->to > 0))
        return refuse(r, map->place, NULL, "spacing log needs positive ends", path);
    return true;
}

/* Returns the assignment of the value at a fraction from 0 to 1 of the range, with 12 digits, which
 * removes round-off of the division. */
static const char *span_text(reading *r, const char *path, const span *s, double share)
{
    double value =
        s->log ? s->from * pow(s->to / s->from, share) : s->from + (s->to - s->from) * share;
    value = share <= 0 ? s->from : share >= 1 ? s->to : value;
    return memory_arena_take(&r->study->arena, memory_print_text("%s=%.12g%s%s", path, value,
                                                                 *s->unit ? " " : "", s->unit));
}

static bool read_count(reading *r, const ff_node *node, const char *name, int64_t least,
                       int64_t *count)
{
    char why[200];
    if (node->kind == FF_SCALAR && ff_integer_parse(node->text, count, why, sizeof why) &&
        *count >= least && *count <= MOST_CASES)
        return true;
    return ff_error(r->report, FF_FAULT_INPUT, node->place, NULL,
                    "study: %s needs a whole number from %d to %d", name, (int)least, MOST_CASES);
}

static bool too_many(reading *r, ff_place place, double cases)
{
    return cases > MOST_CASES &&
           !ff_error(r->report, FF_FAULT_INPUT, place, NULL,
                     "study: %.3g cases; at most %d are possible", cases, MOST_CASES);
}

static double cases_of(const study_definition *study)
{
    double cases = 1;
    for (size_t a = 0; a < study->axis_count; a++)
        cases *= (double)study->points[a];
    return cases;
}

static bool has_dimension(reading *r, ff_place place, const char *path)
{
    return r->dimension < STUDY_SOBOL_DIMENSIONS ||
           refuse(r, place, NULL, "a sample has at most 16 dimensions", path);
}

static bool read_range(reading *r, const ff_node *map, const char *path)
{
    static const char *const known[] = {"from", "to", "points", "spacing", "follow", NULL};
    const ff_node *points = ff_node_get(map, "points"), *follow = ff_node_get(map, "follow");
    bool drawn = !points && r->sampled;
    int64_t count = 0;
    span s;
    if (!study_check_keys(map, "study", path, known, r->report) || !read_span(r, map, path, &s))
        return false;
    if (!points && !drawn)
        return refuse(r, map->place, NULL, "a range needs \"points\"", path);
    if (points && !read_count(r, points, "points", 2, &count))
        return false;
    if (drawn && !has_dimension(r, map->place, path))
        return false;
    if (drawn && follow)
        return refuse(r, follow->place, NULL, "a sampled range cannot be followed", path);
    if (points && too_many(r, points->place, cases_of(r->study) * (double)count))
        return false; /* refused before memory for so many cases is allocated */
    if (follow && !read_follow(r, follow, path, s.to < s.from))
        return false;
    size_t axis = drawn ? 0 : add_axis(r, (size_t)count);
    study_varied *varied = add_varied(r, path, axis);
    for (size_t i = 0; i < r->study->points[axis]; i++)
        varied->assignments[i] = span_text(r, path, &s,
                                           drawn ? study_sobol((uint32_t)i, r->dimension, r->seed)
                                                 : (double)i / (double)(count - 1));
    r->dimension += drawn;
    return true;
}

/* Returns whether all values of the map are maps, so that its keys are names. */
static bool is_named(const ff_node *map)
{
    size_t maps = 0;
    for (size_t i = 0; i < map->count; i++)
        maps += map->items[i]->kind == FF_MAP;
    return maps > 0 && maps == map->count;
}

static const ff_node *list_of(reading *r, ff_node **item)
{
    ff_node *list = memory_arena_alloc(&r->study->arena, sizeof *list);
    *list = (ff_node){.kind = FF_SEQUENCE, .place = (*item)->place, .items = item, .count = 1};
    return list;
}

static bool read_sweep(reading *r, const ff_node *map)
{
    bool good = true;
    if (map->kind != FF_MAP || map->count == 0)
        return refuse(r, map->place, "write for example duty.torque: [100 N m, 200 N m]",
                      "expected a map from paths to values", "sweep");
    for (size_t i = 0; i < map->count; i++) {
        const ff_node *node = map->items[i];
        r->place = map->key_places[i];
        if (r->single && node->kind == FF_SCALAR)
            node = list_of(r, &map->items[i]);
        if (ff_node_get(node, "include"))
            good = add_files(r, map->keys[i], node) && good;
        else if (node->kind == FF_MAP && is_named(node))
            add_list(r, map->keys[i], node, add_axis(r, node->count));
        else if (node->kind == FF_MAP)
            good = read_range(r, node, map->keys[i]) && good;
        else if (node->kind == FF_SEQUENCE && node->count > 0)
            add_list(r, map->keys[i], node, add_axis(r, node->count));
        else
            good = refuse(
                r, node->place, "for a single value write [VALUE]; an axis cannot be removed",
                "expected a list of values, or {from: ..., to: ..., points: ...}", map->keys[i]);
    }
    return good;
}

static bool read_zip(reading *r, const ff_node *map)
{
    size_t count = map->kind == FF_MAP && map->count ? map->items[0]->count : 0;
    if (count == 0)
        return refuse(r, map->place, NULL, "expected a map from paths to lists", "zip");
    size_t axis = add_axis(r, count);
    for (size_t k = 0; k < map->count; k++) {
        if (map->items[k]->kind != FF_SEQUENCE || map->items[k]->count != count)
            return refuse(r, map->items[k]->place, NULL, "the lists of a zip must be equally long",
                          "zip");
        r->place = map->key_places[k];
        add_list(r, map->keys[k], map->items[k], axis);
    }
    return true;
}

static bool read_sample(reading *r, const ff_node *map)
{
    static const char *const known[] = {"sobol", "seed", NULL};
    const ff_node *points = ff_node_get(map, "sobol"), *seed = ff_node_get(map, "seed");
    const ff_node *toleranced = ff_node_get(map, "tolerances");
    int64_t count = 0, number = 0;
    if (toleranced)
        return refuse(r, toleranced->place,
                      "write study: {uncertainty: {outputs: [film.h_min_lowest], samples: 64}}",
                      "values that have a tolerance are inputs of \"uncertainty\"", "sample");
    if (map->kind != FF_MAP || !points)
        return refuse(r, map->place, NULL, "expected {sobol: NUMBER OF POINTS, seed: 1}", "sample");
    if (!study_check_keys(map, "study", "sample", known, r->report) ||
        !read_count(r, points, "sobol", 1, &count) ||
        (seed && !read_count(r, seed, "seed", 0, &number)))
        return false;
    r->seed = (uint64_t)number;
    r->sampled = true;
    add_axis(r, (size_t)count);
    return true;
}

enum { LEAST_MEMORY = 16 /* MiB, needed for what a worker stores between cases */ };

bool study_read_limits(study_definition *study, const ff_node *node, ff_report *report)
{
    reading whole = {.study = study, .report = report}, *r = &whole;
    const ff_node *time = ff_node_get(node, "time_limit");
    const ff_node *memory = ff_node_get(node, "memory_limit");
    ff_unit second, one;
    char why[200];
    ff_unit_parse("s", &second, why, sizeof why);
    ff_unit_parse("1", &one, why, sizeof why);
    if (time &&
        (time->kind != FF_SCALAR ||
         !ff_quantity_parse(time->text, &second, "s", &r->study->time_limit, why, sizeof why) ||
         !(r->study->time_limit > 0)))
        return refuse(r, time->place, NULL, "expected a time such as 60 s", "time_limit");
    if (memory &&
        (memory->kind != FF_SCALAR ||
         !ff_quantity_parse(memory->text, &one, "1", &r->study->memory_limit, why, sizeof why) ||
         !(r->study->memory_limit >= LEAST_MEMORY)))
        return refuse(r, memory->place, "linear algebra alone may take 128 MiB at once",
                      "expected a number of MiB for each worker, 16 at least", "memory_limit");
    r->study->memory_limit *= 1048576;
    return true;
}

static bool finish_axes(reading *r, const ff_node *node)
{
    study_definition *study = r->study;
    double cases = cases_of(study);
    for (size_t k = 0; k < study->varied_count; k++)
        for (size_t l = 0; l < k; l++)
            if (!strcmp(study->varied[k].path, study->varied[l].path))
                return refuse(r, node->place, NULL, "it is varied twice", study->varied[k].path);
    if (r->sampled && r->dimension == 0)
        return refuse(r, node->place, "give it {from: ..., to: ...} under sweep, without points",
                      "there is no range to sample", "sample");
    study->followed = study->followed < study->axis_count ? study->followed : study->axis_count;
    study->direction = study->direction < study->axis_count ? study->direction : study->axis_count;
    study->count = cases <= MOST_CASES ? (size_t)cases : 0;
    return !too_many(r, node->place, cases);
}

const char *const study_keys[] = {"sweep", "zip",        "sample",       "cases",
                                  "below", "time_limit", "memory_limit", NULL};

/* Allocates memory for the paths, and for the axes of a sample and of `follow: both`. */
static void begin_axes(reading *r, size_t paths)
{
    study_definition *study = r->study;
    study->varied = memory_arena_alloc(&study->arena, (paths + 2) * sizeof *study->varied);
    study->points = memory_arena_alloc(&study->arena, (paths + 2) * sizeof *study->points);
    study->followed = study->direction = SIZE_MAX;
}

static bool read_all(reading *r, const ff_node *node)
{
    const ff_node *sweep = ff_node_get(node, "sweep"), *zip = ff_node_get(node, "zip");
    const ff_node *sample = ff_node_get(node, "sample"), *cases = ff_node_get(node, "cases");
    if (cases && (sweep || zip || sample))
        return refuse(r, cases->place, "write two files",
                      "a study has either a list of cases or a sweep", "cases");
    if (cases)
        return (study_listed_is(cases) ? study_listed_read(r->study, cases, r->report)
                                       : study_rows_read(r->study, cases, r->report)) &&
               study_spectrum_finish(r->study, cases, ff_node_get(node, "below"), r->report);
    if (ff_node_get(node, "below"))
        return refuse(r, ff_node_get(node, "below")->place, NULL,
                      "it needs cases with a column \"time\"", "below");
    const ff_node *toleranced = sample ? ff_node_get(sample, "tolerances") : NULL;
    if (node->kind != FF_MAP || (!sweep && !zip && !toleranced))
        return refuse(r, node->place, "write study: {sweep: {duty.torque: [100 N m, 200 N m]}}",
                      "there is nothing to vary", "");
    begin_axes(r, (sweep ? sweep->count : 0) + (zip ? zip->count : 0));
    return (!sample || read_sample(r, sample)) && (!sweep || read_sweep(r, sweep)) &&
           (!zip || read_zip(r, zip)) && finish_axes(r, node);
}

study_definition *study_expand(const ff_node *sweep, ff_report *report)
{
    study_definition *study = memory_alloc(sizeof *study);
    reading r = {.study = study, .report = report, .single = true};
    begin_axes(&r, sweep->count);
    if (read_sweep(&r, sweep) && finish_axes(&r, sweep))
        return study;
    study_definition_free(study);
    return NULL;
}

study_definition *study_read(const ff_node *node, ff_report *report)
{
    study_definition *study = memory_alloc(sizeof *study);
    reading r = {.study = study, .report = report};
    if (study_read_limits(study, node, report) && read_all(&r, node))
        return study;
    if (study->rows) /* the table is kept, since messages quote it */
        return study;
    study_definition_free(study);
    return NULL;
}
