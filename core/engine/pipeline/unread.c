/* SPDX-License-Identifier: MIT */
/* Reports settings without effect: those of stages that do not run, and parameters and wires that
   affect no requested output (host->serves). Refuses values that are given twice. */
#include "build.h"

#include "../plugin/param.h"

#include <stdio.h>
#include <string.h>

int fe_find_table(const ff_model *model, const char *item)
{
    char name[96];
    const char *dot = strchr(item, '.');
    snprintf(name, sizeof name, "%.*s", (int)strcspn(item, "."), item);
    int param = dot ? ff_model_find_param(model, name) : -1;
    for (size_t i = 0; param >= 0 && i < ff_model_columns(model); i++)
        if (!strcmp(ff_model_column(model, i)->name, dot + 1))
            return ff_model_param(model, (size_t)param)->type == FF_FILE ? param : -1;
    return -1;
}

/* Returns what the model stated about an item by host->serves; an input may be named by its wire.
   NULL: nothing, so that the item affects all outputs. */
static const fe_serving *serving_of(const ff_stage *stage, const char *item)
{
    const fe_instance *instance = stage->instance;
    for (size_t i = 0; i < instance->serving_count; i++) {
        const char *named = instance->servings[i].item;
        bool param = ff_model_find_param(stage->loaded->model, named) >= 0;
        if (param ? !strcmp(named, item) : fe_is_on_wire(item, named))
            return &instance->servings[i];
    }
    return NULL;
}

/* Returns the stage that feeds an input, and in *output the index of the output; NULL: none. */
static ff_stage *feeding(const ff_pipeline *pipeline, const ff_stage *stage, size_t input,
                         size_t *output)
{
    const ff_wire *wire = stage->wire_count ? fe_input_wire(stage, input) : NULL;
    ff_stage *from = wire && wire->stage >= 0 ? &pipeline->stages[wire->stage] : NULL;
    int offer = from && from->loaded
                    ? fe_find_offer(from->loaded, ff_model_input(stage->loaded->model, input))
                    : -1;
    *output = (size_t)offer;
    return offer < 0 ? NULL : from;
}

/* Marks an output as read by a requested output, and also all outputs on which the marked output
   depends. */
static void mark_read(const ff_pipeline *pipeline, ff_stage *stage, size_t output)
{
    bool *read = stage->instance->read;
    if (!read || read[output])
        return;
    read[output] = true;
    for (size_t i = 0; i < stage->loaded->model->input_count; i++) {
        const char *name = ff_model_input(stage->loaded->model, i)->name;
        size_t offer;
        ff_stage *from = feeding(pipeline, stage, i, &offer);
        const fe_serving *serving = from ? serving_of(stage, name) : NULL;
        if (from &&
            (!serving || fe_word_find(serving->outputs, stage->results[output].row->name) >= 0))
            mark_read(pipeline, from, offer);
    }
}

static bool reads_any(const ff_stage *stage, const char *outputs)
{
    for (size_t i = 0; i < stage->loaded->model->output_count; i++)
        if (stage->instance->read[i] &&
            (!outputs || fe_word_find(outputs, stage->results[i].row->name) >= 0))
            return true;
    return false;
}

/* Returns the place where a parameter or a wire of the stage is written; its source is NULL if it
   is not written. */
static ff_place written_at(const fe_build *b, const ff_stage *stage, const char *item)
{
    int param = ff_model_find_param(stage->loaded->model, item);
    param = param < 0 ? fe_find_table(stage->loaded->model, item) : param;
    if (param >= 0)
        return stage->params[param].place;
    for (size_t i = 0; i < stage->wire_count; i++)
        if (!strcmp(stage->wires[i].name, item) && stage->wires[i].stage >= 0)
            return stage->wires[i].automatic ? b->pipeline->stages[stage->wires[i].stage].place
                                             : stage->wires[i].place;
    return FF_NOWHERE;
}

