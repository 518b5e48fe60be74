/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reader of YAML: a text, and behind its first NUL byte a --set assignment. */
#include "fuzz.h"

#include "../../core/engine/value/tree.h"

#include <string.h>

static void walk(const fe_node *node)
{
    for (size_t i = 0; i < node->count; i++) {
        must(node->items[i] != NULL);
        must(node->kind != FE_MAP || fe_node_get(node, node->keys[i]) != NULL);
        walk(node->items[i]);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const top[] = {"format", "pipeline", "outputs", NULL};
    char *text = fuzz_text(data, size);
    size_t length = strlen(text);
    fe_report *report = fe_report_new();
    fe_tree *tree = fe_tree_parse("fuzz.yaml", "/nonexistent", text, report);
    if (length < size && fe_tree_root(tree))
        fe_tree_set(tree, text + length + 1, "pipeline", top, report);
    if (fe_tree_root(tree))
        walk(fe_tree_root(tree));
    else
        must(fe_report_errors(report) > 0);
    fuzz_print(report);
    fe_report_free(report);
    fe_tree_free(tree);
    free(text);
    return 0;
}
