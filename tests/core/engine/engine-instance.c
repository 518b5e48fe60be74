/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One model by hand: parameters, inputs, services, states, and what is refused. */
#include <flankfilm/engine.h>

#include "../../bad/plugins/toy/toy.h"

#include <check.h>

#include <stdlib.h>
#include <string.h>

static ff_engine *engine;

static ff_instance *open_model(const char *id)
{
    ff_instance *made;
    check_true(id, ff_instance_new(engine, id, &made) == FF_OK && made);
    return made;
}

static ff_instance *open_source(const char *level)
{
    ff_instance *source = open_model("toy/source");
    check_true("a level", ff_instance_set(source, "level", level) == FF_OK);
    return source;
}

/* -1: not given */
static double scalar(ff_instance *of, const char *output)
{
    const ff_result *result;
    return ff_instance_result(of, output, &result) == FF_OK ? result->data[0] : -1;
}

static int says(const char *words)
{
    return strstr(ff_engine_message(engine), words) != NULL;
}

static int refuses(ff_instance *of, ff_status status, const char *item, const char *words)
{
    return status == FF_INVALID && !strcmp(ff_instance_item(of), item) && says(words) &&
           strstr(ff_instance_reason(of), words);
}

static void parameters(void)
{
    static const double weights[] = {1, 3}, falling[] = {3, 1}, level = 0.004, huge = 1,
                        beyond = 1e300;
    ff_instance *s = open_model("toy/source");
    check_true("no such name",
               refuses(s, ff_instance_set(s, "levle", "2 mm"), "levle", "did you mean \"level\""));
    check_true("no unit", refuses(s, ff_instance_set(s, "level", "2"), "level", "unit"));
    check_true("too large", refuses(s, ff_instance_set(s, "level", "2 m"), "level", "too large"));
    check_true("too large in SI",
               refuses(s, ff_instance_set_reals(s, "level", &huge, 1), "level", "too large"));
    check_true("too large to be whole",
               refuses(s, ff_instance_set_reals(s, "count", &beyond, 1), "count", "beyond 2^53"));
    check_true("no list",
               refuses(s, ff_instance_set_reals(s, "weights", NULL, 3), "weights", "found 0"));
    check_true("a falling list", refuses(s, ff_instance_set_reals(s, "weights", falling, 2),
                                         "weights", "must not decrease"));
    check_true("no number",
               refuses(s, ff_instance_set_reals(s, "note", &level, 1), "note", "expected a text"));
    check_true("a required one", refuses(s, ff_instance_run(s, NULL), "level", "is missing"));
    check_true("in SI", ff_instance_set_reals(s, "level", &level, 1) == FF_OK && says(""));
    check_true("lists", ff_instance_set(s, "weights", "[1 kg, 2 kg, 3 kg]") == FF_OK &&
                            ff_instance_set_reals(s, "weights", weights, 2) == FF_OK);
    check_true("a warning is no error",
               ff_instance_set(s, "level", "60 mm") == FF_OK && says("calibrated range"));
    check_true("as before", ff_instance_set_reals(s, "level", &level, 1) == FF_OK);
    check_true("runs", ff_instance_run(s, "level speed") == FF_OK);
    check_near("the level", scalar(s, "level"), 0.004, 0);
    check_near("a preset", scalar(s, "speed"), 10 * 2 * 3.14159265358979 / 60, 1e-12);
    check_true("another of the group",
               ff_instance_set(s, "rate", "3 Hz") == FF_OK && ff_instance_run(s, NULL) == FF_OK);
    check_near("displaces the preset", scalar(s, "speed"), 0, 0);
    check_true("unset", ff_instance_set(s, "rate", NULL) == FF_OK &&
                            ff_instance_run(s, NULL) == FF_OK && scalar(s, "speed") > 1);
    check_true("a model that refuses",
               ff_instance_set(s, "answer", "ready") == FF_OK &&
                   refuses(s, ff_instance_ready(s), "count", "a count of 3 is not to be had"));
    ff_instance_close(s);
}

