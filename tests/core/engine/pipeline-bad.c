/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Malformed files: the right message at the right line and column. */
#include "pipeline-try.h"

#include <stdio.h>
#include <string.h>

/* Line 1 is "format: 2". */
static const struct {
    const char *text;
    unsigned line, column;
    const char *phrase;
} cases[] = {
    {"pipline: {}\n", 2, 1, "unknown key \"pipline\"; did you mean \"pipeline\"?"},
    {"title: [a]\n", 2, 8, "title: expected a text, found a list"},
    {"title: x\n", 1, 1, "the file has no \"pipeline\""},
    {"pipeline: [a]\n", 2, 11, "expected a map from names to stages, found a list"},
    {"pipeline:\n", 2, 10, "expected a map from names to stages, found nothing"},
    {"pipeline: {}\n", 2, 11, "pipeline: it has no stages"},
    {"pipeline: {a b: {use: toy/law}}\n", 2, 12, "\"a b\" is not a stage name"},
    {"pipeline: {none: {use: toy/law}}\n", 2, 12, "cannot be called \"none\""},
    {"pipeline: {a: toy/law}\n", 2, 15, "expected a map that says which model it uses"},
    {"pipeline: {a: {gain: 1}}\n", 2, 12, "does not say which model it uses"},
    {"pipeline: {law: {use: toy/law}, x: {gain: 1}}\n", 2, 33, "name one of the stages law"},
    {"pipeline: {law.gain: 1}\n", 2, 12, "in a file, write law: {gain: ...}"},
    {"pipeline: {law: {use: toy/law, gian 1}}\n", 2, 32, "a key ends with a colon and a blank"},
    {"pipeline: {law: {use: toy/law}, lwa: {gain: 1}}\n", 2, 33, "uses; did you mean \"law\"?"},
    {"pipeline: {a: {use: [toy/law]}}\n", 2, 21, "a.use: expected a model such as KIND/MODEL"},
    {"pipeline: {a: {use: toy/lav}}\n", 2, 21, "did you mean \"toy/law\"?"},
    {"pipeline: {a: {use: ../../x}}\n", 2, 21, "does not name a model"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, levl: 2}\n", 3, 37,
     "a: unknown key \"levl\"; did you mean \"level\"?"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, zzzzzz: 2}\n", 3, 37,
     "unknown key \"zzzzzz\" for toy/source"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, range: {form: 2 degC}}\n", 3, 45,
     "unknown key \"range.form\"; did you mean \"range.from\"?"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, range: 3}\n", 3, 44,
     "a.range: expected a map, found a value"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, range.from: 2 degC}\n", 3, 37,
     "write the dot as a nested map: range: {from: ...}"},
    {"pipeline:\n  a: {use: toy/source}\n", 3, 3, "\"level\" is missing: value of all outputs"},
    {"pipeline:\n  a: {use: toy/source, level: [1 mm]}\n", 3, 31,
     "expected a number with a unit such as \"3 mm\", found a list"},
    {"pipeline:\n  a: {use: toy/source, level: }\n", 3, 31, "found nothing"},
    {"pipeline:\n  a: {use: toy/source, level: 3}\n", 3, 31, "a.level: \"3\" has no unit"},
    {"pipeline:\n  a: {use: toy/source, level: 3 kg}\n", 3, 31, "a.level: \"3 kg\" is"},
    {"pipeline:\n  a: {use: toy/source, level: .nan}\n", 3, 31, "a.level: \".nan\""},
    {"pipeline:\n  a: {use: toy/source, level: 0 mm}\n", 3, 31,
     "a.level: 0 mm is too small; it must be above 0 mm"},
    {"pipeline:\n  a: {use: toy/source, level: 1 m}\n", 3, 31,
     "a.level: 1000 mm is too large; it must be at most 100 mm"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, count: 2.5}\n", 3, 44,
     "a.count: \"2.5\" is not a whole number"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, mode: evn}\n", 3, 43,
     "did you mean \"even\"?"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, on: yes}\n", 3, 41,
     "a.on: expected true or false, found \"yes\""},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, steps: atuo}\n", 3, 44,
     "expected a whole number or \"auto\", \"few\", found \"atuo\""},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, note: {a: b}}\n", 3, 43,
     "a.note: expected a text, found a map"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, weights: []}\n", 3, 46,
     "a.weights: expected 1 to 3 numbers, found 0"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, weights: [1 kg, 2]}\n", 3, 53,
     "a.weights: \"2\" has no unit"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, weights: [2 kg, 1 kg]}\n", 3, 53,
     "the numbers must not decrease"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, weights: {x: 1 kg}}\n", 3, 46,
     "expected a list of numbers with units such as [3 kg, 4 kg], found a map"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, table: no.csv}\n", 3, 44,
     "the file \"./no.csv\" cannot be read: No such file or directory"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, table: /tmp}\n", 3, 44,
     "it is not a regular file"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, with: [x]}\n", 3, 43,
     "a.with: expected a map from models to their parameters, found a list"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, with: {toy/law: 3}}\n", 3, 53,
     "a.with.toy/law: expected a map of parameters, found a value"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, with: {toy/law: {gian: 3}}}\n", 3, 54,
     "a: unknown key \"gian\"; did you mean \"gain\"?"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, with: {toy/law: {}}}\n", 3, 3,
     "a (toy/law): \"gain\" is missing"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm, gain: 2, with: {toy/law: {gain: 3}}}\n", 3, 37,
     "toy/law has \"gain\": write it under \"with\""},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm}\noutputs: {a: b}\n", 4, 10,
     "outputs: expected a list"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm}\noutputs: []\n", 4, 10,
     "outputs: the list is empty"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm}\noutputs: [a]\n", 4, 11,
     "\"a\" is a stage; write a.OUTPUT"},
    {"pipeline:\n  abc: {use: toy/source, level: 1 mm}\noutputs: [acb.level]\n", 4, 11,
     "there is no stage \"acb\"; did you mean \"abc\"?"},
    {"pipeline:\n  a: {use: toy/source, level: 1 mm}\noutputs: [a.level, a.serie]\n", 4, 20,
     "has no output \"serie\"; did you mean \"series\"?"},
    {"pipeline:\n  a: {use: toy/law, gain: 1}\noutputs: [a.law]\n", 4, 11,
     "is a service for other stages"},
    {"pipeline:\n  a: {use: toy/law, gain: 1}\noutputs: [a.*]\n", 4, 11,
     "has no scalars and no series"},
    {"pipeline:\n  a: {use: toy/law, gain: 1}\noutputs: [[a.law]]\n", 4, 11,
     "expected STAGE.OUTPUT or STAGE.*, found a list"},
    {"pipeline:\n  a: {use: toy/law, gain: 1}\n  a: {use: toy/law, gain: 1}\n", 4, 3, "\"a\""},
    {"pipeline:\n  a: {use: toy/law, gain: 1\n", 3, 6, "is not closed"},
};

