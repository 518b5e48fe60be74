/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hostile and broken texts: bounded time and memory, always a message, never a crash. */
#include <flankfilm/engine.h>

#include <stdio.h>
#include <string.h>
#include <time.h>

#include "../../../core/engine/value/tree.h"
#include "value-check.h"

enum { MEBIBYTE = 1 << 20 };

static char *text;
static size_t used;

static void set_up(void)
{
    text = calloc(1, 2 * MEBIBYTE);
    used = 0;
}

static void tear_down(void)
{
    free(text);
}

static void put(const char *piece)
{
    size_t n = strlen(piece);
    ck_assert_uint_lt(used + n, 2 * MEBIBYTE);
    memcpy(text + used, piece, n);
    used += n;
}

static void put_times(const char *piece, int count)
{
    for (int i = 0; i < count; i++)
        put(piece);
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Reads the text within `limit` seconds of this processor; the first message holds the words. */
static void check_refused(const char *words, double limit)
{
    double start = seconds();
    ff_report *report = ff_report_new();
    fe_tree *tree = fe_tree_parse("bound.yaml", NULL, text, report);
    double took = seconds() - start;
    ck_assert_uint_ge(ff_report_errors(report), 1);
    ck_assert_msg(strstr(ff_report_at(report, 0)->text, words), "%s",
                  ff_report_at(report, 0)->text);
    ck_assert_msg(took < limit, "%g s", took);
    fe_tree_free(tree);
    ff_report_free(report);
}

static void check_accepted(void)
{
    ff_report *report = ff_report_new();
    fe_tree *tree = fe_tree_parse("bound.yaml", NULL, text, report);
    ck_assert_msg(ff_report_errors(report) == 0, "%s", ff_report_at(report, 0)->text);
    ck_assert_ptr_nonnull(fe_tree_root(tree));
    fe_tree_free(tree);
    ff_report_free(report);
}

START_TEST(fifty_thousand_brackets)
{
    put("a: ");
    put_times("[", 50000);
    check_refused("more than 64 levels", 0.1);
}
END_TEST

START_TEST(fifty_thousand_braces)
{
    put_times("{a: ", 50000);
    check_refused("more than 64 levels", 0.1);
}
END_TEST

START_TEST(fifty_thousand_question_marks)
{
    put_times("? ", 50000);
    put("a\n");
    check_refused("cannot be a key", 5);
}
END_TEST

START_TEST(fifty_thousand_dashes)
{
    put_times("- ", 50000);
    put("a\n");
    check_refused("more than 64 levels", 1);
}
END_TEST

START_TEST(sixty_four_levels_are_read)
{
    put("a: ");
    put_times("[", 63);
    put_times("]", 63);
    check_accepted();
}
END_TEST

START_TEST(sixty_five_levels_are_not)
{
    put("a: ");
    put_times("[", 64);
    put_times("]", 64);
    check_refused("more than 64 levels", 0.1);
}
END_TEST

START_TEST(levels_count_through_aliases)
{
    put("a: &a ");
    put_times("[", 40);
    put_times("]", 40);
    put("\nb: ");
    put_times("[", 40);
    put("*a");
    put_times("]", 40);
    check_refused("more than 64 levels", 0.1);
}
END_TEST

START_TEST(alias_bomb)
{
    put("a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n");
    for (int i = 1; i < 12; i++) {
        char line[200];
        snprintf(line, sizeof line, "a%d: &a%d [*a%d, *a%d, *a%d, *a%d, *a%d, *a%d, *a%d, *a%d]\n",
                 i, i, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1);
        put(line);
    }
    check_refused("more than 100000 values", 1);
}
END_TEST

START_TEST(merge_bomb)
{
    put("a0: &a0 {x: 1, y: 2}\n");
    for (int i = 1; i < 60; i++) {
        char line[100];
        snprintf(line, sizeof line, "a%d: &a%d {<<: *a%d, p: *a%d, q%d: *a%d}\n", i, i, i - 1,
                 i - 1, i, i - 1);
        put(line);
    }
    check_refused("more than 100000 values", 1);
}
END_TEST

START_TEST(hundred_thousand_values)
{
    put("a: [");
    put_times("1,", 100000);
    put("]\n");
    check_refused("more than 100000 values", 2);
}
END_TEST

START_TEST(many_values_are_read)
{
    put("a: [");
    put_times("1,", 99000);
    put("]\n");
    check_accepted();
}
END_TEST

START_TEST(self_alias)
{
    put("a: &a [*a]\nb: &b {c: *b, <<: *b}\n");
    check_refused("inside the value that it repeats", 0.1);
}
END_TEST

START_TEST(mebibyte_of_text_and_no_more)
{
    put("a: ");
    while (used < MEBIBYTE)
        text[used++] = 'x';
    check_accepted();
    text[used++] = 'x';
    check_refused("larger than 1 MiB", 0.1);
}
END_TEST

START_TEST(ninety_thousand_equal_keys)
{
    put_times("a: 1\n", 90000);
    check_refused("given twice", 3);
}
END_TEST

START_TEST(too_many_keys)
{
    for (int i = 0; i < 60000; i++) {
        char line[32];
        snprintf(line, sizeof line, "k%d: 1\n", i);
        put(line);
    }
    check_refused("more than 4096 keys", 2);
}
END_TEST

START_TEST(too_many_anchors)
{
    put("a:\n");
    for (int i = 0; i < 60000; i++) {
        char line[32];
        snprintf(line, sizeof line, "- &k%d 1\n", i);
        put(line);
    }
    check_refused("more than 1000 anchors", 2);
}
END_TEST

START_TEST(many_bad_tags)
{
    put("a:\n");
    put_times("- !t 1\n", 90000);
    check_refused("tags are not used", 3);
}
END_TEST

START_TEST(long_unfinished_quote)
{
    put("a: \"");
    put_times("\\n \\x41\n ", 100000);
    check_refused("not closed", 3);
}
END_TEST

START_TEST(many_texts_over_two_lines)
{
    double start = seconds();
    put("a:\n");
    put_times("- x\n  y\n", 90000);
    check_accepted();
    ck_assert_double_lt(seconds() - start, 2);
}
END_TEST

static const char sample[] =
    "# comment\nformat: 2\ntitle: \"a \\\"pair\\\" \\u00e9\"\nbase: &b {x: 1, y: [2, 3 mm]}\n"
    "pipeline:\n  gears: {use: gear/involute-spur, teeth: [50, 50], module: 3 mm}\n"
    "  oil:\n    <<: *b\n    use: viscosity/barus\n    note: |\n      line one\n\n      größe µm\n"
    "  duty:\n    torque: 250 N m\n    list:\n      - a\n      - {b: 'it''s', c: }\n"
    "outputs: [film.h_min, *b]\n";

static uint32_t next_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u; /* Knuth's MMIX generator */
    return (uint32_t)(*state >> 33);
}