static void outputs(void)
{
    ff_instance *s = open_source("2 mm");
    const ff_result *field;
    const ff_quality *line;
    int32_t verdict;
    check_true("what it refuses by name",
               ff_instance_run(s, "level never") == FF_UNSUPPORTED && scalar(s, "level") < 0);
    check_true("what it refuses else", ff_instance_run(s, NULL) == FF_OK);
    check_true("a field", ff_instance_result(s, "field", &field) == FF_OK && field->rank == 2 &&
                              field->shape[0] == 3 && !strcmp(field->dims[1], "x"));
    check_true("not given", ff_instance_result(s, "never", &field) == FF_INVALID && !field);
    check_true("no such output", refuses(s, ff_instance_run(s, "lvel"), "lvel", "no output"));
    check_true("quality", ff_instance_run(s, "level") == FF_OK &&
                              ff_instance_quality(s, 0, &line) == FF_OK &&
                              !strcmp(line->name, "residual") &&
                              ff_instance_quality(s, 1, &line) == FF_INVALID);
    check_near("the same object", scalar(s, "evaluations"), 4, 0);
    check_true("a bad result is there", ff_instance_set(s, "answer", "bad") == FF_OK &&
                                            ff_instance_run(s, "level") == FF_OK &&
                                            ff_instance_verdict(s, &verdict) == FF_OK &&
                                            verdict == FF_BAD);
    check_near("another object", scalar(s, "evaluations"), 1, 0);
    check_true("a failure", ff_instance_set(s, "answer", "noconv") == FF_OK &&
                                ff_instance_run(s, "level") == FF_NOCONV && says("answer is"));
    check_true("leaves no result", scalar(s, "level") < 0 && says("the last run failed"));
    check_true("and is bad", ff_instance_verdict(s, &verdict) == FF_OK && verdict == FF_BAD);
    check_true("a broken plugin", ff_instance_set(s, "answer", "unknown") == FF_OK &&
                                      ff_instance_run(s, "level") == FF_BUG && says("status 77"));
    ff_instance_close(s);
}

static int lacks(ff_instance *of, const char *output, const char *words)
{
    const ff_result *result;
    return refuses(of, ff_instance_result(of, output, &result), output, words) && !result;
}

static void missing_outputs(void)
{
    ff_instance *s = open_source("2 mm"), *sum = open_model("toy/consumer");
    const ff_quality *line;
    const ff_result *result;
    const double weights[] = {1, 2, 3, 4};
    const size_t length = 4;
    const ff_array array = {.data = weights, .shape = &length, .rank = 1};
    int32_t verdict = FF_GOOD;
    check_true("before the run", lacks(s, "level", "has not run yet"));
    check_true("nor a verdict", ff_instance_verdict(s, &verdict) == FF_INVALID &&
                                    verdict == FF_BAD && says("has not run yet"));
    check_true("a misspelt output", lacks(s, "levle", "did you mean \"level\""));
    ff_instance_run(s, "level");
    check_true("not asked for", lacks(s, "field", "did not request it"));
    check_true("another one is there", scalar(s, "level") > 0);
    ff_instance_run(s, NULL);
    check_true("refused", lacks(s, "never", "the model refused it"));
    ff_instance_set(s, "level", "3 mm");
    check_true("a parameter has changed", lacks(s, "level", "has changed since") &&
                                              ff_instance_verdict(s, &verdict) == FF_INVALID &&
                                              ff_instance_quality(s, 0, &line) == FF_INVALID);
    ff_instance_run(s, "level");
    check_true("an unknown output", ff_instance_run(s, "lvel") == FF_INVALID &&
                                        lacks(s, "level", "the last run failed"));
    ff_instance_use(sum, "source", s);
    check_true("all is well", ff_instance_run(sum, NULL) == FF_OK &&
                                  ff_instance_result(sum, "sum", &result) == FF_OK);
    ff_instance_give(sum, "more.series", &array);
    check_true("an input has changed", lacks(sum, "sum", "has changed since"));
    check_true("and does not fit", ff_instance_run(sum, NULL) == FF_INVALID &&
                                       lacks(sum, "sum", "the last run failed"));
    ff_instance_close(sum);
    ff_instance_close(s);
}

