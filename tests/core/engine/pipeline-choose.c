/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stages that choose their model: who takes part, who is chosen, what is refused. */
#include "pipeline-try.h"

#include <stdio.h>
#include <string.h>

static attempt choose(const char *pick, const char *level, const char *outputs)
{
    char text[512];
    snprintf(text, sizeof text,
             "accuracy: 8 %%\npipeline:\n  one: {use: toy/source, level: %s}\n  pick: {%s}\n"
             "outputs: [%s]\n",
             level, pick, outputs);
    return try_run(text);
}

static const ff_candidate *candidate(const attempt *a, const char *model)
{
    const ff_choice *choice = try_stage(a, "pick")->choice;
    for (size_t i = 0; choice && i < choice->count; i++) {
        const ff_candidate *c = &choice->candidates[i];
        const char *use = choice->chosen == c ? try_stage(a, "pick")->use : c->stage->use;
        if (!strcmp(use, model))
            return c;
    }
    return NULL;
}

static int says(const attempt *a, const char *model, const char *phrase)
{
    const ff_candidate *c = candidate(a, model);
    if (c && c->reason && strstr(c->reason, phrase))
        return 1;
    printf("%s says: %s\n", model, c && c->reason ? c->reason : "nothing");
    return 0;
}

static bool hints(const attempt *a, const char *phrase)
{
    for (size_t i = 0; i < ff_report_count(a->report); i++)
        if (ff_report_at(a->report, i)->hint && strstr(ff_report_at(a->report, i)->hint, phrase))
            return true;
    return false;
}

static void cheapest(void)
{
    attempt a = choose("use: picked/auto", "2 mm", "pick.value");
    check_good("the accuracy of the file", &a);
    check_true("the cheapest that meets it", try_scalar(&a, "pick", "value") == 1);
    const ff_stage *pick = try_stage(&a, "pick");
    check_true("the stage is the chosen one's", !strcmp(pick->use, "picked/coarse"));
    check_true("what was asked for stays", !strcmp(pick->choice->use, "picked/auto"));
    check_near("accuracy", pick->choice->accuracy, 0.08, 1e-15);
    check_true("seven models are seen", pick->choice->count == 7);
    check_true("one that is silent", says(&a, "picked/mute", "does not assess"));
    check_true("one that lacks a parameter", says(&a, "picked/needy", "\"key\" is missing"));
    check_true("one that lacks a wire", says(&a, "picked/lonely", "\"more\""));
    check_true("one that proposes nonsense", says(&a, "picked/liar", "not a tunable parameter"));
    check_true("and is out", !candidate(&a, "picked/liar")->assessed);
    check_true("so is one whose error has no bound",
               candidate(&a, "picked/vast")->applies == FF_APPLIES_NOT);
    check_true("the other one has its numbers",
               candidate(&a, "picked/fine")->assessed &&
                   !strcmp(candidate(&a, "picked/fine")->proposals, "cells: 13"));
    check_true("the promise is on record", pick->quality_count == 1 &&
                                               !strcmp(pick->quality[0].name, "promised_error") &&
                                               pick->quality[0].value == 0.05);
    check_true("again gives the same",
               ff_pipeline_run(a.pipeline, NULL, a.report) && try_scalar(&a, "pick", "value") == 1);
    try_close(&a);
}

static void proposals(void)
{
    attempt a = choose("use: picked/auto, accuracy: 2 %", "2 mm", "pick.value, pick.created");
    check_good("an accuracy of its own", &a);
    check_true("the proposal is taken", try_scalar(&a, "pick", "value") == 50);
    check_true("by a new instance", try_scalar(&a, "pick", "created") == 1);
    check_true("and marked", try_param(&a, "pick", "cells")->proposed);
    try_close(&a);
    a = choose("use: picked/auto, accuracy: 2 %, cells: 200", "2 mm", "pick.value");
    check_good("a parameter that is given", &a);
    check_true("stays",
               try_scalar(&a, "pick", "value") == 200 && !try_param(&a, "pick", "cells")->proposed);
    try_close(&a);
    a = choose("use: picked/fine, accuracy: 1 %", "2 mm", "pick.value");
    check_good("one model, tuned", &a);
    check_true("tuned",
               try_scalar(&a, "pick", "value") == 100 && try_stage(&a, "pick")->choice->count == 1);
    try_close(&a);
    a = choose("use: picked/auto, with: {picked/fine: {cells: 300}}, scale: 2 mm", "2 mm",
               "pick.extra, pick.value");
    check_good("sets of parameters, and one that only some know", &a);
    check_true("an output that only some have decides", try_scalar(&a, "pick", "value") == 300);
    check_true("why", says(&a, "picked/coarse", "\"extra\""));
    try_close(&a);
}

static void bad(void)
{
    attempt a = choose("use: picked/fine, cells: 777, accuracy: 1 %", "2 mm", "pick.value");
    check_error("what does not balance", &a, 5, 3, "balance is 1");
    check_true("its result is kept", try_scalar(&a, "pick", "value") == 777);
    check_true("nothing is promised of it", try_stage(&a, "pick")->quality_count == 1);
    try_close(&a);
}

