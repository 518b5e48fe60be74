/* SPDX-License-Identifier: MIT */
/*
 * The choice of a law. A law does not know the operating conditions, but the stages that use it do:
 * they judge each candidate by how it would change their results against a reference law, which
 * serves all stages until then. A stage that cannot judge keeps the reference.
 */
#include "build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const ff_candidate *find_candidate(const ff_choice *choice, const char *model)
{
    for (size_t i = 0; i < choice->count; i++)
        if (!strcmp(choice->candidates[i].stage->use, model))
            return &choice->candidates[i];
    return NULL;
}

static bool refuse_reference(fe_build *b, ff_stage *stage, const ff_bound *written)
{
    const ff_choice *choice = stage->choice;
    const ff_candidate *c = find_candidate(choice, written->value.text);
    const char **ids = fe_alloc(choice->count * sizeof *ids);
    for (size_t i = 0; i < choice->count; i++)
        ids[i] = choice->candidates[i].stage->use;
    const char *advice = fe_did_you_mean(b, written->value.text, ids, choice->count);
    fe_free(ids);
    return ff_error(b->report, FF_FAULT_INPUT, written->place, NULL,
                    "%s.reference: \"%.80s\" is not a candidate%s%s%s", stage->name,
                    written->value.text, c ? ": " : "", c ? c->reason : "", advice);
}

/* The first set under `with` whose law fits, or the only law that does; NULL: several do. */
static const ff_candidate *first_of(const ff_stage *stage)
{
    const ff_choice *choice = stage->choice;
    const ff_node *with = ff_node_get(stage->node, "with");
    const ff_candidate *only = NULL;
    size_t count = 0;
    for (size_t i = 0; with && with->kind == FF_MAP && i < with->count; i++) {
        const ff_candidate *c = find_candidate(choice, with->keys[i]);
        if (c && c->fits)
            return c;
    }
    for (size_t i = 0; i < choice->count; i++) {
        count += choice->candidates[i].fits;
        only = choice->candidates[i].fits ? &choice->candidates[i] : only;
    }
    return count == 1 ? only : NULL;
}

void fe_find_reference(fe_build *b, ff_stage *stage)
{
    ff_choice *choice = stage->choice;
    int index = ff_model_find_param(stage->loaded->model, "reference");
    const ff_bound *written = &stage->params[index];
    const char *names = "";
    if (written->present && written->value.text) {
        const ff_candidate *c = find_candidate(choice, written->value.text);
        choice->reference = c && c->fits ? c : NULL;
        stage->instance->broken |= !choice->reference && !refuse_reference(b, stage, written);
        return;
    }
    choice->reference = first_of(stage);
    if (choice->reference)
        return;
    for (size_t i = 0; i < choice->count; i++)
        if (choice->candidates[i].fits)
            names = fe_join(b->pipeline, names, choice->candidates[i].stage->use);
    stage->instance->broken = true;
    ff_error(b->report, FF_FAULT_INPUT, stage->use_place,
             "write \"reference: MODEL\", or a set of parameters for each law under \"with\", the "
             "most exact first",
             "%s: which law is the one that the others are held against? These could be: %s",
             stage->name, names);
}

static bool can_judge(const ff_stage *stage)
{
    const ff_model *model = stage->loaded ? stage->loaded->model : NULL;
    return model && FF_HAS(model, judge) && model->judge;
}

/* The stage itself, or its first candidate that gives what is needed; NULL: none can judge. */
static ff_stage *judging(ff_stage *stage)
{
    const ff_choice *choice = stage->choice;
    if (!choice || choice->chosen)
        return can_judge(stage) ? stage : NULL;
    for (size_t i = 0; i < choice->count; i++) {
        const ff_candidate *c = &choice->candidates[i];
        if (c->fits && can_judge(c->stage) && !fe_pass_requests(stage, c->stage))
            return c->stage;
    }
    return NULL;
}

static bool takes(const ff_pipeline *pipeline, const ff_stage *stage, const ff_stage *law)
{
    for (size_t i = 0; i < stage->wire_count; i++)
        if (stage->wires[i].stage == law - pipeline->stages)
            return true;
    return false;
}

bool fe_is_judge(const ff_pipeline *pipeline, const ff_stage *stage)
{
    bool can = can_judge(stage);
    for (size_t i = 0; stage->choice && i < stage->choice->count; i++)
        can = can ||
              (stage->choice->candidates[i].fits && can_judge(stage->choice->candidates[i].stage));
    for (size_t i = 0; can && stage->needed && i < pipeline->count; i++) {
        const ff_choice *choice = pipeline->stages[i].choice;
        if (choice && choice->serves && takes(pipeline, stage, &pipeline->stages[i]))
            return true;
    }
    return false;
}

static int law_input(const ff_pipeline *pipeline, const ff_stage *judge, const ff_stage *law)
{
    for (size_t i = 0; i < judge->loaded->model->input_count; i++)
        if (ff_model_input(judge->loaded->model, i)->service &&
            fe_input_wire(judge, i)->stage == law - pipeline->stages)
            return (int)i;
    return -1;
}

