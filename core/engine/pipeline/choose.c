/* SPDX-License-Identifier: MIT */
/*
 * The choice of a model: each candidate looks at what feeds it and says how large an error it would
 * make, and at what cost; the cheapest one within the accuracy asked for becomes the stage's.
 */
#include "build.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const ff_message *last_error(const ff_report *report)
{
    for (size_t i = ff_report_count(report); i-- > 0;)
        if (ff_report_at(report, i)->severity == FF_ERROR)
            return ff_report_at(report, i);
    return NULL;
}

static char *print_proposals(ff_pipeline *pipeline, const ff_assessment *a)
{
    char *text = fe_pipeline_print(pipeline, "%s", "");
    for (size_t i = 0; i < a->proposal_count; i++)
        text = fe_pipeline_print(pipeline, "%s%s%s: %s", text, *text ? ", " : "",
                                 a->proposals[i].param, a->proposals[i].value);
    return text;
}

/* Sets parameters that the user left open to the proposed values. */
static bool take_proposals(ff_stage *stage, const ff_assessment *a, ff_report *report)
{
    const ff_model *model = stage->loaded->model;
    for (size_t i = 0; i < a->proposal_count; i++) {
        const ff_proposal *p = &a->proposals[i];
        int index = p->param && p->value ? ff_model_find_param(model, p->param) : -1;
        char name[192];
        if (index < 0 || !(ff_model_param(model, (size_t)index)->flags & FF_TUNABLE))
            return fe_plugin_fault(
                stage, report, "proposes a value for something that is not a tunable parameter");
        ff_bound *bound = &stage->params[index];
        if (bound->value.given)
            continue;
        ff_param row = *bound->row;
        row.preset = p->value;
        snprintf(name, sizeof name, "%s.%s", stage->name, row.name);
        if (bound->proposed)
            ff_value_clear(&bound->value);
        else
            bound->first = bound->value;
        bound->present = bound->proposed = ff_param_read_preset(
            &row, &stage->loaded->param_units[index], name, &bound->value, report);
        if (!bound->present)
            return fe_plugin_fault(stage, report, "proposes a value that its own table refuses");
    }
    return true;
}

static bool note_assessment(ff_pipeline *pipeline, ff_candidate *c, const ff_assessment *a,
                            ff_report *report)
{
    char clean[600];
    if (a->applies < FF_APPLIES_NOT || a->applies > FF_AMBIGUOUS || !(a->error >= 0) ||
        !(a->cost >= 0 && isfinite(a->cost)) || (a->proposal_count && !a->proposals))
        return fe_plugin_fault(c->stage, report, "gave no usable numbers in assess");
    if (!take_proposals(c->stage, a, report))
        return false;
    ff_clean_text(clean, sizeof clean, a->reason ? a->reason : "");
    c->assessed = true;
    c->applies = isfinite(a->error) || a->applies != FF_APPLIES ? a->applies : FF_APPLIES_NOT;
    c->error = a->error;
    c->cost = a->cost;
    c->reason = fe_pipeline_print(pipeline, "%s", clean);
    c->proposals = print_proposals(pipeline, a);
    return true;
}

/* A law may state its cost in place of the function `assess`. */
static ff_status ask(const ff_stage *candidate, double accuracy, const ff_array *in,
                     ff_assessment *a)
{
    const ff_model *model = candidate->loaded->model;
    if (model->assess)
        return model->assess(candidate->instance->self, fe_wanted_of(candidate), accuracy, in, a);
    a->applies = FF_APPLIES;
    a->cost = model->cost;
    return FF_OK;
}

static void assess(ff_pipeline *pipeline, const ff_stage *stage, ff_candidate *c)
{
    const ff_model *model = c->stage->loaded->model;
    const char *lacks = fe_pass_requests(stage, c->stage);
    ff_report *captured = ff_report_new();
    if (lacks) {
        fe_leave_out(
            pipeline, c,
            fe_pipeline_print(pipeline, "it does not give \"%s\", which is needed", lacks));
    } else {
        ff_array *in = fe_alloc(model->input_count * sizeof *in);
        bool good = fe_gather_inputs(pipeline, c->stage, in, captured);
        if (good) {
            ff_assessment a = {.size = sizeof a};
            fe_call call = fe_call_begin(c->stage, "assess");
            ff_status status = ask(c->stage, stage->choice->accuracy, in, &a);
            good =
                fe_call_end(&call, status, captured) && note_assessment(pipeline, c, &a, captured);
        }
        fe_report_require_memory(captured);
        if (!good)
            fe_leave_out(pipeline, c,
                         last_error(captured) ? last_error(captured)->text
                                              : "its inputs do not fit together");
        fe_free(in);
    }
    ff_report_free(captured);
}

static bool is_better(const ff_candidate *c, const ff_candidate *than, double accuracy)
{
    if (!c->fits || c->applies != FF_APPLIES)
        return false;
    if (!than)
        return true;
    bool keeps = c->error <= accuracy, kept = than->error <= accuracy;
    if (keeps != kept)
        return keeps;
    return !keeps && c->error != than->error ? c->error < than->error : c->cost < than->cost;
}

/* The cheapest candidate within the accuracy, else the most exact one. NULL: none applies. */
static ff_candidate *best_of(const ff_choice *choice)
{
    ff_candidate *best = NULL;
    for (size_t i = 0; i < choice->count; i++)
        if (is_better(&choice->candidates[i], best, choice->accuracy))
            best = &choice->candidates[i];
    return best;
}

