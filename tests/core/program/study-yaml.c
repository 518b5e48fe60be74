/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is written as YAML reads as itself. */
#include "../../../core/program/study/cases/yaml.h"

#include "check.h"

#include <stdlib.h>
#include <string.h>

int main(void)
{
    static const char *const texts[] = {
        "plain", "",   " x",   "x ",  "-",  "- x",  "-3",    "?",         ". x",
        "a, b",  "[a", "a: b", "a:b", "#",  "it's", "\"q\"", "b\\c",      "a\tb",
        "a\nb",  "%",  "@x",   "&x",  "*x", "!x",   "|",     "\x01 \x7f", "{a: 1}"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        char *line = NULL;
        size_t length = 0;
        FILE *out = open_memstream(&line, &length);
        fputs("a: {b: ", out);
        study_yaml_print_text(texts[i], false, out);
        fputs("}\n", out);
        fclose(out);
        ff_report *report = ff_report_new();
        ff_tree *tree = ff_tree_parse("printed", ".", line, report);
        const ff_node *node = ff_node_get(ff_node_get(ff_tree_root(tree), "a"), "b");
        check_true(line, !ff_report_count(report) && node && !strcmp(node->text, texts[i]));
        ff_tree_free(tree);
        ff_report_free(report);
        free(line);
    }
    return check_done();
}
