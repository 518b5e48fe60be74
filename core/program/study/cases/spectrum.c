/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The durations of the rows of a load spectrum, and the sums over them. */
#include "spectrum.h"

#include "case.h"

#include "../../run/run.h"
#include "../store/array-read.h"
#include "../store/journal.h"

#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char study_time_name[] = "time";

enum { MOST_VALUES = 1000 }; /* beyond this many rows, only the sums are listed */

/* If the shares differ from 100 % by more than this, a load class is missing, even if they are
   given with few digits. */
static const double most_rounding = 1e-2;

static const char expected[] = "expected a share such as 12 %, or a time such as 300 h, 0 or above";

/* Returns half a unit of the last digit of a share. */
static double rounding_of(const char *text, double share)
{
    const char *end, *point = strpbrk(text, ".eE");
    double number = 0, exponent = 0;
    if (!ff_number_parse(text, &number, &end) || !(number > 0))
        return 0;
    double digits = point && *point == '.' ? (double)strspn(point + 1, "0123456789") : 0;
    const char *power = strpbrk(text, "eE");
    if (power && power < end)
        exponent = strtod(power + 1, NULL);
    return 0.5 * pow(10, exponent - digits) * share / number;
}

/* Reads a quantity in a unit. Returns false if it has another dimension. */
static bool read_in(const char *text, const char *unit, double *value, char *why, size_t size)
{
    ff_unit row;
    return ff_unit_parse(unit, &row, why, size) &&
           ff_quantity_parse(text, &row, unit, value, why, size);
}

bool study_spectrum_add(study_definition *study, const char *text, ff_place place, bool *empty,
                        ff_report *report)
{
    char why[300];
    double value = 0;
    study_spectrum *s = study->spectrum;
    bool share = read_in(text, "1", &value, why, sizeof why);
    if (!(share || read_in(text, "s", &value, why, sizeof why)) || !(value >= 0))
        return ff_error(report, FF_FAULT_INPUT, place, NULL, "time: %s", expected);
    if (!s)
        s = study->spectrum = memory_arena_alloc(&study->arena, sizeof *s);
    if (s->count + s->empty == 0)
        s->shares = share;
    if (s->shares != share)
        return ff_error(report, FF_FAULT_INPUT, place, NULL,
                        "time: shares and times are mixed: either all rows have shares or all "
                        "have times");
    *empty = !(value > 0);
    s->empty += *empty;
    if (*empty)
        return true;
    s->rounding += share ? rounding_of(text, value) : 0;
    if (s->count == s->room) {
        s->room = s->room ? 2 * s->room : 16;
        s->times = memory_resize(s->times, s->room * sizeof *s->times);
    }
    s->times[s->count++] = value;
    return true;
}

static bool read_below(study_definition *study, const ff_node *below, ff_report *report)
{
    study_spectrum *s = study->spectrum;
    if (below->kind != FF_MAP || below->count == 0)
        return ff_error(report, FF_FAULT_INPUT, below->place,
                        "write below: {film.lambda_ratio_lowest: 1}",
                        "study: below: expected a map from scalars to limits");
    s->below = memory_arena_alloc(&study->arena, below->count * sizeof *s->below);
    for (size_t i = 0; i < below->count; i++) {
        const ff_node *limit = below->items[i];
        if (limit->kind != FF_SCALAR)
            return ff_error(report, FF_FAULT_INPUT, limit->place, NULL,
                            "study: below: %.100s: expected one limit", below->keys[i]);
        s->below[s->below_count++] =
            (study_limit){below->keys[i], limit->text, below->key_places[i], limit->place};
    }
    return true;
}

