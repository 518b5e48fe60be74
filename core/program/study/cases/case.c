/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Builds, runs and records one case: the file with its assignments. */
#include "case.h"

#include "chain.h"
#include "rows.h"

#include "../../accuracy/accuracy.h"
#include "../../accuracy/axis.h"
#include "../../accuracy/goals.h"
#include "../../accuracy/models.h"
#include "../../limits/limits.h"
#include "../../run/run.h"
#include "../store/hash.h"
#include "../store/journal.h"
#include "../store/reuse.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Adds all that is written under a key of the file. */
static uint64_t hash_node(uint64_t hash, const ff_node *node)
{
    hash = study_hash_text(hash, node->text ? node->text : "");
    for (size_t i = 0; i < node->count; i++) {
        if (node->kind == FF_MAP)
            hash = study_hash_text(hash, node->keys[i]);
        hash = hash_node(hash, node->items[i]);
    }
    return hash;
}

/* Adds what a case is judged by: limits as they are meant, reasons as they are written. */
static uint64_t hash_judging(uint64_t hash, const ff_run *run)
{
    const ff_node *accept = ff_node_get(ff_run_root(run), "accept");
    if (ff_node_get(ff_run_root(run), "limits")) {
        char *key = limits_print_key(run);
        hash = study_hash_text(study_hash_text(hash, "limits"), key);
        free(key);
    }
    return accept ? hash_node(study_hash_text(hash, "accept"), accept) : hash;
}

/* A case that cannot be built has no resolved parameters, so its key comes from its assignments. */
static uint64_t hash_assignments(const study_definition *study, size_t index)
{
    uint64_t hash = study_hash_text(STUDY_HASH_START,
                                    study->spectrum ? "not built, of a spectrum" : "not built");
    for (size_t k = 0; k < study->varied_count; k++)
        hash = study_hash_text(hash, study_assignment(study, k, index));
    return study->streams ? study_hash_text(hash, study_rows_text(study->rows, index)) : hash;
}

static bool is_file(const char *assignment)
{
    return !strncmp(assignment, "include=", 8);
}

/* Returns assignment i of a case: its files, then `sets`, then its values. NULL after the last; ""
   where there is nothing to assign. */
static const char *assignment_at(const study_definition *study, size_t index,
                                 const char *const *sets, size_t set_count, size_t i)
{
    size_t n = study->varied_count, k = i < n ? i : i - set_count - n;
    if (i >= n && i < n + set_count)
        return sets[i - n];
    if (k >= n)
        return NULL;
    const char *text = study_assignment(study, k, index);
    return is_file(text) == (i < n) ? text : "";
}

void study_overlay(const study_definition *study, size_t index, const char *const *sets,
                   size_t set_count, ff_run *run)
{
    const char *text;
    size_t n = study->varied_count;
    for (size_t i = 0; (text = assignment_at(study, index, sets, set_count, i)); i++) {
        const study_varied *v = i >= n + set_count ? &study->varied[i - n - set_count] : NULL;
        const ff_place *path = v && v->place.source ? &v->place : NULL, *place = path;
        const study_place *cell = path && v->places ? &v->places[index] : NULL;
        ff_place in_table =
            cell ? (ff_place){path->source, cell->line, cell->column, cell->width} : FF_NOWHERE;
        if (cell)
            place = &in_table;
        if (path && v->values)
            place = &v->values->items[study_rank(study, v->axis, index)]->place;
        if (*text)
            run_set(run, text, path, place);
    }
    if (study->request)
        run_put(run, "outputs", study->request);
    if (study->streams)
        study_rows_check(study->rows, index, ff_run_report(run));
}

ff_run *study_case_base(ff_engine *engine, const char *file)
{
    ff_run *run = run_read(engine, file);
    if (ff_report_count(ff_run_report(run)) == 0 && ff_run_root(run))
        return run;
    ff_run_close(run);
    return NULL;
}

void study_kept_free(study_kept *kept)
{
    ff_run_close(kept->run);
    *kept = (study_kept){.keys = kept->keys};
}

