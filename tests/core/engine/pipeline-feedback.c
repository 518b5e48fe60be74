/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Loops of loop/linear, level = base + gain before + factor back, whose fixed point and rate are
 * known: of a = 1 m + q b and b = a it is 1 m / (1 - q), and the error falls by q in each round.
 */
#include "pipeline-try.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* a, which b feeds back to, and the other lines. */
static attempt run_loop(double q, const char *others)
{
    char text[1024];
    snprintf(text, sizeof text,
             "pipeline:\n"
             "  a: {use: loop/linear, base: 1 m, factor: %g, back: b}\n"
             "  b: {use: loop/linear, base: 0 m, before: a}\n"
             "%s",
             q, others);
    return try_run(text);
}

static const ff_quality *quality(const attempt *a, const char *of, const char *name)
{
    const ff_stage *s = try_stage(a, of);
    for (size_t i = 0; s && i < s->quality_count; i++)
        if (!strcmp(s->quality[i].name, name))
            return &s->quality[i];
    return NULL;
}

static double rounds(const attempt *a)
{
    const ff_quality *line = quality(a, "a", "feedback_rounds");
    return line ? line->value : NAN;
}

static void one_way(void)
{
    attempt a = try_run("pipeline:\n"
                        "  a: {use: loop/linear, base: 1 m, factor: 0.5}\n"
                        "  b: {use: loop/linear, base: 0 m, before: a}\n"
                        "outputs: [a.*, b.*]\n");
    check_good("feedback that is not wired", &a);
    check_true("never wired by itself",
               try_stage(&a, "a")->wires[3].stage == -1 && try_scalar(&a, "a", "connected") == 0);
    check_true("no loop", a.pipeline->loop_count == 0 && !try_stage(&a, "a")->loop &&
                              !quality(&a, "a", "feedback_rounds"));
    try_close(&a);
    a = try_run("pipeline:\n"
                "  b: {use: loop/linear, base: 1 m, factor: 3, back: a}\n"
                "  a: {use: loop/linear, base: 1 m}\n"
                "outputs: [b.level]\n");
    check_good("feedback that closes no loop", &a);
    check_true("is a wire like any other",
               a.pipeline->loop_count == 0 && try_scalar(&a, "b", "level") == 4);
    try_close(&a);
}

/* x_k = 2 - 2^(1-k): the residual of round k is 2^-k / (1 - 2^-k), below 1e-6 from k = 20 on. */
static void converging(void)
{
    attempt a = run_loop(0.5, "outputs: [a.*, b.*]\n");
    check_good("a loop that converges", &a);
    check_near("its fixed point", try_scalar(&a, "a", "level"), 2, 2e-6);
    check_true("its rounds", rounds(&a) == 20);
    check_near("its residual", quality(&a, "a", "feedback_residual")->value, exp2(-20), 2e-6);
    check_true("each stage once in each round", try_scalar(&a, "a", "evaluations") == 20 &&
                                                    try_scalar(&a, "b", "evaluations") == 20);
    check_true("the quality of the last round alone",
               try_stage(&a, "a")->quality_count == 3 && try_stage(&a, "b")->quality_count == 1);
    check_true("again gives the same", fe_pipeline_run(a.pipeline, NULL, a.report) &&
                                           rounds(&a) == 20 &&
                                           try_scalar(&a, "a", "evaluations") == 40);
    try_close(&a);
    a = run_loop(0.5, "outputs: [a.level]\nfeedback: {tolerance: 1e-3}\n");
    check_true("a looser tolerance", rounds(&a) == 10);
    try_close(&a);
    a = run_loop(0.5, "outputs: [a.level]\nfeedback: {tolerance: 0, rounds: 100}\n");
    check_true("to the bit", try_scalar(&a, "a", "level") == 2 && rounds(&a) == 55);
    try_close(&a);
    a = try_build_set("pipeline:\n"
                      "  a: {use: loop/linear, base: 1 m, factor: 0.5, back: b}\n"
                      "  b: {use: loop/linear, base: 0 m, before: a}\n",
                      "feedback.rounds=7", false);
    check_good("--set", &a);
    check_true("has its say", a.pipeline->feedback.rounds == 7);
    try_close(&a);
}

