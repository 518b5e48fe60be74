/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the directory of a single run from its result.json. */
#include "json.h"
#include "view-tables.h"

#include "../accuracy/accuracy.h"
#include "../study/store/judgement.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* Adds the error bar of an output as another output. */
static void add_bar(results_reader *reader, const char *name, const results_entry *of,
                    json_t *error)
{
    results_entry told = *of;
    char *bar = memory_print_text("%s" ACCURACY_BAR, name);
    told.doc = told.extremes = NULL;
    results_output *made = results_view_add_output(reader, bar, &told, 0);
    if (made)
        made->entry = error;
    free(bar);
}

/* Returns the names of the outputs of which only a lower bound is known. */
static json_t *add_outputs(results_reader *reader, json_t *outputs, uint32_t flags)
{
    json_t *names = json_array();
    const char *name;
    json_t *entry;
    json_object_foreach(outputs, name, entry)
    {
        const json_t *label = json_object_get(entry, "label");
        const results_entry told = {.unit = json_object_get(entry, "unit"),
                                    .dims = json_object_get(entry, "dims"),
                                    .shape = json_object_get(entry, "shape"),
                                    .against = json_object_get(entry, "against"),
                                    .extremes = json_object_get(entry, "extremes"),
                                    .doc = label ? label : json_object_get(entry, "doc")};
        const uint32_t least =
            json_is_true(json_object_get(entry, "at_least")) ? RESULTS_VIEW_AT_LEAST : 0;
        results_output *made = results_view_add_output(reader, name, &told, flags | least);
        if (made)
            made->entry = entry;
        if (least)
            json_array_append_new(names, json_string(name));
        json_t *error = json_object_get(entry, "error");
        if (json_object_get(error, "value") || json_object_get(error, "data") ||
            json_object_get(error, "file"))
            add_bar(reader, name, &told, error);
    }
    return names;
}

static int verdict_of(const json_t *text)
{
    const char *word = json_string_value(text);
    return !word || !strcmp(word, "good") ? FF_GOOD
           : !strcmp(word, "doubtful")    ? FF_DOUBTFUL
                                          : FF_BAD;
}

static bool is_of_range(const json_t *line)
{
    const char *of = json_string_value(json_object_get(line, "of"));
    return of && !strcmp(of, "range");
}

/* Adds the quality lines and the times of the stages that ran. Also adds the lines to `judged`, in
 * the form of the record of a case. */
static void add_stages(results_reader *reader, results_view_case *c, const json_t *stages,
                       json_t *judged)
{
    results_rows rows = {.rows = NULL};
    json_t *stage, *line;
    const char *name;
    size_t i;
    c->seconds = 0;
    json_array_foreach(stages, i, stage)
    {
        const char *of = json_string_value(json_object_get(stage, "stage"));
        if (!of || !json_is_true(json_object_get(stage, "ran")))
            continue;
        c->seconds += json_number_value(json_object_get(stage, "seconds"));
        json_t *lines = json_object();
        json_object_foreach(json_object_get(stage, "quality"), name, line)
        {
            json_t *judged_line = json_pack(
                "[O?, O?, i, b]", json_object_get(line, "value"), json_object_get(line, "limit"),
                verdict_of(json_object_get(line, "verdict")), is_of_range(line));
            results_view_add_quality(reader, &rows, of, name, judged_line,
                                     json_string_value(json_object_get(line, "text")),
                                     json_string_value(json_object_get(line, "accepted")));
            json_object_set_new(lines, name, judged_line);
        }
        json_object_set_new(judged, of, lines);
    }
    c->quality_count = rows.count;
    c->quality = results_view_take_rows(reader, &rows);
}

bool results_view_read_run(results_reader *reader)
{
    json_t *root = reader->root = results_view_read_json(reader, "result.json");
    if (!root)
        return ff_error(reader->report, FF_FAULT_INPUT, FF_NOWHERE, "run the case again",
                        "%s/result.json cannot be read%s%s", reader->path, errno ? ": " : "",
                        errno ? strerror(errno) : "");
    json_int_t format = json_integer_value(json_object_get(root, "format"));
    if (format > RESULTS_FORMAT)
        return ff_error(reader->report, FF_FAULT_INPUT, FF_NOWHERE,
                        "read it with a newer flankfilm",
                        "%s/result.json has format %lld; this flankfilm reads up to %d",
                        reader->path, (long long)format, RESULTS_FORMAT);
    results_view_add_head(reader, root);
    results_view_case *c = results_view_add_row(reader, &reader->cases, sizeof *c);
    *c = (results_view_case){
        .status = results_view_member(reader, root, "status"),
        .reason = results_view_text(
            reader, json_object_get(json_array_get(json_object_get(root, "errors"), 0), "message")),
        .command = "",
    };
    reader->per_case = memory_alloc(sizeof *reader->per_case);
    json_t *least = add_outputs(reader, json_object_get(root, "outputs"), RESULTS_VIEW_ASKED);
    json_decref(add_outputs(reader, json_object_get(root, "computed"), 0));
    results_view_take_outputs(reader, &reader->per_case[0]);
    json_t *record = json_pack("{s:O?, s:{}, s:s, s:o, s:O?}", "status",
                               json_object_get(root, "status"), "quality", "key", "", "at_least",
                               least, "limits", json_object_get(root, "limits"));
    add_stages(reader, c, json_object_get(root, "stages"), json_object_get(record, "quality"));
    study_judge_record(record);
    results_view_judge(reader, c, 1, record);
    json_decref(record);
    return true;
}