/* Whether one path leads to the other, or both to one place: then their order counts. */
static bool paths_meet(const char *one, const char *other)
{
    static const char top[] = "pipeline.";
    one += strncmp(one, top, sizeof top - 1) ? 0 : sizeof top - 1;
    other += strncmp(other, top, sizeof top - 1) ? 0 : sizeof top - 1;
    size_t a = strlen(one), b = strlen(other), shorter = a < b ? a : b;
    return !strncmp(one, other, shorter) && (a == b || (a < b ? other : one)[shorter] == '.');
}

/* Lists what differs between two cases; false where that is more than values. */
static bool list_changes(const study_definition *study, size_t from, size_t to, const char **list,
                         size_t *count)
{
    *count = 0;
    if (study->streams && !study_rows_check(study->rows, to, NULL))
        return false;
    for (size_t k = 0; k < study->varied_count; k++) {
        const char *old = study_assignment(study, k, from), *now = study_assignment(study, k, to);
        for (size_t l = 0; l < k; l++)
            if (paths_meet(study->varied[k].path, study->varied[l].path))
                return false;
        if (!strcmp(old, now))
            continue;
        if (!*old || !*now || is_file(old) || is_file(now))
            return false;
        list[(*count)++] = now;
    }
    return true;
}

/* Goes on with the run of the case before; false when there is none, or it will not do. */
static bool take_kept(study_case *c, const study_run *run, size_t index, study_kept *kept)
{
    enum { MOST_CHANGES = 200 };
    const study_definition *study = run->study;
    size_t count;
    if (!kept->run)
        return false;
    const char **changes = memory_alloc((study->varied_count + 1) * sizeof *changes);
    bool good = kept->changes < MOST_CHANGES &&
                list_changes(study, kept->index, index, changes, &count) &&
                ff_run_change(kept->run, changes, count, !kept->keys) == FF_OK;
    free(changes);
    if (!good) {
        study_kept_free(kept);
        return false;
    }
    c->run = kept->run;
    c->pipeline = ff_run_pipeline(c->run);
    kept->run = NULL;
    kept->changes++;
    return true;
}

void study_case_open(study_case *c, const study_run *run, size_t index, study_kept *kept)
{
    const study_definition *study = run->study;
    bool keeps = kept && run->base && !study->measure && study_chain_length(study) == 1;
    *c = (study_case){.kept = keeps ? kept : NULL, .index = index};
    if (!keeps || !take_kept(c, run, index, kept)) {
        c->run = run->base ? run_copy(run->base) : run_read(run->engine, run->file);
        study_overlay(study, index, run->sets, run->set_count, c->run);
        c->pipeline = accuracy_build(c->run, run->engine, false);
        if (c->pipeline)
            limits_check(c->run);
    }
    c->report = ff_run_report(c->run);
    uint64_t fingerprint = hash_assignments(study, index);
    if (study_case_is_good(c)) {
        study_measure_want(study, c->pipeline);
        if (accuracy_is_asked(c->run))
            accuracy_want_beside(c->pipeline);
        c->fingerprints = memory_alloc(c->pipeline->count * sizeof *c->fingerprints);
        fingerprint = study_fingerprint(c->pipeline, c->fingerprints);
    }
    if (c->pipeline && accuracy_is_asked(c->run)) {
        char *asked = accuracy_print_key(c->run, run->engine);
        fingerprint = study_hash_text(study_hash_text(fingerprint, "accuracy"), asked);
        free(asked);
    }
    if (ff_run_root(c->run))
        fingerprint = hash_judging(fingerprint, c->run);
    if (study->measure)
        fingerprint = study_measure_fingerprint(fingerprint, study->measure->repeat[index]);
    snprintf(c->key, sizeof c->key, "%016llx", (unsigned long long)fingerprint);
}

void study_case_close(study_case *c)
{
    /* what was said of a stage that does not change would not be said again */
    if (c->kept && c->pipeline && ff_report_count(c->report) == 0) {
        c->kept->run = c->run;
        c->kept->index = c->index;
    } else {
        ff_run_close(c->run);
        if (c->kept)
            c->kept->changes = 0;
    }
    free(c->fingerprints);
}

