/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads what a case gave from its record in the journal. */
#include "context.h"

#include "case.h"

#include <math.h>
#include <string.h>

static double number_of(const json_t *value)
{
    return json_is_number(value) ? json_number_value(value) : (double)NAN;
}

static const char *text_of(study_context *context, const json_t *value)
{
    const char *text = json_string_value(value);
    return memory_arena_text(&context->arena, text ? text : "", text ? strlen(text) : 0);
}

static const double *numbers_of(study_context *context, const json_t *list, size_t *count)
{
    *count = json_array_size(list);
    double *values = memory_arena_alloc(&context->arena, (*count + 1) * sizeof *values);
    for (size_t i = 0; i < *count; i++)
        values[i] = number_of(json_array_get(list, i));
    return values;
}

/* Reads an output from the case's file of values, else a scalar from the record. */
static study_output read_output(study_context *context, const json_t *record, const json_t *values,
                                const char *name)
{
    const json_t *pair = json_object_get(json_object_get(record, "outputs"), name);
    const json_t *one = json_object_get(values, name), *at = json_object_get(one, "at");
    const json_t *own = json_object_get(one, "values");
    size_t points = 0;
    study_output output = {.rank = (size_t)json_integer_value(json_object_get(one, "rank")),
                           .along = text_of(context, json_object_get(one, "along"))};
    if (own)
        output.values = numbers_of(context, own, &output.count);
    if (at)
        output.at = numbers_of(context, at, &points);
    if (at && points != output.count)
        output.at = NULL;
    if (!own && pair) {
        double *scalar = memory_arena_alloc(&context->arena, sizeof *scalar);
        *scalar = number_of(json_array_get(pair, 1));
        output.values = scalar;
        output.count = 1;
    }
    return output;
}

static void read_outputs(study_context *context, const json_t *record, study_outcome *outcome)
{
    size_t own = context->output_count, count = own + context->extra_count;
    json_t *values = study_record_is_ok(record) && context->measured
                         ? study_measure_values(context->run->directory, outcome->key)
                         : NULL;
    outcome->outputs = memory_arena_alloc(&context->arena, (count + 1) * sizeof *outcome->outputs);
    for (size_t i = 0; i < count; i++)
        outcome->outputs[i] =
            read_output(context, record, values,
                        i < own ? context->outputs[i]->text : context->extras[i - own]);
    json_decref(values);
}

/* Reads the lines [value, limit, verdict, text] of all stages. */
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
                        .value = number_of(json_array_get(line, 0)),
                        .limit = number_of(json_array_get(line, 1)),
                        .verdict = (int)json_integer_value(json_array_get(line, 2)),
                        .text = text_of(context, json_array_get(line, 3))};
}

/* Sums the processor time of the stages in which cases differ, and the wall time of those that they
   share, even when an earlier case computed these. */
static void read_costs(const json_t *record, study_outcome *outcome)
{
    json_t *work = json_object_get(json_object_get(record, "measured"), "work"), *value;
    const char *stage;
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
