/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages: order, doubles, exit codes, and the picture with the caret. */
#include <flankfilm/engine.h>

#include <stdio.h>
#include <string.h>

#include "value-check.h"

static ff_report *report;
static char *printed;

static void set_up(void)
{
    report = ff_report_new();
}

static void tear_down(void)
{
    ff_report_free(report);
}

static const char *print(bool colour)
{
    ff_free(printed);
    return printed = ff_report_text(report, colour);
}

static ff_source source_of(const char *name, char *text)
{
    return (ff_source){.name = (char *)(size_t)name, .text = text, .length = strlen(text)};
}

static ff_place at(const ff_source *source, uint32_t line, uint32_t column, uint32_t width)
{
    return (ff_place){.source = source, .line = line, .column = column, .width = width};
}

START_TEST(prints_place_line_caret_and_hint)
{
    char text[] = "gear:\n  module: 3 furlong\n";
    ff_source source = source_of("gear.yaml", text);
    bool answer = ff_error(report, FF_FAULT_INPUT, at(&source, 2, 11, 9), "lengths are in mm",
                           "\"%s\" is not a length", "3 furlong");
    ck_assert(!answer);
    ck_assert_str_eq(print(false), "gear.yaml:2:11: error: \"3 furlong\" is not a length\n"
                                   "    2 |   module: 3 furlong\n"
                                   "      |           ^^^^^^^^^\n"
                                   "hint: lengths are in mm\n");
}
END_TEST

START_TEST(caret_counts_characters)
{
    char text[] = "räder: {größe: 3}\n";
    ff_source source = source_of("a", text);
    ff_error(report, FF_FAULT_INPUT, at(&source, 1, 9, 5), NULL, "no");
    ck_assert_ptr_nonnull(strstr(print(false), "    1 | räder: {größe: 3}\n"
                                               "      |         ^^^^^\n"));
}
END_TEST

START_TEST(caret_allows_for_wide_characters)
{
    char text[] = "title: 歯車 x\n";
    ff_source source = source_of("a", text);
    ff_error(report, FF_FAULT_INPUT, at(&source, 1, 11, 1), NULL, "no");
    ck_assert_ptr_nonnull(strstr(print(false), "      |             ^\n"));
}
END_TEST

START_TEST(underline_ends_with_the_line)
{
    char text[] = "abc\ndef\n";
    ff_source source = source_of("a", text);
    ff_error(report, FF_FAULT_INPUT, at(&source, 1, 2, 50), NULL, "no");
    ff_error(report, FF_FAULT_INPUT, at(&source, 2, 4, 0), NULL, "end");
    print(false);
    ck_assert_ptr_nonnull(strstr(printed, "    1 | abc\n      |  ^^\n"));
    ck_assert_ptr_nonnull(strstr(printed, "    2 | def\n      |    ^\n"));
}
END_TEST

START_TEST(place_beyond_the_text_does_no_harm)
{
    char text[] = "abc";
    ff_source source = source_of("a", text);
    ff_error(report, FF_FAULT_INPUT, at(&source, 99, 99, 9), NULL, "no");
    ck_assert_ptr_nonnull(strstr(print(false), "a:99:99: error: no\n"));
}
END_TEST

START_TEST(controls_do_not_reach_the_terminal)
{
    char text[] = "\tx: \033[31m\xE2\x80\xAE\xFFy\n";
    ff_source source = source_of("a\033", text);
    ff_error(report, FF_FAULT_INPUT, at(&source, 1, 2, 1), "b\nc", "d\033e");
    print(false);
    ck_assert_ptr_null(strchr(printed, '\033'));
    ck_assert_ptr_nonnull(
        strstr(printed, "a?:1:2: error: d?e\n    1 |  x: ?[31m??y\n      |  ^\n"));
    ck_assert_ptr_nonnull(strstr(printed, "hint: b c\n"));
}
END_TEST

START_TEST(long_line_is_shown_around_the_place)
{
    static char text[300001];
    memset(text, 'a', 300000);
    text[250000] = 'X';
    ff_source source = source_of("a", text);
    ff_error(report, FF_FAULT_INPUT, at(&source, 1, 250001, 1), NULL, "no");
    print(false);
    ck_assert_uint_lt(strlen(printed), 400);
    const char *line = strstr(printed, "    1 | "), *mark = strstr(printed, "      | ");
    ck_assert_int_eq(strchr(line, 'X') - line, strchr(mark, '^') - mark);
}
END_TEST

START_TEST(message_without_a_line_has_no_picture)
{
    char text[] = "";
    ff_source source = source_of("empty.yaml", text);
    ff_error(report, FF_FAULT_INPUT, (ff_place){.source = &source}, NULL, "nothing");
    ff_error(report, FF_FAULT_PLUGIN, FF_NOWHERE, NULL, "no plugins");
    ck_assert_str_eq(print(false), "empty.yaml: error: nothing\nerror: no plugins\n");
}
END_TEST

START_TEST(sorts_by_file_and_line)
{
    char text[] = "a\nb\nc\n";
    ff_source one = source_of("one", text), two = source_of("two", text);
    ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "last");
    ff_error(report, FF_FAULT_INPUT, at(&one, 3, 1, 1), NULL, "third");
    ff_error(report, FF_FAULT_INPUT, at(&two, 1, 1, 1), NULL, "fourth");
    ff_warn(report, at(&one, 2, 5, 1), "second");
    ff_error(report, FF_FAULT_INPUT, at(&one, 2, 1, 1), NULL, "first");
    print(false);
    static const char *const order[] = {"first", "second", "third", "fourth", "last"};
    const char *before = printed;
    for (size_t i = 0; i < ROWS(order); i++) {
        const char *found = strstr(printed, order[i]);
        ck_assert_msg(found && found >= before, "%s", order[i]);
        before = found;
    }
    ck_assert_ptr_nonnull(strstr(printed, "one:2:5: warning: second"));
}
END_TEST

