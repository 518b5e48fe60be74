/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "json.h"

#include "../memory/memory.h"
#include "../study/kinds/answer/number.h"
#include "../study/kinds/kinds.h"
#include "../terminal/answer.h"

#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>

json_t *results_json_text(const char *text)
{
    if (!text)
        return json_null();
    json_t *string = json_string(text);
    if (string)
        return string;
    size_t size = strlen(text) + 1;
    char *clean = memory_alloc(size);
    ff_clean_text(clean, size, text);
    string = json_string(clean);
    free(clean);
    return string;
}

json_t *results_json_key(uint64_t key)
{
    char text[20];
    snprintf(text, sizeof text, "%016llx", (unsigned long long)key);
    return json_string(text);
}

static json_t *number_or_null(uint32_t number)
{
    return number ? json_integer(number) : json_null();
}

static json_t *describe_message(const ff_place *place, const char *text, const char *hint)
{
    return json_pack("{s:o, s:o, s:o, s:o, s:o}", "file",
                     results_json_text(place->source ? place->source->name : NULL), "line",
                     number_or_null(place->line), "column", number_or_null(place->column),
                     "message", results_json_text(text), "hint", results_json_text(hint));
}

static json_t *list_messages(const ff_report *report, ff_severity severity)
{
    json_t *list = json_array();
    for (size_t i = 0; i < ff_report_count(report); i++) {
        const ff_message *message = ff_report_at(report, i);
        if (message->severity == severity)
            json_array_append_new(list,
                                  describe_message(&message->place, message->text, message->hint));
    }
    return list;
}

json_t *results_json_answer(const char *status, int code, const ff_report *report)
{
    json_t *answer =
        json_pack("{s:s, s:s, s:i}", "flankfilm", RESULTS_VERSION, "status", status, "exit", code);
    if (report) {
        json_object_set_new(answer, "errors", list_messages(report, FF_ERROR));
        json_object_set_new(answer, "warnings", list_messages(report, FF_WARNING));
    }
    return answer;
}

void results_json_add_doubts(json_t *answer, const ff_pipeline *pipeline)
{
    json_t *list = json_object_get(answer, "warnings");
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[pipeline->order[i]];
        for (size_t k = 0; k < stage->quality_count; k++) {
            const ff_quality *line = &stage->quality[k];
            if (line->verdict != FF_DOUBTFUL)
                continue;
            char value[STUDY_NUMBER_SIZE];
            study_number_short(line->value, value);
            char *text = memory_print_text("%s: doubtful: %s is %s, limit %.3g%s%s", stage->name,
                                           line->name, value, line->limit, line->text ? ": " : "",
                                           line->text ? line->text : "");
            json_array_append_new(list, describe_message(&stage->place, text, NULL));
            free(text);
        }
    }
}

void results_json_print(json_t *object)
{
    json_dumpf(object, terminal_answer(), JSON_COMPACT | JSON_REAL_PRECISION(RESULTS_JSON_DIGITS));
    fputc('\n', terminal_answer());
    json_decref(object);
}

static json_t *param_value(const ff_bound *bound)
{
    const ff_value *value = &bound->value;
    if (value->text)
        return results_json_text(value->text);
    if (bound->row->type == FF_REAL)
        return study_json_real(value->real);
    if (bound->row->type == FF_BOOL)
        return json_boolean(value->integer != 0);
    if (bound->row->type != FF_REALS)
        return json_integer(value->integer);
    json_t *list = json_array();
    for (size_t i = 0; i < value->count; i++)
        json_array_append_new(list, study_json_real(value->reals[i]));
    return list;
}

json_t *results_json_params(const ff_stage *stage)
{
    json_t *object = json_object();
    for (size_t i = 0; stage->params && i < stage->loaded->model->param_count; i++) {
        const ff_bound *bound = &stage->params[i];
        char text[512], origin[512];
        if (!bound->present && !bound->wire)
            continue;
        if (bound->wire)
            snprintf(text, sizeof text, "by the wire %s", bound->wire->name);
        else
            ff_bound_print(stage, i, text, sizeof text);
        ff_bound_origin(bound->wire ? &(ff_bound){.place = bound->wire->place} : bound, origin,
                        sizeof origin);
        json_object_set_new(
            object, bound->row->name,
            json_pack("{s:o, s:o, s:o}", "value", bound->wire ? json_null() : param_value(bound),
                      "text", results_json_text(text), "origin", results_json_text(origin)));
    }
    return object;
}

json_t *results_json_wires(const ff_pipeline *pipeline, const ff_stage *stage)
{
    json_t *object = json_object();
    for (size_t i = 0; i < stage->wire_count; i++) {
        const ff_wire *wire = &stage->wires[i];
        if (wire->stage < 0)
            continue;
        json_t *entry = json_pack("{s:s, s:b}", "stage", pipeline->stages[wire->stage].name,
                                  "automatic", wire->automatic);
        if (wire->closes)
            json_object_set_new(entry, "feedback", json_true());
        json_object_set_new(object, wire->name, entry);
    }
    return object;
}

json_t *results_json_model(const ff_loaded *loaded)
{
    const ff_model *model = loaded->model;
    char *path = realpath(loaded->path, NULL);
    json_t *entry =
        json_pack("{s:o, s:o, s:o, s:o, s:o}", "version", results_json_text(model->version), "path",
                  results_json_text(path ? path : loaded->path), "build",
                  results_json_key(loaded->build), "reference", results_json_text(model->reference),
                  "bibtex", results_json_text(model->bibtex));
    free(path);
    return entry;
}

json_t *results_json_origin(const ff_pipeline *pipeline, const ff_stage *stage)
{
    json_t *origin = results_json_model(stage->loaded);
    json_object_set_new(origin, "parameters", results_json_params(stage));
    json_object_set_new(origin, "wires", results_json_wires(pipeline, stage));
    return origin;
}

json_t *results_json_facts(const char *file)
{
    struct utsname machine;
    struct tm utc;
    char date[40] = "", *path = realpath(file, NULL);
    const time_t now = time(NULL);
    if (gmtime_r(&now, &utc))
        strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", &utc);
    if (uname(&machine) != 0)
        machine = (struct utsname){.sysname = ""};
    char *host = memory_print_text("%s, %s %s", machine.nodename, machine.sysname, machine.machine);
    json_t *facts = json_pack("{s:s, s:o, s:s, s:o}", "flankfilm", RESULTS_VERSION, "file",
                              results_json_text(path ? path : file), "date", date, "computed on",
                              results_json_text(host));
    free(host);
    free(path);
    return facts;
}
