/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "number.h"
#include "result.h"

#include <math.h>

/* Arrays are written as they are: a JSON node for each number would cost many times as much. */
static void write_array(const ff_result *result, FILE *stream)
{
    char text[FF_NUMBER_SIZE];
    fputc('[', stream);
    for (size_t i = 0; i < result->count; i++) {
        if (i)
            fputc_unlocked(',', stream);
        if (isfinite(result->data[i]))
            fwrite_unlocked(text, 1, ff_number_print(result->data[i], FF_JSON_DIGITS, text),
                            stream);
        else
            fputs("null", stream);
    }
    fputc(']', stream);
}

static void write_members(json_t *object, FILE *stream)
{
    json_dumpf(object, stream, JSON_COMPACT | JSON_EMBED | JSON_REAL_PRECISION(FF_JSON_DIGITS));
    json_decref(object);
}

static void write_output(const ff_stage *stage, size_t output, FILE *stream)
{
    const ff_result *result = &stage->results[output];
    json_t *head = json_object();
    json_object_set_new(head, "unit", ff_json_text(result->row->unit));
    if (result->rank == 0) {
        json_object_set_new(head, "value", ff_json_real(result->data[0]));
        write_members(head, stream);
        return;
    }
    json_t *dims = json_array(), *shape = json_array();
    for (uint32_t i = 0; i < result->rank; i++) {
        json_array_append_new(dims, ff_json_text(ff_result_dim(stage, output, i)));
        json_array_append_new(shape, json_integer((json_int_t)result->shape[i]));
    }
    json_object_set_new(head, "dims", dims);
    json_object_set_new(head, "shape", shape);
    write_members(head, stream);
    fputs(",\"data\":", stream);
    write_array(result, stream);
}

static void write_outputs(const ff_pipeline *pipeline, FILE *stream)
{
    bool first = true;
    for (size_t s = 0; s < pipeline->count; s++) {
        const ff_stage *stage = &pipeline->stages[s];
        for (size_t i = 0; stage->ran && i < stage->loaded->model->output_count; i++) {
            const ff_result *result = &stage->results[i];
            if (!result->asked || !result->data)
                continue;
            char key[256];
            snprintf(key, sizeof key, "%s.%s", stage->name, result->row->name);
            json_t *name = ff_json_text(key);
            fputs(first ? "" : ",", stream);
            json_dumpf(name, stream, JSON_ENCODE_ANY);
            json_decref(name);
            fputs(":{", stream);
            write_output(stage, i, stream);
            fputc('}', stream);
            first = false;
        }
    }
}

static json_t *scalars(const ff_stage *stage)
{
    json_t *object = json_object();
    for (size_t i = 0; stage->ran && i < stage->loaded->model->output_count; i++) {
        const ff_result *result = &stage->results[i];
        if (!result->data || result->rank != 0)
            continue;
        json_t *entry = json_object();
        json_object_set_new(entry, "unit", ff_json_text(result->row->unit));
        json_object_set_new(entry, "value", ff_json_real(result->data[0]));
        json_object_set_new(object, result->row->name, entry);
    }
    return object;
}

static json_t *stages(const ff_pipeline *pipeline, bool details)
{
    json_t *list = json_array();
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        json_t *entry = json_object();
        json_object_set_new(entry, "stage", ff_json_text(stage->name));
        json_object_set_new(entry, "model", ff_json_text(stage->use));
        json_object_set_new(entry, "ran", json_boolean(stage->ran));
        json_object_set_new(entry, "seconds", ff_json_real(stage->seconds));
        json_object_set_new(entry, "status", ff_json_text(ff_status_name(stage)));
        json_object_set_new(entry, "quality", ff_json_quality(stage));
        json_object_set_new(entry, "scalars", scalars(stage));
        if (details && stage->loaded) {
            json_object_set_new(entry, "version", ff_json_text(stage->loaded->model->version));
            json_object_set_new(entry, "parameters", ff_json_params(stage));
            json_object_set_new(entry, "wires", ff_json_wires(pipeline, stage));
        }
        json_array_append_new(list, entry);
    }
    return list;
}

void ff_result_json(const ff_outcome *outcome, bool details, FILE *stream)
{
    json_t *head = ff_json_answer(outcome->status, outcome->exit_code);
    json_object_set_new(head, "title", ff_json_text(outcome->pipeline->title));
    json_object_set_new(head, "file", ff_json_text(outcome->file));
    ff_json_add_messages(head, outcome->report);
    json_t *tail = json_object();
    json_object_set_new(tail, "stages", stages(outcome->pipeline, details));
    json_object_set(tail, "log", outcome->log);

    fputc('{', stream);
    write_members(head, stream);
    fputs(",\"outputs\":{", stream);
    write_outputs(outcome->pipeline, stream);
    fputs("},", stream);
    write_members(tail, stream);
    fputs("}\n", stream);
}
