/* SPDX-License-Identifier: MIT */
/*
 * Stages that choose their model. Such a stage stands in the file, and in the graph, as one with
 * the parameters, inputs and outputs of all its candidates, by name; each candidate is a stage of
 * its own beside it, that is linked, bound and opened like any other. A candidate that cannot be
 * is left out with its reason; what the file says wrongly of one stays an error.
 */
#include "build.h"

#include <stdlib.h>
#include <string.h>

/* Whether a candidate is left. When there is none, `why` (or NULL) is reported. */
static bool some_fit(fe_build *b, ff_stage *stage, const ff_message *why)
{
    const ff_choice *choice = stage->choice;
    for (size_t i = 0; i < choice->count; i++)
        if (choice->candidates[i].fits)
            return true;
    stage->instance->broken = true;
    if (why)
        fe_hand_on(why, b->report);
    return false;
}

/* Adds the wires of a candidate, so that all stages that feed it run first. */
static void add_wires(ff_stage *stage, const ff_candidate *c)
{
    for (size_t i = 0; i < c->stage->wire_count; i++) {
        ff_wire wire = c->stage->wires[i];
        size_t k = 0;
        if (!c->fits)
            wire.stage = -1;
        while (k < stage->wire_count && (strcmp(stage->wires[k].name, wire.name) != 0 ||
                                         (stage->wires[k].stage != wire.stage && wire.stage >= 0 &&
                                          stage->wires[k].stage >= 0)))
            k++;
        if (k == stage->wire_count || stage->wires[k].stage < 0)
            stage->wires[k] = wire;
        stage->wire_count += k == stage->wire_count;
    }
}

static void link_candidates(fe_build *b, ff_stage *stage)
{
    ff_choice *choice = stage->choice;
    size_t most = 1;
    ff_report **captured = fe_alloc(choice->count * sizeof(ff_report *)), *first = NULL;
    for (size_t i = 0; i < choice->count; i++) {
        ff_candidate *c = &choice->candidates[i];
        fe_build capturing = *b;
        capturing.report = captured[i] = ff_report_new();
        if (!c->fits)
            continue;
        fe_link_stage(&capturing, c->stage);
        most += c->stage->wire_count;
        if (!c->stage->instance->broken)
            continue;
        const ff_message *why = ff_report_first(captured[i]);
        first = first ? first : captured[i];
        fe_leave_out(b->pipeline, c, why ? why->text : "its wires cannot be connected");
    }
    stage->wires = fe_arena_alloc(&b->pipeline->memory->arena, most * sizeof *stage->wires);
    for (size_t i = 0; i < choice->count; i++)
        add_wires(stage, &choice->candidates[i]);
    some_fit(b, stage, first ? ff_report_first(first) : NULL);
    for (size_t i = 0; i < choice->count; i++)
        ff_report_free(captured[i]);
    fe_free(captured);
}

void fe_link_from(fe_build *b, ff_stage *stage)
{
    if (stage->wires || !fe_load_stage(b, stage))
        return;
    if (stage->choice)
        link_candidates(b, stage);
    else
        fe_link_stage(b, stage);
    for (size_t i = 0; i < stage->wire_count; i++)
        if (stage->wires[i].stage >= 0)
            fe_link_from(b, &b->pipeline->stages[stage->wires[i].stage]);
}

static bool is_about_stage(const ff_message *m, const ff_stage *stage)
{
    return m->place.source == stage->place.source && m->place.line == stage->place.line &&
           m->place.column == stage->place.column;
}

/* A missing parameter leaves the candidate out; a wrong one in the file is an error. */
static const ff_message *bind_candidate(fe_build *b, ff_candidate *c, ff_report *captured)
{
    fe_build capturing = *b;
    const ff_message *missing = NULL;
    capturing.report = captured;
    fe_bind_stage(&capturing, c->stage);
    for (size_t i = 0; i < ff_report_count(captured); i++) {
        const ff_message *m = ff_report_at(captured, i);
        if (m->severity == FF_ERROR && is_about_stage(m, c->stage))
            missing = missing ? missing : m;
        else
            fe_hand_on(m, b->report);
    }
    if (c->stage->instance->broken)
        fe_leave_out(b->pipeline, c, missing ? missing->text : "its parameters are wrong");
    return missing;
}