static void wires(void)
{
    ff_instance *one = open_source("2 mm"), *two = open_source("3 mm");
    ff_instance *sum = open_model("toy/consumer");
    double more[] = {1, 2, 3, 4};
    size_t length = 4;
    const ff_array array = {.data = more, .shape = &length, .rank = 1};
    check_true("not fed", refuses(sum, ff_instance_run(sum, NULL), "source.level", "feeds"));
    check_true("no such wire", refuses(sum, ff_instance_use(sum, "sauce", one), "sauce", "wire"));
    check_true("no match", refuses(sum, ff_instance_use(sum, "source", sum), "source", "feed"));
    check_true("a wire", ff_instance_use(sum, "source", one) == FF_OK);
    check_true("runs what feeds it", ff_instance_run(sum, NULL) == FF_OK);
    check_near("by it", scalar(sum, "sum"), 3 * 0.002, 1e-15);
    check_near("for what it takes alone", scalar(one, "wanted"), 3, 0);
    check_true("again", ff_instance_run(sum, NULL) == FF_OK);
    check_near("not once more", scalar(one, "evaluations"), 1, 0);
    check_true("another value", ff_instance_set(one, "level", "5 mm") == FF_OK &&
                                    ff_instance_run(sum, NULL) == FF_OK);
    check_near("is taken", scalar(sum, "sum"), 3 * 0.005, 1e-15);
    check_true("another source",
               ff_instance_use(sum, "source", two) == FF_OK && ff_instance_run(sum, NULL) == FF_OK);
    check_near("is used", scalar(sum, "sum"), 3 * 0.003, 1e-15);
    check_true("an array", ff_instance_give(sum, "more.series", &array) == FF_OK);
    more[0] = 100;
    check_true("lengths that differ",
               refuses(sum, ff_instance_run(sum, NULL), "more.series", "\"t\" is 3 long"));
    length = 3;
    check_true("of the length", ff_instance_give(sum, "more.series", &array) == FF_OK);
    more[1] = 100;
    check_true("runs", ff_instance_run(sum, NULL) == FF_OK);
    check_near("a copy", scalar(sum, "sum"), 105 + 3 * 0.003, 1e-15);
    check_true("the rank", refuses(sum, ff_instance_give(sum, "source.level", &array),
                                   "source.level", "1 dimensions"));
    check_true("a failure behind", ff_instance_set(two, "answer", "noconv") == FF_OK &&
                                       ff_instance_run(sum, NULL) == FF_NOCONV &&
                                       says("the answer is noconv"));
    ff_instance_close(two);
    ff_instance_close(one);
    ff_instance_close(sum);
}

static void warnings(void)
{
    ff_instance *law = open_model("toy/law"), *user = open_model("toy/replaced");
    ff_instance *one = open_source("2 mm"), *sum = open_model("toy/consumer");
    size_t length = 2;
    const ff_array two = {.data = (double[]){1, 2}, .shape = &length, .rank = 1};
    const void *table;
    ff_instance_set(law, "gain", "-3");
    check_true("of ready", ff_instance_service(law, TOY_LAW_ID, &table) == FF_DOMAIN && table);
    ff_instance_set(law, "gain", "-4");
    check_true("of a law", ff_instance_use(user, "law", law) == FF_OK &&
                               ff_instance_run(user, "gain") == FF_OK && says("a gain of -4"));
    ff_instance_set(law, "gain", "-20");
    check_true("no warning", ff_instance_run(user, "gain") == FF_NOCONV && says("a gain of -20"));
    ff_instance_set(one, "answer", "domain");
    check_true("of what feeds it", ff_instance_use(sum, "source", one) == FF_OK &&
                                       ff_instance_run(sum, NULL) == FF_OK &&
                                       strstr(ff_instance_reason(sum), "the answer is domain"));
    check_true("with an error",
               ff_instance_give(sum, "more.series", &two) == FF_OK &&
                   ff_instance_set(one, "level", "3 mm") == FF_OK &&
                   refuses(sum, ff_instance_run(sum, NULL), "more.series", "\"t\" is 3 long"));
    ff_instance_set(one, "answer", "nomem");
    check_true("a model without memory", ff_instance_run(one, "level") == FF_NOMEM);
    ff_instance_set(one, "answer", NULL);
    check_true("can go on", ff_instance_run(one, "level") == FF_OK);
    ff_instance_close(one);
    ff_instance_close(sum);
    ff_instance_close(user);
    ff_instance_close(law);
}

static void warned_then_refused(void)
{
    ff_instance *loop = open_model("loop/linear");
    size_t lengths[] = {2, 3};
    const double numbers[] = {1, 2, 3};
    const ff_array two = {.data = numbers, .shape = &lengths[0], .rank = 1};
    const ff_array three = {.data = numbers, .shape = &lengths[1], .rank = 1};
    ff_instance_set(loop, "base", "1 m");
    ff_instance_set(loop, "points", "0");
    check_true("ready warns", ff_instance_run(loop, "level") == FF_DOMAIN && says("no points"));
    ff_instance_give(loop, "before.series", &two);
    ff_instance_give(loop, "back.series", &three);
    check_true("an error is no warning",
               refuses(loop, ff_instance_run(loop, "level"), "back.series", "\"t\" is"));
    ff_instance_close(loop);
}

