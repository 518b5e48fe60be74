/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Builds and runs one case: the file with its assignments. */
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

#include <stdlib.h>
#include <string.h>

/* Adds the contents of the file under a key to the hash. */
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

/* Adds the criteria by which the case is judged to the hash: the meaning of limits, and the text of
   reasons for accepting a doubt. */
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

/* Hashes the assignments of a case that cannot be built, and so has no resolved parameters from
 * which a key could be made. */
static uint64_t hash_assignments(const study_definition *study, size_t index)
{
    uint64_t hash = study_hash_text(STUDY_HASH_START,
                                    study->spectrum ? "not built, of a spectrum" : "not built");
    for (size_t k = 0; k < study->varied_count; k++)
        hash = study_hash_text(hash, study_assignment(study, k, index));
    return study->streams ? study_hash_text(hash, study_rows_text(study->rows, index)) : hash;
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

/* Returns whether two paths lead to the same place, or one is below the other, so that their order
   matters. */
static bool paths_meet(const char *one, const char *other)
{
    static const char top[] = "pipeline.";
    one += strncmp(one, top, sizeof top - 1) ? 0 : sizeof top - 1;
    other += strncmp(other, top, sizeof top - 1) ? 0 : sizeof top - 1;
    size_t a = strlen(one), b = strlen(other), shorter = a < b ? a : b;
    return !strncmp(one, other, shorter) && (a == b || (a < b ? other : one)[shorter] == '.');
}

/* Lists the values in which two cases differ. Returns false if they also differ in anything
   else. */
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
        if (!*old || !*now || study_names_file(old) || study_names_file(now))
            return false;
        list[(*count)++] = now;
    }
    return true;
}

/* Reuses the run of the previous case with other values. Returns false if there is none or it
   cannot be reused. */
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
        study_measure_want(study, index, c->pipeline);
        if (accuracy_is_requested(c->run))
            accuracy_want_beside(c->pipeline, true);
        c->fingerprints = memory_alloc(c->pipeline->count * sizeof *c->fingerprints);
        fingerprint = study_fingerprint(c->pipeline, c->fingerprints);
    }
    if (c->pipeline && accuracy_is_requested(c->run)) {
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
    /* A pipeline with messages is not reused, since messages of an unchanged stage would not be
       repeated. */
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

static void note_warning(void *ctx, const ff_stage *stage, int32_t level, const char *text)
{
    const study_reuse *reuse = ctx;
    if (level == FF_LOG_WARNING)
        json_array_append_new(reuse->warnings, json_sprintf("%s: %s", stage->name, text));
}

/* Runs the case, and sets its pipeline to the pipeline that gave the result. */
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
    if (accuracy_is_requested(c->run))
        accuracy_run(errors, c->run, run->engine, &watch, c->report);
    else
        run_start(c->run, &watch);
    c->pipeline = errors->answer ? errors->answer : c->pipeline;
    free(fresh);
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
    /* determined before the run, which may drop outputs that a model refuses */
    json_t *parameters = study_case_parameters(c, memory->seen);
    if (study_case_is_good(c))
        compute(c, run, &reuse, &errors);
    json_t *record = study_case_record_run(c, run, index, reuse.warnings, &errors, memory);
    c->pipeline = asked;
    accuracy_free(&errors);
    json_decref(reuse.warnings);
    if (!record) {
        json_decref(parameters);
        return NULL;
    }
    json_object_set_new(record, "parameters", parameters);
    json_object_set_new(record, "seconds", study_json_seconds(study_seconds_now() - start));
    return record;
}
