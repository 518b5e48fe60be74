/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters: what the file says, what the preset is, which layer wins. */
#include "pipeline-try.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char source[] = "pipeline:\n"
                             "  a:\n"
                             "    use: toy/source\n"
                             "    level: 2 mm\n";

/* The stage `a` with one more line. */
static attempt with_line(const char *line)
{
    char text[512];
    snprintf(text, sizeof text, "%s    %s\n", source, line);
    return try_build(text, false);
}

static void presets(void)
{
    attempt a = try_build(source, false);
    check_good("a model with its presets", &a);
    check_true("real preset", try_param(&a, "a", "share")->value.real == 0.5);
    check_true("choice preset", !strcmp(try_param(&a, "a", "mode")->value.text, "even"));
    check_true("switch preset", try_param(&a, "a", "on")->value.integer == 1);
    check_true("list preset", try_param(&a, "a", "weights")->value.count == 2 &&
                                  try_param(&a, "a", "weights")->value.reals[1] == 2);
    check_true("word preset", !strcmp(try_param(&a, "a", "steps")->value.text, "auto"));
    check_true("a preset is marked as such", !try_param(&a, "a", "share")->value.given &&
                                                 !try_param(&a, "a", "share")->place.source);
    check_true("no preset, no value", !try_param(&a, "a", "note")->present);
    check_true("given in its unit", try_param(&a, "a", "level")->value.real == 2e-3 &&
                                        try_param(&a, "a", "level")->value.given == 1 &&
                                        try_param(&a, "a", "level")->place.line == 5);
    try_close(&a);
}

static double value_of(const char *line, const char *param)
{
    attempt a = with_line(line);
    const ff_bound *bound = try_param(&a, "a", param);
    check_good(line, &a);
    double value = !bound || !bound->present      ? NAN
                   : bound->row->type == FF_REALS ? bound->value.reals[bound->value.count - 1]
                   : bound->row->type == FF_REAL  ? bound->value.real
                                                  : (double)bound->value.integer;
    try_close(&a);
    return value;
}

static void types(void)
{
    check_true("real at its limit", value_of("share: 1", "share") == 1);
    check_true("integer", value_of("count: 12", "count") == 12);
    check_true("choice", value_of("mode: odd", "mode") == 1);
    check_true("switch", value_of("on: false", "on") == 0);
    check_true("word beside an integer", value_of("steps: few", "steps") == 1);
    check_true("integer beside a word", value_of("steps: 7", "steps") == 7);
    check_true("list", value_of("weights: [1 kg, 2000 g]", "weights") == 2);
    check_true("one number as a list", value_of("weights: 3 kg", "weights") == 3);
    check_near("nested map", value_of("range: {from: 20 degC}", "range.from"), 293.15, 1e-12);
    check_true("keys of the user's own", value_of("x-mine: {any: [thing]}", "share") == 0.5);
    check_true("a file", value_of("table: /dev/../etc/hostname", "count") == 3);
}

/* A scalar of toy/placed, whose outputs are what the members of its instance hold. */
static double member_of(const char *line, const char *output)
{
    char text[256];
    snprintf(text, sizeof text, "pipeline: {a: {use: toy/placed, %s}}\n", line);
    attempt a = try_run(text);
    check_good(line, &a);
    double value = try_scalar(&a, "a", output);
    try_close(&a);
    return value;
}

static void places(void)
{
    static const char *const absent[] = {"real", "integer", "on",   "choice",
                                         "text", "file",    "rate", NULL};
    for (size_t i = 0; absent[i]; i++)
        check_true("not given", member_of("plain: 3", absent[i]) == -1);
    check_true("no list", member_of("plain: 3", "list") == 0);
    check_true("set for what has no place, after the places", member_of("on: true", "sets") == 1);
    check_true("a length in SI", member_of("real: 2 mm", "real") == 2e-3);
    check_true("a word beside a number", member_of("real: auto", "real") == -1);
    check_true("an integer", member_of("integer: 7", "integer") == 7);
    check_true("a word beside an integer", member_of("integer: many", "integer") == -1);
    check_true("a switch", member_of("on: true", "on") == 1 && member_of("on: false", "on") == 0);
    check_true("a choice", member_of("choice: odd", "choice") == 1);
    check_true("a text", member_of("text: four", "text") == 4);
    check_true("a file", member_of("file: /etc/hostname", "file") == 13);
    check_true("a list", member_of("list: [1 kg, 500 g]", "list") == 2 &&
                             member_of("list: [1 kg, 500 g]", "sum") == 1.5);
    check_near("preset of a group", member_of("plain: 3", "speed"), 10 * 2 * M_PI / 60, 1e-12);
    check_true("another member of the group",
               member_of("rate: 5 Hz", "speed") == -1 && member_of("rate: 5 Hz", "rate") == 5);
    check_true("what the user wrote", member_of("rate: 5 Hz, on: true", "given") == 2);
    attempt a = try_build("pipeline: {a: {use: toy/placed, real: 101 mm}}\n", false);
    check_error("limits hold", &a, 0, 0, "is too large; it must be at most 100 mm");
    try_close(&a);
    a = try_build("pipeline: {a: {use: faulty/place-null}}\n", false);
    check_error("no instance", &a, 0, 0, "gave no instance to take its parameters");
    try_close(&a);
}

