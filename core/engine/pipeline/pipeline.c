/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "build.h"

#include "../plugin/param.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

char *fe_pipeline_print(fe_pipeline *pipeline, const char *format, ...)
{
    char *text = NULL;
    va_list args;
    va_start(args, format);
    int length = vasprintf(&text, format, args);
    va_end(args);
    if (length < 0)
        return fe_arena_text(&pipeline->memory->arena, "", 0);
    char *kept = fe_arena_text(&pipeline->memory->arena, text, (size_t)length);
    free(text);
    return kept;
}

const char *fe_join(fe_pipeline *pipeline, const char *list, const char *word)
{
    return fe_pipeline_print(pipeline, "%s%s%s", list, *list ? ", " : "", word);
}

const char *fe_did_you_mean(fe_build *b, const char *word, const char *const *words, size_t count)
{
    const char *near = fe_nearest(word, words, count);
    return near && strcmp(near, word) != 0
               ? fe_pipeline_print(b->pipeline, "; did you mean \"%s\"?", near)
               : "";
}

const char *fe_found(const fe_node *node)
{
    return node->kind == FE_SCALAR && !node->text[0] ? "nothing" : fe_kind_name(node->kind);
}

bool fe_expected(fe_build *b, const fe_node *node, const char *where, const char *what)
{
    return fe_error(b->report, FE_EXIT_INPUT, node->place, NULL, "%s: expected %s, found %s", where,
                    what, fe_found(node));
}

bool fe_load_stage(fe_build *b, fe_stage *stage)
{
    if (stage->loaded || !stage->use)
        return stage->loaded != NULL;
    if (fe_is_choosing(b, stage))
        return fe_load_contenders(b, stage);
    stage->loaded = fe_library_load(b->library, stage->use, stage->use_place, b->report);
    if (!stage->loaded)
        return false;
    const ff_model *model = stage->loaded->model;
    stage->results =
        fe_arena_alloc(&b->pipeline->memory->arena, model->output_count * sizeof *stage->results);
    for (size_t i = 0; i < model->output_count; i++)
        stage->results[i].row = ff_model_output(model, i);
    return true;
}

static void warn_of_accuracy(const fe_build *b)
{
    bool chooses = !b->accuracy || fe_report_errors(b->report) > 0;
    for (size_t i = 0; i < b->pipeline->count && !chooses; i++)
        chooses = b->pipeline->stages[i].needed && b->pipeline->stages[i].choice;
    if (!chooses)
        fe_warn(b->report, b->accuracy->place,
                "accuracy: no stage that runs chooses its model, so that it changes nothing; "
                "write use: KIND/auto there");
}

fe_pipeline *fe_pipeline_build(const fe_tree *tree, fe_library *library, bool everything,
                               fe_report *report)
{
    const fe_node *root = fe_tree_root(tree);
    if (!root)
        return NULL;
    fe_pipeline *pipeline = fe_alloc(sizeof *pipeline);
    pipeline->memory = fe_alloc(sizeof *pipeline->memory);
    pipeline->memory->library = library;
    fe_build b = {.pipeline = pipeline,
                  .library = library,
                  .report = report,
                  .everything = everything,
                  .accuracy = fe_node_get(root, "accuracy")};
    if (!fe_read_stages(&b, root)) {
        fe_pipeline_free(pipeline);
        return NULL;
    }
    for (size_t i = 0; everything && i < pipeline->count; i++)
        fe_link_from(&b, &pipeline->stages[i]);
    fe_request_outputs(&b, fe_node_get(root, "outputs"));
    fe_mark_needed(pipeline);
    fe_sort_stages(&b);
    for (size_t i = 0; i < pipeline->count; i++)
        if (pipeline->stages[i].loaded && (pipeline->stages[i].needed || everything))
            fe_bind_stage(&b, &pipeline->stages[i]);
    for (size_t i = 0; i < pipeline->count; i++) {
        fe_stage *stage = &pipeline->stages[pipeline->order[i]];
        if (stage->params && !stage->instance->broken)
            fe_open_instance(&b, stage);
    }
    warn_of_accuracy(&b);
    return pipeline;
}

void fe_pipeline_free(fe_pipeline *pipeline)
{
    if (!pipeline)
        return;
    for (size_t i = pipeline->count; i-- > 0;)
        fe_close_instance(&pipeline->stages[pipeline->order[i]]);
    for (size_t i = 0; i < pipeline->count; i++) {
        fe_stage *stage = &pipeline->stages[i];
        fe_free_contenders(stage);
        for (size_t k = 0; stage->params && k < stage->loaded->model->param_count; k++)
            fe_value_clear(&stage->params[k].value);
        fe_forget_results(stage);
        free(stage->state);
    }
    fe_arena_free(&pipeline->memory->arena);
    free(pipeline->memory);
    free(pipeline);
}

const char *fe_result_dim(const fe_stage *stage, size_t output, uint32_t axis)
{
    const fe_dims *dims = &stage->loaded->output_dims[output];
    uint32_t absent = dims->first_optional && stage->results[output].rank < dims->rank;
    return axis + absent < dims->rank ? dims->name[axis + absent] : "";
}

const char *fe_verdict_name(int verdict)
{
    return verdict == FF_GOOD ? "good" : verdict == FF_DOUBTFUL ? "doubtful" : "bad";
}
