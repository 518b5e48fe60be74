/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the record of a case: its inputs and its results. */
#include "case.h"

#include "chain.h"

#include "../../accuracy/accuracy.h"
#include "../../limits/limits.h"
#include "../store/journal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Writes the text so that a shell reads it as one word. */
static void put_quoted(FILE *out, const char *text)
{
    fputc('\'', out);
    for (; *text; text++)
        fputs(*text == '\'' ? "'\\''" : (char[]){*text, 0}, out);
    fputc('\'', out);
}

/* Returns the command that runs the case again: alone, unless it starts from its neighbour. */
static json_t *command_of(const study_run *run, size_t index)
{
    const study_definition *study = run->study;
    char *text = NULL;
    size_t length = 0;
    FILE *out = memory_require(open_memstream(&text, &length));
    fputs("flankfilm run ", out);
    put_quoted(out, run->file);
    bool alone = study_chain_length(study) == 1;
    const char *set;
    for (size_t i = 0; (set = study_case_assignment(study, index, run->sets, run->set_count, i));
         i++) {
        if (!*set ||
            (!alone && (i < study->varied_count || i >= study->varied_count + run->set_count)))
            continue;
        fputs(" --set ", out);
        put_quoted(out, set);
    }
    fputs(alone ? " --set 'study=' -o " : " --rerun failed -o ", out);
    char *directory = alone ? memory_print_text("%s-case-%zu", run->directory, index + 1)
                            : memory_print_text("%s", run->directory);
    put_quoted(out, directory);
    free(directory);
    fclose(out);
    json_t *command = json_string(text);
    free(text);
    return command ? command : json_null();
}

json_t *study_case_set(const study_definition *study, size_t index)
{
    json_t *set = json_object();
    for (size_t k = 0; k < study->varied_count; k++)
        json_object_set_new(set, study->varied[k].path, json_string(study_value(study, k, index)));
    return set;
}

json_t *study_case_record(const study_run *run, size_t index, const char *key, const char *status,
                          const char *reason)
{
    json_t *record = json_pack("{s:I, s:s, s:s, s:o}", "case", (json_int_t)index + 1, "key", key,
                               "status", status, "set", study_case_set(run->study, index));
    if (reason) {
        json_t *text = json_string(reason);
        json_object_set_new(record, "reason", text ? text : json_string("not in UTF-8"));
        json_object_set_new(record, "command", command_of(run, index));
    }
    if (run->input)
        json_object_set_new(record, "input", json_string(run->input));
    return record;
}

char *study_first_error(const ff_report *report)
{
    char text[2000] = "no reason is known";
    for (size_t i = ff_report_count(report); i-- > 0;) {
        const ff_message *m = ff_report_at(report, i);
        if (m->severity != FF_ERROR)
            continue;
        if (m->place.source && m->place.source->temporary)
            ff_message_print(m, text, sizeof text);
        else
            snprintf(text, sizeof text, "%s", m->text);
    }
    return memory_copy_text(text, strlen(text));
}

bool study_case_is_refused(const study_definition *study, const ff_report *report)
{
    bool refused = study->spectrum && ff_report_errors(report) > 0;
    for (size_t i = 0; refused && i < ff_report_count(report); i++) {
        const ff_message *m = ff_report_at(report, i);
        refused = m->severity != FF_ERROR || m->beyond;
    }
    return refused;
}

static const char *status_of(const study_definition *study, const ff_report *report)
{
    int code = ff_report_fault(report);
    if (study_case_is_refused(study, report))
        return study_refused;
    return code == EXIT_SUCCESS     ? "ok"
           : code == FF_FAULT_RUN   ? "failed"
           : code == FF_FAULT_INPUT ? "invalid"
                                    : "plugin fault";
}

/* Adds the warnings about the case's own values and models, if there are any. Warnings about unused
   settings are left out, since they apply to the whole study. */
static void add_warnings(json_t *record, const ff_report *report, json_t *logged)
{
    json_t *warnings = json_array();
    for (size_t i = 0; i < ff_report_count(report); i++) {
        const ff_message *m = ff_report_at(report, i);
        if (m->severity == FF_WARNING && !strstr(m->text, " changes nothing"))
            json_array_append_new(warnings, json_string(m->text));
    }
    json_array_extend(warnings, logged);
    if (json_array_size(warnings))
        json_object_set(record, "warnings", warnings);
    json_decref(warnings);
}

/* Adds {stage: {name: [value, limit, verdict, text, reason for accepting it, true if it is about a
   model's range]}} without absent members, and the outputs of which only a lower bound is known. */
