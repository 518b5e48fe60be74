/* SPDX-License-Identifier: MIT */
/* Finds which stages run, why, and in which order. */
#include "build.h"

#include <assert.h>
#include <stdlib.h>

static void set_reason(ff_pipeline *pipeline, ff_stage *stage)
{
    const char *first = "", *fed = "";
    size_t requested = 0;
    for (size_t i = 0; stage->loaded && i < stage->loaded->model->output_count; i++)
        if (stage->results[i].requested && requested++ == 0)
            first = stage->results[i].row->name;
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *other = &pipeline->stages[i];
        bool feeds = false;
        for (size_t k = 0; other->needed && k < other->wire_count; k++)
            feeds = feeds || other->wires[k].stage == stage - pipeline->stages;
        if (feeds)
            fed = fe_join(pipeline, fed, other->name);
    }
    if (requested == 1)
        stage->why = fe_pipeline_print(pipeline, "%s.%s is requested", stage->name, first);
    else if (requested > 1)
        stage->why = fe_pipeline_print(pipeline, "%s.%s and %zu more are requested", stage->name,
                                       first, requested - 1);
    else if (*fed)
        stage->why = fe_pipeline_print(pipeline, "feeds %s", fed);
    else
        stage->why = fe_pipeline_print(pipeline, "no requested output needs it");
}

/* Marks a stage as needed and its inputs as wanted, then does the same for the stages that feed
   it. */
static void mark(ff_pipeline *pipeline, ff_stage *stage)
{
    if (stage->needed)
        return;
    stage->needed = true;
    for (size_t i = 0; i < stage->wire_count; i++)
        if (stage->wires[i].stage >= 0)
            mark(pipeline, &pipeline->stages[stage->wires[i].stage]);
    for (size_t i = 0; stage->loaded && i < stage->loaded->model->input_count; i++) {
        ff_result *result = ff_feeding_result(pipeline, stage, i);
        if (!result)
            continue;
        result->wanted = true;
        if (!(ff_model_input(stage->loaded->model, i)->flags & FF_OPTIONAL))
            result->required = true;
    }
}

void fe_mark_needed(ff_pipeline *pipeline)
{
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[i];
        for (size_t k = 0; stage->loaded && k < stage->loaded->model->output_count; k++) {
            if (!stage->results[k].requested)
                continue;
            stage->results[k].wanted = true;
            mark(pipeline, stage);
        }
    }
    fe_want_quantities(pipeline);
    for (size_t i = 0; i < pipeline->count; i++)
        if (!pipeline->stages[i].why)
            set_reason(pipeline, &pipeline->stages[i]);
}

static void report_cycle(fe_build *b, const ff_stage *first, ff_place place)
{
    const char *text = "";
    const ff_stage *stage = first;
    do {
        stage->instance->broken = true;
        text = fe_pipeline_print(b->pipeline, "%.400s%s -> ", text, stage->name);
        stage = stage->instance->entering;
    } while (stage != first);
    ff_error(b->report, FF_FAULT_INPUT, place,
             "each arrow means \"needs\"; to break the circle, connect one of the wires to another "
             "stage",
             "pipeline: the stages need each other: %s%s", text, first->name);
}

/* Depth-first sort: a stage comes after the stages that feed it. Feedback wires are ignored. */
static void visit(fe_build *b, ff_stage *stage, size_t *sorted)
{
    assert(stage->instance->sorting == FE_NEW);
    ff_pipeline *pipeline = b->pipeline;
    stage->instance->sorting = FE_ENTERED;
    for (size_t i = 0; i < stage->wire_count; i++) {
        const ff_wire *wire = &stage->wires[i];
        if (wire->stage < 0 || wire->feedback)
            continue;
        ff_stage *from = &pipeline->stages[wire->stage];
        stage->instance->entering = from;
        if (from->instance->sorting == FE_ENTERED)
            report_cycle(b, from, wire->place);
        else if (from->instance->sorting == FE_NEW)
            visit(b, from, sorted);
    }
    stage->instance->sorting = FE_SORTED;
    pipeline->order[(*sorted)++] = (size_t)(stage - pipeline->stages);
}

void fe_sort_stages(fe_build *b)
{
    size_t sorted = 0;
    for (size_t i = 0; i < b->pipeline->count; i++)
        if (b->pipeline->stages[i].instance->sorting == FE_NEW)
            visit(b, &b->pipeline->stages[i], &sorted);
    assert(sorted == b->pipeline->count);
    fe_find_loops(b);
    for (size_t i = b->pipeline->count; i-- > 0;) {
        ff_loop *loop = fe_loop_of(b->pipeline, &b->pipeline->stages[b->pipeline->order[i]]);
        if (loop)
            loop->first = i;
    }
}
