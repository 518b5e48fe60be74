/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One case: the file with its assignments, built, run and recorded. */
#include "private.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A case that cannot be built has no resolved parameters: its assignments stand for them. */
static uint64_t print_assignments(const ff_study *study, size_t index)
{
    uint64_t hash = ff_hash_text(FF_HASH_START, "not built");
    for (size_t k = 0; k < study->varied_count; k++)
        hash = ff_hash_text(hash, ff_study_assignment(study, k, index));
    return hash;
}

static bool is_file(const char *assignment)
{
    return !strncmp(assignment, "include=", 8);
}

/* Number i of all assignments of a case, in order; NULL behind the last, "" for none. */
static const char *assignment_at(const ff_study *study, size_t index, const char *const *sets,
                                 size_t set_count, size_t i)
{
    size_t n = study->varied_count, k = i < n ? i : i - set_count - n;
    if (i >= n && i < n + set_count)
        return sets[i - n];
    if (k >= n)
        return NULL;
    const char *text = ff_study_assignment(study, k, index);
    return is_file(text) == (i < n) ? text : "";
}

void ff_study_lay(const ff_study *study, size_t index, const char *const *sets, size_t set_count,
                  ff_tree *tree, ff_report *report)
{
    const char *text;
    size_t n = study->varied_count;
    for (size_t i = 0; (text = assignment_at(study, index, sets, set_count, i)); i++) {
        const ff_varied *v = i >= n + set_count ? &study->varied[i - n - set_count] : NULL;
        const ff_place *path = v && v->place.source ? &v->place : NULL, *place = path;
        if (path && v->values)
            place = &v->values->items[ff_study_rank(study, v->axis, index)]->place;
        if (*text && ff_tree_root(tree))
            ff_tree_set_at(tree, text, path, place, "pipeline", ff_pipeline_top_keys, report);
    }
    if (study->request && ff_tree_root(tree))
        ff_tree_put(tree, "outputs", study->request);
}

void ff_case_open(ff_case *c, const ff_campaign *campaign, size_t index)
{
    const ff_study *study = campaign->study;
    *c =
        (ff_case){.report = ff_report_new(), .states = study->starts ? study->starts[index] : NULL};
    c->tree = ff_tree_load(campaign->file, c->report);
    ff_study_lay(study, index, campaign->sets, campaign->set_count, c->tree, c->report);
    c->pipeline = ff_pipeline_build(c->tree, campaign->library,
                                    campaign->paranoid ? FF_PARANOID : 0, c->report);
    uint64_t print = print_assignments(study, index);
    if (ff_case_is_good(c)) {
        ff_measure_want(study, c->pipeline);
        c->prints = ff_alloc(c->pipeline->count * sizeof *c->prints);
        print = ff_fingerprint(c->pipeline, c->prints);
    }
    c->print = print;
    if (study->measure)
        print = ff_measure_print(print, study->measure->repeat[index]);
    snprintf(c->key, sizeof c->key, "%016llx", (unsigned long long)print);
}

bool ff_case_is_good(const ff_case *c)
{
    return c->pipeline && ff_report_errors(c->report) == 0;
}

void ff_case_close(ff_case *c)
{
    ff_pipeline_free(c->pipeline);
    ff_tree_free(c->tree);
    ff_report_free(c->report);
    free(c->prints);
}

void ff_put_quoted(FILE *out, const char *text)
{
    fputc('\'', out);
    for (; *text; text++)
        fputs(*text == '\'' ? "'\\''" : (char[]){*text, 0}, out);
    fputc('\'', out);
}