static void not_converging(void)
{
    attempt a = run_loop(2, "outputs: [a.*, b.*]\n");
    check_error("a loop that diverges is bad", &a, 3, 3, "feedback_residual is 0.5, limit 1e-06");
    check_error("with its history", &a, 3, 3, "a, b: residuals 1, 0.667, 0.571, 0.533, ..., 0.5,");
    check_true("after all rounds", rounds(&a) == 30);
    check_true("its results are kept", try_scalar(&a, "a", "level") == exp2(30) - 1);
    check_true("the run failed", ff_report_fault(a.report) == FF_FAULT_RUN);
    try_close(&a);
    a = run_loop(-1, "outputs: [a.level]\nfeedback: {rounds: 5}\n");
    check_error("a loop that swings is bad", &a, 3, 3, "a, b: residuals 1, 1, 1, 1, 1");
    try_close(&a);
    a = run_loop(-1, "outputs: [a.level]\nfeedback: {relaxation: 0.5}\n");
    check_good("relaxed by half it settles", &a);
    check_true("at once", rounds(&a) == 3 && try_scalar(&a, "a", "level") == 0.5);
    try_close(&a);
    a = run_loop(2, "  c: {use: toy/consumer, source: b}\noutputs: [c.sum]\n"
                    "x-: {}\n");
    check_true("what takes from it runs all the same", try_stage(&a, "c")->ran);
    try_close(&a);
    a = try_run("pipeline:\n"
                "  a: {use: loop/linear, base: 1 m, factor: 2, back: b}\n"
                "  b: {use: loop/linear, base: 0 m, before: a, most: 10 m}\n");
    check_error("a stage that fails in a loop", &a, 4, 3, "b (loop/linear): the level is 15");
    check_error("names the round", &a, 3, 3,
                "the loop failed in round 4: a, b: residuals 1, 0.667, 0.571");
    check_true("and the loop has not run", !try_stage(&a, "a")->ran && !try_stage(&a, "b")->ran);
    try_close(&a);
}

static void others(void)
{
    attempt a = run_loop(0.5, "  s: {use: loop/linear, base: 1 m}\n"
                              "  c: {use: loop/linear, base: 0 m, before: b}\n"
                              "outputs: [c.*]\n");
    check_good("a stage behind a loop", &a);
    check_true("runs once", try_scalar(&a, "c", "evaluations") == 1);
    check_near("with the last round", try_scalar(&a, "c", "level"), 2, 2e-6);
    check_true("and one that nothing needs does not", !try_stage(&a, "s")->ran);
    try_close(&a);
    a = try_run("pipeline:\n"
                "  c: {use: loop/linear, base: 5 m, flag: a}\n"
                "  a: {use: loop/linear, base: 1 m, factor: 0.5, back: b, more: c}\n"
                "  b: {use: loop/linear, base: 0 m, before: a}\n"
                "outputs: [a.*, b.*, c.*]\n");
    check_good("a loop of three", &a);
    check_true("is one", a.pipeline->loop_count == 1 && a.pipeline->loops[0].count == 3);
    check_true("a stage whose inputs stay the same is not evaluated again",
               try_scalar(&a, "c", "evaluations") == 1 && rounds(&a) == 20);
    try_close(&a);
}

