/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The run: each stage once, with what is wanted; statuses become messages and exit codes. */
#include "pipeline-try.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void results(void)
{
    double begin = now(), taken = 0;
    attempt a = try_run("pipeline:\n"
                        "  one: {use: toy/source, level: 2 mm, count: 5}\n"
                        "  sum: {use: toy/consumer, source: one}\n"
                        "  again: {use: toy/consumer, source: one, more: one}\n"
                        "  law: {use: toy/law, gain: 3}\n"
                        "  user: {use: toy/user}\n"
                        "outputs: [sum.sum, sum.connected, again.sum, again.connected,\n"
                        "          one.evaluations, one.wanted, user.value]\n");
    check_good("a run of five stages", &a);
    check_near("a sum", try_scalar(&a, "sum", "sum"), 0.01, 1e-15);
    check_near("a sum of two", try_scalar(&a, "again", "sum"), 0.02, 1e-15);
    check_true("inputs that are connected", try_scalar(&a, "sum", "connected") == 3 &&
                                                try_scalar(&a, "again", "connected") == 11);
    check_true("a stage runs once", try_scalar(&a, "one", "evaluations") == 1);
    check_true("wanted: what is asked for and what is fed",
               try_scalar(&a, "one", "wanted") == 1 + 2 + 8 + 16);
    check_true("what is not wanted is not there", !try_result(&a, "one", "field")->data);
    check_true("a service", try_scalar(&a, "user", "value") == 6);
    check_true("a law counts as run", try_stage(&a, "law")->ran);
    check_true("quality is kept", try_stage(&a, "one")->quality_count == 1 &&
                                      try_stage(&a, "one")->quality[0].verdict == FF_GOOD);
    for (size_t i = 0; i < a.pipeline->count; i++)
        taken += a.pipeline->stages[i].seconds;
    check_true("time is taken, by each stage its own",
               try_stage(&a, "one")->seconds > 0 && taken < now() - begin);
    check_true("again gives the same", fe_pipeline_run(a.pipeline, NULL, a.report) &&
                                           try_scalar(&a, "one", "evaluations") == 2 &&
                                           try_stage(&a, "one")->quality_count == 1);
    try_close(&a);
}

static attempt bounded(const char *params, const char *outputs)
{
    char text[256];
    snprintf(text, sizeof text, "pipeline:\n  b: {use: toy/bounded%s}\noutputs: [%s]\n", params,
             outputs);
    return try_run(text);
}

static void natural_bounds(void)
{
    static const struct {
        const char *params, *outputs, *said;
    } cases[] = {
        {", share: -0.1", "b.share", "share is -0.1, limit 0: it must be between 0 and 1"},
        {", share: 1.5", "b.share", "share is 1.5, limit 1: it must be between 0 and 1"},
        {", temperature: -1 K", "b.temperature", "limit 0: it cannot be below 0"},
        {", film: [1 m, 2 m, -3 m]", "b.film",
         "film is -3, limit 0: it cannot be below 0, at index 2"},
        {", share: 2", "b.film", "share is 2"}, /* not asked for, and shown all the same */
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        attempt a = bounded(cases[i].params, cases[i].outputs);
        check_error(cases[i].params, &a, 3, 3, cases[i].said);
        check_true("the number stays", try_stage(&a, "b")->ran);
        try_close(&a);
    }
    attempt a = bounded(", share: 1.0000000000001, rise: -300 K", "b.*");
    check_good("rounding at a bound, and a difference below 0 K", &a);
    check_near("what is asked for", try_scalar(&a, "b", "idle"), 7, 0);
    try_close(&a);
    a = bounded("", "b.share");
    check_true("what was not computed is absent", !try_result(&a, "b", "idle")->data);
    check_true("what was computed is there", try_scalar(&a, "b", "rise") == 1);
    try_close(&a);
    a = bounded(", strange: true", "b.share");
    check_good("outside of the range of the model", &a);
    const ff_quality *line = try_stage(&a, "b")->quality;
    check_true("is a doubt of its own", line->verdict == FF_DOUBTFUL && line->range);
    try_close(&a);
}

