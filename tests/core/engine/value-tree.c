/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Trees: places, aliases, merge keys, includes, layers, and assignments. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "../../../core/engine/value/tree.h"
#include "value-check.h"

static ff_report *report;
static fe_tree *tree;
static char folder[64];

static void set_up(void)
{
    report = ff_report_new();
    int used = snprintf(folder, sizeof folder - 7, "/tmp/flankfilm-tree-");
    memset(folder + used, 'X', 6);
    folder[used + 6] = '\0';
    ck_assert_ptr_nonnull(mkdtemp(folder));
}

static void tear_down(void)
{
    char command[100];
    fe_tree_free(tree);
    ff_report_free(report);
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    ck_assert_int_eq(system(command), 0);
}

static const char *path_of(const char *name)
{
    static char path[200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void write_file(const char *name, const char *text)
{
    FILE *file = fopen(path_of(name), "w");
    ck_assert_ptr_nonnull(file);
    fputs(text, file);
    fclose(file);
}

static void parse(const char *text)
{
    tree = fe_tree_parse("test.yaml", folder, text, report);
}

static void load(const char *name)
{
    tree = fe_tree_load(path_of(name), report);
}

/* The node at "a.b.0". */
static const ff_node *find(const char *path)
{
    const ff_node *node = fe_tree_root(tree);
    char copy[200], *rest = NULL;
    snprintf(copy, sizeof copy, "%s", path);
    for (char *word = strtok_r(copy, ".", &rest); word && node; word = strtok_r(NULL, ".", &rest)) {
        if (node->kind == FF_MAP) {
            node = ff_node_get(node, word);
            continue;
        }
        size_t index = strtoul(word, NULL, 10);
        node = index < node->count ? node->items[index] : NULL;
    }
    return node;
}

static void check_text(const char *path, const char *text)
{
    const ff_node *node = find(path);
    ck_assert_msg(node != NULL, "there is no %s", path);
    ck_assert_int_eq(node->kind, FF_SCALAR);
    ck_assert_str_eq(node->text, text);
}

static void check_place(ff_place place, uint32_t line, uint32_t column, uint32_t width)
{
    ck_assert_uint_eq(place.line, line);
    ck_assert_uint_eq(place.column, column);
    ck_assert_uint_eq(place.width, width);
}

static void check_no_errors(void)
{
    if (ff_report_errors(report) > 0)
        fputs(ff_report_text(report, false), stderr);
    ck_assert_uint_eq(ff_report_errors(report), 0);
}

/* The first message holds the words. */
static void check_error(const char *words)
{
    ck_assert_uint_ge(ff_report_errors(report), 1);
    const char *text = ff_report_at(report, 0)->text;
    ck_assert_msg(strstr(text, words) != NULL, "%s", text);
    ck_assert_int_eq(ff_report_fault(report), FF_FAULT_INPUT);
}

START_TEST(scalars_stay_text)
{
    parse("a: 3 mm\nb: 1e-9\nc: \"010\"\nd: no\ne:\nf: 'x y'\ng: 12:30\nh: |\n  two\n  lines\n");
    check_no_errors();
    check_text("a", "3 mm");
    check_text("b", "1e-9");
    check_text("c", "010");
    check_text("d", "no");
    check_text("e", "");
    check_text("g", "12:30");
    check_text("h", "two\nlines\n");
    ck_assert(find("c")->quoted);
    ck_assert(find("f")->quoted);
    ck_assert(!find("a")->quoted);
}
END_TEST

/* Texts that YAML could take for something else, or would trim, are printed so that they come back.
 */
START_TEST(places_count_characters_from_one)
{
    parse("größe: äöü\nb: {c: [1, 22]}\n");
    check_no_errors();
    check_place(find("größe")->place, 1, 8, 3);
    check_place(fe_tree_root(tree)->key_places[0], 1, 1, 5);
    check_place(find("b")->place, 2, 4, 0);
    check_place(find("b.c")->place, 2, 8, 0);
    check_place(find("b.c.1")->place, 2, 12, 2);
    check_place(find("b")->key_places[0], 2, 5, 1);
}
END_TEST

START_TEST(any_line_break_counts)
{
    parse("a: 1\r\nb: 2\rc: 3\nd: [}\n");
    ck_assert_ptr_null(fe_tree_root(tree));
    ck_assert_uint_eq(ff_report_at(report, 0)->place.line, 4);
}
END_TEST

START_TEST(byte_order_mark_is_no_column)
{
    parse("\xEF\xBB\xBF"
          "a: 1\n");
    check_no_errors();
    check_place(find("a")->place, 1, 4, 1);
}
END_TEST

START_TEST(alias_is_a_copy)
{
    parse("study: &a {x: [1, 2]}\noutputs: *a\npipeline: {}\n");
    check_no_errors();
    ck_assert(fe_tree_set(tree, "outputs.x.0=9", NULL, NULL, report));
    check_text("outputs.x.0", "9");
    check_text("study.x.0", "1");
    check_place(find("outputs.x.1")->place, 1, 19, 1);
}
END_TEST

START_TEST(latest_anchor_counts)
{
    parse("a: &n 1\nb: *n\nc: &n 2\nd: *n\n");
    check_no_errors();
    check_text("b", "1");
    check_text("d", "2");
}
END_TEST

START_TEST(merge_key_gives_way_to_own_keys)
{
    parse("one: &one {a: 1, b: 1}\ntwo: &two {b: 2, c: 2, d: 2}\n"
          "x:\n  d: own\n  <<: [*one, *two]\ny:\n  <<: *one\n  a: own\n");
    check_no_errors();
    check_text("x.a", "1");
    check_text("x.b", "1");
    check_text("x.c", "2");
    check_text("x.d", "own");
    check_text("y.a", "own");
    check_text("y.b", "1");
    ck_assert_ptr_null(find("x.<<"));
}
END_TEST

START_TEST(quoted_merge_key_is_a_key)
{
    parse("\"<<\": 3\n");
    check_no_errors();
    check_text("<<", "3");
}
END_TEST

START_TEST(all_errors_in_one_pass)
{
    parse("a: 1\na: 2\nb: !t 3\nc: *none\nd: {e: 1, e: 2}\n");
    ck_assert_uint_eq(ff_report_errors(report), 4);
    ck_assert_ptr_nonnull(fe_tree_root(tree));
    check_text("a", "1");
    for (size_t i = 0; i < 4; i++)
        ck_assert_uint_eq(ff_report_at(report, i)->place.line, i + 2);
}
END_TEST

START_TEST(errors_before_a_broken_line_are_kept)
{
    parse("a: 1\na: 2\nb: [1\nc: 2\n");
    ck_assert_uint_eq(ff_report_errors(report), 2);
    ck_assert_ptr_null(fe_tree_root(tree));
}
END_TEST

START_TEST(includes_lie_under_the_file)
{
    write_file("base.yaml", "oil: {eta0: 5 cP, b: 3}\nteeth: [1, 2, 3]\nonly: base\n");
    write_file("card.yaml", "oil: {eta0: 6 cP, c: 4}\nswap: {a: 1}\n");
    write_file("main.yaml", "include: [base.yaml, card.yaml]\noil: {b: 7}\nteeth: [9]\nswap: 5\n");
    load("main.yaml");
    check_no_errors();
    check_text("oil.eta0", "6 cP");
    check_text("oil.b", "7");
    check_text("oil.c", "4");
    check_text("only", "base");
    check_text("swap", "5");
    ck_assert_uint_eq(find("teeth")->count, 1);
    ck_assert_ptr_null(find("include"));
    ck_assert_uint_lt(find("only")->rank, find("oil.eta0")->rank);
    ck_assert_uint_lt(find("oil.eta0")->rank, find("oil.b")->rank);
    ck_assert(fe_tree_set(tree, "oil.c=1", NULL, NULL, report));
    ck_assert_uint_lt(find("oil.b")->rank, find("pipeline.oil.c")->rank);
}
END_TEST

START_TEST(includes_lie_beside_the_file_that_names_them)
{
    char place[200];
    ck_assert_int_eq(mkdir(path_of("cards"), 0700), 0);
    write_file("cards/inner.yaml", "a: inner\n");
    write_file("cards/outer.yaml", "include: inner.yaml\nb: outer\n");
    write_file("main.yaml", "include: [cards/outer.yaml]\n");
    load("main.yaml");
    check_no_errors();
    check_text("a", "inner");
    snprintf(place, sizeof place, "%s/cards", folder);
    ck_assert_str_eq(find("a")->place.source->directory, place);
    snprintf(place, sizeof place, "%s/cards/inner.yaml", folder);
    ck_assert_str_eq(find("a")->place.source->name, place);
}
END_TEST

START_TEST(same_file_may_be_included_twice)
{
    write_file("card.yaml", "a: 1\n");
    write_file("one.yaml", "include: [card.yaml]\n");
    write_file("main.yaml", "include: [one.yaml, card.yaml]\n");
    load("main.yaml");
    check_no_errors();
    check_text("a", "1");
}
END_TEST

START_TEST(circle_of_includes_is_refused)
{
    write_file("one.yaml", "include: [two.yaml]\n");
    write_file("two.yaml", "a: 1\ninclude: [one.yaml]\n");
    load("one.yaml");
    check_error("includes itself by way of");
    ck_assert_uint_eq(ff_report_at(report, 0)->place.line, 2);
    ck_assert_uint_eq(ff_report_at(report, 0)->place.column, 11);
    ck_assert_ptr_null(fe_tree_root(tree));
}
END_TEST

START_TEST(every_lost_include_is_reported)
{
    write_file("bad.yaml", "a: [1\n");
    write_file("main.yaml", "include: [none.yaml, bad.yaml, ., also-none.yaml]\nb: 1\nb: 2\n");
    load("main.yaml");
    ck_assert_uint_eq(ff_report_errors(report), 5);
    ck_assert_ptr_null(fe_tree_root(tree));
}
END_TEST

/* A file that is not there was mistyped: the nearest name of its folder. */
START_TEST(lost_files_have_a_nearest_name)
{
    write_file("gears.yaml", "a: 1\n");
    write_file("main.yaml", "include: [gear.yaml]\n");
    load("main.yaml");
    ck_assert_str_eq(ff_report_at(report, 0)->hint, "did you mean \"gears.yaml\"?");
    fe_tree_free(tree);
    load("mian.yaml");
    ck_assert_str_eq(ff_report_at(report, 1)->hint, "did you mean \"main.yaml\"?");
    fe_tree_free(tree);
    load("else.yaml");
    ck_assert_ptr_null(ff_report_at(report, 2)->hint);
}
END_TEST

START_TEST(includes_have_a_depth)
{
    for (int i = 0; i < 20; i++) {
        char name[32], text[64];
        snprintf(name, sizeof name, "f%d.yaml", i);
        snprintf(text, sizeof text, "include: [f%d.yaml]\na%d: 1\n", i + 1, i);
        write_file(name, text);
    }
    load("f0.yaml");
    check_error("more than 16 levels deep");
    ck_assert_uint_eq(ff_report_errors(report), 1);
}
END_TEST

START_TEST(includes_have_a_number)
{
    FILE *file = fopen(path_of("main.yaml"), "w");
    fputs("include:\n", file);
    for (int i = 0; i < 70; i++)
        fputs("  - card.yaml\n", file);
    fclose(file);
    write_file("card.yaml", "a: 1\n");
    load("main.yaml");
    check_error("more than 64 files");
}
END_TEST

START_TEST(unreadable_files_are_named)
{
    static const char *const rows[][2] = {{"none.yaml", "No such file or directory"},
                                          {"", "it is a directory"},
                                          {"pipe", "it is not a regular file"},
                                          {"main.yaml/x", "Not a directory"}};
    write_file("main.yaml", "a: 1\n");
    ck_assert_int_eq(mkfifo(path_of("pipe"), 0600), 0);
    for (size_t i = 0; i < ROWS(rows); i++) {
        ff_report *one = ff_report_new();
        fe_tree *none = fe_tree_load(path_of(rows[i][0]), one);
        ck_assert_ptr_null(fe_tree_root(none));
        ck_assert_uint_eq(ff_report_errors(one), 1);
        ck_assert_msg(strstr(ff_report_at(one, 0)->text, rows[i][1]) &&
                          strstr(ff_report_at(one, 0)->text, folder),
                      "%s", ff_report_at(one, 0)->text);
        fe_tree_free(none);
        ff_report_free(one);
    }
}
END_TEST

START_TEST(file_without_permission_is_named)
{
    write_file("main.yaml", "a: 1\n");
    ck_assert_int_eq(chmod(path_of("main.yaml"), 0), 0);
    load("main.yaml");
    if (geteuid() == 0) /* root reads everything */
        check_no_errors();
    else
        check_error("Permission denied");
}
END_TEST

static const char two_stages[] =
    "format: 2\npipeline:\n  duty: {use: operating/steady, torque: 250 "
    "N m}\n  gears: {teeth: [50, 50]}\noutputs: [film.h_min, x]\n";

START_TEST(assignment_replaces_a_value)
{
    parse(two_stages);
    ck_assert(fe_tree_set(tree, "duty.torque=300 N m", NULL, NULL, report));
    check_text("pipeline.duty.torque", "300 N m");
    check_text("pipeline.duty.use", "operating/steady");
    check_no_errors();
}
END_TEST

START_TEST(assignment_starts_at_the_top_for_top_words)
{
    parse(two_stages);
    ck_assert(fe_tree_set(tree, "pipeline.duty.torque=1 N m", NULL, NULL, report));
    ck_assert(fe_tree_set(tree, "title=a: b", NULL, NULL, report));
    ck_assert(fe_tree_set(tree, "outputs=[film.p_max]", NULL, NULL, report));
    check_text("pipeline.duty.torque", "1 N m");
    check_text("title.a", "b");
    ck_assert_uint_eq(find("outputs")->count, 1);
}
END_TEST

START_TEST(assignment_reaches_into_lists)
{
    parse(two_stages);
    ck_assert(fe_tree_set(tree, "gears.teeth.1=25", NULL, NULL, report));
    ck_assert(fe_tree_set(tree, "outputs.0=film.p_max", NULL, NULL, report));
    check_text("pipeline.gears.teeth.0", "50");
    check_text("pipeline.gears.teeth.1", "25");
    check_text("outputs.0", "film.p_max");
}
END_TEST

START_TEST(assignment_follows_keys_with_dots)
{
    parse("format: 2\nstudy: {sweep: {duty.torque: {points: 2}}}\n");
    ck_assert(fe_tree_set(tree, "study.sweep.duty.torque.points=3", NULL, NULL, report));
    ck_assert(fe_tree_set(tree, "study.sweep.duty.torquem=1", NULL, NULL, report));
    const ff_node *sweep = find("study.sweep");
    ck_assert_uint_eq(sweep->count, 2);
    ck_assert_str_eq(ff_node_get(ff_node_get(sweep, "duty.torque"), "points")->text, "3");
    check_text("study.sweep.duty.torquem", "1");
}
END_TEST

START_TEST(assignment_makes_maps_on_the_way)
{
    parse("format: 2\n");
    ck_assert(fe_tree_set(tree, "oil.with.viscosity/barus.eta0=5 cP", NULL, NULL, report));
    check_text("pipeline.oil.with.viscosity/barus.eta0", "5 cP");
    ck_assert_uint_eq(find("pipeline.oil")->rank, 1);
}
END_TEST

START_TEST(assignment_of_a_map_merges)
{
    parse(two_stages);
    ck_assert(fe_tree_set(tree, "duty={torque: 1 N m, speed: 3 rpm}", NULL, NULL, report));
    check_text("pipeline.duty.use", "operating/steady");
    check_text("pipeline.duty.torque", "1 N m");
    check_text("pipeline.duty.speed", "3 rpm");
}
END_TEST

START_TEST(copy_changes_by_itself)
{
    parse(two_stages);
    ck_assert(fe_tree_set(tree, "duty.torque=5 N m", NULL, NULL, report));
    fe_tree *first = tree, *copy = fe_tree_copy(first);
    ck_assert(fe_tree_set(copy, "duty.torque=7 N m", NULL, NULL, report));
    ck_assert(fe_tree_set(copy, "duty.more=1", NULL, NULL, report));
    check_text("pipeline.duty.torque", "5 N m");
    ck_assert_ptr_null(ff_node_get(find("pipeline.duty"), "more"));
    tree = copy;
    check_text("pipeline.duty.torque", "7 N m");
    check_text("pipeline.duty.more", "1");
    const ff_node *torque = find("pipeline.duty.torque");
    ck_assert_str_eq(torque->replaced->text, "5 N m");
    ck_assert_uint_eq(torque->rank, torque->replaced->rank + 1);
    fe_tree_free(copy);
    tree = first;
}
END_TEST

START_TEST(assignment_may_be_empty_or_hold_equals)
{
    parse(two_stages);
    ck_assert(fe_tree_set(tree, "title=", NULL, NULL, report));
    check_text("title", "");
    ck_assert(fe_tree_set(tree, "title = a=b", NULL, NULL, report));
    check_text("title", "a=b");
}
END_TEST

START_TEST(assignment_places_point_into_it)
{
    parse(two_stages);
    ck_assert(fe_tree_set(tree, "düty.torque=\"3 N\"", NULL, NULL, report));
    const ff_node *node = find("pipeline.düty.torque");
    ck_assert_str_eq(node->place.source->name, "--set");
    ck_assert_str_eq(node->place.source->text, "düty.torque=\"3 N\"");
    check_place(node->place, 1, 13, 5);
    check_place(find("pipeline.düty")->key_places[0], 1, 6, 6);
}
END_TEST

static const struct {
    const char *assignment, *words;
    uint32_t column;
} bad_assignments[] = {
    {"duty.torque", "needs a \"=\"", 1},
    {"", "needs a \"=\"", 1},
    {"=3", "a word is missing", 1},
    {"duty..torque=3", "a word is missing", 6},
    {"duty.=3", "a word is missing", 6},
    {"duty.torque.x=3", "leads to a value, not to a map", 13},
    {"gears.teeth.2=3", "\"2\" is not an entry of this list, which has 2", 13},
    {"gears.teeth.-1=3", "\"-1\" is not an entry", 13},
    {"gears.teeth.first=3", "\"first\" is not an entry", 13},
    {"gears.teeth.99999999999999999999=3", "is not an entry", 13},
    {"duty.torque=[3", "is not closed", 13},
    {"duty={a: 1, a: 2}", "given twice", 13},
    {"duty.torque=!t 3", "tags are not used", 13},
    {"duty.torque=\xFF", "not UTF-8", 13},
    {"dut\xFF.torque=3", "not UTF-8", 4},
    {"include=[no-such-file.yaml]", "cannot read \"no-such-file.yaml\"", 10},
};

START_TEST(assignment_is_refused)
{
    parse(two_stages);
    const char *assignment = bad_assignments[_i].assignment;
    ck_assert(!fe_tree_set(tree, assignment, NULL, NULL, report));
    check_error(bad_assignments[_i].words);
    ck_assert_uint_eq(ff_report_at(report, 0)->place.column, bad_assignments[_i].column);
    ck_assert_str_eq(ff_report_at(report, 0)->place.source->name, "--set");
}
END_TEST

START_TEST(assignment_path_has_a_depth)
{
    char text[400] = "";
    for (int i = 0; i < 100; i++)
        strcat(text, "a.");
    strcat(text, "a=1");
    parse("format: 2\n");
    ck_assert(!fe_tree_set(tree, text, NULL, NULL, report));
    check_error("more than 64 levels deep");
}
END_TEST

START_TEST(assignment_to_a_broken_file_is_false)
{
    parse("a: [\n");
    ck_assert(!fe_tree_set(tree, "a=1", NULL, NULL, report));
    ck_assert_ptr_null(fe_tree_root(tree));
}
END_TEST

START_TEST(absent_things_are_null)
{
    parse("a: 1\n");
    ck_assert_ptr_null(ff_node_get(NULL, "a"));
    ck_assert_ptr_null(ff_node_get(fe_tree_root(tree), "b"));
    ck_assert_ptr_null(ff_node_get(find("a"), "b"));
    ck_assert_str_eq(fe_kind_name(FF_MAP), "a map");
    fe_tree_free(NULL);
    ff_report_free(NULL);
}
END_TEST

int main(void)
{
    static const TTest *const *const tests[] = {
        &scalars_stay_text,
        &places_count_characters_from_one,
        &any_line_break_counts,
        &byte_order_mark_is_no_column,
        &alias_is_a_copy,
        &latest_anchor_counts,
        &merge_key_gives_way_to_own_keys,
        &quoted_merge_key_is_a_key,
        &all_errors_in_one_pass,
        &errors_before_a_broken_line_are_kept,
        &includes_lie_under_the_file,
        &includes_lie_beside_the_file_that_names_them,
        &same_file_may_be_included_twice,
        &circle_of_includes_is_refused,
        &every_lost_include_is_reported,
        &lost_files_have_a_nearest_name,
        &includes_have_a_depth,
        &includes_have_a_number,
        &unreadable_files_are_named,
        &file_without_permission_is_named,
        &assignment_replaces_a_value,
        &assignment_starts_at_the_top_for_top_words,
        &assignment_reaches_into_lists,
        &assignment_follows_keys_with_dots,
        &assignment_makes_maps_on_the_way,
        &assignment_of_a_map_merges,
        &copy_changes_by_itself,
        &assignment_may_be_empty_or_hold_equals,
        &assignment_places_point_into_it,
        &assignment_path_has_a_depth,
        &assignment_to_a_broken_file_is_false,
        &absent_things_are_null,
    };
    Suite *suite = suite_create("tree");
    TCase *group = tcase_create("tree");
    tcase_add_checked_fixture(group, set_up, tear_down);
    for (size_t i = 0; i < ROWS(tests); i++)
        tcase_add_test(group, *tests[i]);
    tcase_add_loop_test(group, assignment_is_refused, 0, (int)ROWS(bad_assignments));
    suite_add_tcase(suite, group);
    return run_suite(suite);
}
