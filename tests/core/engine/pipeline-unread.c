/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a file says in vain is named, what it says twice is refused, and a swap of a stage's model
   keeps what both models have. */
#include "pipeline-try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void check_warning(const char *what, const attempt *a, unsigned line, unsigned column,
                          const char *phrase)
{
    check_good(what, a);
    check_true(what, try_says(a, FF_WARNING, line, column, phrase));
    check_true("and nothing else", ff_report_count(a->report) == 1);
}

static attempt with_outputs(const char *stages, const char *outputs)
{
    char text[640];
    snprintf(text, sizeof text, "pipeline:\n%soutputs: [%s]\n", stages, outputs);
    return try_build(text, false);
}

static void parameters(void)
{
    static const char p[] = "  p: {use: toy/frugal, form: 1, finish: 2}\n";
    attempt a = with_outputs(p, "p.shape, p.shade");
    check_true("both are read", ff_report_count(a.report) == 0);
    try_close(&a);
    a = with_outputs(p, "p.shape");
    check_warning("one serves another output alone", &a, 3, 41,
                  "p.finish changes nothing: no requested output depends on \"shade\" of p");
    try_close(&a);
    a = with_outputs("  p: {use: toy/frugal, form: 1, step: 3, fixed: true}\n", "p.shape");
    check_warning("settings that shut it out", &a, 3, 39, "p.step changes nothing: fixed is on");
    try_close(&a);
    a = with_outputs("  p: {use: toy/frugal, form: 1, fixed: true}\n", "p.shape");
    check_true("a preset is not the user's", ff_report_count(a.report) == 0);
    try_close(&a);
    a = with_outputs("  p: {use: toy/frugal, wrong: true}\n", "p.shape");
    check_error("a model that names what it does not have", &a, 3, 12,
                "stated what \"finnish\" serves, but has no such item");
    try_close(&a);
}

static void columns(void)
{
    static const char p[] = "  p: {use: toy/frugal, table: /dev/../etc/hostname, fixed: true}\n";
    attempt a = with_outputs(p, "p.shape");
    check_warning("a column of a table", &a, 3, 31, "p.table.depth changes nothing: fixed is on");
    try_close(&a);
}

static void through_stages(void)
{
    attempt a = with_outputs("  p: {use: toy/frugal, form: 1, finish: 2}\n"
                             "  q: {use: toy/frugal, before: p}\n",
                             "q.shape");
    check_warning("what is read behind it does not count either", &a, 3, 41,
                  "p.finish changes nothing: no requested output depends on \"shade\" of p");
    try_close(&a);
    a = with_outputs("  p: {use: toy/frugal, form: 1, finish: 2}\n"
                     "  q: {use: toy/frugal, before: p, finish: 3}\n",
                     "q.shade, q.shape");
    check_error("the same value twice", &a, 3, 41,
                "p.finish and q.finish (case.yaml:4:43) give the same value twice");
    try_close(&a);
    a = with_outputs("  p: {use: toy/frugal, form: 1}\n"
                     "  q: {use: toy/frugal, before: p, finish: 3}\n",
                     "q.shade, q.shape");
    check_true("in one of them", ff_report_count(a.report) == 0);
    try_close(&a);
    a = with_outputs("  p: {use: toy/frugal, form: 1}\n"
                     "  q: {use: toy/frugal, before: p, finish: 3}\n",
                     "q.shade");
    check_warning("a stage of which nothing counts", &a, 3, 3,
                  "p: no requested output depends on this stage: q: finish is given");
    try_close(&a);
}

static void idle_stages(void)
{
    static const char text[] = "pipeline:\n"
                               "  a: {use: toy/source, level: 1 mm}\n"
                               "  b: {use: toy/source, level: 2 mm}\n"
                               "outputs: [a.level]\n";
    attempt a = try_build(text, false);
    check_warning("a stage that does not run", &a, 5, 10, "b (case.yaml:4:3)");
    try_close(&a);
    a = try_build_set(text, "b.share=0.1", false);
    check_warning("an assignment to it", &a, 1, 9,
                  "b.share changes nothing: the stage \"b\" does not run");
    try_close(&a);
}

