/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A run as a program sees it through the library: results, quality, messages, what it refuses. */
#include <flankfilm/engine.h>

#include <check.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static ff_engine *engine;
static char file[] = "/tmp/flankfilm-run-XXXXXX";

static ff_engine *open_engine(void)
{
    const char *toys = getenv("FLANKFILM_TEST_BAD");
    ff_engine_options options = {
        .size = sizeof options, .plugin_paths = &toys, .plugin_path_count = 1};
    ff_engine *made = NULL;
    check_true("an engine", toys && ff_engine_new(&options, &made) == FF_OK);
    return made;
}

static ff_run *open_run(ff_engine *of, const char *text, const char *const *sets, ff_status *status)
{
    ff_run *run;
    FILE *out = fopen(file, "w");
    fprintf(out, "format: 2\n%s", text);
    fclose(out);
    *status = ff_run_open(of, file, sets, &run);
    return run;
}

static int says(const char *words)
{
    return strstr(ff_engine_message(engine), words) != NULL;
}

static const char two_stages[] = "pipeline:\n"
                                 "  one: {use: toy/source, level: 2 mm, count: 5}\n"
                                 "  sum: {use: toy/consumer, source: one}\n"
                                 "outputs: [sum.sum, one.field]\n";

static double scalar(ff_run *run, const char *path)
{
    const ff_result *result;
    return ff_run_result(run, path, &result) == FF_OK ? result->data[0] : -1;
}

static void results(void)
{
    static const char *const sets[] = {"one.level=4 mm", NULL};
    ff_status status;
    const ff_result *result;
    const ff_quality *line;
    int32_t verdict = -1;
    ff_run *run = open_run(engine, two_stages, sets, &status);
    check_true("a file is read", status == FF_OK && run && says("") && !*ff_engine_message(engine));
    check_true("nothing is there before the run",
               ff_run_result(run, "sum.sum", &result) == FF_INVALID && !result &&
                   says("sum.sum was not computed: the run has not been started"));
    check_true("nor a verdict", ff_run_verdict(run, &verdict) == FF_INVALID && verdict == FF_BAD &&
                                    says("has not been started"));
    check_true("a run", ff_run_start(run, NULL) == FF_OK);
    check_near("a result, as set", scalar(run, "sum.sum"), 0.02, 1e-15);
    check_true("a field", ff_run_result(run, "one.field", &result) == FF_OK && result->rank == 2 &&
                              !strcmp(result->dims[0], "t") && !strcmp(result->dims[1], "x") &&
                              result->count == result->shape[0] * result->shape[1] &&
                              !strcmp(result->row->name, "field"));
    check_true("no such result", ff_run_result(run, "sum.nothing", &result) == FF_INVALID &&
                                     says("there is no result \"sum.nothing\""));
    check_true("no such stage", ff_run_result(run, "none.sum", &result) == FF_INVALID);
    check_true("not asked for", ff_run_result(run, "one.rare", &result) == FF_INVALID &&
                                    says("`outputs` in the file does not request it"));
    check_true("a verdict", ff_run_verdict(run, &verdict) == FF_OK && verdict == FF_GOOD);
    check_true("a quality line", ff_run_quality(run, 0, &line) == FF_OK &&
                                     !strcmp(line->stage, "one") && line->name[0]);
    check_true("no more of them", ff_run_quality(run, 1, &line) == FF_INVALID && !line);
    check_true("a second run", ff_run_start(run, NULL) == FF_OK && scalar(run, "sum.sum") > 0);
    ff_run_close(run);
}

