/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reader of YAML: a text, and behind its first NUL byte a --set assignment. */
#include "fuzz.h"

#include "../../core/engine/value/tree.h"

#include <string.h>

static void walk(const ff_node *node)
{
    for (size_t i = 0; i < node->count; i++) {
        must(node->items[i] != NULL);
        must(node->kind != FF_MAP || ff_node_get(node, node->keys[i]) != NULL);
        walk(node->items[i]);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = fuzz_text(data, size);
    size_t length = strlen(text);
    ff_report *report = ff_report_new();
    fe_tree *tree = fe_tree_parse("fuzz.yaml", "/nonexistent", text, report);
    if (length < size && fe_tree_root(tree))
        fe_tree_set(tree, text + length + 1, NULL, NULL, report);
    if (fe_tree_root(tree))
        walk(fe_tree_root(tree));
    else
        must(ff_report_errors(report) > 0);
    fuzz_print(report);
    ff_report_free(report);
    fe_tree_free(tree);
    free(text);
    return 0;
}
