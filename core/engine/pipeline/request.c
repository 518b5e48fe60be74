/* SPDX-License-Identifier: MIT */
/* Reads which outputs the file requests, and which doubts it accepts. */
#include "build.h"

#include <stdlib.h>
#include <string.h>

/* Gives an output the next position among the requested outputs, unless the output has a
   position. */
static void request(fe_build *b, ff_result *result)
{
    if (!result->requested)
        result->requested = ++b->requested;
}

/* Requests all scalars and series of the stage. False if it has none. */
static bool request_all(fe_build *b, ff_stage *stage)
{
    bool some = false;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const ff_dims *dims = &stage->loaded->output_dims[i];
        ff_result *result = &stage->results[i];
        bool field = dims->rank - dims->first_optional > 1;
        if (!field && !result->row->service)
            request(b, result);
        some = some || result->requested;
    }
    return some;
}

/* How messages describe a text "STAGE.NAME" in the file: by the key above it, and by the word for
   NAME under this key. */
typedef struct naming {
    const char *key, *item;
} naming;
static const naming of_outputs = {"outputs", "OUTPUT"}, of_limits = {"limits", "OUTPUT"},
                    of_accept = {"accept", "LINE"};

static void request_one(fe_build *b, ff_stage *stage, const char *name, ff_place place,
                        const naming *as)
{
    const ff_model *model = stage->loaded->model;
    int output = ff_model_find_output(model, name);
    if (output >= 0 && stage->results[output].row->service) {
        ff_error(b->report, FF_FAULT_INPUT, place, NULL,
                 "%s: \"%s\" of %s is a service for other stages; it has no values", as->key, name,
                 stage->name);
    } else if (output >= 0) {
        request(b, &stage->results[output]);
        stage->results[output].required = true;
    } else {
        const char **names = fe_alloc(model->output_count * sizeof *names);
        for (size_t i = 0; i < model->output_count; i++)
            names[i] = stage->results[i].row->name;
        ff_error(b->report, FF_FAULT_INPUT, place, NULL, "%s: %s (%s) has no output \"%.80s\"%s",
                 as->key, stage->name, stage->use, name,
                 fe_did_you_mean(b, name, names, model->output_count));
        fe_free(names);
    }
}

/* Finds and loads the stage of "STAGE.NAME"; NULL after an error. */
static ff_stage *find_named(fe_build *b, const char *text, ff_place place, const naming *as,
                            const char **name)
{
    size_t length = strcspn(text, ".");
    const char *word = fe_pipeline_print(b->pipeline, "%.*s", (int)length, text);
    *name = text[length] ? text + length + 1 : "";
    ff_stage *stage = fe_find_stage(b, word, place, as->key);
    if (stage && !**name)
        ff_error(b->report, FF_FAULT_INPUT, place,
                 as == &of_outputs ? "STAGE.* stands for its scalars and series" : NULL,
                 "%s: \"%s\" is a stage; write %s.%s", as->key, word, word, as->item);
    return stage && **name && fe_load_stage(b, stage) ? stage : NULL;
}

static void read_request(fe_build *b, const ff_node *item)
{
    if (item->kind != FF_SCALAR || !item->text[0]) {
        fe_expected(b, item, "outputs", "STAGE.OUTPUT or STAGE.*");
        return;
    }
    const char *name;
    ff_stage *stage = find_named(b, item->text, item->place, &of_outputs, &name);
    if (!stage)
        return;
    if (strcmp(name, "*") != 0)
        request_one(b, stage, name, item->place, &of_outputs);
    else if (!request_all(b, stage))
        ff_error(b->report, FF_FAULT_INPUT, item->place, NULL,
                 "outputs: %s (%s) has no scalars and no series", stage->name, stage->use);
    fe_link_from(b, stage);
}

/* Requests the default outputs if the file lists none: those of the stages that feed no other
   stage. Feedback wires are ignored. */
static void request_default(fe_build *b)
{
    ff_pipeline *pipeline = b->pipeline;
    bool *feeds = fe_alloc(pipeline->count * sizeof *feeds);
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        fe_link_from(b, &pipeline->stages[i]);
        for (size_t k = 0; k < stage->wire_count; k++)
            if (stage->wires[k].stage >= 0 && !stage->wires[k].feedback)
                feeds[stage->wires[k].stage] = true;
    }
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[i];
        if (!feeds[i] && stage->loaded && request_all(b, stage))
            stage->why = fe_pipeline_print(pipeline, "feeds no other stage");
    }
    fe_free(feeds);
}

/* Whether an earlier entry named the same missing stage, so that it was already reported. */
static bool is_missed_again(const fe_build *b, const ff_node *outputs, size_t index)
{
    const ff_node *item = outputs->items[index];
    const char *name;
    size_t length = item->kind == FF_SCALAR ? strcspn(item->text, ".") : 0, i = 0;
    if (length == 0 || ff_stage_of(b->pipeline, item->text, &name))
        return false;
    while (i < index && (outputs->items[i]->kind != FF_SCALAR ||
                         strcspn(outputs->items[i]->text, ".") != length ||
                         strncmp(outputs->items[i]->text, item->text, length) != 0))
        i++;
    return i < index;
}

void fe_request_outputs(fe_build *b, const ff_node *outputs)
{
    if (!outputs)
        request_default(b);
    else if (outputs->kind == FF_MAP || (outputs->kind == FF_SCALAR && !outputs->text[0]))
        fe_expected(b, outputs, "outputs", "a list such as [STAGE.OUTPUT, STAGE.*]");
    else if (outputs->kind == FF_SCALAR)
        read_request(b, outputs);
    else if (outputs->count == 0)
        ff_error(b->report, FF_FAULT_INPUT, outputs->place,
                 "remove \"outputs\" to get the scalars and series of the last stages",
                 "outputs: the list is empty, so nothing would run");
    else
        for (size_t i = 0; i < outputs->count; i++)
            if (!is_missed_again(b, outputs, i))
                read_request(b, outputs->items[i]);
}

/* Whether the node is a map or absent; otherwise reports what is expected. */
static bool is_map(fe_build *b, const ff_node *node, const char *key, const char *example)
{
    if (!node || (node->kind == FF_SCALAR && !node->text[0]))
        return false;
    if (node->kind != FF_MAP)
        fe_expected(b, node, key, example);
    return node->kind == FF_MAP;
}

void fe_request_limits(fe_build *b, const ff_node *limits)
{
    const char *name;
    if (!is_map(b, limits, "limits", "a map such as {STAGE.OUTPUT: \"> 1.5\"}"))
        return;
    for (size_t i = 0; i < limits->count; i++) {
        ff_stage *stage = find_named(b, limits->keys[i], limits->key_places[i], &of_limits, &name);
        if (stage)
            request_one(b, stage, name, limits->key_places[i], &of_limits);
        if (stage)
            fe_link_from(b, stage);
    }
}

void fe_read_accept(fe_build *b, const ff_node *accept)
{
    const char *name;
    if (!is_map(b, accept, "accept", "a map such as {STAGE.LINE: \"why this is no problem\"}"))
        return;
    for (size_t i = 0; i < accept->count; i++) {
        const ff_node *reason = accept->items[i];
        ff_stage *stage = find_named(b, accept->keys[i], accept->key_places[i], &of_accept, &name);
        if (reason->kind != FF_SCALAR || !reason->text[strspn(reason->text, " \t\n")])
            fe_expected(b, reason, fe_pipeline_print(b->pipeline, "accept.%s", accept->keys[i]),
                        "the reason why this is no problem, in words");
        else if (stage)
            stage->accept = accept;
    }
}
