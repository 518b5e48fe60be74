/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Describes a run in JSON: result.json, and the answer of --json. */
#include "extremes.h"
#include "json.h"
#include "write.h"

#include "../accuracy/axis.h"
#include "../accuracy/choice.h"
#include "../accuracy/lines.h"
#include "../accuracy/settings.h"
#include "../memory/memory.h"
#include "../study/kinds/kinds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static json_t *describe_scalar(const ff_result *result)
{
    return json_pack("{s:s, s:o}", "unit", result->row->unit, "value",
                     study_json_real(result->data[0]));
}

static json_t *list_numbers(const ff_result *result)
{
    json_t *list = json_array();
    for (size_t i = 0; i < result->count; i++)
        json_array_append_new(list, study_json_real(result->data[i]));
    return list;
}

static json_t *describe_array(const ff_stage *stage, size_t output)
{
    const ff_result *result = &stage->results[output];
    json_t *dims = json_array(), *shape = json_array();
    for (uint32_t i = 0; i < result->rank; i++) {
        json_array_append_new(dims, json_string(result->dims[i]));
        json_array_append_new(shape, json_integer((json_int_t)result->shape[i]));
    }
    return json_pack("{s:s, s:o, s:o}", "unit", result->row->unit, "dims", dims, "shape", shape);
}

json_t *results_against(const ff_pipeline *pipeline, const ff_stage *stage, size_t output)
{
    const ff_result *result = &stage->results[output];
    json_t *list = json_array();
    for (uint32_t i = 0; i < result->rank; i++) {
        const ff_result *axis =
            accuracy_axis(pipeline, stage, result->dims[i], result->shape[i], result, NULL);
        const ff_stage *of =
            axis && !accuracy_is_axis(result) ? results_stage_of(pipeline, axis) : NULL;
        char *name = memory_print_text("%s%s%s", of ? of->name : "", of ? "." : "",
                                       of ? axis->row->name : "");
        json_array_append_new(list, json_string(name));
        free(name);
    }
    return list;
}

static json_t *list_bars(const accuracy_error *e)
{
    if (e->result->rank == 0)
        return study_json_real(e->bar[0]);
    json_t *list = json_array();
    for (size_t i = 0; i < e->result->count; i++)
        json_array_append_new(list, study_json_real(e->bar[i]));
    return list;
}

/* Whether an array is left out of the object. */
static bool is_elsewhere(const ff_result *result, results_arrays arrays)
{
    return arrays == RESULTS_IN_FILES ||
           (arrays != RESULTS_ALL_HERE && result->count > RESULTS_LONGEST_TEXT);
}

/* Returns the name of an array's file; null if none is written. */
static json_t *name_file(const ff_stage *stage, const ff_result *result, const char *ending,
                         results_arrays arrays)
{
    return arrays == RESULTS_LONG_ABSENT
               ? json_null()
               : json_sprintf("%s.%s%s.npy", stage->name, result->row->name, ending);
}

/* Returns the numerical error; its bar has the shape of the output. */
static json_t *describe_error(const accuracy_error *e, bool checked, results_arrays arrays)
{
    json_t *parts = json_object();
    for (size_t i = 0; i < e->part_count; i++) {
        char *name = memory_print_text("%s.%s", e->parts[i].stage->name, e->parts[i].setting);
        json_object_set_new(parts, name, study_json_real(e->parts[i].error));
        free(name);
    }
    json_t *entry =
        json_pack("{s:o, s:o, s:o, s:o}", "relative", study_json_real(e->relative), "goal",
                  study_json_real(e->goal), "order", study_json_real(e->order), "parts", parts);
    if (e->absolute)
        json_object_set_new(entry, "absolute", study_json_real(e->reached));
    if (checked)
        json_object_set_new(entry, "from_finer", study_json_real(e->twin_difference));
    if (e->bar && e->result->rank && is_elsewhere(e->result, arrays))
        json_object_set_new(entry, "file", name_file(e->stage, e->result, ACCURACY_BAR, arrays));
    else if (e->bar)
        json_object_set_new(entry, e->result->rank ? "data" : "value", list_bars(e));
    return entry;
}

static json_t *describe_output(const results_outcome *outcome, const ff_stage *stage, size_t output,
                               results_arrays arrays)
{
    const ff_pipeline *pipeline = outcome->pipeline;
    const ff_result *result = &stage->results[output];
    const accuracy_error *error = accuracy_find(outcome->errors, result);
    json_t *entry = result->rank ? describe_array(stage, output) : describe_scalar(result);
    json_object_set_new(entry, "doc", results_json_text(result->row->doc));
    if (result->row->label)
        json_object_set_new(entry, "label", results_json_text(result->row->label));
    if (result->rank)
        json_object_set_new(entry, "against", results_against(pipeline, stage, output));
    results_extremes at;
    if (result->rank == 1 && results_find_extremes(pipeline, stage, result, &at) && at.partial)
        json_object_set_new(entry, "extremes",
                            json_pack("[I, I, s]", (json_int_t)at.least, (json_int_t)at.greatest,
                                      result->row->origin));
    if (result->rank && is_elsewhere(result, arrays)) {
        json_object_set_new(entry, "file", name_file(stage, result, "", arrays));
    } else if (result->rank) {
        json_object_set_new(entry, "data", list_numbers(result));
    }
    if (error)
        json_object_set_new(entry, "error",
                            describe_error(error, outcome->errors->checked, arrays));
    if (accuracy_is_least(stage, result))
        json_object_set_new(entry, "at_least", json_true());
    return entry;
}