static void format(const char *text, unsigned line, unsigned column, const char *phrase)
{
    attempt a = {.report = ff_report_new(), .engine = try_engine(NULL, 0)};
    a.tree = fe_tree_parse("case.yaml", ".", text, a.report);
    a.pipeline = fe_pipeline_build(a.tree, a.engine, true, a.report);
    check_error(phrase, &a, line, column, phrase);
    try_close(&a);
}

static void all_in_one_pass(void)
{
    attempt a = try_build("titel: x\n"
                          "pipeline:\n"
                          "  a: {use: toy/source, level: 3, count: x, shar: 1}\n"
                          "  b: {use: toy/lav}\n"
                          "  c: {use: toy/user, law: d}\n"
                          "outputs: [a.leve]\n",
                          true);
    check_true("seven errors of one file at once", ff_report_errors(a.report) == 7);
    check_true("exit code 2", ff_report_fault(a.report) == FF_FAULT_INPUT);
    if (ff_report_errors(a.report) != 7)
        try_print(&a);
    try_close(&a);
}

int main(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        attempt a = try_build(cases[i].text, true);
        check_error(cases[i].phrase, &a, cases[i].line, cases[i].column, cases[i].phrase);
        check_true("exit code 2", ff_report_fault(a.report) == FF_FAULT_INPUT);
        try_close(&a);
    }
    format("pipeline: {a: {use: toy/law}}\n", 1, 1, "the file does not state its format");
    format("format: 1\npipeline: {a: {use: toy/law}}\n", 1, 9,
           "format: expected 2, the only format");
    format("format: [1]\npipeline: {a: {use: toy/law}}\n", 1, 9, "expected 2, found a list");
    all_in_one_pass();
    return check_done();
}