/* a = 1 + b / 4 + c / 4, b = a, c = a: 2 again. */
static void several(void)
{
    attempt a =
        try_run("pipeline:\n"
                "  a: {use: loop/linear, base: 1 m, factor: 0.25, share: 0.25, back: b, more: c}\n"
                "  b: {use: loop/linear, base: 0 m, before: a}\n"
                "  c: {use: loop/linear, base: 0 m, before: a}\n"
                "outputs: [a.level]\n");
    check_good("two loops that share a stage", &a);
    check_true("are one", a.pipeline->loop_count == 1 && rounds(&a) == 20);
    check_near("with its fixed point", try_scalar(&a, "a", "level"), 2, 2e-6);
    try_close(&a);
    a = run_loop(0.5, "  d: {use: loop/linear, base: 1 m, factor: 0.5, back: e, before: b}\n"
                      "  e: {use: loop/linear, base: 0 m, before: d}\n"
                      "outputs: [e.level, d.evaluations]\n");
    check_good("one loop behind another", &a);
    check_true("are two", a.pipeline->loop_count == 2 && try_stage(&a, "a")->loop->first == 0 &&
                              try_stage(&a, "e")->loop->first == 2);
    check_near("each with its fixed point", try_scalar(&a, "e", "level"), 6, 1e-5);
    try_close(&a);
    a = try_run("pipeline: {a: {use: loop/linear, base: 1 m, factor: 0.5, back: a}}\n");
    check_good("a stage that feeds itself", &a);
    check_true("is a loop", rounds(&a) == 20);
    try_close(&a);
}

/* From 4 points on there is one less with feedback. */
static void shapes(void)
{
    attempt a = try_run("pipeline:\n"
                        "  a: {use: loop/linear, base: 1 m, factor: 0.5, back: b, points: 5}\n"
                        "  b: {use: loop/linear, base: 0 m, before: a, points: 4}\n"
                        "outputs: [a.*, b.*]\n");
    check_good("a series that changes its length", &a);
    check_true("starts anew", try_result(&a, "a", "series")->count == 4 && rounds(&a) == 20);
    try_close(&a);
}

/* What comes back is left out of each round, and the loop settles without it. */
static void misfits(void)
{
    attempt a = try_run("pipeline:\n"
                        "  a: {use: loop/linear, base: 1 m, factor: 0.5, back: b}\n"
                        "  b: {use: loop/linear, base: 0 m, before: a, rows: 2}\n");
    check_error("a field for a series", &a, 3, 55,
                "a.back.series: b gives \"series\" with 2 dimensions, but loop/linear takes it "
                "along \"before.t\"");
    check_true("the loop has not run", !try_stage(&a, "a")->ran && !try_stage(&a, "b")->ran);
    try_close(&a);
    a = try_run("pipeline:\n"
                "  s: {use: loop/linear, base: 1 m, points: 2}\n"
                "  a: {use: loop/linear, base: 1 m, factor: 0.5, before: s, back: b}\n"
                "  b: {use: loop/linear, base: 0 m, flag: a}\n");
    check_error("a series of another length", &a, 4, 66,
                "a.back: the dimension \"t\" is 2 long in \"before.series\", but 3 in "
                "\"back.series\"");
    try_close(&a);
}

static void refused_at_first(void)
{
    static const char *const requests[] = {"outputs: [a.returned]\n", "outputs: [a.*]\n"};
    for (size_t i = 0; i < 2; i++) {
        attempt a = run_loop(0.5, requests[i]);
        check_good(i ? "requested as one of all" : "requested by name", &a);
        check_near("given from the second round on", try_scalar(&a, "a", "returned"), 2, 4e-6);
        check_true("and in a second run", fe_pipeline_run(a.pipeline, NULL, a.report) &&
                                              try_result(&a, "a", "returned")->data);
        try_close(&a);
    }
    attempt a = run_loop(0.5, "outputs: [b.returned]\n");
    check_error("refused in each round", &a, 4, 3, "b.returned (loop/linear): nothing comes back");
    try_close(&a);
    a = try_run("pipeline:\n"
                "  a: {use: loop/linear, base: 1 m, back: b}\n"
                "  b: {use: loop/linear, base: 0 m, flag: a}\n"
                "outputs: [b.returned]\n");
    check_error("refused when the inputs stay the same", &a, 4, 3,
                "b.returned (loop/linear): nothing comes back");
    try_close(&a);
}

static int lines;
static char last_line[64];

static void count_line(void *ctx, const ff_stage *of, int level, const char *text)
{
    (void)ctx, (void)of, (void)level;
    lines++;
    snprintf(last_line, sizeof last_line, "%s", text);
}