bool study_spectrum_finish(study_definition *study, const ff_node *cases, const ff_node *below,
                           ff_report *report)
{
    study_spectrum *s = study->spectrum;
    double sum = 0;
    if (!s)
        return !below || ff_error(report, FF_FAULT_INPUT, below->place,
                                  "a column time [%], or time: 12 % in each row of a list",
                                  "study: below: the cases have no time");
    for (size_t i = 0; i < s->count; i++)
        sum += s->times[i];
    if (s->shares && !(fabs(sum - 1) <= fmin(s->rounding, most_rounding) + 1e-9))
        return ff_error(report, FF_FAULT_INPUT, cases->place, "times such as 300 h need no sum",
                        "study: cases: the shares of the time sum to %.6g %%, not to 100 %%",
                        100 * sum);
    s->stated = sum;
    for (size_t i = 0; s->shares && i < s->count; i++)
        s->times[i] /= sum;
    return !below || read_below(study, below, report);
}

/* Returns the unit of a requested output, or NULL if it is not requested. */
static const char *find_unit(const ff_pipeline *pipeline, const char *path)
{
    const ff_stage *stage;
    const ff_result *result = run_output(pipeline, path, &stage);
    bool scalar = result && result->wanted && (!result->row->dims || !*result->row->dims);
    return scalar ? result->row->unit : NULL;
}

void study_spectrum_check(const study_definition *study, const ff_pipeline *pipeline,
                          ff_report *report)
{
    const study_spectrum *s = study->spectrum;
    for (size_t i = 0; s && i < s->below_count; i++) {
        const study_limit *limit = &s->below[i];
        const char *unit = find_unit(pipeline, limit->output);
        double value;
        char why[300];
        if (!unit)
            ff_error(report, FF_FAULT_INPUT, limit->place, "request it under outputs",
                     "study: below: %.100s is not a scalar that the cases give", limit->output);
        else if (!read_in(limit->text, unit, &value, why, sizeof why))
            ff_error(report, FF_FAULT_INPUT, limit->at, NULL, "study: below: %.100s: %s",
                     limit->output, why);
    }
}

/* Sums over the rows for one output. */
typedef struct sum {
    double time, integral; /* time of the rows with numbers, and integral over this time */
    double low, high;
    size_t low_row, high_row;
    bool series;
} sum;

static void add_value(sum *of, double value, double time, size_t row)
{
    if (!isfinite(value))
        return;
    of->time += time;
    of->integral += time * value;
    if (of->low_row == 0 || value < of->low) {
        of->low = value;
        of->low_row = row + 1;
    }
    if (of->high_row == 0 || value > of->high) {
        of->high = value;
        of->high_row = row + 1;
    }
}

/* The numbers of all rows, with one entry for each output. */
typedef struct reading {
    const study_definition *study;
    json_t *names; /* {output: [index in `sums`, unit]} */
    sum *sums;
    size_t count;
    json_t *stages;
    json_t *values;          /* {output: [value of each row]}; NULL if there are too many rows */
    double missing, refused; /* time of the rows without numbers, and of the refused rows */
    size_t refused_rows, first_refused; /* their number, and the number of the first, from 1 */
    char *reason;                       /* reason of the first refused row */
    /* for each entry of `below`: the limit in SI, the time below it, and the number of rows */
    double *limits, *shares;
    size_t *rows;
} reading;

static sum *sum_of(reading *r, const char *name, const json_t *unit)
{
    json_t *entry = json_object_get(r->names, name);
    if (entry)
        return &r->sums[json_integer_value(json_array_get(entry, 0))];
    r->sums = memory_resize(r->sums, (r->count + 1) * sizeof *r->sums);
    r->sums[r->count] = (sum){.time = 0};
    json_object_set_new(r->names, name,
                        json_pack("[I, O]", (json_int_t)r->count, (json_t *)(size_t)unit));
    return &r->sums[r->count++];
}