static void narrowed(void)
{
    attempt a = choose("use: picked/auto, only: picked/fine, accuracy: 10 %", "2 mm", "pick.value");
    check_good("one model alone", &a);
    check_true("it is chosen", try_scalar(&a, "pick", "value") == 10);
    check_true("others are told why", says(&a, "picked/coarse", "names another"));
    try_close(&a);
    a = choose("use: picked/auto, only: picked/fine, cells: 200, accuracy: 0.2 %, refine: true",
               "2 mm", "pick.value");
    check_good("a setting that gives way", &a);
    check_true("to the accuracy", try_scalar(&a, "pick", "value") == 500);
    try_close(&a);
    a = choose("use: picked/auto, only: picked/fine, accuracy: 0.01 %, refine: true", "2 mm",
               "pick.value");
    check_good("the best there is will do", &a);
    check_true("with all it has", try_scalar(&a, "pick", "value") == 1000);
    try_close(&a);
    a = choose("use: picked/auto, only: picked/fien", "2 mm", "pick.value");
    check_error("a slip in the one model", &a, 5, 34, "did you mean \"picked/fine\"?");
    try_close(&a);
    a = choose("use: picked/auto, only: picked/mute", "2 mm", "pick.value");
    check_error("one that cannot say", &a, 5, 34, "does not assess itself");
    try_close(&a);
}

static void refusals(void)
{
    attempt a = choose("use: picked/auto, accuracy: 0.01 %", "2 mm", "pick.value");
    check_error("out of reach", &a, 5, 15, "no model promises 0.01 %");
    check_true("fails", ff_report_fault(a.report) == FF_FAULT_RUN);
    check_true("what is", hints(&a, "accuracy: 0.105 % is within reach for value"));
    try_close(&a);
    a = choose("use: picked/auto, cells: 1, only: picked/fine, accuracy: 3 %", "2 mm",
               "pick.value, pick.extra");
    check_true("at most 100 %", hints(&a, "accuracy: 100 % is within reach for value, extra"));
    try_close(&a);
    a = choose("use: picked/auto", "95 mm", "pick.value");
    check_error("several answers", &a, 5, 15, "several answers, says picked/fine");
    try_close(&a);
    a = choose("use: picked/auto, accuracy: 2 %", "0.6 mm", "pick.value");
    check_error("nobody can say", &a, 5, 15, "the best is picked/coarse");
    check_true("why", says(&a, "picked/fine", "too short to judge"));
    try_close(&a);
    a = choose("use: picked/auto, celsl: 3", "2 mm", "pick.value");
    check_error("a slip", &a, 5, 28, "did you mean \"cells\"?");
    try_close(&a);
    a = choose("use: picked/auto, cells: 0", "2 mm", "pick.value");
    check_error("a value that the models refuse", &a, 5, 35, "pick.cells");
    check_true("told once", ff_report_errors(a.report) == 1);
    try_close(&a);
    a = choose("use: picked/auto, cells: 13", "2 mm", "pick.value");
    check_error("what all models refuse together", &a, 5, 35, "must not be 13");
    try_close(&a);
    a = choose("use: picked/auto, source: nobody", "2 mm", "pick.value");
    check_error("a stage that is not there", &a, 5, 36, "no stage \"nobody\"");
    try_close(&a);
    a = choose("use: toy/auto", "2 mm", "pick.value");
    check_error("a kind that cannot say", &a, 5, 15, "can say how well");
    try_close(&a);
    a = choose("use: picked/mute, accuracy: 3 %", "2 mm", "pick.value");
    check_error("a model that cannot say", &a, 5, 15, "no accuracy can be asked");
    try_close(&a);
    a = choose("use: picked/auto, accuracy: 0 %", "2 mm", "pick.value");
    check_error("no error at all", &a, 5, 38, "pick.accuracy");
    try_close(&a);
    a = choose("use: nothing/auto", "2 mm", "pick.value");
    check_error("a kind that is not there", &a, 5, 15, "nothing");
    try_close(&a);
}

static void feeds(void)
{
    attempt a = try_build("pipeline:\n  one: {use: toy/source, level: 2 mm}\n"
                          "  idle: {use: toy/source, level: 2 mm}\n"
                          "  pick: {use: picked/auto, source: one, accuracy: 9 %}\n"
                          "outputs: [pick.value]\n",
                          true);
    check_good("check", &a);
    check_true("only what a choice needs is run",
               ff_pipeline_choose(a.pipeline, NULL, a.report) && try_stage(&a, "one")->ran &&
                   !try_stage(&a, "idle")->ran && !try_stage(&a, "pick")->ran);
    check_true("and the choice is made", !strcmp(try_stage(&a, "pick")->use, "picked/coarse"));
    check_true("then the rest",
               ff_pipeline_run(a.pipeline, NULL, a.report) && try_scalar(&a, "pick", "value") == 1);
    try_close(&a);
}

int main(void)
{
    cheapest();
    proposals();
    bad();
    narrowed();
    refusals();
    feeds();
    return check_done();
}