static void errors(void)
{
    ff_status status;
    ff_run *run = open_run(engine, "pipeline:\n  one: {use: toy/source, level: 2 s, cuont: 5}\n",
                           NULL, &status);
    check_true("a wrong file", status == FF_INVALID && !run);
    check_true("all errors at once, with places",
               says(":3:") && says("error:") && says("cuont") && says("2 s"));
    check_true("a file that is not there",
               ff_run_open(engine, "/nowhere/x.yaml", NULL, &run) == FF_INVALID && !run &&
                   says("/nowhere/x.yaml"));
    run = open_run(engine, "pipeline: {one: {use: toy/source, level: 2 mm, answer: noconv}}\n",
                   NULL, &status);
    check_true("a run that fails", ff_run_start(run, NULL) == FF_NOCONV && says("noconv"));
    ff_run_close(run);
    run = open_run(engine, "pipeline: {one: {use: toy/source, level: 2 mm, answer: bug}}\n", NULL,
                   &status);
    check_true("a plugin at fault", ff_run_start(run, NULL) == FF_BUG && says("the plugin "));
    ff_run_close(run);
    ff_run_close(NULL);
}

/* What a run that failed has left, and what not. */
static void failed(void)
{
    static const char file_of_two[] = "pipeline:\n"
                                      "  good: {use: toy/source, level: 1 mm}\n"
                                      "  one: {use: toy/source, level: 2 mm, answer: noconv}\n"
                                      "  sum: {use: toy/consumer, source: one}\n"
                                      "outputs: [sum.sum, one.level, \"good.*\"]\n";
    ff_status status;
    const ff_result *result;
    const char *stage;
    int32_t verdict = FF_GOOD;
    bool good = true;
    ff_run *run = open_run(engine, file_of_two, NULL, &status);
    check_true("fails", ff_run_start(run, NULL) == FF_NOCONV);
    check_near("what ended well is there", scalar(run, "good.level"), 1e-3, 0);
    check_true("what the model refuses", ff_run_result(run, "good.never", &result) == FF_INVALID &&
                                             says("does not give it for these inputs"));
    check_true("what failed is not", ff_run_result(run, "one.level", &result) == FF_INVALID &&
                                         !result && says("its stage failed"));
    check_true("nor what it feeds", ff_run_result(run, "sum.sum", &result) == FF_INVALID &&
                                        says("a stage that feeds its stage failed"));
    check_true("the verdict is bad", ff_run_verdict(run, &verdict) == FF_OK && verdict == FF_BAD);
    for (size_t i = 0; ff_run_output(run, i, &stage, &result) == FF_OK; i++)
        good = good && !strcmp(stage, "good");
    check_true("the list has whole results alone", good);
    ff_run_close(run);
}

static void refused(void)
{
    ff_status status;
    ff_run *run = open_run(engine,
                           "study: {sweep: {one.level: [1 mm, 2 mm]}}\npipeline: {one: {use: "
                           "toy/source, level: 2 mm}}\n",
                           NULL, &status);
    check_true("a study is refused", status == FF_INVALID && !run && says("study: the library"));
    run = open_run(engine, "accuracy: 2 %\npipeline: {one: {use: toy/source, level: 2 mm}}\n", NULL,
                   &status);
    check_true("an accuracy is refused", status == FF_INVALID && !run && says("accuracy: "));
    run = open_run(engine, "pipeline: {one: {use: toy/auto, level: 2 mm}}\n", NULL, &status);
    check_true("an open model is refused", status == FF_INVALID && !run && says("toy/auto"));
}

static ff_run *parse(const char *text)
{
    ff_run *run;
    char whole[400];
    snprintf(whole, sizeof whole, "format: 2\n%s", text);
    ff_run_parse(engine, "text.yaml", ".", whole, &run);
    return run;
}