/* The line that runs the case again: alone, unless it starts from its neighbour. */
static json_t *command_of(const ff_campaign *campaign, size_t index)
{
    const ff_study *study = campaign->study;
    char *text = NULL;
    size_t length = 0;
    FILE *out = ff_there(open_memstream(&text, &length));
    fputs("flankfilm run ", out);
    ff_put_quoted(out, campaign->file);
    bool alone = ff_study_chain_length(study) == 1 && !(study->starts && study->starts[index]);
    const char *set;
    for (size_t i = 0; (set = assignment_at(study, index, campaign->sets, campaign->set_count, i));
         i++) {
        if (!*set ||
            (!alone && (i < study->varied_count || i >= study->varied_count + campaign->set_count)))
            continue;
        fputs(" --set ", out);
        ff_put_quoted(out, set);
    }
    fputs(alone ? " --set 'study=' -o " : " --rerun failed -o ", out);
    char *directory = alone ? ff_print_text("%s-case-%zu", campaign->directory, index + 1)
                            : ff_print_text("%s", campaign->directory);
    ff_put_quoted(out, directory);
    free(directory);
    fclose(out);
    json_t *command = json_string(text);
    free(text);
    return command ? command : json_null();
}

json_t *ff_case_set(const ff_study *study, size_t index)
{
    json_t *set = json_object();
    for (size_t k = 0; k < study->varied_count; k++)
        json_object_set_new(set, study->varied[k].path,
                            json_string(ff_study_value(study, k, index)));
    return set;
}

json_t *ff_case_record(const ff_campaign *campaign, size_t index, const char *key,
                       const char *status, const char *reason)
{
    json_t *record = json_pack("{s:I, s:s, s:s, s:o}", "case", (json_int_t)index + 1, "key", key,
                               "status", status, "set", ff_case_set(campaign->study, index));
    if (reason) {
        json_t *text = json_string(reason);
        json_object_set_new(record, "reason", text ? text : json_string("not in UTF-8"));
        json_object_set_new(record, "command", command_of(campaign, index));
    }
    return record;
}

char *ff_first_error(const ff_report *report)
{
    char text[2000] = "no reason is known";
    for (size_t i = ff_report_count(report); i-- > 0;) {
        const ff_message *m = ff_report_at(report, i);
        if (m->severity != FF_ERROR)
            continue;
        if (m->place.source && m->place.source->brief)
            ff_message_print(m, text, sizeof text);
        else
            snprintf(text, sizeof text, "%s", m->text);
    }
    return ff_copy_text(text, strlen(text));
}

static const char *status_of(const ff_report *report)
{
    int code = ff_report_exit_code(report);
    return code == FF_EXIT_OK       ? "ok"
           : code == FF_EXIT_FAILED ? "failed"
           : code == FF_EXIT_INPUT  ? "invalid"
                                    : "plugin fault";
}

/* {stage: {name: [value, limit, verdict, text]}} */
static void add_quality(json_t *record, const ff_pipeline *pipeline)
{
    json_t *all = json_object();
    for (size_t i = 0; pipeline && i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        json_t *lines = stage->quality_count ? json_object() : NULL;
        for (size_t k = 0; k < stage->quality_count; k++) {
            const ff_quality *line = &stage->quality[k];
            json_object_set_new(lines, line->name,
                                json_pack("[o, o, i, s*]", ff_json_real(line->value),
                                          ff_json_real(line->limit), line->verdict, line->text));
        }
        if (lines)
            json_object_set_new(all, stage->name, lines);
    }
    json_object_set_new(record, "quality", all);
}

/* [unit, dims, shape] of what the files of the case hold. */
static json_t *describe_array(const ff_stage *stage, size_t output)
{
    const ff_result *result = &stage->results[output];
    json_t *dims = json_array(), *shape = json_array();
    for (uint32_t i = 0; i < result->rank; i++) {
        json_array_append_new(dims, json_string(ff_result_dim(stage, output, i)));
        json_array_append_new(shape, json_integer((json_int_t)result->shape[i]));
    }
    return json_pack("[s, o, o]", result->row->unit, dims, shape);
}

