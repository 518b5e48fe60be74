/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables that a model reads: what is wrong is told at its place in the file. */
#include "pipeline-try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char path[64];

static attempt run(const char *how, const char *table)
{
    char text[300];
    FILE *file = fopen(path, "w");
    if (!file || fputs(table, file) < 0 || fclose(file) != 0)
        exit(2);
    snprintf(text, sizeof text,
             "pipeline:\n"
             "  one: {use: toy/reader, how: %s, file: %s}\n",
             how, path);
    return try_run(text);
}

/* In the table, unless `source` says otherwise. */
static void refuse(const char *how, const char *table, unsigned line, unsigned column,
                   const char *phrase, const char *source, int exit_code)
{
    attempt a = run(how, table);
    check_error(phrase, &a, line, column, phrase);
    check_true("alone", ff_report_errors(a.report) == 1);
    check_true("of that exit code", ff_report_fault(a.report) == exit_code);
    check_true("in that file", ff_report_count(a.report) > 0 &&
                                   !strcmp(ff_report_at(a.report, 0)->place.source->name, source));
    try_close(&a);
}

static void printed(void)
{
    char expected[1000];
    attempt a = run("cell", "# flood\nlevel [m]\n0.5\n 0.25\n");
    char *text = ff_report_text(a.report, false);
    snprintf(expected, sizeof expected,
             "%s:4:2: error: one.file (toy/reader): the level of row 2 is wrong\n"
             "    4 |  0.25\n"
             "      |  ^^^^\n",
             path);
    if (!check_true("the line with a caret", !strcmp(text, expected)))
        puts(text);
    ff_free(text);
    try_close(&a);
}

int main(void)
{
    strcpy(path, "/tmp/flankfilm-table-XXXXXX");
    int file = mkstemp(path);
    if (file < 0)
        return 2;
    close(file);
    const char *good = "level [m]\n0.5\n0.25\n", *bad = "level [m]\n0.5\nx\n";
    attempt a = run("used", good);
    check_good("a table is read", &a);
    check_near("in SI", try_scalar(&a, "one", "sum"), 0.75, 1e-15);
    try_close(&a);
    a = run("used", "tiefe [m], level [s]\n1\n");
    check_true("all errors at once", ff_report_errors(a.report) == 2);
    try_close(&a);
    a = run("ignored", bad);
    check_good("a failure that the model can live with", &a);
    check_true("leaves it without a table", try_scalar(&a, "one", "sum") <= 0);
    try_close(&a);
    printed();
    refuse("used", bad, 3, 1, "one.file (toy/reader): \"x\" is not a number", path, 2);
    refuse("used", "level [m]\n2\n", 2, 1, "level must be at most 1000 mm, but is 2000 mm", path,
           2);
    refuse("late", good, 1, 1, "one.file (toy/reader): a thought came late", path, 2);
    refuse("replaced", bad, 3, 31, "one.how (toy/reader): another reason", "case.yaml", 2);
    refuse("foreign", good, 3, 14, "named a table that it has not read", "case.yaml", 3);
    refuse("unit", good, 3, 14,
           "asked for a table that cannot be read: the requested column \"level\"", "case.yaml", 3);
    refuse("nowhere", good, 3, 14, "asked for a table that cannot be read: it gave no path",
           "case.yaml", 3);
    unlink(path);
    return check_done();
}
