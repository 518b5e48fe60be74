/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bound.h"
#include "command.h"
#include "json.h"
#include "wrap.h"

#include "../plugin/clean.h"
#include "../value/memory.h"

#include <stdlib.h>
#include <string.h>

enum { NAME = 24, VALUE = 28 };

static void print_wires(const ff_pipeline *pipeline, const ff_stage *stage)
{
    for (size_t i = 0; i < stage->wire_count; i++) {
        const ff_wire *wire = &stage->wires[i];
        if (wire->stage < 0)
            continue;
        char left[80];
        snprintf(left, sizeof left, "%s <-", wire->name);
        printf("  %-*s %-*s %s\n", NAME, left, VALUE, pipeline->stages[wire->stage].name,
               wire->automatic ? "automatic" : "written");
    }
}

static void print_params(const ff_stage *stage)
{
    for (size_t i = 0; stage->params && i < stage->loaded->model->param_count; i++) {
        char value[512], origin[512];
        if (!ff_bound_print(stage, i, value, sizeof value))
            continue;
        ff_origin(&stage->params[i], origin, sizeof origin);
        printf("  %-*s %-*s %s\n", NAME, stage->params[i].row->name, VALUE, value, origin);
    }
}

/* Names of the outputs that will be computed; those that the file asks for bear a star. */
static void print_outputs(const ff_stage *stage)
{
    char *names = ff_copy_text("", 0);
    for (size_t i = 0; stage->results && i < stage->loaded->model->output_count; i++) {
        const ff_result *result = &stage->results[i];
        if (!result->wanted && !result->asked)
            continue;
        char *longer = ff_print_text("%s%s%s%s", names, *names ? ", " : "", result->row->name,
                                     result->asked ? "*" : "");
        free(names);
        names = longer;
    }
    if (*names)
        ff_print_wrapped(stdout, names, printf("  computes: "), 4);
    free(names);
}

static void print_stage(const ff_pipeline *pipeline, const ff_stage *stage)
{
    printf("\n%s: %s, because %s\n", stage->name, stage->use, stage->why ? stage->why : "?");
    if (!stage->loaded)
        return;
    print_wires(pipeline, stage);
    print_params(stage);
    print_outputs(stage);
}

static void print_all(const ff_pipeline *pipeline, const char *file)
{
    size_t needed = 0;
    char title[400];
    ff_clean_text(title, sizeof title, pipeline->title ? pipeline->title : file);
    for (size_t i = 0; i < pipeline->count; i++)
        needed += pipeline->stages[i].needed;
    printf("%s: %zu of %zu stages run (* requested)\n", title, needed, pipeline->count);
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[pipeline->order[i]];
        if (stage->needed)
            print_stage(pipeline, stage);
    }
    if (needed < pipeline->count)
        printf("\nnot run:\n");
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        if (!stage->needed)
            printf("  %s: %s, %s%s\n", stage->name, stage->use, stage->why ? stage->why : "?",
                   stage->loaded ? "" : "; not loaded");
    }
}

static json_t *json_outputs(const ff_stage *stage)
{
    json_t *list = json_array();
    for (size_t i = 0; stage->results && i < stage->loaded->model->output_count; i++) {
        const ff_result *result = &stage->results[i];
        if (!result->wanted && !result->asked)
            continue;
        json_t *entry = json_object();
        json_object_set_new(entry, "output", ff_json_text(result->row->name));
        json_object_set_new(entry, "unit", ff_json_text(result->row->unit));
        json_object_set_new(entry, "requested", json_boolean(result->asked));
        json_array_append_new(list, entry);
    }
    return list;
}

static json_t *json_stage(const ff_pipeline *pipeline, const ff_stage *stage)
{
    json_t *entry = json_object();
    json_object_set_new(entry, "stage", ff_json_text(stage->name));
    json_object_set_new(entry, "model", ff_json_text(stage->use));
    json_object_set_new(entry, "runs", json_boolean(stage->needed));
    json_object_set_new(entry, "loaded", json_boolean(stage->loaded != NULL));
    json_object_set_new(entry, "why", ff_json_text(stage->why));
    if (stage->needed && stage->loaded) {
        json_object_set_new(entry, "wires", ff_json_wires(pipeline, stage));
        json_object_set_new(entry, "parameters", ff_json_params(stage));
        json_object_set_new(entry, "outputs", json_outputs(stage));
    }
    return entry;
}

static void print_json(const ff_session *session, const char *file)
{
    const ff_pipeline *pipeline = session->pipeline;
    json_t *answer = ff_json_answer("ok", FF_EXIT_OK), *stages = json_array();
    ff_json_add_messages(answer, session->report);
    json_object_set_new(answer, "title", ff_json_text(pipeline->title));
    json_object_set_new(answer, "file", ff_json_text(file));
    for (size_t i = 0; i < pipeline->count; i++)
        json_array_append_new(stages, json_stage(pipeline, &pipeline->stages[pipeline->order[i]]));
    json_object_set_new(answer, "stages", stages);
    ff_json_print(answer, stdout);
}

int ff_explain(const ff_options *options)
{
    ff_session session;
    int code = FF_EXIT_OK;
    if (!ff_session_open(&session, options, false)) {
        code = ff_refuse(session.report, options, "nothing was run");
    } else if (options->json) {
        print_json(&session, options->operand);
    } else {
        ff_report_print(session.report, stderr, ff_colour(stderr));
        print_all(session.pipeline, options->operand);
    }
    ff_session_close(&session);
    return code;
}
