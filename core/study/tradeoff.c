/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a trade-off comes to: the error and the cost of every candidate, the fronts, the claims. */
#include "private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* A claim is wrong when the error is more than this many times as large, or as small. */
static const double most_beyond = 3, most_above = 10;

static double *numbers(const json_t *list, size_t *count)
{
    *count = json_array_size(list);
    double *values = ff_alloc((*count + 1) * sizeof *values);
    for (size_t i = 0; i < *count; i++) {
        const json_t *value = json_array_get(list, i);
        values[i] = json_is_number(value) ? json_number_value(value) : NAN;
    }
    return values;
}

static bool read_series(const json_t *values, const char *output, ff_series *s)
{
    const json_t *one = json_object_get(values, output), *at = json_object_get(one, "at");
    size_t count;
    *s = (ff_series){.rank = (size_t)json_integer_value(json_object_get(one, "rank"))};
    s->value = numbers(json_object_get(one, "values"), &s->count);
    s->at = at ? numbers(at, &count) : NULL;
    return one != NULL;
}

static const char *axis_of(const json_t *values, const char *output)
{
    const char *name = json_string_value(json_object_get(json_object_get(values, output), "along"));
    return name ? name : "";
}

bool ff_point_compare(const ff_point *a, const ff_point *b, const char *output, ff_difference *d)
{
    ff_series answer, reference;
    bool good = read_series(a->values, output, &answer);
    good = read_series(b->values, output, &reference) && good &&
           !strcmp(axis_of(a->values, output), axis_of(b->values, output)) &&
           ff_compare(&answer, &reference, d);
    free(answer.at);
    free(answer.value);
    free(reference.at);
    free(reference.value);
    return good;
}