/* A file, its settings and its start one by one; a copy goes on from what was set. */
static void in_steps(void)
{
    ff_run *run = parse(two_stages), *copy;
    check_true("a setting", ff_run_set(run, "one.level=4 mm") == FF_OK);
    check_true("a later one", ff_run_set(run, "one.level=6 mm") == FF_OK);
    check_true("ready", ff_run_ready(run) == FF_OK && ff_run_ready(run) == FF_OK);
    check_true("can be set no more", ff_run_set(run, "one.level=2 mm") == FF_INVALID);
    check_true("a copy can",
               ff_run_copy(run, &copy) == FF_OK && ff_run_set(copy, "one.level=2 mm") == FF_OK);
    check_true("both start", ff_run_start(copy, NULL) == FF_OK && ff_run_start(run, NULL) == FF_OK);
    check_near("the copy by itself", scalar(copy, "sum.sum"), 0.01, 1e-15);
    check_near("the first by itself", scalar(run, "sum.sum"), 0.03, 1e-15);
    ff_run_close(copy);
    ff_run_close(run);
}

static void wrong_steps(void)
{
    ff_run *run = parse("pipeline: {one: {use: toy/source, level: 2 K}}\n"), *none;
    const ff_result *result;
    check_true("a broken setting", ff_run_set(run, "one.count") == FF_INVALID && says("\"=\""));
    check_true("all that is wrong at once",
               ff_run_ready(run) == FF_INVALID && says("\"=\"") && says("level"));
    check_true("not to be started", ff_run_start(run, NULL) == FF_INVALID);
    ff_run_close(run);
    check_true("no such file", ff_run_read(engine, "/nonexistent", &run) == FF_INVALID && run &&
                                   says("/nonexistent"));
    check_true("nothing to set, copy, make ready or start",
               ff_run_set(run, "one.count=1") == FF_INVALID &&
                   ff_run_copy(run, &none) == FF_INVALID && !none &&
                   ff_run_ready(run) == FF_INVALID && ff_run_start(run, NULL) == FF_INVALID);
    check_true("nor to be asked for",
               ff_run_result(run, "one.level", &result) == FF_INVALID && says("not been started"));
    ff_run_close(run);
    run = parse("study: {sweep: {one.level: [1 mm, 2 mm]}}\npipeline: {one: {use: toy/source, "
                "level: 2 mm}}\n");
    check_true("a study in steps is refused",
               ff_run_ready(run) == FF_INVALID && says("study: the library"));
    ff_run_close(run);
}

/* What the program needs beyond that. */
static void by_the_program(void)
{
    static const char *const value[] = {"one.level=4 mm"}, *const model[] = {"one.use=toy/one"};
    ff_run *run = parse(two_stages);
    check_true("built", ff_run_build(run, false) == FF_OK && ff_run_start(run, NULL) == FF_OK);
    check_true("another value",
               ff_run_change(run, value, 1, true) == FF_OK && ff_run_start(run, NULL) == FF_OK);
    check_near("counts", scalar(run, "sum.sum"), 0.02, 1e-15);
    check_true("another model is too much", ff_run_change(run, model, 1, true) == FF_UNSUPPORTED &&
                                                ff_run_start(run, NULL) == FF_INVALID);
    ff_run_close(run);
    run = parse(two_stages);
    ff_error(ff_run_report(run), FF_FAULT_INPUT, FF_NOWHERE, NULL, "no case");
    check_true("an error of the caller's", ff_run_build(run, false) == FF_INVALID &&
                                               says("no case") && ff_run_pipeline(run) &&
                                               ff_run_start(run, NULL) == FF_INVALID);
    ff_run_close(run);
}

static int32_t stop(void *ctx, const ff_stage *of, double fraction)
{
    (void)ctx;
    return !strcmp(ff_stage_name(of), "one") && fraction == 0.5;
}

static void count_lines(void *ctx, const ff_stage *of, int32_t level, const char *text)
{
    (void)of;
    *(int *)ctx += level == FF_LOG_INFO && !strcmp(text, "working");
}

static void observed(void)
{
    int lines = 0;
    ff_status status;
    ff_observer observer = {
        .size = sizeof observer, .ctx = &lines, .progress = stop, .log = count_lines};
    ff_run *run =
        open_run(engine, "pipeline: {one: {use: toy/source, level: 2 mm, answer: progress}}\n",
                 NULL, &status);
    check_true("a run that is stopped", ff_run_start(run, &observer) == FF_STOPPED);
    check_true("log lines arrive", lines == 1);
    ff_run_close(run);
}