static void count_stages(reading *r, const json_t *record, const char *member, const char *count)
{
    const char *stage;
    json_t *seconds;
    json_object_foreach(json_object_get(record, member), stage, seconds)
    {
        json_t *of = json_object_get(r->stages, stage);
        if (!of)
            json_object_set_new(r->stages, stage,
                                of = json_pack("{s:i, s:i}", "computed", 0, "reused", 0));
        json_object_set_new(of, count,
                            json_integer(json_integer_value(json_object_get(of, count)) + 1));
    }
}

static json_t *values_of(reading *r, const char *name)
{
    json_t *list = json_object_get(r->values, name);
    if (list)
        return list;
    list = json_array();
    for (size_t i = 0; i < r->study->count; i++)
        json_array_append_new(list, json_null());
    json_object_set_new(r->values, name, list);
    return list;
}

static void add_scalars(reading *r, const json_t *record, size_t row)
{
    const study_spectrum *s = r->study->spectrum;
    const char *name;
    json_t *pair, *outputs = json_object_get(record, "outputs");
    json_object_foreach(outputs, name, pair)
    {
        const json_t *value = json_array_get(pair, 1);
        if (r->values && json_is_number(value))
            json_array_set(values_of(r, name), row, (json_t *)(size_t)value);
        if (json_is_number(value))
            add_value(sum_of(r, name, json_array_get(pair, 0)), json_number_value(value),
                      s->times[row], row);
    }
    for (size_t i = 0; i < s->below_count; i++) {
        const json_t *value = json_array_get(json_object_get(outputs, s->below[i].output), 1);
        bool under = json_is_number(value) && json_number_value(value) < r->limits[i];
        r->shares[i] += under ? s->times[row] : 0;
        r->rows[i] += under;
    }
}

static bool add_arrays(reading *r, arrays_reader *logs, const json_t *record, size_t row,
                       const char *directory, ff_report *report)
{
    const char *name;
    json_t *entry;
    json_object_foreach(json_object_get(record, "arrays"), name, entry)
    {
        memory_arena arena = {0};
        char why[ARRAYS_WHY] = "";
        size_t rank, count;
        const double *values = study_array_read(logs, record, name, &arena, &rank, &count, why);
        sum *of = values ? sum_of(r, name, json_array_get(entry, 0)) : NULL;
        for (size_t i = 0; of && i < count; i++)
            add_value(of, values[i], r->study->spectrum->times[row] / (double)count, row);
        if (of)
            of->series = true;
        memory_arena_free(&arena);
        if (!values)
            return ff_error(
                report, FF_FAULT_INPUT, FF_NOWHERE, "flankfilm run --rerun all writes it again",
                "an array of row %zu in %s cannot be read: %s", row + 1, directory, why);
    }
    return true;
}

static json_t *describe_outputs(const reading *r)
{
    json_t *outputs = json_object(), *entry;
    const char *name;
    json_object_foreach(r->names, name, entry)
    {
        const sum *of = &r->sums[json_integer_value(json_array_get(entry, 0))];
        const char *unit = json_string_value(json_array_get(entry, 1));
        double mean = of->time > 0 ? of->integral / of->time : (double)NAN;
        json_t *one = json_pack("{s:s}", "unit", unit);
        json_object_set_new(one, "mean", study_json_real(of->series ? (double)NAN : mean));
        if (!of->series && !r->study->spectrum->shares && !strcmp(unit, "W"))
            json_object_set_new(one, "energy", study_json_real(of->integral));
        json_object_set_new(one, "lowest", study_json_real(of->low));
        json_object_set_new(one, "lowest_row", json_integer((json_int_t)of->low_row));
        json_object_set_new(one, "highest", study_json_real(of->high));
        json_object_set_new(one, "highest_row", json_integer((json_int_t)of->high_row));
        if (json_object_get(r->values, name))
            json_object_set(one, "values", json_object_get(r->values, name));
        json_object_set_new(outputs, name, one);
    }
    return outputs;
}

