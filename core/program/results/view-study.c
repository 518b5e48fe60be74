/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the directory of a study: study.json describes it, and the journals contain the results of
 * its cases. */
#include "view-tables.h"

#include "../memory/file.h"

#include "../study/store/records.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CASES = 100000000 };

/* Reads the lengths and counts the cases; false if there are none, or too many. */
static bool read_lengths(results_reader *reader, const json_t *lengths)
{
    size_t count = json_array_size(lengths);
    size_t *copy = memory_arena_alloc(&reader->arena, (count + 1) * sizeof *copy);
    double cases = 1;
    for (size_t i = 0; i < count; i++) {
        copy[i] = (size_t)json_integer_value(json_array_get(lengths, i));
        cases *= (double)copy[i];
    }
    reader->view.lengths = copy;
    reader->view.dimension_count = count;
    reader->view.case_count = cases <= MOST_CASES ? (size_t)cases : 0;
    return cases >= 1 && cases <= MOST_CASES;
}

static bool add_axis(results_reader *reader, const json_t *entry)
{
    const json_t *words = json_object_get(entry, "words"),
                 *numbers = json_object_get(entry, "values");
    size_t dimension = (size_t)json_integer_value(json_object_get(entry, "dimension"));
    size_t count = json_array_size(words);
    if (dimension >= reader->view.dimension_count || count != reader->view.lengths[dimension] ||
        (numbers && json_array_size(numbers) != count))
        return false;
    const char **texts = memory_arena_alloc(&reader->arena, count * sizeof *texts);
    double *values = numbers ? memory_arena_alloc(&reader->arena, count * sizeof *values) : NULL;
    for (size_t i = 0; i < count; i++) {
        texts[i] = results_view_text(reader, json_array_get(words, i));
        if (values)
            values[i] = json_number_value(json_array_get(numbers, i));
    }
    results_view_axis *axis = results_view_add_row(reader, &reader->axes, sizeof *axis);
    *axis = (results_view_axis){.path = results_view_member(reader, entry, "path"),
                                .dimension = dimension,
                                .unit = results_view_member(reader, entry, "unit"),
                                .values = values,
                                .words = texts};
    return true;
}

/* Returns the assignments of a case in the form of its record: {path: value}. */
static json_t *assignments_of(const results_reader *reader, size_t index)
{
    json_t *set = json_object();
    for (size_t k = 0; k < reader->axes.count; k++) {
        const results_view_axis *axis = reader->axes.rows[k];
        size_t point = results_view_point(&reader->view, index, axis->dimension);
        json_object_set_new(set, axis->path, json_string(axis->words[point]));
    }
    return set;
}

/* Reads the key of each case from table.csv, which exists after the first run has ended. */
static void read_keys(results_reader *reader)
{
    FILE *stream = file_stream(reader->directory, "table.csv");
    char *line = NULL, key[STUDY_KEY_SIZE];
    size_t size = 0, number;
    while (stream && getline(&line, &size, stream) > 0)
        if (sscanf(line, "%zu,%19[^,],", &number, key) == 2 && number >= 1 &&
            number <= reader->view.case_count)
            memcpy(reader->per_case[number - 1].key, key, sizeof key);
    free(line);
    if (stream)
        fclose(stream);
}

/* Finds cases of an unfinished study that the table does not contain, by the assignments in their
 * records; a later record replaces an earlier one. If the file was changed since, its old records
 * belong to other cases. */
static void match_records(results_reader *reader, study_records *records, const json_t *input)
{
    uint64_t *ranks = memory_alloc((reader->view.case_count + 1) * sizeof *ranks), rank;
    bool *listed = memory_alloc((reader->view.case_count + 1) * sizeof *listed);
    size_t at = 0, missing = 0;
    json_t *record;
    for (size_t i = 0; i < reader->view.case_count; i++)
        missing += !(listed[i] = reader->per_case[i].key[0]);
    for (; missing && (record = study_records_next(records, &at, &rank)); json_decref(record)) {
        const char *key = json_string_value(json_object_get(record, "key"));
        size_t number = (size_t)json_integer_value(json_object_get(record, "case"));
        const json_t *own = json_object_get(record, "input");
        if (number < 1 || number > reader->view.case_count || strlen(key) >= STUDY_KEY_SIZE ||
            listed[number - 1] || rank < ranks[number - 1] ||
            (input && own && !json_equal(input, own)))
            continue;
        json_t *set = assignments_of(reader, number - 1);
        if (json_equal(set, json_object_get(record, "set"))) {
            results_case *of = &reader->per_case[number - 1];
            snprintf(of->key, sizeof of->key, "%s", key);
            ranks[number - 1] = rank;
        }
        json_decref(set);
    }
    free(ranks);
    free(listed);
}

