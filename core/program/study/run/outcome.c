/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the results of a case from its record in the journal. */
#include "context.h"

#include "../cases/case.h"
#include "../store/array-read.h"

#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

static const char *text_of(study_context *context, const json_t *value)
{
    const char *text = json_string_value(value);
    return memory_arena_text(&context->arena, text ? text : "", text ? strlen(text) : 0);
}

static const double *read_array(study_context *context, arrays_reader *reader, const json_t *record,
                                const char *name, size_t *rank, size_t *count)
{
    char why[ARRAYS_WHY];
    const double *values =
        study_array_read(reader, record, name, &context->arena, rank, count, why);
    if (!values && *why)
        ff_error(context->report, FF_FAULT_INPUT, FF_NOWHERE,
                 "flankfilm run --rerun all writes it again", "%s/%s cannot be read: %s",
                 context->run->directory,
                 json_string_value(json_array_get(json_object_get(record, "log"), 0)), why);
    return values;
}

/* Reads a scalar, or an array with the series over which it is plotted. */
static study_output read_output(study_context *context, arrays_reader *reader, const json_t *record,
                                const char *name)
{
    const json_t *pair = json_object_get(json_object_get(record, "outputs"), name);
    const json_t *along = json_object_get(json_object_get(record, "measured"), "along");
    study_output output = {.along = text_of(context, json_object_get(along, name))};
    size_t points = 0, rank = 0;
    if (pair) {
        double *scalar = memory_arena_alloc(&context->arena, sizeof *scalar);
        *scalar = study_json_number(json_array_get(pair, 1));
        output.values = scalar;
        output.count = 1;
        return output;
    }
    output.values = read_array(context, reader, record, name, &output.rank, &output.count);
    if (!output.values || !*output.along)
        return output;
    const char *axis =
        study_context_format(context, "%.*s.%s", (int)strcspn(name, "."), name, output.along);
    output.at = read_array(context, reader, record, axis, &rank, &points);
    if (points != output.count)
        output.at = NULL;
    return output;
}

static void read_outputs(study_context *context, const json_t *record, study_outcome *outcome)
{
    size_t own = context->output_count, count = own + context->extra_count;
    int directory = open(context->run->directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    arrays_reader reader;
    arrays_reader_open(&reader, directory);
    outcome->outputs = memory_arena_alloc(&context->arena, (count + 1) * sizeof *outcome->outputs);
    for (size_t i = 0; i < count; i++)
        outcome->outputs[i] =
            read_output(context, &reader, record,
                        i < own ? context->outputs[i]->text : context->extras[i - own]);
    arrays_reader_close(&reader);
    if (directory >= 0)
        close(directory);
}

/* Reads the quality lines [value, limit, verdict, text] of all stages. */
static void read_quality(study_context *context, const json_t *record, study_outcome *outcome)
{
    json_t *stages = json_object_get(record, "quality"), *lines, *line;
    const char *stage, *name;
    size_t count = 0;
    json_object_foreach(stages, stage, lines) count += json_object_size(lines);
    outcome->quality = memory_arena_alloc(&context->arena, (count + 1) * sizeof *outcome->quality);
    json_object_foreach(stages, stage, lines) json_object_foreach(lines, name, line)
        outcome->quality[outcome->quality_count++] =
        (study_quality){.name = study_context_format(context, "%.80s.%.80s", stage, name),
                        .value = study_json_number(json_array_get(line, 0)),
                        .limit = study_json_number(json_array_get(line, 1)),
                        .verdict = (int)json_integer_value(json_array_get(line, 2)),
                        .text = text_of(context, json_array_get(line, 3))};
}

/* Sums the processor time of the stages in which cases differ, and the wall time of the shared
   stages, including those that an earlier case has computed. */
static void read_costs(const json_t *record, study_outcome *outcome)
{
    json_t *work = json_object_get(json_object_get(record, "measured"), "work"), *value;
    const char *stage;
    outcome->processor = study_json_number(json_object_get(record, "processor"));
    outcome->saved = study_json_number(json_object_get(record, "processor_saved"));
    outcome->work = study_record_is_ok(record) ? 0 : (double)NAN;
    json_object_foreach(work, stage, value) outcome->work += json_number_value(value);
    for (const char *const *key = (const char *const[]){"stages", "reused", NULL}; *key; key++)
        json_object_foreach(json_object_get(record, *key), stage, value) outcome->shared +=
            json_object_get(work, stage) ? 0 : json_number_value(value);
}

static const study_outcome *read_outcome(study_context *context, const char *key)
{
    study_outcome *outcome = memory_arena_alloc(&context->arena, sizeof *outcome);
    json_t *record = context->records ? study_records_get(context->records, key) : NULL;
    outcome->key = memory_arena_text(&context->arena, key, strlen(key));
    outcome->status = record ? text_of(context, json_object_get(record, "status")) : "not run";
    outcome->reason = text_of(context, json_object_get(record, "reason"));
    read_outputs(context, record, outcome);
    read_quality(context, record, outcome);
    read_costs(record, outcome);
    json_decref(record);
    return outcome;
}

const study_outcome *study_outcome_of(study_context *context, size_t number)
{
    study_submitted *submitted = &context->cases[number];
    if (!submitted->outcome || !*submitted->outcome->key)
        submitted->outcome = read_outcome(context, context->keys[number]);
    return submitted->outcome;
}

const study_quality *study_line_of(const study_outcome *outcome, const char *name)
{
    for (size_t i = 0; i < outcome->quality_count; i++)
        if (!strcmp(outcome->quality[i].name, name))
            return &outcome->quality[i];
    return NULL;
}