/* Writes the text as one word of a shell. */
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
    for (size_t i = 0; (set = assignment_at(study, index, run->sets, run->set_count, i)); i++) {
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

/* Adds what the case is warned of, none without: its own values and models, not what nothing reads,
   which holds for the whole study. */
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

/* Adds {stage: {name: [value, limit, verdict, text, why it is accepted, true where it is of a
   range]}} without what is not there, and the outputs that are known from below alone. */
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

/* To the microsecond, which no clock here is better than. */
static json_t *json_seconds(double seconds)
{
    return json_real(round(seconds * 1e6) / 1e6);
}

/* Adds the requested scalars, and how long each stage took or that it was reused. */
static void add_results(json_t *record, const ff_pipeline *pipeline)
{
    json_t *outputs = json_object(), *seconds = json_object(), *reused = json_object();
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        char name[160];
        if (!stage->ran)
            continue;
        json_object_set_new(stage->reused ? reused : seconds, stage->name,
                            json_seconds(stage->seconds));
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

/* Adds the error bars of scalars as outputs beside them; those of series are in the quality; and
   the settings that were chosen. */
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

/* Adds how the case stands to the limits of the file, if it has any. */
static void add_limits(json_t *record, const study_case *c, const accuracy_record *errors)
{
    limits_verdict verdict = limits_judge(c->run, c->pipeline, errors);
    if (verdict.count > 0)
        json_object_set_new(record, "limits", limits_json(&verdict));
    limits_free(&verdict);
}

/* Adds the results to the record, and keeps arrays. False after an error. */
static bool keep_results(study_case *c, const study_run *run, size_t index, json_t *record,
                         study_memory *memory)
{
    const study_measure *measure = run->study->measure;
    add_results(record, c->pipeline);
    if (measure)
        study_measure_record(c, run->study, record);
    bool repeats = measure && measure->repeat[index] > 0; /* which gives the same arrays */
    return repeats || study_arrays_keep(&memory->arrays, c, record);
}

static void note_warning(void *ctx, const ff_stage *stage, int32_t level, const char *text)
{
    const study_reuse *reuse = ctx;
    if (level == FF_LOG_WARNING)
        json_array_append_new(reuse->warnings, json_sprintf("%s: %s", stage->name, text));
}

/* Runs the case, whose pipeline is then the one that the answer comes from. */
static void compute(study_case *c, const study_run *run, study_reuse *reuse,
                    accuracy_record *errors)
{
    const study_measure *measure = run->study->measure;
    bool *fresh = measure ? study_measure_fresh(measure, c->pipeline) : NULL;
    ff_observer watch = {.size = sizeof watch,
                         .ctx = reuse,
                         .log = note_warning,
                         .recall = study_reuse_recall,
                         .keep = study_reuse_keep};
    reuse->fresh = fresh;
    study_chain_restore_states(c);
    if (accuracy_is_asked(c->run))
        accuracy_run(errors, c->run, run->engine, &watch, c->report);
    else
        run_start(c->run, &watch);
    c->pipeline = errors->answer ? errors->answer : c->pipeline;
    free(fresh);
}

/* NULL after an error of writing. */
static json_t *record_run(study_case *c, const study_run *run, size_t index, json_t *warnings,
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

json_t *study_case_run(study_case *c, const study_run *run, size_t index, study_memory *memory)
{
    study_reuse reuse = {.directory = memory->directory,
                         .fingerprints = c->fingerprints,
                         .stats = memory->stats,
                         .warnings = json_array(),
                         .held = -1};
    accuracy_record errors = {.count = 0};
    ff_pipeline *asked = c->pipeline;
    double start = study_seconds_now();
    /* running may drop outputs that a model refuses */
    json_t *parameters = study_case_parameters(c, memory->seen);
    if (study_case_is_good(c))
        compute(c, run, &reuse, &errors);
    json_t *record = record_run(c, run, index, reuse.warnings, &errors, memory);
    c->pipeline = asked;
    accuracy_free(&errors);
    json_decref(reuse.warnings);
    if (!record) {
        json_decref(parameters);
        return NULL;
    }
    json_object_set_new(record, "parameters", parameters);
    json_object_set_new(record, "seconds", json_seconds(study_seconds_now() - start));
    return record;
}