/* Puts in, takes out, doubles or changes a few bytes. */
static void mutate(uint64_t *state)
{
    static const char marks[] = "[]{}:,-?&*!|>'\"%@`#\t\n\r \\<=.~01aé\xFF\xC3\x80";
    uint32_t changes = 1 + next_random(state) % 6;
    for (uint32_t i = 0; i < changes; i++) {
        size_t at = next_random(state) % (used + 1), left = used - at;
        size_t span = left ? 1 + next_random(state) % (left < 30 ? left : 30) : 0;
        switch (next_random(state) % 4) {
        case 0:
            memmove(text + at, text + at + span, left - span);
            used -= span;
            break;
        case 1:
            memmove(text + at + span, text + at, left);
            used += span;
            break;
        case 2:
            memmove(text + at + 1, text + at, left);
            text[at] = marks[next_random(state) % (sizeof marks - 1)];
            used++;
            break;
        default:
            if (left > 0)
                text[at] = marks[next_random(state) % (sizeof marks - 1)];
        }
    }
    text[used] = '\0';
}

static size_t count_nodes(const ff_node *node)
{
    size_t count = 1;
    ck_assert(node->kind != FF_SCALAR || strlen(node->text) <= used + sizeof sample);
    for (size_t i = 0; i < node->count; i++) {
        ck_assert_ptr_nonnull(node->items[i]);
        ck_assert(node->kind != FF_MAP || node->keys[i]);
        count += count_nodes(node->items[i]);
    }
    return count;
}

/* Each text gives a tree, or errors that can be printed; places stay inside the text. */
static void check_round(void)
{
    ff_report *report = ff_report_new();
    fe_tree *tree = fe_tree_parse("fuzz.yaml", "/nonexistent", text, report);
    if (fe_tree_root(tree))
        ck_assert_uint_le(count_nodes(fe_tree_root(tree)), 100000);
    else
        ck_assert_uint_ge(ff_report_errors(report), 1);
    for (size_t i = 0; i < ff_report_count(report); i++) {
        const ff_message *m = ff_report_at(report, i);
        ck_assert(m->text[0] && !strstr(m->text, "not valid YAML: unknown"));
        ck_assert_uint_le(m->place.line, used + 2);
        ck_assert_uint_le(m->place.column, used + 2);
    }
    ff_free(ff_report_text(report, true));
    fe_tree_free(tree);
    ff_report_free(report);
}

START_TEST(mutated_files)
{
    uint64_t state = 20110521;
    for (int round = 0; round < 2000; round++) {
        used = 0;
        put(sample);
        mutate(&state);
        check_round();
    }
}
END_TEST

START_TEST(mutated_assignments)
{
    static const char *const starts[] = {"duty.torque=250 N m", "oil={a: [1, 2], <<: *b}",
                                         "outputs.0=x", "a.b.c.d=", "gears.teeth.1=\"2\\n\""};
    uint64_t state = 1986;
    for (int round = 0; round < 2000; round++) {
        ff_report *report = ff_report_new();
        fe_tree *tree = fe_tree_parse("fuzz.yaml", ".", sample, report);
        used = 0;
        put(starts[round % 5]);
        mutate(&state);
        size_t errors = ff_report_errors(report);
        bool done = fe_tree_set(tree, text, NULL, NULL, report);
        ck_assert(done == (ff_report_errors(report) == errors));
        count_nodes(fe_tree_root(tree));
        fe_tree_free(tree);
        ff_report_free(report);
    }
}
END_TEST

int main(void)
{
    static const TTest *const *const tests[] = {
        &fifty_thousand_brackets,
        &fifty_thousand_braces,
        &fifty_thousand_question_marks,
        &fifty_thousand_dashes,
        &sixty_four_levels_are_read,
        &sixty_five_levels_are_not,
        &levels_count_through_aliases,
        &alias_bomb,
        &merge_bomb,
        &hundred_thousand_values,
        &many_values_are_read,
        &self_alias,
        &mebibyte_of_text_and_no_more,
        &ninety_thousand_equal_keys,
        &too_many_keys,
        &too_many_anchors,
        &many_bad_tags,
        &long_unfinished_quote,
        &many_texts_over_two_lines,
        &mutated_files,
        &mutated_assignments,
    };
    Suite *suite = suite_create("bounds");
    TCase *group = tcase_create("bounds");
    tcase_add_checked_fixture(group, set_up, tear_down);
    tcase_set_timeout(group, 60);
    for (size_t i = 0; i < ROWS(tests); i++)
        tcase_add_test(group, *tests[i]);
    suite_add_tcase(suite, group);
    return run_suite(suite);
}
