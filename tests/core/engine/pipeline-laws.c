/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws that are chosen: who is held against whom, who judges, who gets the chosen one. */
#include "pipeline-try.h"

#include <stdio.h>
#include <string.h>

/* costly: 10 x; middling: 10.2 x; cheap: 15 x. */
#define SETS                                                                                       \
    "with: {ruled/costly: {gain: 10}, ruled/middling: {gain: 10.2}, ruled/cheap: {gain: 15}}"

static attempt choose(const char *law, const char *judges, const char *outputs)
{
    char text[1024];
    snprintf(text, sizeof text,
             "pipeline:\n  one: {use: toy/source, level: 2 mm}\n  rule: {%s}\n%s"
             "outputs: [%s]\n",
             law, judges, outputs);
    return try_run(text);
}

static const char one_judge[] = "  film: {use: judge/strict}\n";

static const ff_candidate *candidate(const attempt *a, const char *model)
{
    const ff_choice *choice = try_stage(a, "rule")->choice;
    for (size_t i = 0; choice && i < choice->count; i++) {
        const ff_candidate *c = &choice->candidates[i];
        if (!strcmp(c->stage->use, model))
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

static int is_chosen(const attempt *a, const char *model)
{
    return !strcmp(try_stage(a, "rule")->use, model);
}

static void judged(void)
{
    attempt a = choose("use: ruled/auto, accuracy: 5 %, " SETS, one_judge, "film.value");
    check_good("the cheapest within the accuracy", &a);
    check_true("is chosen", is_chosen(&a, "ruled/middling"));
    check_near("and used", try_scalar(&a, "film", "value"), 20.4, 1e-12);
    check_near("its error", candidate(&a, "ruled/middling")->error, 0.02, 1e-12);
    check_true("in the judge's words", says(&a, "ruled/middling", "film: moves the value by 2 %"));
    check_true("the first set is the reference", says(&a, "ruled/costly", "the reference"));
    check_true("which says what it is", says(&a, "ruled/costly", "it is costly"));
    check_true("one that is silent", says(&a, "ruled/silent", "does not assess"));
    check_true("one without a set", says(&a, "ruled/keyed", "\"gain\" is missing"));
    const ff_stage *rule = try_stage(&a, "rule");
    check_true("the promise is on record",
               rule->quality_count == 1 && !strcmp(rule->quality[0].name, "promised_error"));
    check_true("again gives the same", ff_pipeline_run(a.pipeline, NULL, a.report) &&
                                           try_scalar(&a, "film", "value") > 20.3);
    try_close(&a);
    a = choose("use: ruled/auto, accuracy: 60 %, " SETS, one_judge, "film.value");
    check_true("a rough answer is cheaper", is_chosen(&a, "ruled/cheap"));
    try_close(&a);
    a = choose("use: ruled/auto, accuracy: 6 %, " SETS, one_judge, "film.coarse");
    check_true("what is wanted decides", is_chosen(&a, "ruled/cheap"));
    try_close(&a);
    a = choose("use: ruled/auto, " SETS, one_judge, "film.value");
    check_near("without a word of its own a quarter", try_stage(&a, "rule")->choice->accuracy,
               0.005, 1e-15);
    check_true("the reference itself", is_chosen(&a, "ruled/costly"));
    check_near("used", try_scalar(&a, "film", "value"), 20, 1e-12);
    try_close(&a);
}

static void references(void)
{
    attempt a = choose("use: ruled/auto, accuracy: 5 %, reference: ruled/cheap, " SETS, one_judge,
                       "film.value");
    check_good("a reference by name", &a);
    check_true("is the one that counts", is_chosen(&a, "ruled/cheap"));
    check_true("against others", candidate(&a, "ruled/costly")->error > 0.3);
    try_close(&a);
    a = choose("use: ruled/auto, gain: 3", one_judge, "film.value");
    check_error("several, and none is first", &a, 4, 15, "held against? These could be:");
    try_close(&a);
    a = choose("use: ruled/auto, reference: ruled/keyed, " SETS, one_judge, "film.value");
    check_error("a reference that does not fit", &a, 4, 38, "\"gain\" is missing");
    try_close(&a);
    a = choose("use: ruled/auto, reference: ruled/costlee, " SETS, one_judge, "film.value");
    check_error("a slip", &a, 4, 38, "did you mean \"ruled/costly\"?");
    try_close(&a);
    a = choose("use: ruled/costly, accuracy: 5 %, gain: 7", one_judge, "film.value");
    check_good("a law alone is its own reference", &a);
    check_near("used", try_scalar(&a, "film", "value"), 14, 1e-12);
    try_close(&a);
}

static void judges(void)
{
    attempt a =
        choose("use: ruled/auto, accuracy: 60 %, " SETS,
               "  film: {use: judge/strict}\n  old: {use: judge/deaf}\n", "film.value, old.value");
    check_good("one that cannot judge", &a);
    check_near("keeps the reference", try_scalar(&a, "old", "value"), 20, 1e-12);
    check_near("beside one that can", try_scalar(&a, "film", "value"), 30, 1e-12);
    try_close(&a);
    a = choose("use: ruled/auto, accuracy: 60 %, " SETS, "  old: {use: judge/deaf}\n", "old.value");
    check_good("nobody who can judge", &a);
    check_true("the reference stands",
               is_chosen(&a, "ruled/costly") &&
                   says(&a, "ruled/costly", "no stage that runs can judge"));
    try_close(&a);
    a = choose("use: ruled/auto, accuracy: 6 %, " SETS,
               "  film: {use: judge/strict}\n  other: {use: judge/strict}\n",
               "film.coarse, other.value");
    check_good("two judges", &a);
    check_true("the stricter one counts",
               is_chosen(&a, "ruled/middling") && says(&a, "ruled/cheap", "other: "));
    check_near("both get it", try_scalar(&a, "film", "coarse"), 2.04, 1e-12);
    try_close(&a);
    a = choose("use: ruled/auto, accuracy: 6 %, " SETS,
               "  film: {use: judge/strict}\n  other: {use: judge/strict, after: film}\n",
               "other.value");
    check_error("one that waits for another", &a, 4, 15, "waits for film");
    try_close(&a);
    a = choose("use: ruled/auto, accuracy: 60 %, " SETS, "  film: {use: judge/auto}\n",
               "film.value");
    check_good("a judge that is chosen itself", &a);
    check_near("gets the law, too", try_scalar(&a, "film", "value"), 30, 1e-12);
    try_close(&a);
}

static void verdicts(void)
{
    attempt a = try_run("pipeline:\n  one: {use: toy/source, level: 95 mm}\n"
                        "  rule: {use: ruled/auto, accuracy: 60 %, " SETS "}\n"
                        "  film: {use: judge/strict}\noutputs: [film.value]\n");
    check_good("a judge that cannot say", &a);
    check_true("leaves the reference",
               is_chosen(&a, "ruled/costly") && says(&a, "ruled/cheap", "beyond 90 mm"));
    try_close(&a);
    a = try_run("pipeline:\n  one: {use: toy/source, level: 85 mm}\n"
                "  rule: {use: ruled/auto, accuracy: 60 %, " SETS "}\n"
                "  film: {use: judge/strict}\noutputs: [film.value]\n");
    check_good("a judge without numbers", &a);
    check_true("leaves the reference",
               is_chosen(&a, "ruled/costly") && says(&a, "ruled/cheap", "no usable numbers"));
    try_close(&a);
    a = choose("use: ruled/auto, accuracy: 900 %", one_judge, "film.value");
    check_error("an accuracy beyond all", &a, 4, 37, "rule.accuracy");
    try_close(&a);
    a = choose("use: ruled/auto, accuracy: 90 %, with: {ruled/costly: {gain: 1}, ruled/cheap: "
               "{gain: 7}}",
               one_judge, "film.value");
    check_true("one that does not apply",
               is_chosen(&a, "ruled/costly") && candidate(&a, "ruled/cheap")->applies == 0);
    try_close(&a);
}

static void looks(void)
{
    attempt a = try_build("pipeline:\n  one: {use: toy/source, level: 2 mm}\n"
                          "  idle: {use: toy/source, level: 2 mm}\n"
                          "  rule: {use: ruled/auto, accuracy: 60 %, " SETS "}\n"
                          "  film: {use: judge/strict, source: one}\noutputs: [film.value]\n",
                          true);
    check_good("check", &a);
    check_true("only what the judge needs is run",
               ff_pipeline_choose(a.pipeline, NULL, a.report) && try_stage(&a, "one")->ran &&
                   !try_stage(&a, "idle")->ran && !try_stage(&a, "film")->ran);
    check_true("and the choice is made", is_chosen(&a, "ruled/cheap"));
    check_true("then the rest", ff_pipeline_run(a.pipeline, NULL, a.report));
    check_near("with the law", try_scalar(&a, "film", "value"), 30, 1e-12);
    try_close(&a);
}

int main(void)
{
    judged();
    references();
    judges();
    verdicts();
    looks();
    return check_done();
}
