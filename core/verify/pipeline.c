/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters and inputs of a real run: those of a stage in a user's file. */
#include "subject.h"

#include "../value/memory.h"

#include <stdlib.h>
#include <string.h>

/* The name of the stage that uses the model; NULL after an error. */
static const char *find_stage(const ff_node *root, const char *id, ff_report *report)
{
    const ff_node *stages = ff_node_get(root, "pipeline");
    for (size_t i = 0; stages && stages->kind == FF_MAP && i < stages->count; i++) {
        const ff_node *use = ff_node_get(stages->items[i], "use");
        if (use && use->kind == FF_SCALAR && !strcmp(use->text, id))
            return stages->keys[i];
    }
    ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL, "no stage of the file uses %s", id);
    return NULL;
}

static void take_values(ff_feed *feed, const ff_stage *stage)
{
    for (size_t i = 0; i < feed->loaded->model->param_count; i++) {
        const ff_value *value = &stage->params[i].value;
        if (!stage->params[i].present)
            continue;
        feed->values[i] = *value;
        feed->values[i].size = sizeof *value;
        feed->values[i].text = value->text ? ff_print_text("%s", value->text) : NULL;
        if (value->reals) {
            double *reals = ff_alloc((value->count + 1) * sizeof *reals);
            memcpy(reals, value->reals, value->count * sizeof *reals);
            feed->values[i].reals = reals;
        }
    }
}

static ff_feed *take(const ff_pipeline *pipeline, const char *name, const ff_subject *subject)
{
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        if (strcmp(stage->name, name) != 0)
            continue;
        const ff_loaded *loaded = subject->loaded;
        ff_feed *feed = ff_feed_new(subject);
        take_values(feed, stage);
        for (size_t k = 0; k < loaded->model->input_count; k++) {
            const ff_result *result = ff_feeding_result(pipeline, stage, k);
            if (result && result->data)
                ff_feed_give(feed, k, result->data, result->rank, result->shape);
        }
        return feed;
    }
    return NULL;
}

ff_feed *ff_feed_from_pipeline(const ff_verify *request, ff_library *library,
                               const ff_subject *subject, bool inputs, ff_report *report)
{
    ff_tree *tree = ff_tree_load(request->pipeline, report);
    ff_feed *feed = NULL;
    const char *name = NULL;
    bool good = ff_tree_root(tree) && ff_report_errors(report) == 0;
    for (size_t i = 0; i < request->set_count && good; i++)
        good = ff_tree_set(tree, request->sets[i], "pipeline", ff_pipeline_top_keys, report);
    if (good)
        name = find_stage(ff_tree_root(tree), subject->loaded->model->id, report);
    if (name) {
        bool data = ff_all_outputs(subject->loaded->model); /* or a law, which nothing asks for */
        char *outputs = ff_print_text("outputs=[%s.*]", name);
        good = !data || ff_tree_set(tree, outputs, "pipeline", ff_pipeline_top_keys, report);
        ff_pipeline *pipeline = ff_pipeline_build(tree, library, data ? 0 : FF_EVERYTHING, report);
        if (pipeline && ff_report_errors(report) == 0 &&
            (!inputs || !data || ff_pipeline_run(pipeline, NULL, report)))
            feed = take(pipeline, name, subject);
        ff_pipeline_free(pipeline);
        free(outputs);
    }
    ff_tree_free(tree);
    return feed;
}
