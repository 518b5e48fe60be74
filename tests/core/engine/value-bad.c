/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Malformed files in tests/bad/yaml: the first message of each says what is wrong, and where. */
#include <flankfilm/engine.h>

#include <dirent.h>
#include <stdio.h>
#include <string.h>

#include "../../../core/engine/value/tree.h"
#include "value-check.h"

static const struct {
    const char *name;
    uint32_t line, column; /* 0: the whole file */
    const char *words;
} rows[] = {
    {"alias-without-name", 2, 8, "an anchor or alias needs a name of letters and digits"},
    {"anchor-without-name", 2, 8, "an anchor or alias needs a name of letters and digits"},
    {"bad-character", 2, 8, "a value cannot begin with \"@\""},
    {"bad-escape", 3, 41, "this escape after \"\\\" is not known"},
    {"block-text", 2, 10, "nothing may follow \"|\" or \">\" in its line"},
    {"colon-in-list", 2, 15, "a \":\" is not possible here inside brackets"},
    {"control-character", 2, 9, "there is a control character (U+0007) in the text"},
    {"directive", 1, 1, "this directive is not used in these files"},
    {"document-in-quotes", 2, 8, "the quote opened here is not closed"},
    {"duplicate-key", 6, 5, "the key \"torque\" is given twice"},
    {"duplicate-stage", 5, 3, "the key \"oil\" is given twice"},
    {"empty", 0, 0, "the file is empty"},
    {"entry-in-map", 4, 3, "there is a list entry in place of a key"},
    {"entry-on-key-line", 2, 10, "a list entry is not possible here"},
    {"include-broken", 3, 10,
     "the \"{\" opened here is not closed, or a \",\" is missing before line 4"},
    {"include-directory", 1, 10, "it is a directory"},
    {"include-itself", 3, 5, "includes itself"},
    {"include-missing", 2, 11, "No such file or directory"},
    {"include-number", 1, 10, "expected the path of a file, found a map"},
    {"indent-too-deep", 5, 7, "this line is indented deeper than the line above allows"},
    {"indent-too-shallow", 5, 4, "this line's indentation fits none of the lines above"},
    {"key-among-entries", 4, 3, "this line is not an entry of the list above"},
    {"key-in-list", 4, 3, "this line has no \":\" after its key"},
    {"key-missing", 2, 1, "a key is missing before \":\""},
    {"latin-1", 2, 13, "the text is not UTF-8 here (byte 0xE4)"},
    {"list-at-top", 1, 1, "expected a map at the top, found a list"},
    {"map-as-key", 2, 1, "a list or a map cannot be a key"},
    {"merge-inline", 4, 9, "\"<<\" takes aliases of maps only"},
    {"merge-of-value", 4, 7, "\"<<\" takes aliases of maps only"},
    {"missing-comma", 3, 43, "expected \",\" or \"}\" here"},
    {"missing-value", 3, 23, "a value is missing before \",\""},
    {"no-colon-value", 2, 1, "this line has no \":\" after its key"},
    {"no-colon", 2, 1, "this line has no \":\" after its key"},
    {"no-space-after-colon", 5, 11, "a space is missing after \":\""},
    {"no-space-anywhere", 1, 1, "expected a map at the top, found a value"},
    {"no-space-in-braces", 3, 10, "a space is missing after \":\" in \"use:operating/steady\""},
    {"only-comments", 0, 0, "the file is empty"},
    {"open-brace-at-end", 3, 10, "the \"{\" opened here is not closed"},
    {"open-brace", 3, 10,
     "the \"{\" opened here is not closed, or a \",\" is missing before line 4"},
    {"open-bracket-line", 2, 10,
     "the \"[\" opened here is not closed, or a \",\" is missing before line 3"},
    {"open-bracket", 3, 50, "expected \",\" or \"]\" here"},
    {"open-double-quote", 2, 8, "the quote opened here is not closed"},
    {"open-single-quote", 2, 18, "there is text after the end of the value"},
    {"percent-first", 2, 8, "a value cannot begin with \"%\""},
    {"question-key", 2, 3, "a list or a map cannot be a key"},
    {"self-alias", 4, 10, "the alias \"*all\" is inside the value that it repeats"},
    {"stray-brace", 3, 32, "this bracket closes nothing"},
    {"stray-bracket", 2, 22, "this bracket closes nothing"},
    {"tab-after-spaces", 5, 3, "a tab is used for indentation"},
    {"tab-indent", 4, 1, "a tab is used for indentation"},
    {"tag-unclosed", 2, 8, "tags are not used in these files"},
    {"tag", 1, 9, "tags are not used in these files"},
    {"text-after-bracket", 4, 21, "there is text after the end of the value"},
    {"text-after-quote", 2, 16, "there is text after the end of the value"},
    {"two-colons", 2, 13, "there is a second \": \" in this line"},
    {"two-documents", 2, 1, "a second document begins here; only one is read"},
    {"unfinished-key", 3, 1, "this line has no \":\" after its key"},
    {"unknown-alias", 3, 8, "there is no anchor \"&common\" before the alias \"*common\""},
    {"utf-16", 1, 1, "the text is not UTF-8 here (byte 0xFF)"},
    {"value-at-top", 1, 1, "expected a map at the top, found a value"},
};

static const char *folder(void)
{
    static char path[1000];
    const char *source = getenv("FLANKFILM_TEST_SOURCE");
    snprintf(path, sizeof path, "%s/tests/bad/yaml", source ? source : ".");
    return path;
}

START_TEST(says_what_and_where)
{
    char path[1100];
    snprintf(path, sizeof path, "%s/%s.yaml", folder(), rows[_i].name);
    ff_report *report = ff_report_new();
    fe_tree *tree = fe_tree_load(path, report);
    ck_assert_msg(ff_report_errors(report) > 0, "%s: no error", rows[_i].name);
    const ff_message *first = ff_report_at(report, 0);
    ck_assert_msg(first->place.line == rows[_i].line && first->place.column == rows[_i].column,
                  "%s:%u:%u: %s", rows[_i].name, first->place.line, first->place.column,
                  first->text);
    ck_assert_msg(strstr(first->text, rows[_i].words), "%s: %s", rows[_i].name, first->text);
    ck_assert_int_eq(ff_report_fault(report), FF_FAULT_INPUT);
    ff_report_free(report);
    fe_tree_free(tree);
}
END_TEST

START_TEST(every_file_has_a_row)
{
    DIR *directory = opendir(folder());
    ck_assert_ptr_nonnull(directory);
    size_t count = 0;
    for (struct dirent *entry; (entry = readdir(directory));)
        count += strstr(entry->d_name, ".yaml") != NULL;
    closedir(directory);
    ck_assert_uint_eq(count, ROWS(rows));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("bad files");
    add_loop(suite, says_what_and_where, ROWS(rows));
    add_test(suite, every_file_has_a_row);
    return run_suite(suite);
}
