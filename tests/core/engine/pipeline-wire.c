/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires, what is needed, and what is loaded. */
#include "pipeline-try.h"

#include <flankfilm/history.h>
#include <math.h>
#include <string.h>

static int feeder(const attempt *a, const char *of, const char *wire)
{
    const ff_stage *s = try_stage(a, of);
    for (size_t i = 0; s && i < s->wire_count; i++)
        if (!strcmp(s->wires[i].name, wire))
            return s->wires[i].stage;
    return -2;
}

static void automatic(void)
{
    attempt a = try_build("pipeline:\n"
                          "  sum: {use: toy/consumer}\n"
                          "  one: {use: toy/source, level: 1 mm}\n"
                          "  pass: {use: toy/relay, before: one}\n",
                          false);
    check_good("one stage offers what a wire asks for", &a);
    check_true("it is wired", feeder(&a, "sum", "source") == 1);
    check_true("and marked as automatic", try_stage(&a, "sum")->wires[0].automatic);
    check_true("an optional wire of a kind that is absent", feeder(&a, "sum", "more") == -1);
    check_true("a wire of several rows is one", try_stage(&a, "sum")->wire_count == 2);
    check_true("a written wire",
               feeder(&a, "pass", "before") == 1 && !try_stage(&a, "pass")->wires[0].automatic);
    check_true("order: each after what it needs", a.pipeline->order[0] == 1);
    try_close(&a);
}

static void ambiguous(void)
{
    static const char text[] = "pipeline:\n"
                               "  one: {use: toy/source, level: 1 mm}\n"
                               "  two: {use: toy/source, level: 1 mm}\n"
                               "  sum: {use: toy/consumer}\n";
    attempt a = try_build(text, false);
    check_error("several can feed a wire", &a, 5, 3,
                "several stages can feed its wire \"source\": one, two");
    check_error("one line to write", &a, 5, 3, "add the line \"source: one\" to sum");
    try_close(&a);
    a = try_build_set(text, "sum.source=two", false);
    check_good("and it is good when written", &a);
    check_true("as written", feeder(&a, "sum", "source") == 1);
    try_close(&a);
}

static void absent(void)
{
    attempt a = try_build("pipeline:\n  sum: {use: toy/consumer}\n", false);
    check_error("none can feed a wire", &a, 3, 3,
                "nothing feeds its wire \"source\" (level, series): no stage is of the kind "
                "toy|faulty");
    check_error("what is installed of the kind", &a, 3, 3, "models of that kind: ");
    try_close(&a);
    a = try_build("pipeline:\n  sum: {use: toy/consumer}\n  l: {use: toy/law, gain: 1}\n", false);
    check_error("one of the kind that does not fit", &a, 3, 3,
                "the stage \"l\" (toy/law) does not offer \"level\"");
    try_close(&a);
}

static void lazy(void)
{
    static const char text[] = "pipeline:\n"
                               "  one: {use: toy/source, level: 1 mm}\n"
                               "  pass: {use: toy/relay, before: one}\n"
                               "  unused: {use: faulty/crash-load}\n"
                               "outputs: [pass.level]\n";
    attempt a = try_build(text, false);
    check_good("a stage that is not needed is not loaded", &a);
    check_true("not loaded", !try_stage(&a, "unused")->loaded);
    check_true("not needed",
               !try_stage(&a, "unused")->needed &&
                   !strcmp(try_stage(&a, "unused")->why, "no requested output needs it"));
    check_true("why one runs", !strcmp(try_stage(&a, "one")->why, "feeds pass"));
    check_true("why pass runs", !strcmp(try_stage(&a, "pass")->why, "pass.level is requested"));
    check_true("only what is fed is wanted",
               try_result(&a, "one", "level")->wanted && !try_result(&a, "one", "series")->wanted);
    check_true("the file asked for it", try_result(&a, "pass", "level")->requested &&
                                            !try_result(&a, "one", "level")->requested);
    try_close(&a);
}

static void cycles(void)
{
    attempt a = try_build("pipeline:\n"
                          "  a: {use: toy/relay, before: b}\n"
                          "  b: {use: toy/relay, before: c}\n"
                          "  c: {use: toy/relay, before: a}\n",
                          true);
    check_error("a circle of stages", &a, 5, 31, "need each other: a -> b -> c -> a");
    try_close(&a);
    a = try_build("pipeline:\n  a: {use: toy/relay, before: a}\n", true);
    check_error("a stage that feeds itself", &a, 3, 31, "need each other: a -> a");
    try_close(&a);
}

static void mismatches(void)
{
    static const char head[] = "pipeline:\n  one: {use: toy/source, level: 1 mm}\n"
                               "  pass: {use: toy/relay, before: one}\n";
    char text[512];
    strcat(strcpy(text, head), "  sum: {use: toy/consumer, source: pass}\n");
    attempt a = try_build(text, true);
    check_error("another unit", &a, 5, 36, "(toy/relay) gives \"series\" in \"s\", not in \"m\"");
    try_close(&a);
    strcat(strcpy(text, head), "  sum: {use: toy/consumer, source: pasd}\n");
    a = try_build(text, true);
    check_error("a stage that is not there", &a, 5, 36,
                "no stage \"pasd\"; did you mean \"pass\"?");
    try_close(&a);
    strcat(strcpy(text, head), "  sum: {use: toy/consumer, source: none}\n");
    a = try_build(text, true);
    check_error("none for a wire that is needed", &a, 5, 36, "\"none\" is not possible");
    try_close(&a);
    strcat(strcpy(text, head), "  sum: {use: toy/consumer, source: one, more: none}\n");
    a = try_build(text, true);
    check_good("none for an optional wire", &a);
    try_close(&a);
    strcat(strcpy(text, head), "  sum: {use: toy/consumer, source: {use: toy/source}}\n");
    a = try_build(text, true);
    check_error("a map for a wire", &a, 5, 36, "expected the name of a stage, found a map");
    try_close(&a);
}