static int stop_in_b(void *ctx, const ff_stage *of, double fraction)
{
    (void)ctx, (void)fraction;
    return !strcmp(of->name, "b");
}

static void what_is_told(void)
{
    const ff_observer watch = {.log = count_line}, stopping = {.progress = stop_in_b};
    attempt a = try_build("pipeline:\n"
                          "  a: {use: loop/linear, base: 1 m, factor: 0.5, back: b, warns: true}\n"
                          "  b: {use: loop/linear, base: 0 m, before: a}\n",
                          false);
    check_true("runs", fe_pipeline_run(a.pipeline, &watch, a.report));
    check_true("the log of the last round alone",
               lines == 2 && !strcmp(last_line, "evaluation 20"));
    check_true("its warnings alone",
               ff_report_count(a.report) == 1 && try_says(&a, FF_WARNING, 3, 3, "level 2"));
    check_true("stopped", !fe_pipeline_run(a.pipeline, &stopping, a.report) &&
                              try_stage(&a, "a")->status == FF_STOPPED && !try_stage(&a, "a")->ran);
    try_close(&a);
}

/* Each round starts from the state of the neighbouring case; the last one leaves its own. */
static void chained(void)
{
    attempt a = try_build("pipeline:\n"
                          "  a: {use: loop/linear, base: 1 m, factor: 0.5, back: b}\n"
                          "  b: {use: loop/linear, base: 0 m, before: a}\n"
                          "outputs: [a.*, b.*]\n",
                          false);
    a.pipeline->chained = true;
    ff_stage_set_state(&a.pipeline->stages[0], "xx", 2);
    check_true("runs", fe_pipeline_run(a.pipeline, NULL, a.report));
    check_true("from that state in each round", try_scalar(&a, "a", "evaluations") == 201 &&
                                                    try_scalar(&a, "b", "evaluations") == 20);
    check_true("and leaves one",
               a.pipeline->stages[0].state_size == 1 && a.pipeline->stages[1].state_size == 1);
    try_close(&a);
}

static void refused(void)
{
    static const struct {
        const char *text, *phrase;
        unsigned line, column;
    } cases[] = {
        {"  a: {use: loop/linear, base: 1 m, before: b}\n  b: {use: loop/linear, base: 0 m, "
         "before: a}\n",
         "the stages need each other", 0, 0},
        {"  a: {use: loop/linear, base: 1 m, back: b}\n  b: {use: loop/linear, base: 0 m}\n"
         "feedback: {round: 3}\n",
         "feedback: unknown key \"round\"; did you mean \"rounds\"?", 5, 12},
        {"  a: {use: loop/linear, base: 1 m, back: b}\n"
         "  b: {use: loop/linear, base: 0 m, before: a, law: a}\n",
         "b: it is in a loop, so it cannot use a service of another stage in the loop", 4, 52},
        {"  a: {use: loop/linear, base: 1 m}\nfeedback: 3\n", "feedback: expected a map such as", 4,
         11},
        {"  a: {use: loop/linear, base: 1 m}\nfeedback: {rounds: 1}\n", "1 is too small", 4, 20},
        {"  a: {use: loop/linear, base: 1 m}\nfeedback: {tolerance: 1}\n", "it must be below 1", 4,
         23},
        {"  a: {use: loop/linear, base: 1 m}\nfeedback: {relaxation: 0}\n", "is too small", 4, 24},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text, "pipeline:\n%s", cases[i].text);
        attempt a = try_build(text, false);
        check_error(cases[i].phrase, &a, cases[i].line, cases[i].column, cases[i].phrase);
        try_close(&a);
    }
    attempt a =
        try_build("pipeline: {a: {use: loop/linear, base: 1 m}}\nfeedback: {rounds: 3}\n", false);
    check_good("rounds without a loop", &a);
    check_true("are warned of", try_says(&a, FF_WARNING, 3, 11, "no stage that runs is in a loop"));
    try_close(&a);
}

int main(void)
{
    one_way();
    converging();
    not_converging();
    others();
    several();
    shapes();
    misfits();
    refused_at_first();
    what_is_told();
    chained();
    refused();
    return check_done();
}