/* The line of the second of two toys that lie so far apart, in K; NULL: none. */
static const ff_quality *agreement(attempt *a, const char *second, const char *outputs)
{
    char text[400];
    snprintf(text, sizeof text,
             "pipeline:\n  b: {use: toy/bounded, temperature: 300 K}\n"
             "  c: {use: toy/bounded, temperature: %s}\noutputs: [%s]\n",
             second, outputs);
    *a = try_run(text);
    const ff_stage *stage = try_stage(a, "c");
    for (size_t i = 0; i < stage->quality_count; i++)
        if (!strcmp(stage->quality[i].name, "temperature_agreement"))
            return &stage->quality[i];
    return NULL;
}

/* Two stages that give one quantity are asked for it and compared, by their rows. */
static void quantities(void)
{
    attempt a;
    const ff_quality *line = agreement(&a, "304 K", "b.share, c.share");
    check_good("two that give one quantity", &a);
    check_true("agree", line && line->verdict == FF_GOOD && !try_stage(&a, "b")->quality_count);
    check_near("how far they lie apart", line->value, 4, 1e-12);
    check_near("how far they may", line->limit, 5, 0);
    check_true("nobody asked for it", !try_result(&a, "c", "temperature")->requested);
    try_close(&a);
    line = agreement(&a, "293.15 K", "b.share, c.share");
    check_good("further apart", &a);
    check_true("is a doubt of the range", line && line->verdict == FF_DOUBTFUL && line->range);
    check_true("says both", strstr(line->text, "temperature of the toy: 20 degC here, 26.85 degC "
                                               "by b.temperature") != NULL);
    check_true("again, once more", fe_pipeline_run(a.pipeline, NULL, a.report) &&
                                       try_stage(&a, "c")->quality_count == 1);
    try_close(&a);
    check_true("one that does not run", !agreement(&a, "400 K", "c.share"));
    try_close(&a);
}

/* A pipeline that goes on with other values answers as one that is built with them; objects stay
   whose values do; what is no plain value of a parameter needs another pipeline. */
static void changes(void)
{
    static const char *const values[] = {"one.level=3 mm", "pipeline.law.gain=5"};
    static const char *const before[] = {"one.level=2 mm"};
    const char *name;
    static const char *const others[] = {
        "one.level=[1 mm]",     "one.use=toy/law", "one.levels=1 mm",
        "none.level=1 mm",      "sum.source=one",  "one.level=",
        "one.level=3 furlongs", "title=x",         "one.level"};
    attempt a = try_run("pipeline:\n"
                        "  one: {use: toy/source, level: 2 mm, count: 5}\n"
                        "  sum: {use: toy/consumer, source: one}\n"
                        "  law: {use: toy/law, gain: 3}\n"
                        "  user: {use: toy/user}\n"
                        "outputs: [sum.sum, one.evaluations, user.value]\n");
    check_good("a run before the change", &a);
    check_true("other values", fe_pipeline_change(a.pipeline, a.tree, values, 2, true) &&
                                   fe_pipeline_run(a.pipeline, NULL, a.report));
    check_near("what the changed one feeds", try_scalar(&a, "sum", "sum"), 0.015, 1e-15);
    check_true("its service", try_scalar(&a, "user", "value") == 10);
    check_true("what has another value is new", try_scalar(&a, "one", "evaluations") == 1);
    check_true("what keeps its values stays",
               fe_pipeline_change(a.pipeline, a.tree, values + 1, 1, true) &&
                   fe_pipeline_run(a.pipeline, NULL, a.report) &&
                   try_scalar(&a, "one", "evaluations") == 2);
    check_near("and answers as before", try_scalar(&a, "sum", "sum"), 0.015, 1e-15);
    check_true("what is wired to a service is new", try_scalar(&a, "user", "value") == 10);
    const ff_stage *one = ff_stage_of(a.pipeline, "one.level", &name);
    check_true("values without objects",
               fe_pipeline_change(a.pipeline, a.tree, before, 1, false) &&
                   one->params[ff_model_find_param(one->loaded->model, "level")].value.real ==
                       0.002 &&
                   !fe_pipeline_run(a.pipeline, NULL, a.report));
    check_true("and with them", fe_pipeline_change(a.pipeline, a.tree, values, 1, true) &&
                                    fe_pipeline_run(a.pipeline, NULL, a.report));
    check_near("as before", try_scalar(&a, "sum", "sum"), 0.015, 1e-15);
    try_close(&a);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        a = try_build("pipeline: {one: {use: toy/source, level: 2 mm}, sum: {use: toy/consumer, "
                      "source: one}}\noutputs: [sum.sum]\n",
                      false);
        check_true(others[i], !fe_pipeline_change(a.pipeline, a.tree, &others[i], 1, true));
        try_close(&a);
    }
}

