/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "json.h"
#include "number.h"
#include "write.h"

#include "../memory/memory.h"
#include "../study/study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Arrays are written as they are: a JSON node for each number would cost many times as much. */
static void write_array(const ff_result *result, FILE *stream)
{
    char text[RESULTS_NUMBER_SIZE];
    for (size_t i = 0; i < result->count; i++) {
        fputc_unlocked(i ? ',' : '[', stream);
        if (isfinite(result->data[i]))
            fwrite_unlocked(
                text, 1, results_number_print(result->data[i], RESULTS_JSON_DIGITS, text), stream);
        else
            fputs("null", stream);
    }
    fputs(result->count ? "]" : "[]", stream);
}

/* Writes the members of an object without its braces, and frees it. */
static void write_members(json_t *object, FILE *stream)
{
    json_dumpf(object, stream,
               JSON_COMPACT | JSON_EMBED | JSON_REAL_PRECISION(RESULTS_JSON_DIGITS));
    json_decref(object);
}

static json_t *describe_scalar(const ff_result *result)
{
    return json_pack("{s:s, s:o}", "unit", result->row->unit, "value",
                     study_json_real(result->data[0]));
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

/* A time, an angle, or what its dimension is named after: other series are plotted against it. */
static bool is_axis(const ff_stage *stage, size_t output)
{
    const ff_port *row = stage->results[output].row;
    return stage->results[output].rank == 1 &&
           (!strcmp(row->unit, "s") || !strcmp(row->unit, "rad") ||
            !strcmp(row->name, stage->results[output].dims[0]));
}

/* Names what each dimension is plotted against: "gears.roll_angle", or "". */
static json_t *axes_of(const ff_pipeline *pipeline, const ff_stage *stage, size_t output)
{
    const ff_result *result = &stage->results[output];
    json_t *list = json_array();
    for (uint32_t i = 0; i < result->rank; i++) {
        const ff_result *axis =
            results_axis(pipeline, stage, result->dims[i], result->shape[i], result, "rad");
        const ff_stage *of =
            axis && !is_axis(stage, output) ? results_stage_of(pipeline, axis) : NULL;
        char *name = memory_print_text("%s%s%s", of ? of->name : "", of ? "." : "",
                                       of ? axis->row->name : "");
        json_array_append_new(list, json_string(name));
        free(name);
    }
    return list;
}

static void write_output(const ff_pipeline *pipeline, const ff_stage *stage, size_t output,
                         FILE *stream)
{
    const ff_result *result = &stage->results[output];
    fprintf(stream, "\"%s.%s\":{", stage->name, result->row->name); /* plain words */
    json_t *head = result->rank ? describe_array(stage, output) : describe_scalar(result);
    json_object_set_new(head, "doc", results_json_text(result->row->doc));
    if (result->rank)
        json_object_set_new(head, "against", axes_of(pipeline, stage, output));
    write_members(head, stream);
    if (result->rank) {
        fputs(",\"data\":", stream);
        write_array(result, stream);
    }
    fputc('}', stream);
}

/* Writes what the file requests; or, of what was computed on the way, the scalars and series. */
static void write_outputs(const ff_pipeline *pipeline, bool requested, FILE *stream)
{
    const char *gap = "";
    for (size_t s = 0; s < pipeline->count; s++) {
        const ff_stage *stage = &pipeline->stages[s];
        for (size_t i = 0; stage->ran && i < stage->loaded->model->output_count; i++) {
            const ff_result *result = &stage->results[i];
            if (!result->data || result->requested != requested || (!requested && result->rank > 1))
                continue;
            fputs(gap, stream);
            write_output(pipeline, stage, i, stream);
            gap = ",";
        }
    }
}

void results_write_arrays_json(const ff_pipeline *pipeline, FILE *stream)
{
    fputs("{\"outputs\":{", stream);
    write_outputs(pipeline, true, stream);
    fputs("}}\n", stream);
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
        json_object_set_new(object, line->name,
                            json_pack("{s:o, s:o, s:s, s:o}", "value", study_json_real(line->value),
                                      "limit", study_json_real(line->limit), "verdict",
                                      ff_verdict_name(line->verdict), "text",
                                      results_json_text(line->text)));
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
    if (stage->choice)
        json_object_set_new(entry, "choice", results_json_choice(stage));
    if (details && stage->loaded) {
        json_t *origin = results_json_origin(pipeline, stage);
        json_object_update(entry, origin);
        json_decref(origin);
    }
    return entry;
}

void results_write_run_json(const results_outcome *outcome, bool details, FILE *stream)
{
    const ff_pipeline *pipeline = outcome->pipeline;
    json_t *head = results_json_answer(outcome->status, outcome->exit_code, outcome->report);
    json_t *stages = json_array();
    json_object_set_new(head, "title", results_json_text(pipeline->title));
    json_object_set_new(head, "file", results_json_text(outcome->file));
    if (details)
        json_object_set_new(head, "facts", results_json_facts(outcome->file));
    for (size_t i = 0; i < pipeline->count; i++)
        json_array_append_new(stages, describe_stage(pipeline, &pipeline->stages[i], details));
    fputc('{', stream);
    write_members(head, stream);
    fputs(",\"outputs\":{", stream);
    write_outputs(pipeline, true, stream);
    if (details) {
        fputs("},\"computed\":{", stream);
        write_outputs(pipeline, false, stream);
    }
    fputs("},", stream);
    write_members(json_pack("{s:o, s:O}", "stages", stages, "log", outcome->log), stream);
    fputs("}\n", stream);
}