static json_t *describe(const reading *r, const ff_pipeline *pipeline)
{
    const study_spectrum *s = r->study->spectrum;
    double time = 0;
    json_t *below = json_array();
    for (size_t i = 0; i < s->count; i++)
        time += s->times[i];
    for (size_t i = 0; i < s->below_count; i++)
        json_array_append_new(
            below, json_pack("{s:s, s:o, s:s, s:o, s:I}", "output", s->below[i].output, "limit",
                             study_json_real(r->limits[i]), "unit",
                             find_unit(pipeline, s->below[i].output), "share",
                             study_json_real(r->shares[i] / time), "rows", (json_int_t)r->rows[i]));
    json_t *refused = json_pack("{s:I, s:o, s:I, s:s?}", "rows", (json_int_t)r->refused_rows,
                                "share", study_json_real(r->refused / time), "row",
                                (json_int_t)r->first_refused, "reason", r->reason);
    return json_pack(
        "{s:I, s:o, s:s, s:o, s:I, s:o, s:o, s:o, s:o, s:O}", "rows", (json_int_t)s->count, "time",
        study_json_real(time), "unit", s->shares ? "1" : "s", "stated",
        study_json_real(s->shares ? s->stated : (double)NAN), "empty", (json_int_t)s->empty,
        "refused", refused, "missing", study_json_real(r->missing / time), "outputs",
        describe_outputs(r), "below", below, "stages", r->stages);
}

static void note_refused(reading *r, const json_t *record, size_t row)
{
    const char *status = json_string_value(json_object_get(record, "status"));
    const char *reason = json_string_value(json_object_get(record, "reason"));
    if (!status || strcmp(status, study_refused) != 0)
        return;
    r->refused += r->study->spectrum->times[row];
    if (r->refused_rows++ > 0 || !reason)
        return;
    r->first_refused = row + 1;
    r->reason = memory_copy_text(reason, strlen(reason));
}

static bool read_rows(reading *r, const study_run *run, char (*keys)[STUDY_KEY_SIZE],
                      ff_report *report)
{
    bool good = true;
    int directory = open(run->directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    study_records *records = study_records_open(run->directory, false);
    arrays_reader logs;
    arrays_reader_open(&logs, directory);
    for (size_t i = 0; good && i < run->study->count; i++) {
        json_t *record = study_records_get(records, keys[i]);
        bool ok = record && study_record_is_ok(record);
        if (ok) {
            add_scalars(r, record, i);
            count_stages(r, record, "stages", "computed");
            count_stages(r, record, "reused", "reused");
            good = add_arrays(r, &logs, record, i, run->directory, report);
        }
        note_refused(r, record, i);
        r->missing += ok ? 0 : run->study->spectrum->times[i];
        json_decref(record);
    }
    arrays_reader_close(&logs);
    study_records_close(records);
    if (directory >= 0)
        close(directory);
    return good;
}

json_t *study_spectrum_sums(const study_run *run, char (*keys)[STUDY_KEY_SIZE], ff_report *report)
{
    const study_spectrum *s = run->study->spectrum;
    char why[300];
    reading r = {.study = run->study,
                 .names = json_object(),
                 .values = s->count <= MOST_VALUES ? json_object() : NULL,
                 .stages = json_object(),
                 .limits = memory_alloc((s->below_count + 1) * sizeof *r.limits),
                 .shares = memory_alloc((s->below_count + 1) * sizeof *r.shares),
                 .rows = memory_alloc((s->below_count + 1) * sizeof *r.rows)};
    for (size_t i = 0; i < s->below_count; i++)
        read_in(s->below[i].text, find_unit(run->pipeline, s->below[i].output), &r.limits[i], why,
                sizeof why);
    json_t *sums = read_rows(&r, run, keys, report) ? describe(&r, run->pipeline) : NULL;
    json_decref(r.names);
    json_decref(r.stages);
    json_decref(r.values);
    free(r.reason);
    free(r.sums);
    free(r.limits);
    free(r.shares);
    free(r.rows);
    return sums;
}
