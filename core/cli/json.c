/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "json.h"
#include "bound.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

json_t *ff_json_text(const char *text)
{
    if (!text)
        return json_null();
    json_t *string = json_string(text);
    if (string)
        return string;
    char *plain = strdup(text);
    for (char *c = plain; c && *c; c++)
        if ((unsigned char)*c >= 0x80)
            *c = '?';
    string = json_string(plain ? plain : "");
    free(plain);
    return string;
}

json_t *ff_json_real(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *number_or_null(uint32_t number)
{
    return number ? json_integer(number) : json_null();
}

json_t *ff_json_messages(const ff_report *report, ff_severity severity)
{
    json_t *list = json_array();
    for (size_t i = 0; i < ff_report_count(report); i++) {
        const ff_message *message = ff_report_at(report, i);
        if (message->severity != severity)
            continue;
        const ff_place *place = &message->place;
        json_t *entry = json_object();
        json_object_set_new(entry, "file",
                            ff_json_text(place->source ? place->source->name : NULL));
        json_object_set_new(entry, "line", number_or_null(place->line));
        json_object_set_new(entry, "column", number_or_null(place->column));
        json_object_set_new(entry, "message", ff_json_text(message->text));
        json_object_set_new(entry, "hint", ff_json_text(message->hint));
        json_array_append_new(list, entry);
    }
    return list;
}

json_t *ff_json_answer(const char *status, int code)
{
    json_t *answer = json_object();
    json_object_set_new(answer, "flankfilm", json_string(FF_VERSION));
    json_object_set_new(answer, "status", json_string(status));
    json_object_set_new(answer, "exit", json_integer(code));
    return answer;
}

void ff_json_add_messages(json_t *answer, const ff_report *report)
{
    json_object_set_new(answer, "errors", ff_json_messages(report, FF_ERROR));
    json_object_set_new(answer, "warnings", ff_json_messages(report, FF_WARNING));
}

void ff_json_print(json_t *object, FILE *stream)
{
    json_dumpf(object, stream, JSON_COMPACT | JSON_REAL_PRECISION(FF_JSON_DIGITS));
    fputc('\n', stream);
    json_decref(object);
}

int ff_json_refuse(const ff_report *report)
{
    int code = ff_report_exit_code(report);
    json_t *answer = ff_json_answer("error", code);
    ff_json_add_messages(answer, report);
    ff_json_print(answer, stdout);
    return code;
}

static json_t *param_value(const ff_bound *bound)
{
    const ff_value *value = &bound->value;
    switch (bound->row->type) {
    case FF_REAL:
        return value->text ? ff_json_text(value->text) : ff_json_real(value->real);
    case FF_INT:
        return value->text ? ff_json_text(value->text) : json_integer(value->integer);
    case FF_BOOL:
        return json_boolean(value->integer != 0);
    case FF_REALS: {
        json_t *list = json_array();
        for (size_t i = 0; i < value->count; i++)
            json_array_append_new(list, ff_json_real(value->reals[i]));
        return list;
    }
    default:
        return ff_json_text(value->text);
    }
}

json_t *ff_json_params(const ff_stage *stage)
{
    json_t *object = json_object();
    for (size_t i = 0; stage->params && i < stage->loaded->model->param_count; i++) {
        const ff_bound *bound = &stage->params[i];
        char text[512], origin[512];
        if (!ff_bound_print(stage, i, text, sizeof text))
            continue;
        ff_origin(bound, origin, sizeof origin);
        json_t *entry = json_object();
        json_object_set_new(entry, "value", param_value(bound));
        json_object_set_new(entry, "text", ff_json_text(text));
        json_object_set_new(entry, "origin", ff_json_text(origin));
        json_object_set_new(object, bound->row->name, entry);
    }
    return object;
}

json_t *ff_json_wires(const ff_pipeline *pipeline, const ff_stage *stage)
{
    json_t *object = json_object();
    for (size_t i = 0; i < stage->wire_count; i++) {
        const ff_wire *wire = &stage->wires[i];
        if (wire->stage < 0)
            continue;
        json_t *entry = json_object();
        json_object_set_new(entry, "stage", ff_json_text(pipeline->stages[wire->stage].name));
        json_object_set_new(entry, "automatic", json_boolean(wire->automatic));
        json_object_set_new(object, wire->name, entry);
    }
    return object;
}

json_t *ff_json_quality(const ff_stage *stage)
{
    json_t *object = json_object();
    for (size_t i = 0; i < stage->quality_count; i++) {
        const ff_quality *line = &stage->quality[i];
        json_t *entry = json_object();
        json_object_set_new(entry, "value", ff_json_real(line->value));
        json_object_set_new(entry, "limit", ff_json_real(line->limit));
        json_object_set_new(entry, "verdict", json_string(ff_verdict_name(line->verdict)));
        json_object_set_new(entry, "text", ff_json_text(line->text));
        json_object_set_new(object, line->name, entry);
    }
    return object;
}

const char *ff_status_name(const ff_stage *stage)
{
    switch (stage->status) {
    case FF_OK:
        return stage->ran ? "ok" : "not run";
    case FF_DOMAIN:
        return "out of range";
    case FF_NOCONV:
        return "no convergence";
    case FF_STOPPED:
        return "stopped";
    case FF_INVALID:
        return "invalid";
    case FF_NOMEM:
        return "out of memory";
    case FF_UNSUPPORTED:
        return "not supported";
    default:
        return "bug";
    }
}