/* An object that hands on a state is made anew where its values stay, so that no case starts from
   the one before: it counts its evaluations, and would have two. */
static void no_state_is_kept(void)
{
    static const char *const values[] = {"one.level=3 mm"};
    attempt a = try_run("pipeline:\n"
                        "  one: {use: toy/source, level: 2 mm}\n"
                        "  a: {use: loop/linear, base: 1 m}\n"
                        "outputs: [one.series, a.evaluations]\n");
    check_good("a run with a state", &a);
    check_true("from no state", fe_pipeline_change(a.pipeline, a.tree, values, 1, true) &&
                                    fe_pipeline_run(a.pipeline, NULL, a.report) &&
                                    try_scalar(&a, "a", "evaluations") == 1);
    try_close(&a);
}

/* toy/wide gives each output its rank, and the last one the number of those wanted. */
static void many_outputs(void)
{
    attempt a = try_run("pipeline:\n"
                        "  wide: {use: toy/wide}\n"
                        "outputs: [wide.o3, wide.o63, wide.o64, wide.o90, wide.o99]\n");
    check_good("a run of a hundred outputs", &a);
    check_true("outputs on both sides of the mask",
               try_scalar(&a, "wide", "o3") == 3 && try_scalar(&a, "wide", "o63") == 63 &&
                   try_scalar(&a, "wide", "o64") == 64 && try_scalar(&a, "wide", "o90") == 90);
    check_true("no other is wanted", try_scalar(&a, "wide", "o99") == 5 &&
                                         !try_result(&a, "wide", "o26")->data &&
                                         !try_result(&a, "wide", "o65")->data);
    try_close(&a);
    a = try_run("pipeline: {wide: {use: toy/wide}}\noutputs: [wide.o64]\n");
    check_true("an output without a bit runs alone", try_scalar(&a, "wide", "o64") == 64);
    try_close(&a);
    a = try_run("pipeline: {wide: {use: toy/wide}}\noutputs: [wide.*]\n");
    check_true("all of them", try_scalar(&a, "wide", "o99") == 100);
    try_close(&a);
}

static void shapes(void)
{
    attempt a = try_run("pipeline: {one: {use: toy/source, level: 2 mm, count: 0}}\n"
                        "outputs: [one.field, one.series, one.rare]\n");
    check_good("lengths of 0", &a);
    const ff_result *field = try_result(&a, "one", "field");
    check_true("an empty field",
               field->data && field->rank == 2 && field->shape[1] == 4 && field->count == 0);
    const ff_stage *one = try_stage(&a, "one");
    int rare = ff_model_find_output(one->loaded->model, "rare");
    check_true("an absent leading dimension",
               one->results[rare].rank == 1 && !strcmp(one->results[rare].dims[0], "k"));
    check_true("names of dimensions",
               !strcmp(one->results[2].dims[0], "t") && !strcmp(one->results[2].dims[1], "x"));
    try_close(&a);
}

static void lengths_of_inputs(void)
{
    attempt a = try_run("pipeline:\n"
                        "  one: {use: toy/source, level: 2 mm, count: 5}\n"
                        "  two: {use: toy/source, level: 2 mm, count: 6}\n"
                        "  sum: {use: toy/consumer, source: one, more: two}\n");
    check_error("two inputs of different lengths along one dimension", &a, 5, 47,
                "the dimension \"t\" is 5 long in \"source.series\", but 6 in \"more.series\"");
    check_true("wrong input", ff_report_fault(a.report) == FF_FAULT_INPUT);
    check_true("results so far stay", try_result(&a, "one", "series")->data != NULL);
    try_close(&a);
}