/* Adds a verdict on a candidate: the largest error of all judges counts, with its reason. */
static bool note_verdict(ff_pipeline *pipeline, ff_candidate *c, const ff_stage *judge,
                         const ff_assessment *a, ff_report *report)
{
    char clean[600];
    if (a->applies < FF_APPLIES_NOT || a->applies > FF_AMBIGUOUS || !(a->error >= 0))
        return fe_plugin_fault(judge, report, "gave no usable numbers in judge");
    int32_t applies = isfinite(a->error) || a->applies != FF_APPLIES ? a->applies : FF_APPLIES_NOT;
    bool worse = applies == FF_APPLIES ? c->applies == FF_APPLIES && a->error > c->judged
                                       : c->applies == FF_APPLIES;
    if (c->verdict && !worse)
        return true;
    ff_clean_text(clean, sizeof clean, a->reason ? a->reason : "");
    c->error += fmax(a->error - c->judged, 0);
    c->judged = fmax(a->error, c->judged);
    c->applies = applies == FF_APPLIES ? c->applies : applies;
    c->verdict = fe_pipeline_print(pipeline, "%s: %s", judge->name, clean);
    return true;
}

static void dismiss(ff_pipeline *pipeline, ff_candidate *c, const char *reason)
{
    c->assessed = false;
    fe_leave_out(pipeline, c, reason);
}

static bool hear(ff_pipeline *pipeline, ff_candidate *c, ff_stage *judge, int input,
                 const ff_array *in, ff_report *report)
{
    const ff_model *model = judge->loaded->model;
    int output = fe_find_offer(c->stage->loaded, ff_model_input(model, (size_t)input));
    const void *table = fe_fetch_service(c->stage, (uint32_t)output, report);
    ff_assessment a = {.size = sizeof a};
    if (!table)
        return false;
    const ff_guard_mark **lent = fe_end_of_services(&judge->instance->mark);
    *lent = &c->stage->instance->mark;
    fe_call call = fe_call_begin(judge, "judge");
    ff_status status =
        model->judge(judge->instance->self, fe_wanted_of(judge), (uint32_t)input, table, in, &a);
    *lent = NULL;
    return fe_call_end(&call, status, report) && note_verdict(pipeline, c, judge, &a, report);
}

static void judge_one(ff_pipeline *pipeline, ff_candidate *c, ff_stage *judge, int input,
                      const ff_array *in)
{
    ff_report *captured = ff_report_new();
    bool good = hear(pipeline, c, judge, input, in, captured);
    fe_report_require_memory(captured);
    if (!good)
        dismiss(pipeline, c,
                ff_report_first(captured) ? ff_report_first(captured)->text : "the judge gave up");
    ff_report_free(captured);
}

/* False when what feeds the judge waits for another one. */
static bool ask(ff_pipeline *pipeline, ff_stage *law, ff_stage *judge, ff_report *report)
{
    ff_choice *choice = law->choice;
    int input = law_input(pipeline, judge, law);
    if (input < 0)
        return true;
    for (size_t i = 0; i < judge->wire_count; i++) {
        const ff_stage *from =
            judge->wires[i].stage < 0 ? NULL : &pipeline->stages[judge->wires[i].stage];
        if (!from || from->ran)
            continue;
        return ff_report_errors(report) > 0
                   ? false
                   : ff_error(report, FF_FAULT_INPUT, law->use_place, "name the law yourself",
                              "%s: %s would have to judge the law, too, but waits for %s, which "
                              "needs it",
                              law->name, judge->name, from->name);
    }
    ff_array *in = fe_alloc(judge->loaded->model->input_count * sizeof *in);
    bool good = fe_gather_inputs(pipeline, judge, in, report);
    for (size_t i = 0; good && i < choice->count; i++)
        if (choice->candidates[i].fits && &choice->candidates[i] != choice->reference)
            judge_one(pipeline, &choice->candidates[i], judge, input, in);
    fe_free(in);
    return good;
}

bool fe_ask_judges(ff_pipeline *pipeline, ff_stage *law, ff_report *report)
{
    ff_choice *choice = law->choice;
    size_t judges = 0;
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[i];
        ff_stage *judge = stage->needed && takes(pipeline, stage, law) ? judging(stage) : NULL;
        if (!judge || !judge->instance->alive)
            continue;
        judges++;
        if (!ask(pipeline, law, judge, report))
            return false;
    }
    for (size_t i = 0; i < choice->count; i++) {
        ff_candidate *c = &choice->candidates[i];
        if (c->fits && c == choice->reference)
            c->reason = fe_pipeline_print(
                pipeline, "the reference%s%s%s",
                judges ? "" : ", which stands since no stage that runs can judge the others",
                *c->reason ? "; " : "", c->reason);
        else if (c->fits && c->verdict)
            c->reason = c->verdict;
        else if (c->fits)
            dismiss(pipeline, c, "nobody judges it");
    }
    return true;
}

static bool was_swapped(const ff_pipeline *pipeline, const ff_stage *judge)
{
    for (size_t i = 0; i < judge->wire_count; i++) {
        int from = judge->wires[i].stage;
        const ff_choice *choice = from < 0 ? NULL : pipeline->stages[from].choice;
        if (choice && choice->serves && choice->chosen != choice->reference)
            return true;
    }
    return false;
}

bool fe_rewire_judges(ff_pipeline *pipeline, ff_report *report)
{
    bool good = true;
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[i];
        ff_choice *choice = stage->choice;
        if (!stage->needed || !stage->instance->alive || !was_swapped(pipeline, stage) ||
            !judging(stage))
            continue;
        if (!choice || choice->chosen)
            good = fe_reopen(pipeline, stage, report) && good;
        for (size_t k = 0; choice && !choice->chosen && k < choice->count; k++)
            if (choice->candidates[k].fits)
                good = fe_reopen(pipeline, choice->candidates[k].stage, report) && good;
    }
    return good;
}