/* The stage `r` of toy/replaced, with the parameters, beside the other lines. */
static attempt replaced(const char *params, const char *others)
{
    char text[512];
    snprintf(text, sizeof text, "pipeline:\n%s  r: {use: toy/replaced, %s}\noutputs: [r.*]\n",
             others, params);
    return try_run(text);
}

/* Rows and descriptors that are longer or shorter than those of this version. */
static void other_versions(void)
{
    attempt a = try_run("pipeline:\n"
                        "  a: {use: toy/strides, first: 10 m}\n"
                        "  b: {use: toy/short, second: 20 m}\n");
    check_good("rows of another length", &a);
    check_true("longer", try_scalar(&a, "a", "sum") == 12);
    check_true("shorter", try_scalar(&a, "b", "sum") == 21);
    check_true("what they lack is not there", !try_param(&a, "b", "first")->row->place &&
                                                  !try_param(&a, "b", "first")->row->instead);
    try_close(&a);
}

static void replaced_by_a_wire(void)
{
    static const char law[] = "  l: {use: toy/law, gain: 5}\n";
    attempt a = replaced("gain: 3, far: 1 m", "");
    check_good("a parameter without the wire", &a);
    check_true("its preset applies",
               try_scalar(&a, "r", "gain") == 3 && try_scalar(&a, "r", "absent") == 1);
    try_close(&a);
    a = replaced("law: l", law);
    check_good("the wire without the parameter", &a);
    check_true("no preset applies",
               try_scalar(&a, "r", "gain") == 5 && try_scalar(&a, "r", "absent") == 4);
    check_true("the wire is named", try_param(&a, "r", "gain")->wire == try_stage(&a, "r")->wires);
    try_close(&a);
    a = replaced("law: l, gain: 3", law);
    check_error("both: at the parameter", &a, 4, 40,
                "gives this value, too, by the wire \"law\" (case.yaml:4:31)");
    check_error("both: what to do", &a, 4, 40, "or leave the wire unconnected: law: none");
    try_close(&a);
    a = replaced("far: 1 m", law);
    check_error("both: wired by itself", &a, 4, 31, "by the wire \"law\" (case.yaml:3:3)");
    try_close(&a);
    a = replaced("law: none, gain: 3, far: 1 m", law);
    check_good("the wire left unconnected", &a);
    try_close(&a);
    a = replaced("far: 1 m", "");
    check_error("neither", &a, 3, 3, "\"gain\" or the wire \"law\" is missing: what the law says");
    check_error("neither: what to write", &a, 3, 3, "gain: a number, or law: STAGE");
    try_close(&a);
    static const char level[] = "  s: {use: toy/source, level: 2 mm}\n";
    a = replaced("gain: 3, far: 1 m, source: s", level);
    check_good("a data input in place of a preset", &a);
    check_near("feeds the stage", try_scalar(&a, "r", "gain"), 3.002, 1e-12);
    check_true("the preset is gone", !try_param(&a, "r", "offset")->present);
    try_close(&a);
    a = replaced("gain: 3, far: 1 m, source: s, offset: 1 mm", level);
    check_error("a data input beside the parameter", &a, 4, 64,
                "gives this value, too, by the wire \"source\" (case.yaml:4:53)");
    try_close(&a);
    a = replaced("gain: 3", "");
    check_error("neither of a group", &a, 3, 3,
                "one of \"near\", \"far\" must be given, or the wire");
    try_close(&a);
}