static void moved(void)
{
    ff_status status;
    char before[4096], after[4096];
    ff_run *run = open_run(engine, two_stages, NULL, &status);
    if (!getcwd(before, sizeof before) || chdir("/") != 0)
        exit(2);
    check_true("a caller that goes to another folder", ff_run_start(run, NULL) == FF_OK);
    check_true("no plugin is blamed", !*ff_engine_message(engine));
    check_true("stays there", getcwd(after, sizeof after) && !strcmp(after, "/"));
    ff_run_close(run);
    if (chdir(before) != 0)
        exit(2);
}

static void two_engines(void)
{
    ff_status one, two;
    ff_engine *other = open_engine();
    ff_run *a = open_run(engine, two_stages, NULL, &one);
    ff_run *b = open_run(other, two_stages, NULL, &two);
    check_true("two engines in one process", ff_run_start(a, NULL) == FF_OK &&
                                                 ff_run_start(b, NULL) == FF_OK &&
                                                 scalar(a, "sum.sum") == scalar(b, "sum.sum"));
    ff_run_close(b);
    ff_engine_close(other);
    check_near("one outlives the other", scalar(a, "sum.sum"), 0.01, 1e-15);
    ff_run_close(a);
    ff_engine_close(NULL);
}

static void wrong_arguments(void)
{
    ff_status status;
    ff_run *none, *run = open_run(engine, two_stages, NULL, &status);
    const ff_result *result;
    const ff_quality *line;
    const char *stage;
    int32_t verdict;
    check_true("no engine", ff_run_open(NULL, file, NULL, &none) == FF_INVALID && !none);
    check_true("no file", ff_run_open(engine, NULL, NULL, &none) == FF_INVALID && !none);
    check_true("no place for it", ff_run_open(engine, file, NULL, NULL) == FF_INVALID &&
                                      ff_run_read(engine, file, NULL) == FF_INVALID &&
                                      ff_run_copy(run, NULL) == FF_INVALID);
    check_true("no text", ff_run_parse(engine, "a", ".", NULL, &none) == FF_INVALID && !none &&
                              ff_run_read(engine, NULL, &none) == FF_INVALID && !none);
    check_true("nothing to set", ff_run_set(run, NULL) == FF_INVALID &&
                                     ff_run_set(NULL, "a=b") == FF_INVALID &&
                                     ff_run_ready(NULL) == FF_INVALID);
    check_true("no path", ff_run_result(run, NULL, &result) == FF_INVALID && !result &&
                              ff_run_result(run, "sum.sum", NULL) == FF_INVALID);
    check_true("nothing to answer to", ff_run_output(run, 0, &stage, NULL) == FF_INVALID &&
                                           ff_run_quality(run, 0, NULL) == FF_INVALID &&
                                           ff_run_verdict(run, NULL) == FF_INVALID);
    check_true("no run", ff_run_start(NULL, NULL) == FF_INVALID &&
                             ff_run_result(NULL, "sum.sum", &result) == FF_INVALID &&
                             ff_run_output(NULL, 0, &stage, &result) == FF_INVALID &&
                             ff_run_quality(NULL, 0, &line) == FF_INVALID &&
                             ff_run_verdict(NULL, &verdict) == FF_INVALID && !*ff_stage_name(NULL));
    check_true("all is as it was", ff_run_start(run, NULL) == FF_OK);
    ff_run_close(run);
}

int main(void)
{
    int made = mkstemp(file);
    if (made < 0)
        return 2;
    close(made);
    engine = open_engine();
    results();
    errors();
    failed();
    refused();
    in_steps();
    wrong_steps();
    by_the_program();
    observed();
    moved();
    two_engines();
    wrong_arguments();
    ff_engine_close(engine);
    unlink(file);
    return check_done();
}
