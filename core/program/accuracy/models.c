/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "models.h"

#include "goals.h"

#include "../run/run.h"

#include <stdlib.h>
#include <string.h>

static const char ending[] = "/auto";

bool accuracy_is_open_use(const char *use)
{
    size_t length = strlen(use), tail = sizeof ending - 1;
    return length > tail && !strcmp(use + length - tail, ending);
}

static bool is_open_node(const ff_node *use)
{
    return use && use->kind == FF_SCALAR && accuracy_is_open_use(use->text);
}

const char *accuracy_open_use(const ff_stage *stage)
{
    const ff_node *use = ff_node_get(stage->node, "use"), *was = use ? use->replaced : NULL;
    bool same = is_open_node(was) && was->place.source == use->place.source &&
                was->place.line == use->place.line && was->place.column == use->place.column;
    return same ? was->text : NULL; /* a model named by the user has another place */
}

/* True if the id belongs to the kind before the slash of `use`. */
static bool is_of_kind(const char *id, const char *use)
{
    return !strncmp(id, use, strcspn(use, "/") + 1);
}

/* NULL if the model is missing or disabled. */
static const ff_loaded *loaded_of(ff_engine *engine, const char *id)
{
    ff_report *unused = ff_report_new();
    const ff_loaded *loaded = ff_engine_model(engine, id, FF_NOWHERE, unused);
    ff_report_free(unused);
    return loaded;
}

static double cost_of(ff_engine *engine, const char *id)
{
    const ff_loaded *loaded = loaded_of(engine, id);
    return loaded ? ff_model_cost(loaded->model) : 0;
}

static bool is_law(const ff_model *model)
{
    return model->output_count > 0 && ff_model_output(model, 0)->service;
}

/* The most expensive model of the kind. NULL if none states its cost, or if the kind is a law,
   whose most expensive member need not be the exact one. */
static const char *most_expensive(ff_engine *engine, const char *use)
{
    const char *found = NULL;
    size_t count;
    const char *const *ids = ff_engine_ids(engine, &count);
    double most = 0;
    for (size_t i = 0; i < count; i++) {
        const ff_loaded *loaded = is_of_kind(ids[i], use) ? loaded_of(engine, ids[i]) : NULL;
        if (!loaded || is_law(loaded->model) || !(ff_model_cost(loaded->model) > most))
            continue;
        most = ff_model_cost(loaded->model);
        found = ids[i];
    }
    return found;
}

static const char *reference_of(const ff_node *stage, ff_engine *engine)
{
    const ff_node *named = ff_node_get(stage, "reference"), *with = ff_node_get(stage, "with");
    const char *use = ff_node_get(stage, "use")->text;
    if (named && named->kind == FF_SCALAR && *named->text)
        return named->text;
    for (size_t i = 0; with && with->kind == FF_MAP && i < with->count; i++)
        if (is_of_kind(with->keys[i], use))
            return with->keys[i];
    return most_expensive(engine, use);
}

static bool refuse(const ff_node *use, const char *name, ff_report *report)
{
    return ff_error(report, FF_FAULT_INPUT, use->place,
                    "write \"reference: MODEL\", or a set of parameters for each model under "
                    "\"with\", the most exact first",
                    "%s: with which model of %s are the others to be compared?", name, use->text);
}

/* Replaces KIND/auto by the reference. */
static void name_reference(ff_run *run, const char *name, const ff_node *stage, ff_engine *engine)
{
    ff_report *report = ff_run_report(run);
    const ff_node *use = ff_node_get(stage, "use"), *named = ff_node_get(stage, "reference");
    if (named && named->kind != FF_SCALAR) {
        ff_error(report, FF_FAULT_INPUT, named->place, NULL,
                 "%s.reference: expected the name of a model, found a %s", name,
                 named->kind == FF_MAP ? "map" : "list");
        return;
    }
    const char *reference = reference_of(stage, engine);
    const ff_place place = reference && named ? named->place : use->place;
    if (!reference) {
        refuse(use, name, report);
        return;
    }
    if (!is_of_kind(reference, use->text)) {
        ff_error(report, FF_FAULT_INPUT, place, NULL,
                 "%s.reference: \"%.80s\" is not a model of %s", name, reference, use->text);
        return;
    }
    char *set = memory_print_text("pipeline.%s.use=%s", name, reference);
    const ff_place at = use->place;
    run_set(run, set, &at, &at);
    free(set);
}