static void groups(void)
{
    check_near("preset of a group", value_of("count: 3", "speed"), 10 * 2 * M_PI / 60, 1e-12);
    check_true("a member that is given drops the preset", isnan(value_of("rate: 5 Hz", "speed")));
    attempt a = with_line("rate: 5 Hz\n    speed: 6 rpm");
    check_error("two of a group", &a, 7, 12,
                "only one of \"rate\" (case.yaml:6:11) and \"speed\" (case.yaml:7:12) may");
    try_close(&a);
    a = try_build_set("pipeline:\n  a: {use: toy/source, level: 2 mm, rate: 5 Hz}\n",
                      "a.speed=7 rpm", false);
    check_good("--set on one member of a group replaces the other", &a);
    check_true("and that one is gone",
               !try_param(&a, "a", "rate")->present && try_param(&a, "a", "speed")->present);
    try_close(&a);
}

static void layers(void)
{
    static const char text[] = "pipeline:\n"
                               "  a:\n"
                               "    use: toy/source\n"
                               "    level: 2 mm\n"
                               "    with:\n"
                               "      toy/source: {level: 3 mm, share: 0.25}\n"
                               "      toy/law: {gain: 2}\n"
                               "      nobody/here: {any: 1}\n";
    attempt a = try_build(text, false);
    check_good("sets of other models, one of them unknown", &a);
    check_true("the stage's own key wins", try_param(&a, "a", "level")->value.real == 2e-3);
    check_true("the set's key applies", try_param(&a, "a", "share")->value.real == 0.25);
    try_close(&a);
    a = try_build_set(text, "a.with.toy/source.level=4 mm", false);
    check_true("a later layer wins over the stage's own key",
               try_param(&a, "a", "level")->value.real == 4e-3);
    try_close(&a);
    a = try_build(text, true);
    check_error("in a check the unknown model is an error", &a, 9, 7, "nobody/here");
    check_true("the only one", ff_report_errors(a.report) == 1);
    try_close(&a);
}

static void swaps(void)
{
    static const char text[] = "pipeline:\n"
                               "  a:\n"
                               "    use: toy/law\n"
                               "    with: {toy/law: {gain: 2}, toy/source: {level: 1 mm}}\n"
                               "  b: {use: toy/user, law: a}\n";
    attempt a = try_build(text, true);
    check_good("a stage with sets for two models", &a);
    try_close(&a);
    a = try_build_set(text, "a.use=toy/source", false);
    check_error("the other model does not fit the wire", &a, 6, 27,
                "does not offer the service toy.law/1");
    try_close(&a);
}

static void calibration(void)
{
    attempt a = with_line("share: 0.1");
    check_true("no warning inside", ff_report_count(a.report) == 0);
    try_close(&a);
    a = try_build("pipeline:\n  a: {use: toy/source, level: 60 mm}\n", false);
    check_good("outside the calibrated range", &a);
    check_true("a warning at the value",
               try_says(&a, FF_WARNING, 3, 31,
                        "a.level: 60 mm is outside the calibrated range, which ends at 50 mm"));
    try_close(&a);
}

static void files(void)
{
    char directory[64], path[128];
    snprintf(directory, sizeof directory, "/tmp/flankfilm-bind-%d", (int)getpid());
    if (mkdir(directory, 0700) != 0)
        exit(2);
    snprintf(path, sizeof path, "%s/data.csv", directory);
    FILE *file = fopen(path, "w");
    if (!file || fclose(file) != 0)
        exit(2);
    const char *const places[] = {try_plugins()};
    attempt a = {.report = ff_report_new(), .engine = try_engine(places, 1)};
    a.tree = fe_tree_parse("case.yaml", directory,
                           "format: 2\npipeline:\n"
                           "  a: {use: toy/source, level: 1 mm, table: data.csv}\n",
                           a.report);
    a.pipeline = fe_pipeline_build(a.tree, a.engine, false, a.report);
    check_good("a file beside the text that names it", &a);
    check_true("its path is resolved", !strcmp(try_param(&a, "a", "table")->value.text, path));
    try_close(&a);
    remove(path);
    remove(directory);
}

int main(void)
{
    presets();
    types();
    groups();
    places();
    replaced_by_a_wire();
    other_versions();
    layers();
    swaps();
    calibration();
    files();
    return check_done();
}