static void add_quality(json_t *record, const ff_pipeline *pipeline)
{
    json_t *all = json_object();
    for (size_t i = 0; pipeline && i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        json_t *lines = stage->quality_count ? json_object() : NULL;
        for (size_t k = 0; k < stage->quality_count; k++) {
            const ff_quality *line = &stage->quality[k];
            json_object_set_new(lines, line->name,
                                json_pack("[o, o, i, s*, s*]", study_json_real(line->value),
                                          study_json_real(line->limit), line->verdict,
                                          line->accepted && !line->text ? "" : line->text,
                                          line->accepted));
            if (line->range)
                json_array_append_new(json_object_get(lines, line->name), json_true());
        }
        if (lines)
            json_object_set_new(all, stage->name, lines);
    }
    json_object_set_new(record, "quality", all);
    json_t *least = pipeline ? study_list_least(pipeline) : NULL;
    if (json_array_size(least) > 0)
        json_object_set(record, "at_least", least);
    json_decref(least);
}

json_t *study_json_seconds(double seconds)
{
    return json_real(round(seconds * 1e6) / 1e6);
}

/* Adds the requested scalars, and for each stage its time, or that its result was reused. */
static void add_results(json_t *record, const ff_pipeline *pipeline)
{
    json_t *outputs = json_object(), *seconds = json_object(), *reused = json_object();
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        char name[160];
        if (!stage->ran)
            continue;
        json_object_set_new(stage->reused ? reused : seconds, stage->name,
                            study_json_seconds(stage->seconds));
        for (size_t k = 0; k < stage->loaded->model->output_count; k++) {
            const ff_result *result = &stage->results[k];
            if (!result->requested || !result->data || study_is_array(result))
                continue;
            snprintf(name, sizeof name, "%s.%s", stage->name, result->row->name);
            json_object_set_new(
                outputs, name,
                json_pack("[s, o]", result->row->unit, study_json_real(result->data[0])));
        }
    }
    json_object_set_new(record, "outputs", outputs);
    json_object_set_new(record, "stages", seconds);
    json_object_set_new(record, "reused", reused);
}

/* Adds the error bars of scalars as outputs, and the settings that were chosen. The bars of
 * series are in the quality. */
static void add_bars(json_t *record, const accuracy_record *errors)
{
    json_t *outputs = json_object_get(record, "outputs");
    if (errors->chosen_count)
        json_object_set_new(record, "settings",
                            study_settings_record(errors->chosen, errors->chosen_count));
    for (size_t i = 0; i < errors->count; i++) {
        const accuracy_error *e = &errors->errors[i];
        if (!e->bar || study_is_array(e->result))
            continue;
        char *name = memory_print_text("%s.%s" ACCURACY_BAR, e->stage->name, e->result->row->name);
        json_object_set_new(outputs, name,
                            json_pack("[s, o]", e->result->row->unit, study_json_real(e->bar[0])));
        free(name);
    }
}

/* Adds whether the case meets the limits of the file, if there are any. */
static void add_limits(json_t *record, const study_case *c, const accuracy_record *errors)
{
    limits_verdict verdict = limits_judge(c->run, c->pipeline, errors);
    if (verdict.count > 0)
        json_object_set_new(record, "limits", limits_json(&verdict));
    limits_free(&verdict);
}

/* Adds the results to the record, and stores arrays. Returns false after an error. */
static bool keep_results(study_case *c, const study_run *run, size_t index, json_t *record,
                         study_memory *memory)
{
    const study_measure *measure = run->study->measure;
    add_results(record, c->pipeline);
    if (measure)
        study_measure_record(c, run->study, record);
    bool repeats = measure && measure->repeat[index] > 0; /* a repeat would give the same arrays */
    return repeats || study_arrays_keep(&memory->arrays, c, record);
}

json_t *study_case_record_run(study_case *c, const study_run *run, size_t index, json_t *warnings,
                              const accuracy_record *errors, study_memory *memory)
{
    bool good = ff_report_errors(c->report) == 0;
    char *reason = good ? NULL : study_first_error(c->report);
    json_t *record =
        study_case_record(run, index, c->key, status_of(run->study, c->report), reason);
    free(reason);
    add_quality(record, c->pipeline);
    add_warnings(record, c->report, warnings);
    study_judge_record(record);
    if (good && !keep_results(c, run, index, record, memory)) {
        json_decref(record);
        return NULL;
    }
    if (good)
        add_bars(record, errors);
    if (good)
        add_limits(record, c, errors);
    study_chain_record_states(c, record);
    return record;
}