/* For an output that affects no requested output: returns why a stage that takes it does not use
   it. */
static const fe_serving *excuse_of(const fe_build *b, const ff_stage *from, size_t output,
                                   const ff_stage **taker)
{
    for (size_t k = 0; k < b->pipeline->count; k++) {
        const ff_stage *stage = &b->pipeline->stages[k];
        for (size_t i = 0;
             stage->needed && stage->instance->read && i < stage->loaded->model->input_count; i++) {
            size_t offer;
            const fe_serving *serving =
                feeding(b->pipeline, stage, i, &offer) == from && offer == output
                    ? serving_of(stage, ff_model_input(stage->loaded->model, i)->name)
                    : NULL;
            *taker = stage;
            if (serving && (*serving->text || *serving->by))
                return serving;
        }
    }
    return NULL;
}

/* Refuses a parameter whose value stage `by` gives a second time: `stated` names the parameter,
   `serving` the item of stage `by` that replaces it. */
static bool refuse_twice(fe_build *b, const ff_stage *stage, const fe_serving *stated,
                         ff_place place, const ff_stage *by, const fe_serving *serving)
{
    ff_place other = *serving->by ? written_at(b, by, serving->by) : FF_NOWHERE;
    if (!other.source)
        return false;
    ff_error(
        b->report, FF_FAULT_INPUT, place,
        fe_pipeline_print(b->pipeline,
                          "remove one of the two; an empty value removes the first: --set %s.%s=",
                          stage->name, stated->item),
        "%s.%s and %s.%s (%s) give the same value twice%s%s", stage->name, stated->item, by->name,
        serving->by, fe_place_text(b->pipeline, other), *serving->text ? ": " : "", serving->text);
    return true;
}

/* Prints "x|film|pressure" as a list in words: "x", "film" or "pressure". */
static const char *list_outputs(fe_build *b, const char *outputs)
{
    const char *text = "";
    for (const char *at = outputs; *at; at += *at == '|') {
        size_t length = strcspn(at, "|");
        const char *before = !*text ? "" : at[length] ? ", " : " or ";
        text = fe_pipeline_print(b->pipeline, "%s%s\"%.*s\"", text, before, (int)length, at);
        at += length;
    }
    return text;
}

/* Whether the outputs were chosen later than the value: by a file that includes the value's file,
   by a study or by an assignment. The value was then written for other outputs. */
static bool is_chosen_later(const ff_stage *stage, const char *item, const ff_node *outputs)
{
    const ff_node *value = ff_node_get(stage->node, item);
    return value && outputs && outputs->rank > value->rank;
}

static void check_serving(fe_build *b, const ff_stage *stage, const fe_serving *serving,
                          const ff_node *outputs)
{
    ff_place place = written_at(b, stage, serving->item);
    const ff_stage *taker = NULL;
    const fe_serving *excuse = NULL;
    int param = ff_model_find_param(stage->loaded->model, serving->item);
    if (!place.source || reads_any(stage, serving->outputs) ||
        refuse_twice(b, stage, serving, place, stage, serving))
        return;
    for (size_t i = 0; i < stage->loaded->model->output_count && !excuse; i++)
        if (fe_word_find(serving->outputs, stage->results[i].row->name) >= 0)
            excuse = excuse_of(b, stage, i, &taker);
    if (excuse && param >= 0 && refuse_twice(b, stage, serving, place, taker, excuse))
        return;
    if (*serving->text)
        ff_warn(b->report, place, "%s.%s changes nothing: %s", stage->name, serving->item,
                serving->text);
    else if (excuse && *excuse->text)
        ff_warn(b->report, place, "%s.%s changes nothing: %s: %s", stage->name, serving->item,
                taker->name, excuse->text);
    else if (*serving->outputs && is_chosen_later(stage, serving->item, outputs))
        return;
    else if (*serving->outputs)
        ff_warn(b->report, place, "%s.%s changes nothing: no requested output depends on %s of %s",
                stage->name, serving->item, list_outputs(b, serving->outputs), stage->name);
    else
        ff_warn(b->report, place, "%s.%s changes nothing with these settings", stage->name,
                serving->item);
}