static void check_requests(ff_run *run)
{
    const ff_pipeline *pipeline = ff_run_pipeline(run);
    for (size_t i = 0; i < pipeline->count && !accuracy_has_goals(run); i++) {
        const ff_stage *stage = &pipeline->stages[i];
        if (stage->needed && accuracy_open_use(stage))
            ff_error(ff_run_report(run), FF_FAULT_INPUT, stage->use_place,
                     "accuracy: 2 %, or name the model",
                     "%s: %s needs an accuracy, but the file states none", stage->name,
                     accuracy_open_use(stage));
    }
}

static size_t stage_count(const ff_run *run)
{
    const ff_node *stages = ff_node_get(ff_run_root(run), "pipeline");
    return stages && stages->kind == FF_MAP ? stages->count : 0;
}

/* True if the stage has KIND/auto, in this layer or an earlier one. */
static bool was_open(const ff_node *stage)
{
    for (const ff_node *use = ff_node_get(stage, "use"); use; use = use->replaced)
        if (is_open_node(use))
            return true;
    return false;
}

/* Removes the key `reference`, which is no parameter of a model. */
static void remove_reference(ff_run *run, const char *name)
{
    char *none = memory_print_text("pipeline.%s.reference=", name);
    run_set(run, none, NULL, NULL);
    free(none);
}

/*
 * Gives each stage that says KIND/auto its reference, with which other models of the kind are
 * compared: the model under `reference`, else the first under `with`, else the most expensive. For
 * a law the file must name it. Returns false after an error.
 */
static bool name_references(ff_run *run, ff_engine *engine)
{
    const ff_report *report = ff_run_report(run);
    size_t errors = ff_report_errors(report), count = stage_count(run);
    for (size_t i = 0; i < count; i++) {
        const ff_node *stages = ff_node_get(ff_run_root(run), "pipeline"); /* in the current
                                                                              layer */
        const ff_node *stage = stages->items[i];
        const char *name = stages->keys[i];
        const ff_node *reference = ff_node_get(stage, "reference");
        bool empty = !reference || (reference->kind == FF_SCALAR && !*reference->text);
        if (is_open_node(ff_node_get(stage, "use")))
            name_reference(run, name, stage, engine);
        if (!empty && was_open(stage))
            remove_reference(run, name);
    }
    return ff_report_errors(report) == errors;
}

ff_pipeline *accuracy_build_alone(ff_run *run, ff_engine *engine, bool everything)
{
    return name_references(run, engine) ? run_build(run, everything) : NULL;
}

ff_pipeline *accuracy_build(ff_run *run, ff_engine *engine, bool everything)
{
    ff_pipeline *pipeline = accuracy_build_alone(run, engine, everything);
    if (pipeline && !run_has_errors(run) && accuracy_check(run))
        check_requests(run);
    return pipeline;
}

const char **accuracy_candidates(const ff_stage *stage, ff_engine *engine, memory_arena *arena)
{
    size_t all, count = 0;
    const char *const *ids = ff_engine_ids(engine, &all);
    const char *use = accuracy_open_use(stage);
    const char **list = memory_arena_alloc(arena, (all + 1) * sizeof *list);
    const double most = ff_model_cost(stage->loaded->model);
    for (size_t i = 0; use && i < all; i++) {
        double cost = is_of_kind(ids[i], use) ? cost_of(engine, ids[i]) : 0;
        if (!(cost > 0) || (most > 0 && cost >= most))
            continue;
        size_t at = count++;
        for (; at > 0 && cost_of(engine, list[at - 1]) > cost; at--)
            list[at] = list[at - 1];
        list[at] = ids[i];
    }
    return list;
}

char *accuracy_print_key(const ff_run *run, ff_engine *engine)
{
    const ff_pipeline *pipeline = ff_run_pipeline(run);
    char *text = accuracy_print_goals(run);
    memory_arena arena = {.blocks = NULL};
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        bool chooses = stage->needed && stage->loaded && accuracy_open_use(stage);
        const char **ids = chooses ? accuracy_candidates(stage, engine, &arena) : NULL;
        for (; ids && *ids; ids++) {
            unsigned long long build = loaded_of(engine, *ids)->build;
            memory_add_text(&text, "; %s: %s %llx", stage->name, *ids, build);
        }
    }
    memory_arena_free(&arena);
    return text;
}