START_TEST(equal_messages_are_kept_once)
{
    char text[] = "a\nb\n";
    ff_source source = source_of("a", text);
    for (uint32_t i = 0; i < 3; i++)
        ff_error(report, FF_FAULT_INPUT, at(&source, 1, 1, i), NULL, "no");
    ff_error(report, FF_FAULT_INPUT, at(&source, 2, 1, 1), NULL, "no");
    ff_warn(report, at(&source, 1, 1, 1), "no");
    ck_assert_uint_eq(ff_report_count(report), 3);
    ck_assert_uint_eq(ff_report_errors(report), 2);
    ck_assert_int_eq(ff_report_at(report, 2)->severity, FF_WARNING);
}
END_TEST

START_TEST(prints_twenty_errors_at_most)
{
    for (int i = 0; i < 30; i++)
        ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "number %d", i);
    print(false);
    ck_assert_ptr_nonnull(strstr(printed, "number 19\n"));
    ck_assert_ptr_null(strstr(printed, "number 20\n"));
    ck_assert_ptr_nonnull(strstr(printed, "... and 10 more errors\n"));
}
END_TEST

START_TEST(counts_errors_beyond_those_it_keeps)
{
    for (int i = 0; i < 5000; i++)
        ff_error(report, i == 4999 ? FF_FAULT_PLUGIN : FF_FAULT_INPUT, FF_NOWHERE, NULL, "no %d",
                 i);
    ck_assert_uint_eq(ff_report_errors(report), 5000);
    ck_assert_uint_eq(ff_report_count(report), 1000);
    ck_assert_int_eq(ff_report_fault(report), FF_FAULT_PLUGIN);
}
END_TEST

START_TEST(gravest_error_gives_the_exit_code)
{
    ck_assert_int_eq(ff_report_fault(report), FF_FAULT_NONE);
    ff_warn(report, FF_NOWHERE, "careful");
    ck_assert_int_eq(ff_report_fault(report), FF_FAULT_NONE);
    ff_error(report, FF_FAULT_RUN, FF_NOWHERE, NULL, "a");
    ck_assert_int_eq(ff_report_fault(report), FF_FAULT_RUN);
    ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "b");
    ck_assert_int_eq(ff_report_fault(report), FF_FAULT_INPUT);
    ff_error(report, FF_FAULT_PLUGIN, FF_NOWHERE, NULL, "c");
    ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "d");
    ck_assert_int_eq(ff_report_fault(report), FF_FAULT_PLUGIN);
}
END_TEST

START_TEST(colours_on_request_only)
{
    ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "no");
    ck_assert_ptr_null(strchr(print(false), '\033'));
    ck_assert_ptr_nonnull(strstr(print(true), "\033[1;31merror: \033[0m"));
}
END_TEST

START_TEST(finds_the_nearest_word)
{
    static const char *const keys[] = {"module", "teeth", "pressure_angle", "face_width", "rpm"};
    static const char *const rows[][2] = {
        {"modul", "module"},
        {"moduel", "module"},
        {"press", "pressure_angle"}, /* the rest was left out */
        {"rp", NULL},
        {"teeht", "teeth"},
        {"Teeth", "teeth"},
        {"pressure-angle", "pressure_angle"},
        {"presure_angel", "pressure_angle"},
        {"facewidth", "face_width"},
        {"RPM", "rpm"},
        {"FACE WIDTH", "face_width"},
        {"viscosity", NULL},
        {"x", NULL},
        {"", NULL},
    };
    for (size_t i = 0; i < ROWS(rows); i++) {
        const char *near = ff_nearest(rows[i][0], keys, ROWS(keys));
        ck_assert_msg((!near && !rows[i][1]) || (near && rows[i][1] && !strcmp(near, rows[i][1])),
                      "%s: %s", rows[i][0], near ? near : "none");
    }
    ck_assert_ptr_null(ff_nearest("a", NULL, 0));
    /* of words at one distance that which begins alike */
    static const char *const stages[] = {"oil", "film_static", "film"};
    ck_assert_str_eq(ff_nearest("fil", stages, 3), "film");
    ck_assert_str_eq(ff_nearest("film_s", stages, 3), "film_static");
    ck_assert_str_eq(ff_nearest("il", stages, 3) ? "near" : "none", "none");
    static const char *const outputs[] = {"h_min", "friction_coefficient", "friction_loss"};
    ck_assert_str_eq(ff_nearest("friction_coefficient_mean", outputs, 3), "friction_coefficient");
    ck_assert_ptr_null(ff_nearest("friction_coefficients_mean", outputs, 3));
}
END_TEST

int main(void)
{
    static const TTest *const *const tests[] = {
        &prints_place_line_caret_and_hint,
        &caret_counts_characters,
        &caret_allows_for_wide_characters,
        &underline_ends_with_the_line,
        &place_beyond_the_text_does_no_harm,
        &controls_do_not_reach_the_terminal,
        &long_line_is_shown_around_the_place,
        &message_without_a_line_has_no_picture,
        &sorts_by_file_and_line,
        &equal_messages_are_kept_once,
        &prints_twenty_errors_at_most,
        &counts_errors_beyond_those_it_keeps,
        &gravest_error_gives_the_exit_code,
        &colours_on_request_only,
        &finds_the_nearest_word,
    };
    Suite *suite = suite_create("report");
    TCase *group = tcase_create("report");
    tcase_add_checked_fixture(group, set_up, tear_down);
    for (size_t i = 0; i < ROWS(tests); i++)
        tcase_add_test(group, *tests[i]);
    suite_add_tcase(suite, group);
    return run_suite(suite);
}
