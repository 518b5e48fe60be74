/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which outputs the file asks for. */
#include "build.h"

#include <stdlib.h>
#include <string.h>

bool ff_is_field(const ff_loaded *loaded, size_t output)
{
    const ff_dims *dims = &loaded->output_dims[output];
    return dims->rank - dims->first_optional > 1;
}

/* All that is not a field and no service; the number of them. */
static size_t ask_for_all(ff_stage *stage)
{
    size_t asked = 0;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        ff_result *result = &stage->results[i];
        if (!result->row->service && !ff_is_field(stage->loaded, i)) {
            result->asked = true;
            asked++;
        }
    }
    return asked;
}

static const char *nearest_output(const ff_loaded *loaded, const char *name)
{
    const ff_model *model = loaded->model;
    const char **names = ff_alloc(model->output_count * sizeof *names);
    size_t count = 0;
    for (size_t i = 0; i < model->output_count; i++)
        if (!ff_model_output(model, i)->service)
            names[count++] = ff_model_output(model, i)->name;
    const char *near = ff_nearest(name, names, count);
    free(names);
    return near;
}

static void ask_for_one(ff_build *b, ff_stage *stage, const char *name, ff_place place)
{
    int output = ff_model_find_output(stage->loaded->model, name);
    if (output >= 0 && stage->results[output].row->service) {
        ff_error(b->report, FF_EXIT_INPUT, place, NULL,
                 "outputs: \"%s\" of %s is a service for other stages; it has no values", name,
                 stage->name);
    } else if (output >= 0) {
        stage->results[output].asked = true;
        stage->instance->demanded |= UINT64_C(1) << output;
    } else {
        const char *near = nearest_output(stage->loaded, name);
        ff_error(b->report, FF_EXIT_INPUT, place, NULL,
                 near ? "outputs: %s (%s) has no output \"%.80s\"; did you mean \"%s\"?"
                      : "outputs: %s (%s) has no output \"%.80s\"",
                 stage->name, stage->use, name, near);
    }
}

static void read_request(ff_build *b, const ff_node *item)
{
    ff_pipeline *pipeline = b->pipeline;
    if (item->kind != FF_SCALAR || !item->text[0]) {
        ff_error(b->report, FF_EXIT_INPUT, item->place, NULL,
                 "outputs: expected STAGE.OUTPUT or STAGE.*, found %s",
                 item->kind == FF_SCALAR ? "nothing" : ff_kind_name(item->kind));
        return;
    }
    size_t length = strcspn(item->text, ".");
    int index = ff_find_stage(pipeline, item->text, length);
    if (index < 0) {
        char *word = ff_print_text("%.*s", (int)length, item->text);
        const char *near = ff_nearest_stage(pipeline, word);
        ff_error(b->report, FF_EXIT_INPUT, item->place, NULL,
                 near ? "outputs: there is no stage \"%.80s\"; did you mean \"%s\"?"
                      : "outputs: there is no stage \"%.80s\"",
                 word, near);
        free(word);
        return;
    }
    ff_stage *stage = &pipeline->stages[index];
    if (!item->text[length] || !item->text[length + 1]) {
        ff_error(b->report, FF_EXIT_INPUT, item->place, NULL,
                 "outputs: \"%s\" is a stage; write %s.OUTPUT, or %s.* for its scalars and series",
                 stage->name, stage->name, stage->name);
        return;
    }
    if (!ff_load_stage(b, stage))
        return;
    const char *name = item->text + length + 1;
    if (strcmp(name, "*") != 0)
        ask_for_one(b, stage, name, item->place);
    else if (ask_for_all(stage) == 0)
        ff_error(b->report, FF_EXIT_INPUT, item->place, NULL,
                 "outputs: %s (%s) has no scalars and no series", stage->name, stage->use);
    ff_link_from(b, (size_t)index);
}

/* Without a list: what the stages offer that feed no other. */
static void ask_by_default(ff_build *b)
{
    ff_pipeline *pipeline = b->pipeline;
    bool *feeds = ff_alloc(pipeline->count * sizeof *feeds);
    for (size_t i = 0; i < pipeline->count; i++)
        ff_link_from(b, i);
    for (size_t i = 0; i < pipeline->count; i++)
        for (size_t k = 0; k < pipeline->stages[i].wire_count; k++)
            if (pipeline->stages[i].wires[k].stage >= 0)
                feeds[pipeline->stages[i].wires[k].stage] = true;
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[i];
        if (!feeds[i] && stage->loaded && ask_for_all(stage) > 0)
            stage->why = ff_pipeline_print(pipeline, "feeds no other stage");
    }
    free(feeds);
}

void ff_request_outputs(ff_build *b, const ff_node *outputs)
{
    if (!outputs)
        ask_by_default(b);
    else if (outputs->kind == FF_MAP || (outputs->kind == FF_SCALAR && !outputs->text[0]))
        ff_error(b->report, FF_EXIT_INPUT, outputs->place, NULL,
                 "outputs: expected a list such as [STAGE.OUTPUT, STAGE.*], found %s",
                 outputs->kind == FF_MAP ? ff_kind_name(FF_MAP) : "nothing");
    else if (outputs->kind == FF_SCALAR)
        read_request(b, outputs);
    else if (outputs->count == 0)
        ff_error(b->report, FF_EXIT_INPUT, outputs->place,
                 "leave \"outputs\" away to get the scalars and series of the last stages",
                 "outputs: the list is empty, so that nothing would run");
    else
        for (size_t i = 0; i < outputs->count; i++)
            read_request(b, outputs->items[i]);
}