static json_t *real(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *processor(void)
{
    char line[256];
    json_t *name = NULL;
    FILE *stream = fopen("/proc/cpuinfo", "re");
    while (stream && !name && fgets(line, sizeof line, stream)) {
        const char *colon = strchr(line, ':');
        line[strcspn(line, "\n")] = '\0';
        if (!strncmp(line, "model name", 10) && colon)
            name = json_string(colon + 1 + strspn(colon + 1, " "));
    }
    if (stream)
        fclose(stream);
    return name ? name : json_string("unknown");
}

static json_t *today(void)
{
    char text[32] = "";
    time_t now = time(NULL);
    struct tm utc;
    if (gmtime_r(&now, &utc))
        strftime(text, sizeof text, "%Y-%m-%d", &utc);
    return json_string(text);
}

static int compare_numbers(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Time of the processor in the stages in which cases differ; NAN: the case failed. */
static double work_of(const json_t *record)
{
    const char *stage;
    json_t *value;
    double sum = 0;
    if (!ff_record_is_ok(record))
        return NAN;
    json_object_foreach(json_object_get(json_object_get(record, "measured"), "work"), stage, value)
        sum += json_number_value(value);
    return sum;
}

static json_t *cost_of(const ff_point *point, const json_t *records, double *median)
{
    double *all = ff_alloc(point->repeats * sizeof *all);
    size_t count = 0;
    for (size_t i = 0; i < point->repeats; i++) {
        double work = work_of(json_object_get(records, point->keys[i]));
        if (isfinite(work))
            all[count++] = work;
    }
    qsort(all, count, sizeof *all, compare_numbers);
    *median = count ? (all[(count - 1) / 2] + all[count / 2]) / 2 : NAN;
    json_t *cost = count ? json_pack("{s:f, s:f, s:f, s:I}", "median", *median, "min", all[0],
                                     "max", all[count - 1], "repeats", (json_int_t)count)
                         : json_null();
    free(all);
    return cost;
}

/* A claim against the measured error, which itself is known to `floor`. */
static const char *judge(double claim, double error, double floor)
{
    return error - floor > most_beyond * claim       ? "too small"
           : claim > most_above * fmax(error, floor) ? "too large"
                                                     : "kept";
}

/* How far the reference is from its last level but one: what errors can be told apart. */
static double floor_of(const ff_point *points, size_t levels, const char *output)
{
    ff_difference d;
    bool known =
        levels > 1 && ff_point_compare(&points[levels - 2], &points[levels - 1], output, &d);
    return known ? d.largest : 0;
}

static json_t *error_of(const ff_point *point, const ff_point *reference, const char *output,
                        double floor, double *largest)
{
    ff_difference d;
    *largest = NAN;
    if (!point->values || !ff_point_compare(point, reference, output, &d))
        return json_null();
    *largest = d.largest;
    json_t *error = json_pack("{s:f, s:f}", "largest", d.largest, "rms", d.rms);
    const json_t *claim = json_object_get(
        json_object_get(json_object_get(point->record, "measured"), "claims"), output);
    if (claim)
        json_object_update_new(error,
                               json_pack("{s:f, s:s}", "claimed", json_number_value(claim), "claim",
                                         judge(json_number_value(claim), d.largest, floor)));
    return error;
}

static json_t *describe_reference(const ff_study *study, const ff_point *points, size_t levels)
{
    const ff_measure *m = study->measure;
    json_t *list = json_array();
    bool reached = levels > 1;
    for (size_t level = 0; level < levels; level++) {
        json_t *changes = json_object();
        for (size_t i = 0; level > 0 && i < m->output_count; i++) {
            const char *output = m->request->items[i]->text;
            ff_difference d;
            bool good = ff_point_compare(&points[level - 1], &points[level], output, &d);
            json_object_set_new(changes, output, real(good ? d.largest : NAN));
            if (level == levels - 1)
                reached = reached && good && d.largest <= study->tradeoff->accuracy / 10;
        }
        json_array_append_new(
            list, json_pack("{s:s, s:o, s:o}", "label", study->tradeoff->labels[level], "seconds",
                            real(work_of(points[level].record)), "change", changes));
    }
    return json_pack("{s:b, s:o}", "reached", reached, "levels", list);
}

/* Wall time of the stages that all candidates share, whenever they were computed. */
static double shared_of(const json_t *record)
{
    const json_t *work = json_object_get(json_object_get(record, "measured"), "work");
    const char *stage;
    json_t *value;
    double sum = 0;
    for (const char *const *key = (const char *const[]){"stages", "reused", NULL}; *key; key++)
        json_object_foreach(json_object_get(record, *key), stage, value) sum +=
            json_object_get(work, stage) ? 0 : json_number_value(value);
    return sum;
}

/* What each step along the front costs and gains. */
static json_t *describe_front(const double *cost, const double *error, size_t count)
{
    size_t *front = ff_alloc((count + 1) * sizeof *front);
    size_t length = ff_front(cost, error, count, front);
    size_t knee = ff_front_knee(cost, error, front, length);
    json_t *list = json_array();
    for (size_t i = 0; i < length; i++) {
        json_t *one =
            json_pack("{s:I, s:f, s:f, s:b}", "candidate", (json_int_t)front[i], "seconds",
                      cost[front[i]], "error", error[front[i]], "knee", i == knee);
        if (i > 0)
            json_object_update_new(
                one, json_pack("{s:f, s:f}", "times_the_cost", cost[front[i]] / cost[front[i - 1]],
                               "part_of_the_error", error[front[i]] / error[front[i - 1]]));
        json_array_append_new(list, one);
    }
    free(front);
    return list;
}

static json_t *describe_candidate(const ff_study *study, const ff_point *point, size_t c,
                                  const json_t *records, double *cost)
{
    const ff_tradeoff *t = study->tradeoff;
    json_t *set = json_object(), *record = json_object(), *assignments = json_array();
    for (size_t k = 0; k < study->varied_count; k++) {
        const ff_varied *varied = &study->varied[k];
        const char *assignment = varied->assignments[t->levels + c];
        if (!assignment[0])
            continue;
        json_object_set_new(set, varied->path, json_string(varied->names[t->levels + c]));
        json_array_append_new(assignments, json_string(assignment));
    }
    json_object_set_new(record, "label", json_string(t->labels[t->levels + c]));
    json_object_set_new(record, "set", set);
    json_object_set_new(record, "assignments", assignments);
    for (const char *const *key = (const char *const[]){"status", "reason", NULL}; *key; key++)
        if (json_object_get(point->record, *key))
            json_object_set(record, *key, json_object_get(point->record, *key));
    json_object_set_new(record, "seconds", cost_of(point, records, cost));
    json_object_set_new(record, "shared_seconds", json_real(shared_of(point->record)));
    json_t *counts = json_object_get(json_object_get(point->record, "measured"), "counts");
    json_object_set_new(record, "counts", counts ? json_incref(counts) : json_object());
    return record;
}

json_t *ff_tradeoff_result(const ff_study *study, const ff_point *points, size_t levels,
                           const json_t *records)
{
    const ff_tradeoff *t = study->tradeoff;
    const ff_measure *m = study->measure;
    const ff_point *reference = &points[levels - 1], *candidates = &points[t->levels];
    json_t *list = json_array(), *fronts = json_object();
    double *cost = ff_alloc(t->candidates * sizeof *cost);
    double *error = ff_alloc(t->candidates * sizeof *error);
    for (size_t c = 0; c < t->candidates; c++) {
        json_t *one = describe_candidate(study, &candidates[c], c, records, &cost[c]);
        json_object_set_new(one, "errors", json_object());
        json_array_append_new(list, one);
    }
    for (size_t i = 0; i < m->output_count; i++) {
        const char *output = m->request->items[i]->text;
        double floor = floor_of(points, levels, output);
        for (size_t c = 0; c < t->candidates; c++) {
            json_t *errors = json_object_get(json_array_get(list, c), "errors");
            json_object_set_new(errors, output,
                                error_of(&candidates[c], reference, output, floor, &error[c]));
            if (isfinite(error[c])) /* below that, none is known to be better */
                error[c] = fmax(error[c], fmax(floor, 1e-15));
        }
        for (size_t c = 0; c < t->candidates; c++) {
            json_t *one =
                json_object_get(json_object_get(json_array_get(list, c), "errors"), output);
            if (json_is_object(one))
                json_object_set_new(one, "over_front",
                                    real(ff_front_excess(cost, error, t->candidates, c)));
        }
        json_object_set_new(fronts, output,
                            json_pack("{s:f, s:o}", "reference_error", floor, "front",
                                      describe_front(cost, error, t->candidates)));
    }
    free(cost);
    free(error);
    return json_pack("{s:o, s:o, s:f, s:o, s:o, s:o}", "date", today(), "processor", processor(),
                     "accuracy", t->accuracy, "reference",
                     describe_reference(study, points, levels), "candidates", list, "outputs",
                     fronts);
}