/* Warns of a stage whose outputs are used by other stages but affect no requested output. */
static void warn_of_stage(fe_build *b, const ff_stage *stage)
{
    const ff_stage *taker = NULL;
    const fe_serving *excuse = NULL;
    for (size_t i = 0; i < stage->loaded->model->output_count && !excuse; i++)
        excuse = excuse_of(b, stage, i, &taker);
    ff_warn(b->report, stage->place, "%s: no requested output depends on this stage%s%s%s%s",
            stage->name, excuse && *excuse->text ? ": " : "",
            excuse && *excuse->text ? taker->name : "", excuse && *excuse->text ? ": " : "",
            excuse ? excuse->text : "");
}

/* Warns of assignments to a stage that does not run. True if there are any. */
static bool warn_of_assigned(fe_build *b, const ff_stage *stage, const ff_node *node,
                             const char *path)
{
    bool some = node->kind != FF_MAP && node->rank > b->file_rank;
    for (size_t i = 0; node->kind == FF_MAP && i < node->count; i++)
        some = warn_of_assigned(b, stage, node->items[i],
                                fe_pipeline_print(b->pipeline, "%s.%s", path, node->keys[i])) ||
               some;
    if (node->kind != FF_MAP && some)
        ff_warn(b->report, node->place,
                "%s changes nothing: the stage \"%s\" does not run, since no requested output "
                "needs it",
                path, stage->name);
    return some;
}

static void warn_of_idle(fe_build *b, const ff_node *outputs)
{
    const char *names = "";
    size_t count = 0;
    for (size_t i = 0; i < b->pipeline->count; i++) {
        const ff_stage *stage = &b->pipeline->stages[i];
        if (stage->needed || fe_latest_rank(stage->node) < b->file_rank)
            continue; /* an included file may define more than is used */
        if (warn_of_assigned(b, stage, stage->node, stage->name))
            continue;
        names = fe_join(b->pipeline, names,
                        fe_pipeline_print(b->pipeline, "%s (%s)", stage->name,
                                          fe_place_text(b->pipeline, stage->place)));
        count++;
    }
    /* the outputs were chosen for this run, or by a study */
    bool chosen = outputs && outputs->rank > b->file_rank;
    if (count > 0 && !chosen)
        ff_warn(
            b->report, outputs ? outputs->place : FF_NOWHERE,
            "%s not run, since no requested output needs %s, so %s in the file change nothing: %s",
            count == 1 ? "one stage does" : "some stages do", count == 1 ? "it" : "them",
            count == 1 ? "its settings" : "their settings", names);
}

void fe_check_unread(fe_build *b, const ff_node *outputs)
{
    ff_pipeline *pipeline = b->pipeline;
    if (ff_report_errors(b->report) > 0)
        return;
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[i];
        if (stage->needed)
            stage->instance->read = fe_arena_alloc(
                &pipeline->memory->arena, stage->loaded->model->output_count * sizeof(bool) + 1);
    }
    for (size_t i = 0; i < pipeline->count; i++)
        for (size_t k = 0;
             pipeline->stages[i].needed && k < pipeline->stages[i].loaded->model->output_count; k++)
            if (pipeline->stages[i].results[k].requested)
                mark_read(pipeline, &pipeline->stages[i], k);
    warn_of_idle(b, outputs);
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        if (!stage->needed)
            continue;
        bool some = reads_any(stage, NULL);
        if (!some && fe_latest_rank(stage->node) >= b->file_rank)
            warn_of_stage(b, stage);
        for (size_t k = 0; some && k < stage->instance->serving_count; k++)
            check_serving(b, stage, &stage->instance->servings[k], outputs);
    }
}