/* Leaves out all but the model that `only` names. */
static void keep_only(fe_build *b, ff_stage *stage)
{
    const ff_bound *only = &stage->params[FE_ONLY];
    ff_choice *choice = stage->choice;
    const char **names = fe_alloc((choice->count + 1) * sizeof *names);
    const ff_candidate *found = NULL;
    for (size_t i = 0; i < choice->count; i++) {
        names[i] = choice->candidates[i].stage->use;
        if (!strcmp(names[i], only->value.text))
            found = &choice->candidates[i];
    }
    if (!found || !found->fits) {
        stage->instance->broken = true;
        ff_error(
            b->report, FF_FAULT_INPUT, only->place, NULL, "%s.only: %s cannot choose \"%.80s\"%s%s",
            stage->name, stage->use, only->value.text, found ? ": " : "",
            found ? found->reason : fe_did_you_mean(b, only->value.text, names, choice->count));
    }
    for (size_t i = 0; i < choice->count; i++)
        if (strcmp(names[i], only->value.text) != 0)
            fe_leave_out(b->pipeline, &choice->candidates[i], "\"only\" names another model");
    fe_free(names);
}

/* Lets the model propose other values for its numerical settings than the file gives. */
static void free_settings(ff_stage *stage)
{
    for (size_t i = 0; i < stage->loaded->model->param_count; i++)
        if (stage->params[i].row->flags & FF_TUNABLE)
            stage->params[i].value.given = 0;
}

/* Three laws are usual and cost little: with a quarter each, their errors and that of the stage
   stay below twice the accuracy. */
static const double share_of_law = 0.25;

void fe_bind_candidates(fe_build *b, ff_stage *stage)
{
    ff_choice *choice = stage->choice;
    ff_bound *accuracy = &stage->params[FE_ACCURACY];
    ff_report *captured = NULL;
    const ff_message *missing = NULL;
    bool shared = !accuracy->place.source;
    if (b->accuracy && shared) {
        ff_value_clear(&accuracy->value);
        accuracy->place = b->accuracy->place;
        accuracy->present = fe_read_accuracy(b, &accuracy->value);
    }
    stage->instance->broken = stage->instance->broken || !accuracy->present;
    choice->accuracy = accuracy->value.real;
    choice->refine = stage->params[FE_REFINE].present && stage->params[FE_REFINE].value.integer;
    if (stage->params[FE_ONLY].present)
        keep_only(b, stage);
    if (choice->serves && shared)
        choice->accuracy *= share_of_law;
    for (size_t i = 0; i < choice->count && !stage->instance->broken; i++) {
        if (!choice->candidates[i].fits)
            continue;
        ff_report *own = ff_report_new();
        const ff_message *lacks = bind_candidate(b, &choice->candidates[i], own);
        if (choice->refine && choice->candidates[i].fits)
            free_settings(choice->candidates[i].stage);
        if (lacks && !missing) {
            ff_report_free(captured);
            captured = own;
            missing = lacks;
        } else {
            ff_report_free(own);
        }
    }
    some_fit(b, stage, missing);
    ff_report_free(captured);
}

void fe_open_candidates(fe_build *b, ff_stage *stage)
{
    ff_choice *choice = stage->choice;
    ff_report *captured = NULL;
    for (size_t i = 0; i < choice->count; i++) {
        ff_candidate *c = &choice->candidates[i];
        fe_build capturing = *b;
        if (!c->fits)
            continue;
        capturing.report = ff_report_new();
        fe_open_instance(&capturing, c->stage);
        fe_report_require_memory(capturing.report);
        const ff_message *why = ff_report_first(capturing.report);
        if (!c->stage->instance->alive)
            fe_leave_out(b->pipeline, c, why ? why->text : "it cannot be set up");
        for (size_t k = 0; c->fits && k < ff_report_count(capturing.report); k++)
            fe_hand_on(ff_report_at(capturing.report, k), b->report);
        if (c->fits || captured) {
            ff_report_free(capturing.report);
        } else {
            captured = capturing.report;
        }
    }
    if (some_fit(b, stage, captured ? ff_report_first(captured) : NULL) && choice->serves)
        fe_find_reference(b, stage);
    stage->instance->alive = !stage->instance->broken;
    ff_report_free(captured);
}

void fe_free_candidates(ff_stage *stage)
{
    for (size_t i = 0; stage->choice && i < stage->choice->count; i++) {
        ff_stage *candidate = stage->choice->candidates[i].stage;
        if (!candidate->loaded)
            continue;
        for (size_t k = 0; candidate->params && k < candidate->loaded->model->param_count; k++) {
            ff_value_clear(&candidate->params[k].value);
            ff_value_clear(&candidate->params[k].first);
        }
        fe_forget_results(candidate);
    }
}