static void status(const char *answer, int exit_code, const char *phrase)
{
    char text[256];
    snprintf(text, sizeof text,
             "pipeline:\n  one: {use: toy/source, level: 2 mm, answer: %s}\n"
             "  sum: {use: toy/consumer, source: one}\n",
             answer);
    attempt a = try_run(text);
    check_true(answer, ff_report_fault(a.report) == exit_code);
    if (exit_code == FF_FAULT_NONE)
        check_true("a warning", try_says(&a, FF_WARNING, 3, 33, phrase));
    else if (exit_code == FF_FAULT_PLUGIN)
        check_error("at the model", &a, 3, 14, phrase);
    else
        check_error("at the parameter", &a, 3, 33, phrase);
    const ff_stage *sum = try_stage(&a, "sum");
    check_true("what depends on it", sum && sum->ran == (exit_code == FF_FAULT_NONE));
    try_close(&a);
}

static void statuses(void)
{
    status("domain", FF_FAULT_NONE, "one: the answer is domain");
    status("noconv", FF_FAULT_RUN, "one.level (toy/source): the answer is noconv");
    status("stopped", FF_FAULT_RUN, "the answer is stopped");
    status("nomem", FF_FAULT_RUN, "the answer is nomem");
    status("invalid", FF_FAULT_INPUT, "the answer is invalid");
    status("unsupported", FF_FAULT_INPUT, "the answer is unsupported");
    status("bug", FF_FAULT_PLUGIN, "an internal error during evaluate: the answer is bug");
    status("unknown", FF_FAULT_PLUGIN, "the unknown status 77 during evaluate");
    attempt a = try_build("pipeline: {one: {use: toy/source, level: 2 mm, count: 7, answer: "
                          "ready}}\n",
                          false);
    check_error("ready fails while the pipeline is built", &a, 2, 55,
                "one.count (toy/source): a count of 7 is not to be had");
    try_close(&a);
}

static void bad_quality(void)
{
    attempt a = try_run("pipeline:\n  one: {use: toy/source, level: 2 mm, answer: bad}\n"
                        "  sum: {use: toy/consumer, source: one}\n");
    check_error("a bad verdict fails the run", &a, 3, 3,
                "balance is 0.5, limit 1e-08: nothing balances");
    check_true("with its exit code", ff_report_fault(a.report) == FF_FAULT_RUN);
    check_true("and its results kept", try_stage(&a, "sum")->ran);
    try_close(&a);
}

static void refused_outputs(void)
{
    attempt a = try_run("pipeline: {one: {use: toy/source, level: 2 mm}}\noutputs: [one.*]\n");
    check_good("a star does without what the model refuses", &a);
    check_true("which is not asked for any more", !try_result(&a, "one", "never")->requested);
    check_true("the rest is there", try_result(&a, "one", "series")->data != NULL);
    try_close(&a);
    a = try_run("pipeline: {one: {use: toy/source, level: 2 mm}}\noutputs: [one.*, one.never]\n");
    check_error("what is asked for by name is an error", &a, 2, 12,
                "one.never (toy/source): not to be had");
    check_true("of the input", ff_report_fault(a.report) == FF_FAULT_INPUT);
    try_close(&a);
}

static int stop(void *ctx, const ff_stage *s, double fraction)
{
    (void)ctx, (void)s;
    return fraction == 0.5;
}

static void count_lines(void *ctx, const ff_stage *s, int level, const char *text)
{
    *(int *)ctx += level == FF_LOG_INFO && !strcmp(text, "working") && !strcmp(s->name, "one");
}

static void watched(void)
{
    int lines = 0;
    ff_observer watch = {.progress = stop, .log = count_lines, .ctx = &lines};
    attempt a =
        try_build("pipeline: {one: {use: toy/source, level: 2 mm, answer: progress}}\n", false);
    check_true("a run that is stopped", !fe_pipeline_run(a.pipeline, &watch, a.report) &&
                                            ff_report_fault(a.report) == FF_FAULT_RUN);
    check_error("says so", &a, 0, 0, "it was stopped");
    check_true("log lines arrive", lines == 1);
    try_close(&a);
}

int main(void)
{
    results();
    natural_bounds();
    quantities();
    changes();
    no_state_is_kept();
    many_outputs();
    shapes();
    lengths_of_inputs();
    statuses();
    bad_quality();
    refused_outputs();
    watched();
    return check_done();
}