static void swaps(void)
{
    static const char text[] = "pipeline:\n"
                               "  a: {use: toy/source, level: 2 mm, range: {to: 3 degC}, note: x}\n"
                               "outputs: [\"a.*\"]\n";
    attempt a = try_build_set(text, "a.use=toy/frugal", false);
    check_warning(
        "what the new model cannot take is named", &a, 1, 7,
        "toy/frugal cannot take values that are written for toy/source (case.yaml:3:12), so they "
        "are left out: \"level\" (case.yaml:3:24), \"range\" (case.yaml:3:37), \"note\"");
    try_close(&a);
    a = try_build_set("pipeline:\n  a: {use: toy/source, level: 2 mm, notte: x}\n",
                      "a.use=toy/frugal", false);
    check_error("a mistake stays one", &a, 3, 37, "unknown key \"notte\"");
    check_true("the only one", ff_report_errors(a.report) == 1);
    try_close(&a);
    a = try_build("pipeline:\n  a: {use: toy/frugal, level: 2 mm}\n", false);
    check_error("without a swap", &a, 3, 24, "unknown key \"level\"");
    try_close(&a);
    a = try_build_set(text, "a={use: toy/frugal, level: 3 mm}", false);
    check_error("written with the new model", &a, 1, 21, "unknown key \"level\"");
    try_close(&a);
    a = try_build_set("pipeline:\n  a: {use: toy/frugal, form: 1, step: 2}\n  b: {use: toy/source, "
                      "level: 1 mm}\n",
                      "b.use=toy/frugal", false);
    check_true("the other stage is left alone", ff_report_errors(a.report) == 0);
    try_close(&a);
}

static void empty_values(void)
{
    static const char text[] =
        "pipeline:\n  a: {use: toy/source, level: 2 mm, note: x, share: 1}\n";
    attempt a = try_build_set(text, "a.note=", false);
    check_good("an empty value takes one away", &a);
    check_true("so that it is not there", !try_param(&a, "a", "note")->present);
    try_close(&a);
    a = try_build_set(text, "a.share=", false);
    check_true("and the preset holds", try_param(&a, "a", "share")->value.real == 0.5);
    try_close(&a);
    a = try_build_set(text, "a.level=", false);
    check_error("what is needed is missed", &a, 3, 3, "\"level\" is missing");
    try_close(&a);
    a = try_build_set(text, "a.count=", false);
    check_error("nothing there to take", &a, 0, 0, "found nothing");
    try_close(&a);
}

static void offers(void)
{
    static const char text[] = "pipeline:\n"
                               "  a:\n"
                               "    use: toy/frugal\n"
                               "    with:\n"
                               "      toy/source: {level: 3 mm, shere: 0.25, count: 3 mm}\n"
                               "      toy/sourze: {level: 3 mm}\n"
                               "      nobody/here: {any: 1}\n";
    attempt a = try_build(text, false);
    check_error("a mistake in a set that is not in use", &a, 6, 33, "did you mean \"share\"?");
    check_error("a wrong value there", &a, 6, 53, "a.count");
    check_true("a model that is misspelt",
               try_says(&a, FF_WARNING, 7, 7, "did you mean \"toy/source\"?"));
    check_true("one that is not installed is named",
               try_says(&a, FF_WARNING, 8, 7, "there is no model \"nobody/here\""));
    try_close(&a);
}

/* A text that includes card.yaml, in a directory of its own. */
static attempt with_card(const char *card, const char *text)
{
    char directory[64], path[128];
    snprintf(directory, sizeof directory, "/tmp/flankfilm-unread-%d", (int)getpid());
    snprintf(path, sizeof path, "%s/card.yaml", directory);
    FILE *file = mkdir(directory, 0700) == 0 ? fopen(path, "w") : NULL;
    if (!file || fputs(card, file) < 0 || fclose(file) != 0)
        exit(2);
    const char *const places[] = {try_plugins()};
    attempt a = {.report = ff_report_new(), .engine = try_engine(places, 1)};
    a.tree = fe_tree_parse("case.yaml", directory, text, a.report);
    a.pipeline = fe_pipeline_build(a.tree, a.engine, false, a.report);
    remove(path);
    remove(directory);
    return a;
}

