/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a case gave, as the model that asked for it sees it. */
#include "desk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double number_of(const json_t *value)
{
    return json_is_number(value) ? json_number_value(value) : (double)NAN;
}

static const char *text_of(study_desk *desk, const json_t *value)
{
    const char *text = json_string_value(value);
    return fe_arena_text(&desk->arena, text ? text : "", text ? strlen(text) : 0);
}

static const double *numbers_of(study_desk *desk, const json_t *list, size_t *count)
{
    *count = json_array_size(list);
    double *values = fe_arena_alloc(&desk->arena, (*count + 1) * sizeof *values);
    for (size_t i = 0; i < *count; i++)
        values[i] = number_of(json_array_get(list, i));
    return values;
}

/* An output from the case's file of values, else a scalar of the record. */
static const ff_study_output *output_of(study_desk *desk, const json_t *record,
                                        const json_t *values, const char *name)
{
    ff_study_output *output = fe_arena_alloc(&desk->arena, sizeof *output);
    const json_t *pair = json_object_get(json_object_get(record, "outputs"), name);
    const json_t *one = json_object_get(values, name), *at = json_object_get(one, "at");
    const json_t *data = json_object_get(one, "data"); /* in a file of all that the case gave */
    const json_t *own = data ? data : json_object_get(one, "values");
    size_t points = 0;
    *output = (ff_study_output){.size = sizeof *output,
                                .rank = (size_t)json_integer_value(json_object_get(one, "rank")),
                                .along = text_of(desk, json_object_get(one, "along"))};
    if (data)
        output->rank = json_array_size(json_object_get(one, "shape"));
    if (own)
        output->values = numbers_of(desk, own, &output->count);
    if (at)
        output->at = numbers_of(desk, at, &points);
    if (at && points != output->count)
        output->at = NULL;
    if (!own && pair) {
        double *scalar = fe_arena_alloc(&desk->arena, sizeof *scalar);
        *scalar = number_of(json_array_get(pair, 1));
        output->values = scalar;
        output->count = 1;
    }
    return output;
}

/* Of a case of a sweep, the series are in the file that shows them to others, too. */
static json_t *values_of(const study_desk *desk, const json_t *record, const char *key)
{
    if (!study_record_is_ok(record) || (!desk->list.measure && !desk->sweep))
        return NULL;
    if (!desk->sweep)
        return study_measure_values(desk->campaign->directory, key);
    char *path = fe_print_text("%s/cases/%s/arrays.json", desk->campaign->directory, key);
    json_t *all = json_load_file(path, 0, NULL);
    json_t *values = json_incref(json_object_get(all, "outputs"));
    json_decref(all);
    free(path);
    return values;
}

static void take_outputs(study_desk *desk, size_t number, const json_t *record,
                         ff_study_answer *answer)
{
    const fe_node *request = desk->list.request;
    const study_asked *asked = &desk->cases[number];
    json_t *values = values_of(desk, record, answer->key);
    size_t own = request ? request->count : asked->output_count;
    size_t count = own + desk->plan.extra_count;
    const ff_study_output **outputs = fe_arena_alloc(&desk->arena, (count + 1) * sizeof *outputs);
    for (size_t i = 0; i < count; i++)
        outputs[i] = output_of(desk, record, values,
                               i >= own  ? desk->plan.extras[i - own]
                               : request ? request->items[i]->text
                                         : asked->outputs[i]);
    answer->outputs = outputs;
    json_decref(values);
}

static const char *take_record(study_desk *desk, const json_t *record)
{
    static const char *const keys[] = {"set", "outputs", "chosen", "choices", "command"};
    json_t *part = json_object(), *value;
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if ((value = json_object_get(record, keys[i])))
            json_object_set(part, keys[i], value);
    char *text = json_dumps(part, JSON_COMPACT | JSON_REAL_PRECISION(17));
    const char *kept = study_desk_keep(desk, text);
    free(text);
    json_decref(part);
    return kept;
}

/* Lines [value, limit, verdict, text] of all stages. */
static void take_lines(study_desk *desk, const json_t *record, ff_study_answer *answer)
{
    json_t *stages = json_object_get(record, "quality"), *lines, *line;
    const char *stage, *name;
    size_t count = 0;
    json_object_foreach(stages, stage, lines) count += json_object_size(lines);
    const ff_study_line **rows = fe_arena_alloc(&desk->arena, (count + 1) * sizeof *rows);
    answer->lines = rows;
    json_object_foreach(stages, stage, lines) json_object_foreach(lines, name, line)
    {
        ff_study_line *row = fe_arena_alloc(&desk->arena, sizeof *row);
        char path[200];
        int length = snprintf(path, sizeof path, "%.80s.%.80s", stage, name);
        *row = (ff_study_line){.size = sizeof *row,
                               .name = fe_arena_text(&desk->arena, path, (size_t)length),
                               .value = number_of(json_array_get(line, 0)),
                               .limit = number_of(json_array_get(line, 1)),
                               .verdict = (int32_t)json_integer_value(json_array_get(line, 2)),
                               .text = text_of(desk, json_array_get(line, 3))};
        rows[answer->line_count++] = row;
    }
}

/* Processor time of the stages in which cases differ, and wall time of those that they share,
   whenever these were computed. */
static void take_costs(const json_t *record, ff_study_answer *answer)
{
    json_t *work = json_object_get(json_object_get(record, "measured"), "work"), *value;
    const char *stage;
    answer->work = study_record_is_ok(record) ? 0 : (double)NAN;
    json_object_foreach(work, stage, value) answer->work += json_number_value(value);
    for (const char *const *key = (const char *const[]){"stages", "reused", NULL}; *key; key++)
        json_object_foreach(json_object_get(record, *key), stage, value) answer->shared +=
            json_object_get(work, stage) ? 0 : json_number_value(value);
}

const ff_study_answer *study_desk_answer(study_desk *desk, size_t number)
{
    ff_study_answer *answer = fe_arena_alloc(&desk->arena, sizeof *answer);
    const json_t *record = json_object_get(desk->records, desk->keys[number]);
    *answer = (ff_study_answer){
        .size = sizeof *answer,
        .key = fe_arena_text(&desk->arena, desk->keys[number], strlen(desk->keys[number])),
        .status = record ? text_of(desk, json_object_get(record, "status")) : "not run",
        .reason = text_of(desk, json_object_get(record, "reason"))};
    answer->record = record ? take_record(desk, record) : NULL;
    take_outputs(desk, number, record, answer);
    take_lines(desk, record, answer);
    take_costs(record, answer);
    return answer;
}