static void states(void)
{
    ff_instance *one = open_model("loop/linear"), *two = open_model("loop/linear");
    ff_instance_set(one, "base", "1 m");
    ff_instance_set(two, "base", "1 m");
    check_true("made, but not run",
               ff_instance_ready(one) == FF_OK && ff_instance_carry(two, one) == FF_UNSUPPORTED);
    check_true("run", ff_instance_run(one, NULL) == FF_OK && ff_instance_carry(two, one) == FF_OK);
    ff_instance_close(one);
    check_true("after its end", ff_instance_run(two, NULL) == FF_OK);
    check_near("from the state", scalar(two, "evaluations"), 101, 0);
    ff_instance_close(two);
}

static double twice(const void *self, double x)
{
    (void)self;
    return 2 * x;
}

static ff_status fail(void *ctx)
{
    return *(ff_status *)ctx;
}

static void services(void)
{
    static const toy_law own = {sizeof own, NULL, twice};
    ff_instance *law = open_model("toy/law"), *user = open_model("toy/replaced");
    const void *table;
    ff_status bug = FF_BUG, good = FF_OK;
    check_true("a law without its gain", ff_instance_service(law, TOY_LAW_ID, &table) < 0 &&
                                             !table && says("\"gain\" is missing"));
    ff_instance_set(law, "gain", "3");
    check_true("with it", ff_instance_service(law, TOY_LAW_ID, &table) == FF_OK);
    const toy_law *toy = table;
    check_near("the law", toy->eval(toy->self, 2), 6, 0);
    check_true("no such service", ff_instance_service(law, "toy.rule/1", &table) == FF_INVALID);
    check_true("neither", refuses(user, ff_instance_ready(user), "gain", "is missing"));
    ff_instance_use(user, "law", law);
    check_true("a wire in place of parameters", ff_instance_run(user, "gain absent") == FF_OK);
    check_near("gives the gain", scalar(user, "gain"), 3, 0);
    check_near("and all of them", scalar(user, "absent"), 4, 0);
    ff_instance *other = open_model("toy/law"); /* takes the memory of the law that ends */
    ff_instance_set(other, "gain", "9");
    ff_instance_set(law, "gain", "4");
    ff_instance_ready(other);
    check_true("another law", ff_instance_run(user, "gain") == FF_OK);
    check_near("reaches its user", scalar(user, "gain"), 4, 0);
    ff_instance_set(user, "gain", "1");
    check_true("both", refuses(user, ff_instance_run(user, "gain"), "gain", "gives it, too"));
    ff_instance_set(user, "gain", NULL);
    check_true("a table of the caller", ff_instance_serve(user, "law", &own) == FF_OK &&
                                            ff_instance_run(user, "gain") == FF_OK);
    check_near("is used", scalar(user, "gain"), 2, 0);
    check_true("a call", ff_instance_call(law, "its test", fail, &good) == FF_OK);
    check_true("that fails",
               ff_instance_call(law, "its test", fail, &bug) == FF_BUG && says("during its test"));
    ff_instance_close(other);
    ff_instance_close(law);
    ff_instance_close(user);
}

static int32_t stop(void *ctx, const ff_stage *stage, double fraction)
{
    *(double *)ctx = fraction;
    return !strcmp(ff_stage_name(stage), "source");
}

static void watched(void)
{
    double share = 0;
    const ff_observer observer = {.size = sizeof observer, .ctx = &share, .progress = stop};
    ff_instance *s = open_source("2 mm");
    ff_instance_set(s, "answer", "progress");
    ff_instance_observe(s, &observer);
    check_true("stopped", ff_instance_run(s, "level") == FF_STOPPED);
    check_near("at half", share, 0.5, 0);
    ff_instance_observe(s, NULL);
    check_true("and not", ff_instance_run(s, "level") == FF_OK);
    check_true("no state", ff_instance_carry(s, s) == FF_UNSUPPORTED);
    ff_instance_close(s);
}

