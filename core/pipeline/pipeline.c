/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "build.h"

#include "../plugin/param.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

char *ff_pipeline_print(ff_pipeline *pipeline, const char *format, ...)
{
    char *text = NULL;
    va_list args;
    va_start(args, format);
    int length = vasprintf(&text, format, args);
    va_end(args);
    if (length < 0)
        return ff_arena_text(&pipeline->memory->arena, "", 0);
    char *kept = ff_arena_text(&pipeline->memory->arena, text, (size_t)length);
    free(text);
    return kept;
}

const char *ff_join(ff_pipeline *pipeline, const char *list, const char *word)
{
    return ff_pipeline_print(pipeline, "%s%s%s", list, *list ? ", " : "", word);
}

const char *ff_did_you_mean(ff_build *b, const char *word, const char *const *words, size_t count)
{
    const char *near = ff_nearest(word, words, count);
    return near && strcmp(near, word) != 0
               ? ff_pipeline_print(b->pipeline, "; did you mean \"%s\"?", near)
               : "";
}

const char *ff_found(const ff_node *node)
{
    return node->kind == FF_SCALAR && !node->text[0] ? "nothing" : ff_kind_name(node->kind);
}

bool ff_expected(ff_build *b, const ff_node *node, const char *where, const char *what)
{
    return ff_error(b->report, FF_EXIT_INPUT, node->place, NULL, "%s: expected %s, found %s", where,
                    what, ff_found(node));
}

bool ff_load_stage(ff_build *b, ff_stage *stage)
{
    if (stage->loaded || !stage->use)
        return stage->loaded != NULL;
    if (ff_is_choosing(b, stage))
        return ff_load_contenders(b, stage);
    stage->loaded = ff_library_load(b->library, stage->use, stage->use_place, b->report);
    if (!stage->loaded)
        return false;
    const ff_model *model = stage->loaded->model;
    stage->results =
        ff_arena_alloc(&b->pipeline->memory->arena, model->output_count * sizeof *stage->results);
    for (size_t i = 0; i < model->output_count; i++)
        stage->results[i].row = ff_model_output(model, i);
    return true;
}

static void warn_of_accuracy(const ff_build *b)
{
    bool chooses = !b->accuracy || ff_report_errors(b->report) > 0;
    for (size_t i = 0; i < b->pipeline->count && !chooses; i++)
        chooses = b->pipeline->stages[i].needed && b->pipeline->stages[i].choice;
    if (!chooses)
        ff_warn(b->report, b->accuracy->place,
                "accuracy: no stage that runs chooses its model, so that it changes nothing; "
                "write use: KIND/auto there");
}

ff_pipeline *ff_pipeline_build(const ff_tree *tree, ff_library *library, unsigned how,
                               ff_report *report)
{
    const ff_node *root = ff_tree_root(tree);
    bool everything = how & FF_EVERYTHING;
    if (!root)
        return NULL;
    ff_pipeline *pipeline = ff_alloc(sizeof *pipeline);
    pipeline->memory = ff_alloc(sizeof *pipeline->memory);
    pipeline->memory->library = library;
    ff_build b = {.pipeline = pipeline,
                  .library = library,
                  .report = report,
                  .everything = everything,
                  .paranoid = how & FF_PARANOID,
                  .accuracy = ff_node_get(root, "accuracy")};
    if (!ff_read_stages(&b, root)) {
        ff_pipeline_free(pipeline);
        return NULL;
    }
    for (size_t i = 0; everything && i < pipeline->count; i++)
        ff_link_from(&b, &pipeline->stages[i]);
    ff_request_outputs(&b, ff_node_get(root, "outputs"));
    ff_mark_needed(pipeline);
    ff_sort_stages(&b);
    for (size_t i = 0; i < pipeline->count; i++)
        if (pipeline->stages[i].loaded && (pipeline->stages[i].needed || everything))
            ff_bind_stage(&b, &pipeline->stages[i]);
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[pipeline->order[i]];
        if (stage->params && !stage->instance->broken)
            ff_open_instance(&b, stage);
    }
    warn_of_accuracy(&b);
    return pipeline;
}

void ff_pipeline_free(ff_pipeline *pipeline)
{
    if (!pipeline)
        return;
    for (size_t i = pipeline->count; i-- > 0;)
        ff_close_instance(&pipeline->stages[pipeline->order[i]]);
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[i];
        ff_free_contenders(stage);
        for (size_t k = 0; stage->params && k < stage->loaded->model->param_count; k++)
            ff_value_clear(&stage->params[k].value);
        ff_forget_results(stage);
        free(stage->state);
    }
    ff_arena_free(&pipeline->memory->arena);
    free(pipeline->memory);
    free(pipeline);
}

const char *ff_result_dim(const ff_stage *stage, size_t output, uint32_t axis)
{
    const ff_dims *dims = &stage->loaded->output_dims[output];
    uint32_t absent = dims->first_optional && stage->results[output].rank < dims->rank;
    return axis + absent < dims->rank ? dims->name[axis + absent] : "";
}

const char *ff_verdict_name(int verdict)
{
    return verdict == FF_GOOD ? "good" : verdict == FF_DOUBTFUL ? "doubtful" : "bad";
}