#define HISTORIES                                                                                  \
    "pipeline:\n"                                                                                  \
    "  a: {use: toy/histories, count: 5}\n"                                                        \
    "  b: {use: toy/histories, count: 3, from: 1 s}\n"                                             \
    "  c: {use: toy/along, one: a}\n"                                                              \
    "  d: {use: toy/along, one: c}\n"

/* Names of dimensions belong to a wire. */
static void lengths(void)
{
    attempt a = try_run(HISTORIES "  s: {use: toy/apart, one: b, two: a}\noutputs: [s.series]\n");
    check_good("two wires of different lengths", &a);
    const ff_result *sampled = try_result(&a, "s", "series");
    check_true("one at the instants of the other",
               sampled->data && sampled->count == 3 && sampled->data[0] == 1 &&
                   sampled->data[1] == 4 && sampled->data[2] == 9);
    check_true("the result names its dimension without the wire",
               sampled->data && !strcmp(sampled->dims[0], "t"));
    try_close(&a);
    a = try_build(HISTORIES "  s: {use: toy/together, one: a, two: b}\noutputs: [s.series]\n",
                  false);
    check_error("lengths that are made apart", &a, 7, 39,
                "s.two.t is fed along \"t\" of the stage \"b\", but toy/together requires \"t\" of "
                "the stage \"a\"");
    try_close(&a);
    a = try_run(HISTORIES "  s: {use: toy/together, one: a, two: d}\noutputs: [s.series]\n");
    check_good("made in one stage, handed on by two", &a);
    try_close(&a);
    a = try_build(HISTORIES "  s: {use: toy/together, one: b, two: d}\noutputs: [s.series]\n",
                  false);
    check_error("made in another stage", &a, 7, 39, "along \"t\" of the stage \"a\"");
    try_close(&a);
    a = try_run(HISTORIES "  e: {use: toy/along, one: a, more: 2}\noutputs: [e.series]\n");
    check_error("not as long as the row says", &a, 0, 0,
                "the dimension \"t\" is 5 long in \"one.t\", but 7 in \"t\"");
    try_close(&a);
}

/* The value at instant `i` of `at`, or NaN. */
static double history_at(size_t n, const double *t, const double *y, size_t m, const double *at,
                         size_t i)
{
    double out[8];
    return ff_history_at(n, t, y, m, at, out) < 0 ? NAN : out[i];
}

static void histories(void)
{
    static const double t[] = {0, 0.1, 0.3, 0.3, 0.7}, y[] = {1, 1.0 / 3, 5, 7, 9},
                        at[] = {0.1, 0.2, 0.3, 0.3, 0.5, 0.7}, once[] = {0.3}, far[] = {-1, 2},
                        falls[] = {1, 0}, missing[] = {NAN};
    double out[8];
    check_true("within", ff_history_at(5, t, y, 6, at, out) == FF_OK);
    check_true("shared instants to the last bit",
               out[0] == y[1] && out[2] == 5 && out[3] == 7 && out[5] == 9);
    check_true("linear between",
               fabs(out[1] - 8.0 / 3) < 1e-15 * 8 && fabs(out[4] - 8) < 1e-15 * 8);
    check_true("at its own instants it is itself",
               ff_history_at(5, t, y, 5, t, out) == FF_OK && !memcmp(out, y, sizeof y));
    check_true("one instant at a jump is after it", history_at(5, t, y, 1, once, 0) == 7);
    check_true("outside: the end, and said so",
               ff_history_at(5, t, y, 2, far, out) == FF_DOMAIN && out[0] == 1 && out[1] == 9);
    check_true("nothing of nothing", ff_history_at(0, t, y, 0, at, out) == FF_OK);
    check_true("something of nothing", ff_history_at(0, t, y, 1, at, out) == FF_INVALID);
    check_true("instants that fall", ff_history_at(5, t, y, 2, falls, out) == FF_INVALID &&
                                         ff_history_at(2, falls, y, 1, at, out) == FF_INVALID);
    check_true("an instant that is none",
               ff_history_at(5, t, y, 1, missing, out) == FF_INVALID &&
                   ff_history_at(1, missing, y, 1, at, out) == FF_INVALID);
}

static void requests(void)
{
    attempt a = try_build("pipeline:\n"
                          "  one: {use: toy/source, level: 1 mm}\n"
                          "  law: {use: toy/law, gain: 2}\n"
                          "  sum: {use: toy/consumer, source: one}\n",
                          false);
    check_good("no list of outputs", &a);
    check_true("the last stage's scalars are asked for",
               try_result(&a, "sum", "sum")->requested > 0);
    check_true("not those of one that feeds it", !try_result(&a, "one", "level")->requested);
    check_true("a law that nobody uses is not needed", !try_stage(&a, "law")->needed);
    check_true("why", !strcmp(try_stage(&a, "sum")->why, "feeds no other stage"));
    try_close(&a);
    a = try_build("pipeline: {one: {use: toy/source, level: 1 mm}}\noutputs: [one.*]\n", false);
    check_true("a star: scalars and series, no field",
               try_result(&a, "one", "series")->requested &&
                   try_result(&a, "one", "rare")->requested &&
                   !try_result(&a, "one", "field")->requested);
    try_close(&a);
}

int main(void)
{
    automatic();
    ambiguous();
    absent();
    lazy();
    cycles();
    mismatches();
    lengths();
    histories();
    requests();
    return check_done();
}