/* Adds scalars: [unit, value]. */
static void add_scalars(results_reader *reader, const json_t *docs, json_t *outputs)
{
    const char *name;
    json_t *pair;
    json_object_foreach(outputs, name, pair)
    {
        const json_t *value = json_array_get(pair, 1);
        const results_entry told = {.unit = json_array_get(pair, 0),
                                    .doc = json_object_get(docs, name)};
        results_output *made = results_view_add_output(reader, name, &told, RESULTS_VIEW_ASKED);
        if (made)
            made->value = json_is_number(value) ? json_number_value(value) : (double)NAN;
    }
}

/* Adds arrays: [unit, dims, shape, offset, against]. */
static void add_arrays(results_reader *reader, const json_t *docs, json_t *arrays)
{
    const char *name;
    json_t *entry;
    json_object_foreach(arrays, name, entry)
    {
        const results_entry told = {.unit = json_array_get(entry, 0),
                                    .dims = json_array_get(entry, 1),
                                    .shape = json_array_get(entry, 2),
                                    .against = json_array_get(entry, 4),
                                    .doc = json_object_get(docs, name)};
        results_output *made = results_view_add_output(reader, name, &told, RESULTS_VIEW_ASKED);
        if (made)
            made->offset = (off_t)json_integer_value(json_array_get(entry, 3));
    }
}

static void add_quality(results_reader *reader, results_view_case *c, json_t *stages)
{
    results_rows rows = {.rows = NULL};
    const char *stage, *name;
    json_t *lines, *line;
    json_object_foreach(stages, stage, lines) json_object_foreach(lines, name, line)
        results_view_add_quality(reader, &rows, stage, name, line,
                                 json_string_value(json_array_get(line, 3)),
                                 json_string_value(json_array_get(line, 4)));
    c->quality_count = rows.count;
    c->quality = results_view_take_rows(reader, &rows);
}

static void add_case(results_reader *reader, size_t index, const json_t *record, const json_t *docs)
{
    const json_t *status = json_object_get(record, "status"),
                 *seconds = json_object_get(record, "seconds");
    results_view_case *c = results_view_add_row(reader, &reader->cases, sizeof *c);
    results_case *of = &reader->per_case[index];
    *c = (results_view_case){
        .status = status ? results_view_shared_text(reader, json_string_value(status)) : "not run",
        .reason = results_view_member(reader, record, "reason"),
        .command = results_view_member(reader, record, "command"),
        .seconds = seconds ? json_number_value(seconds) : (double)NAN,
    };
    add_scalars(reader, docs, json_object_get(record, "outputs"));
    add_arrays(reader, docs, json_object_get(record, "arrays"));
    results_view_take_outputs(reader, of);
    of->log = results_view_shared_text(
        reader, json_string_value(json_array_get(json_object_get(record, "log"), 0)));
    add_quality(reader, c, json_object_get(record, "quality"));
    results_view_judge(reader, c, index + 1, record);
}

static bool refuse(results_reader *reader, const char *what)
{
    return ff_error(reader->report, FF_FAULT_INPUT, FF_NOWHERE,
                    "run the study again; cases that are done are not repeated", "%s/%s %s",
                    reader->path, study_description, what);
}

bool results_view_read_study(results_reader *reader)
{
    const char *model;
    json_t *entry;
    size_t i;
    bool good = true;
    if (!study_check_format(reader->path, reader->report))
        return false;
    json_t *study = results_view_read_json(reader, study_description);
    if (!study)
        return refuse(reader, errno ? "is missing" : "is not a description of a study");
    const json_t *length = json_array_get(json_object_get(study, "lengths"), 0);
    if (json_is_integer(length) && json_integer_value(length) == 0) {
        json_decref(study);
        return refuse(reader,
                      "lists no cases; rows from standard input are listed after the last one");
    }
    reader->view.study = true;
    results_view_add_head(reader, study);
    good = read_lengths(reader, json_object_get(study, "lengths"));
    json_array_foreach(json_object_get(study, "axes"), i, entry) good =
        good && add_axis(reader, entry);
    json_object_foreach(json_object_get(study, "models"), model, entry)
        results_view_add_citation(reader, model, entry);
    json_object_del(study, "axes"); /* the points name all cases, and have been copied */
    if (good) {
        study_records *records = study_records_open(reader->path, false);
        reader->per_case = memory_alloc(reader->view.case_count * sizeof *reader->per_case);
        read_keys(reader);
        match_records(reader, records, json_object_get(study, "key"));
        for (i = 0; i < reader->view.case_count; i++) {
            json_t *record = study_records_get(records, reader->per_case[i].key);
            add_case(reader, i, record, json_object_get(study, "docs"));
            json_decref(record);
        }
        study_records_close(records);
    }
    json_decref(study);
    return good || refuse(reader, "is not a description of a study");
}