/* Describes the requested outputs, in the order of the file. */
static json_t *describe_requested(const results_outcome *outcome, results_arrays arrays)
{
    size_t count;
    results_requested *list = results_list_requested(outcome->pipeline, &count);
    json_t *outputs = json_object();
    for (size_t i = 0; i < count; i++)
        json_object_set_new(outputs, list[i].name,
                            describe_output(outcome, list[i].stage, list[i].output, arrays));
    results_free_requested(list, count);
    return outputs;
}

/* Describes scalars that were computed but not requested, and the series against which arrays are
 * plotted. */
static json_t *describe_computed(const results_outcome *outcome)
{
    const ff_pipeline *pipeline = outcome->pipeline;
    const ff_result **axes = results_axes(pipeline);
    json_t *outputs = json_object();
    for (size_t s = 0; s < pipeline->count; s++) {
        const ff_stage *stage = &pipeline->stages[s];
        for (size_t i = 0; stage->ran && i < stage->loaded->model->output_count; i++) {
            const ff_result *result = &stage->results[i];
            if (!result->data || result->requested ||
                (result->rank && !results_is_kept(result, axes)))
                continue;
            char *name = memory_print_text("%s.%s", stage->name, result->row->name);
            json_object_set_new(outputs, name,
                                describe_output(outcome, stage, i, RESULTS_IN_FILES));
            free(name);
        }
    }
    free(axes);
    return outputs;
}

/* Writes the object on one line, and frees it. */
static void write_object(json_t *object, FILE *stream)
{
    json_dumpf(object, stream, JSON_COMPACT | JSON_REAL_PRECISION(RESULTS_JSON_DIGITS));
    fputc('\n', stream);
    json_decref(object);
}

const char *results_status_name(const ff_stage *stage)
{
    static const char *const names[] = {"bug", "not supported", "out of memory",  "invalid",
                                        "ok",  "out of range",  "no convergence", "stopped"};
    if (stage->status == FF_OK && !stage->ran)
        return "not run";
    return stage->status < FF_BUG || stage->status > FF_STOPPED ? "bug"
                                                                : names[stage->status - FF_BUG];
}

static json_t *describe_quality(const ff_stage *stage)
{
    json_t *object = json_object();
    for (size_t i = 0; i < stage->quality_count; i++) {
        const ff_quality *line = &stage->quality[i];
        json_t *entry =
            json_pack("{s:o, s:o, s:s, s:o}", "value", study_json_real(line->value), "limit",
                      study_json_real(line->limit), "verdict", ff_verdict_name(line->verdict),
                      "text", results_json_text(line->text));
        if (line->verdict != FF_GOOD || line->accepted)
            json_object_set_new(entry, "of", json_string(line->range ? "range" : "numbers"));
        if (line->accepted)
            json_object_set_new(entry, "accepted", results_json_text(line->accepted));
        json_object_set_new(object, line->name, entry);
    }
    return object;
}

static json_t *describe_scalars(const ff_stage *stage)
{
    json_t *object = json_object();
    for (size_t i = 0; stage->ran && i < stage->loaded->model->output_count; i++)
        if (stage->results[i].data && stage->results[i].rank == 0)
            json_object_set_new(object, stage->results[i].row->name,
                                describe_scalar(&stage->results[i]));
    return object;
}

static json_t *describe_stage(const ff_pipeline *pipeline, const ff_stage *stage, bool details)
{
    json_t *entry =
        json_pack("{s:s, s:s, s:b, s:o, s:s, s:o, s:o}", "stage", stage->name, "model", stage->use,
                  "ran", stage->ran, "seconds", study_json_real(stage->seconds), "status",
                  results_status_name(stage), "quality", describe_quality(stage), "scalars",
                  describe_scalars(stage));
    if (details && stage->loaded) {
        json_t *origin = results_json_origin(pipeline, stage);
        json_object_update(entry, origin);
        json_decref(origin);
    }
    return entry;
}

static void add_judgement(json_t *head, const results_outcome *outcome)
{
    bool failed = strcmp(outcome->status, "ok") != 0;
    study_judgement judgement = study_judge_pipeline(outcome->pipeline, failed);
    study_judgement_add(&judgement, head);
    study_judgement_free(&judgement);
    results_json_add_doubts(head, outcome->pipeline);
}