static const ff_candidate *ambiguous(const ff_choice *choice)
{
    for (size_t i = 0; i < choice->count; i++)
        if (choice->candidates[i].fits && choice->candidates[i].applies == FF_AMBIGUOUS)
            return &choice->candidates[i];
    return NULL;
}

/* What could be asked for instead. */
static const char *within_reach(ff_pipeline *pipeline, const ff_candidate *best)
{
    const char *list = "";
    size_t count = 0;
    for (size_t i = 0; i < best->stage->loaded->model->output_count; i++)
        if (best->stage->results[i].requested)
            list = fe_pipeline_print(pipeline, "%s%s%s", list, count++ ? ", " : " for ",
                                     best->stage->results[i].row->name);
    if (best->error > 1)
        return fe_pipeline_print(pipeline, "no model promises anything%s%s: name it yourself", list,
                                 count > 1 ? " together" : "");
    return fe_pipeline_print(pipeline, "accuracy: %.3g %% is within reach%s%s",
                             100 * fmin(best->error * 1.05, 1), list, count > 1 ? " together" : "");
}

static bool refuse(ff_pipeline *pipeline, const ff_stage *stage, const ff_candidate *best,
                   ff_report *report)
{
    const ff_choice *choice = stage->choice;
    const ff_candidate *doubt = ambiguous(choice);
    const char *list = "";
    if (doubt)
        return ff_error(report, FF_FAULT_RUN, stage->use_place,
                        "name the model yourself to get one of the answers",
                        "%s: the scene has several answers, says %s: %s", stage->name,
                        doubt->stage->use, doubt->reason);
    if (best)
        return ff_error(report, FF_FAULT_RUN, stage->use_place, within_reach(pipeline, best),
                        "%s: no model promises %.3g %%; the best is %s with %.3g %%: %s",
                        stage->name, 100 * choice->accuracy, best->stage->use, 100 * best->error,
                        best->reason);
    for (size_t i = 0; i < choice->count; i++)
        list = fe_pipeline_print(pipeline, "%.3000s%s%s: %s", list, *list ? "; " : "",
                                 choice->candidates[i].stage->use, choice->candidates[i].reason);
    return ff_error(report, FF_FAULT_RUN, stage->use_place, NULL, "%s: no model of %s applies (%s)",
                    stage->name, choice->use, list);
}

/* Swaps the stage and the candidate: the candidate is left with the tables of the choice and frees
   them. */
static void adopt(ff_stage *stage, ff_stage *candidate)
{
    ff_stage was = *stage;
    stage->use = candidate->use;
    stage->loaded = candidate->loaded;
    stage->params = candidate->params;
    stage->wires = candidate->wires;
    stage->wire_count = candidate->wire_count;
    stage->results = candidate->results;
    stage->instance = candidate->instance;
    stage->instance->stage = stage;
    stage->instance->watch = was.instance->watch;
    stage->instance->sorting = was.instance->sorting;
    candidate->loaded = was.loaded;
    candidate->params = was.params;
    candidate->results = was.results;
    candidate->instance = was.instance;
    candidate->instance->stage = candidate;
}

static void assess_all(ff_pipeline *pipeline, ff_stage *stage)
{
    for (size_t i = 0; i < stage->choice->count; i++)
        if (stage->choice->candidates[i].fits)
            assess(pipeline, stage, &stage->choice->candidates[i]);
}

static bool settle(ff_pipeline *pipeline, ff_stage *stage, ff_report *report)
{
    ff_choice *choice = stage->choice;
    ff_candidate *best = best_of(choice);
    if (!best || ambiguous(choice) || (best->error > choice->accuracy && !choice->refine))
        return refuse(pipeline, stage, best, report);
    if (*best->proposals && !fe_reopen(pipeline, best->stage, report))
        return false;
    adopt(stage, best->stage);
    choice->chosen = best;
    return true;
}

bool fe_choose(ff_pipeline *pipeline, ff_stage *stage, ff_report *report)
{
    if (stage->choice->chosen || stage->choice->serves)
        return true; /* the stages that use a law choose it */
    for (size_t i = 0; i < stage->wire_count; i++)
        if (stage->wires[i].stage >= 0 && !pipeline->stages[stage->wires[i].stage].ran)
            return false; /* reported already */
    assess_all(pipeline, stage);
    return settle(pipeline, stage, report);
}

static bool is_open(const ff_stage *law)
{
    return law->needed && law->choice && law->choice->serves && !law->choice->chosen &&
           law->instance->alive;
}

/* Judges all laws before choosing one, so that each is compared with the references alone. */
bool fe_choose_laws(ff_pipeline *pipeline, ff_report *report)
{
    bool good = true;
    for (size_t i = 0; i < pipeline->count && good; i++) {
        ff_stage *law = &pipeline->stages[i];
        if (!is_open(law))
            continue;
        assess_all(pipeline, law);
        good = fe_ask_judges(pipeline, law, report);
    }
    if (!good)
        return false;
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *law = &pipeline->stages[i];
        if (!is_open(law))
            continue;
        good = settle(pipeline, law, report) && good;
        if (law->choice->chosen)
            fe_note_choice(law);
    }
    return good && fe_rewire_judges(pipeline, report);
}

void fe_note_choice(ff_stage *stage)
{
    const ff_choice *choice = stage->choice;
    const ff_candidate *c = choice->chosen;
    char text[400];
    snprintf(text, sizeof text, "%s: %s", choice->count > 1 ? "the cheapest that fits" : "assessed",
             c->reason);
    ff_add_quality(stage, "promised_error", c->error, choice->accuracy, FF_GOOD, text);
}