static void cards(void)
{
    static const char card[] = "pipeline:\n  a: {use: toy/source, level: 1 mm, rate: 5 Hz}\n";
    attempt a = with_card(card, "format: 2\ninclude: card.yaml\npipeline: {a: {speed: 6 rpm}}\n");
    check_error("two of a group in two files", &a, 3, 23, "only one of \"rate\" (");
    check_error("with both places", &a, 3, 23, "card.yaml:2:43) and \"speed\" (case.yaml:3:23)");
    check_error("and what to do", &a, 3, 23, "removes that of an included file: rate:");
    try_close(&a);
    a = with_card(card, "format: 2\ninclude: card.yaml\npipeline: {a: {speed: 6 rpm, rate: }}\n");
    check_good("taken away", &a);
    check_true("the one of the file holds", try_param(&a, "a", "speed")->value.given == 1);
    try_close(&a);
    a = with_card("pipeline:\n  b: {use: toy/source, level: 1 mm}\n",
                  "format: 2\ninclude: card.yaml\n"
                  "pipeline: {a: {use: toy/source, level: 1 mm}}\noutputs: [a.level]\n");
    check_true("a stage of a card may stay unused", ff_report_count(a.report) == 0);
    try_close(&a);
    static const char fed[] = "format: 2\ninclude: card.yaml\n"
                              "pipeline: {q: {use: toy/frugal, before: p, finish: 3}}\n"
                              "outputs: [q.shade]\n";
    a = with_card("pipeline: {p: {use: toy/frugal, form: 1}}\n", fed);
    check_true("and one that runs may serve nothing", ff_report_count(a.report) == 0);
    try_close(&a);
    a = with_card("pipeline: {p: {use: toy/frugal, form: 1, finish: 2}}\noutputs: [p.shade]\n",
                  "format: 2\ninclude: card.yaml\noutputs: [p.shape]\n");
    check_true("a value served the outputs of its file", ff_report_count(a.report) == 0);
    try_close(&a);
    a = with_card("pipeline: {p: {use: toy/frugal, form: 1}}\n",
                  "format: 2\ninclude: card.yaml\npipeline: {p: {finish: 2}}\n"
                  "outputs: [p.shape]\n");
    check_warning("one beside the outputs does not", &a, 3, 24, "p.finish changes nothing");
    try_close(&a);
}

static void names(void)
{
    attempt a = try_build("pipeline:\n  feedback: {use: toy/source, level: 1 mm}\n", false);
    check_error("a stage named like a key of the file", &a, 3, 3,
                "a stage cannot be called \"feedback\"");
    try_close(&a);
    a = try_build("pipeline:\n  s: {use: toys/source, level: 1 mm}\n  c: {use: toy/consumer}\n",
                  false);
    check_error("a kind that there is not", &a, 3, 12, "did you mean \"toy/source\"?");
    check_true("says all", ff_report_errors(a.report) == 1);
    try_close(&a);
    a = try_build("pipelin:\n  a: {use: toy/source, level: 1 mm}\noutputs: [a.level]\n", false);
    check_error("the stages under a misspelt key", &a, 2, 1, "did you mean \"pipeline\"?");
    check_true("that is all", ff_report_errors(a.report) == 1);
    try_close(&a);
    a = try_build("pipeline:\n  a: {use: toy/source, level: 1 mm}\noutputs: [b.level, b.field]\n",
                  false);
    check_error("a stage that is not there", &a, 4, 11, "there is no stage \"b\"");
    check_true("once", ff_report_errors(a.report) == 1);
    try_close(&a);
}

int main(void)
{
    parameters();
    columns();
    through_stages();
    idle_stages();
    swaps();
    empty_values();
    offers();
    cards();
    names();
    return check_done();
}