/* What the run gave: requested scalars, and how each stage came by its results. */
static bool add_results(json_t *record, const ff_pipeline *pipeline)
{
    json_t *outputs = json_object(), *seconds = json_object(), *reused = json_object();
    json_t *arrays = json_object();
    json_t *chosen = json_object();
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        char name[160];
        if (!stage->ran)
            continue;
        if (stage->choice)
            json_object_set_new(chosen, stage->name, json_string(stage->use));
        json_object_set_new(stage->reused ? reused : seconds, stage->name,
                            json_real(stage->seconds));
        for (size_t k = 0; k < stage->loaded->model->output_count; k++) {
            const ff_result *result = &stage->results[k];
            if (!result->asked || !result->data)
                continue;
            snprintf(name, sizeof name, "%s.%s", stage->name, result->row->name);
            if (result->rank > 0)
                json_object_set_new(arrays, name, describe_array(stage, k));
            else
                json_object_set_new(outputs, name,
                                    json_pack("[s, f]", result->row->unit, result->data[0]));
        }
    }
    json_object_set_new(record, "outputs", outputs);
    json_object_set_new(record, "stages", seconds);
    json_object_set_new(record, "reused", reused);
    if (json_object_size(chosen)) {
        json_object_set(record, "chosen", chosen);
        json_object_set_new(record, "choices", ff_choices_record(pipeline));
    }
    json_decref(chosen);
    bool any = json_object_size(arrays) > 0;
    if (any)
        json_object_set(record, "arrays", arrays);
    json_decref(arrays);
    return any;
}

static bool recall(void *ctx, const ff_pipeline *pipeline, ff_stage *stage)
{
    return ff_reuse_recall(ctx, pipeline, stage);
}

static void keep(void *ctx, const ff_pipeline *pipeline, const ff_stage *stage)
{
    ff_reuse_keep(ctx, pipeline, stage);
}

/* In the record, and series and fields in files. False after an error. */
static bool keep_results(ff_case *c, const ff_campaign *campaign, size_t index, json_t *record)
{
    bool series = add_results(record, c->pipeline);
    if (campaign->study->measure) {
        json_object_del(record, "arrays"); /* it has a file of its own for these */
        return ff_measure_record(c, campaign, index, record);
    }
    if (!series)
        return true;
    char *path = ff_print_text("%s/cases/%s", campaign->directory, c->key);
    bool written = campaign->write(c->pipeline, path, c->report);
    free(path);
    return written;
}

json_t *ff_case_run(ff_case *c, const ff_campaign *campaign, size_t index, ff_memory *memory)
{
    ff_reuse reuse = {
        .directory = memory->directory, .prints = c->prints, .habits = memory->habits, .held = -1};
    ff_watch watch = {.recall = recall, .keep = keep, .ctx = &reuse};
    double start = ff_seconds_now();
    json_t *setups = ff_case_setups(c); /* running may drop outputs that a model refuses */
    json_t *parameters = ff_case_parameters(c, setups, memory->seen);
    if (ff_case_is_good(c)) {
        const ff_measure *measure = campaign->study->measure;
        bool *fresh = measure ? ff_measure_fresh(measure, c->pipeline) : NULL;
        reuse.fresh = fresh;
        ff_chain_give(c);
        ff_pipeline_run(c->pipeline, &watch, c->report);
        free(fresh);
    }
    bool good = ff_report_errors(c->report) == 0;
    char *reason = good ? NULL : ff_first_error(c->report);
    json_t *record = ff_case_record(campaign, index, c->key, status_of(c->report), reason);
    free(reason);
    add_quality(record, c->pipeline);
    if (good && !keep_results(c, campaign, index, record)) {
        json_decref(setups);
        json_decref(parameters);
        json_decref(record);
        return NULL;
    }
    ff_chain_take(c, record);
    json_object_set_new(record, "setups", setups);
    json_object_set_new(record, "parameters", parameters);
    json_object_set_new(record, "seconds", json_real(ff_seconds_now() - start));
    return record;
}

bool ff_record_is_ok(const json_t *record)
{
    const char *status = json_string_value(json_object_get(record, "status"));
    return status && !strcmp(status, "ok");
}

bool ff_record_stands(const json_t *record, enum ff_rerun rerun)
{
    return record &&
           (rerun == FF_RERUN_NONE || (rerun == FF_RERUN_FAILED && ff_record_is_ok(record)));
}