static void add_input(json_t *head, const results_input *input)
{
    json_t *sets = json_array();
    for (size_t i = 0; i < input->set_count; i++)
        json_array_append_new(sets, results_json_text(input->sets[i]));
    json_object_set_new(head, "facts", results_json_facts(input->file));
    json_object_set_new(head, "sets", sets);
}

/* Returns {stage, model, taken, reason} for each model that was tried. */
static json_t *describe_tried(const results_outcome *outcome)
{
    const accuracy_choice *choice = outcome->errors->choice;
    json_t *list = json_array();
    for (size_t i = 0; choice && i < choice->tried_count; i++) {
        const accuracy_tried *tried = &choice->tried[i];
        json_array_append_new(list, json_pack("{s:s, s:s, s:b, s:o}", "stage",
                                              outcome->pipeline->stages[tried->stage].name, "model",
                                              tried->model, "taken", tried->accepted, "reason",
                                              results_json_text(tried->reason)));
    }
    return list;
}

/* Returns {settings, seconds} for each run that was made for the answer. */
static json_t *describe_spent(const accuracy_record *errors)
{
    json_t *list = json_array();
    memory_arena arena = {.blocks = NULL};
    for (size_t i = 0; errors->attempts > 0 && i < errors->runs.count; i++) {
        const accuracy_twin *run = errors->runs.list[i];
        size_t count = 0;
        const char **settings =
            run->pipeline ? accuracy_list_settings(run->pipeline, &count, &arena) : NULL;
        json_array_append_new(list, json_pack("{s:o, s:o}", "settings",
                                              study_settings_record(settings, count), "seconds",
                                              study_json_real(run->work)));
    }
    memory_arena_free(&arena);
    return list;
}

/* Returns the cost of measuring the errors; null if the file does not ask for it. */
static json_t *describe_accuracy(const results_outcome *outcome)
{
    const accuracy_record *errors = outcome->errors;
    if (errors->runs.count == 0)
        return json_null();
    return json_pack(
        "{s:s, s:I, s:I, s:o, s:o, s:o, s:o, s:o}", "asked", outcome->input->accuracy, "attempts",
        (json_int_t)errors->attempts, "twins", (json_int_t)accuracy_twin_count(errors), "seconds",
        study_json_real(accuracy_seconds(errors)), "failure", results_json_text(errors->failure),
        "settings", study_settings_record(errors->chosen, errors->chosen_count), "models",
        describe_tried(outcome), "runs", describe_spent(errors));
}

static json_t *describe_head(const results_outcome *outcome)
{
    json_t *head = results_json_answer(outcome->status, outcome->exit_code, outcome->report);
    json_object_set_new(head, "title", results_json_text(outcome->pipeline->title));
    add_judgement(head, outcome);
    json_object_set_new(head, "limits", limits_json(outcome->limits));
    json_object_set_new(head, "file", results_json_text(outcome->input->file));
    json_object_set_new(head, "accuracy", describe_accuracy(outcome));
    return head;
}

static json_t *describe_stages(const ff_pipeline *pipeline, bool details)
{
    json_t *stages = json_array();
    for (size_t i = 0; i < pipeline->count; i++)
        json_array_append_new(stages, describe_stage(pipeline, &pipeline->stages[i], details));
    return stages;
}

void results_write_run_json(const results_outcome *outcome, FILE *stream)
{
    const ff_pipeline *pipeline = outcome->pipeline;
    json_t *all = json_pack("{s:i, s:o}", "format", RESULTS_FORMAT, "key",
                            results_json_key(outcome->input->key)); /* previous-results.c reads only
                                                                     * this part */
    json_t *head = describe_head(outcome);
    json_object_update(all, head);
    json_decref(head);
    add_input(all, outcome->input);
    json_object_set_new(all, "outputs", describe_requested(outcome, RESULTS_IN_FILES));
    json_object_set_new(all, "computed", describe_computed(outcome));
    json_object_set_new(all, "stages", describe_stages(pipeline, true));
    json_object_set(all, "log", outcome->log);
    write_object(all, stream);
}

void results_write_answer(const results_outcome *outcome, const char *directory, bool all_arrays,
                          FILE *stream)
{
    json_t *all = describe_head(outcome);
    results_arrays arrays = all_arrays  ? RESULTS_ALL_HERE
                            : directory ? RESULTS_LONG_IN_FILES
                                        : RESULTS_LONG_ABSENT;
    json_object_set_new(all, "directory", results_json_text(directory));
    json_object_set_new(all, "outputs", describe_requested(outcome, arrays));
    json_object_set_new(all, "stages", describe_stages(outcome->pipeline, false));
    json_object_set(all, "log", outcome->log);
    write_object(all, stream);
}