static void nothing_given(ff_instance *s)
{
    const ff_result *result;
    const ff_quality *line;
    const void *table;
    ff_instance *made;
    int32_t verdict;
    check_true("no engine", ff_instance_new(NULL, "toy/source", &made) == FF_INVALID && !made);
    check_true("no id", ff_instance_new(engine, NULL, &made) == FF_INVALID && !made);
    check_true("no place for it", ff_instance_new(engine, "toy/source", NULL) == FF_INVALID);
    check_true("no name", refuses(s, ff_instance_set(s, NULL, "2 mm"), "", "NULL: param") &&
                              refuses(s, ff_instance_set_reals(s, NULL, NULL, 0), "", "NULL") &&
                              refuses(s, ff_instance_give(s, NULL, NULL), "", "NULL: input") &&
                              refuses(s, ff_instance_use(s, NULL, NULL), "", "NULL: wire") &&
                              refuses(s, ff_instance_serve(s, NULL, NULL), "", "NULL: wire"));
    check_true("no output", refuses(s, ff_instance_result(s, NULL, &result), "", "NULL: output"));
    check_true("no result", refuses(s, ff_instance_result(s, "level", NULL), "", "NULL: result"));
    check_true("no interface",
               refuses(s, ff_instance_service(s, NULL, &table), "", "NULL: interface"));
    check_true("no work", refuses(s, ff_instance_call(s, "work", NULL, NULL), "", "NULL: work"));
    check_true("no state", refuses(s, ff_instance_carry(s, NULL), "", "NULL: from"));
    check_true("no instance", ff_instance_set(NULL, "level", "2 mm") == FF_INVALID &&
                                  ff_instance_set_reals(NULL, "level", NULL, 0) == FF_INVALID &&
                                  ff_instance_give(NULL, "level", NULL) == FF_INVALID &&
                                  ff_instance_use(NULL, "source", s) == FF_INVALID &&
                                  ff_instance_serve(NULL, "law", NULL) == FF_INVALID &&
                                  ff_instance_ready(NULL) == FF_INVALID &&
                                  ff_instance_run(NULL, NULL) == FF_INVALID &&
                                  ff_instance_result(NULL, "level", &result) == FF_INVALID &&
                                  !result && ff_instance_verdict(NULL, &verdict) == FF_INVALID &&
                                  ff_instance_quality(NULL, 0, &line) == FF_INVALID &&
                                  ff_instance_service(NULL, "law", &table) == FF_INVALID &&
                                  ff_instance_carry(NULL, s) == FF_INVALID &&
                                  ff_instance_observe(NULL, NULL) == FF_INVALID &&
                                  !*ff_instance_reason(NULL) && !*ff_instance_item(NULL));
}

static void wrong_arguments(const ff_engine_options *options)
{
    static const double number = 1;
    const size_t huge[] = {(size_t)1 << 62, 4, 4, 4};
    ff_engine *other;
    ff_instance *stranger = NULL, *s = open_source("2 mm"), *sum = open_model("toy/consumer");
    nothing_given(s);
    ff_array array = {.data = &number, .shape = huge, .rank = 1};
    check_true("too many numbers", refuses(sum, ff_instance_give(sum, "more.series", &array),
                                           "more.series", "an impossible number of elements"));
    array.shape = NULL;
    check_true("no shape", refuses(sum, ff_instance_give(sum, "more.series", &array), "more.series",
                                   "an impossible number of elements"));
    check_true("another engine", ff_engine_new(options, &other) == FF_OK &&
                                     ff_instance_new(other, "toy/source", &stranger) == FF_OK);
    check_true("does not feed", refuses(sum, ff_instance_use(sum, "source", stranger), "source",
                                        "belongs to another engine"));
    check_true("hands on nothing",
               refuses(s, ff_instance_carry(s, stranger), "", "belongs to another engine"));
    ff_instance_close(stranger);
    ff_engine_close(other);
    check_true("all is as it was",
               ff_instance_use(sum, "source", s) == FF_OK && ff_instance_run(sum, NULL) == FF_OK);
    ff_instance_close(sum);
    ff_instance_close(s);
    check_true("no engine to be made", ff_engine_new(options, NULL) == FF_INVALID);
    check_true("which says nothing", !*ff_engine_message(NULL));
}

int main(void)
{
    const char *toys = getenv("FLANKFILM_TEST_BAD");
    const ff_engine_options options = {sizeof options, &toys, 1};
    ff_instance *none;
    check_true("an engine", toys && ff_engine_new(&options, &engine) == FF_OK);
    check_true("no such model", ff_instance_new(engine, "toy/sorce", &none) == FF_INVALID &&
                                    !none && says("toy/source"));
    parameters();
    outputs();
    missing_outputs();
    wires();
    warnings();
    warned_then_refused();
    states();
    services();
    watched();
    wrong_arguments(&options);
    ff_engine_close(engine);
    return check_done();
}
