/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tolerances.h"

#include <stdlib.h>
#include <string.h>

typedef struct search {
    memory_arena *arena;
    study_toleranced *list;
    size_t count;
} search;

static void look_at(search *s, const ff_node *node, const char *path);

/* Examines the value under a name, or at an index of a list. */
static void search_below(search *s, const ff_node *node, const char *path, const char *name)
{
    char *longer = memory_print_text("%s.%s", path, name);
    look_at(s, node, longer);
    free(longer);
}

static void look_at(search *s, const ff_node *node, const char *path)
{
    char number[24], why[200];
    ff_tolerance tolerance;
    for (size_t i = 0; node->kind != FF_SCALAR && i < node->count; i++) {
        snprintf(number, sizeof number, "%zu", i);
        search_below(s, node->items[i], path, node->kind == FF_MAP ? node->keys[i] : number);
    }
    if (node->kind != FF_SCALAR || ff_tolerance_parse(node->text, &tolerance, why, sizeof why) <= 0)
        return;
    s->list = memory_arena_grow(s->arena, s->list, s->count, sizeof *s->list);
    s->list[s->count++] =
        (study_toleranced){.path = memory_arena_text(s->arena, path, strlen(path)),
                           .text = node->text,
                           .tolerance = tolerance};
}

static void look_at_stage(search *s, const ff_node *stage, const char *name)
{
    const ff_node *use = ff_node_get(stage, "use");
    for (size_t i = 0; stage->kind == FF_MAP && i < stage->count; i++) {
        const char *key = stage->keys[i];
        const ff_node *set = stage->items[i];
        if (strcmp(key, "with") != 0) {
            search_below(s, set, name, key);
        } else if (use && use->kind == FF_SCALAR && (set = ff_node_get(set, use->text))) {
            char *path = memory_print_text("%s.with", name);
            search_below(s, set, path, use->text);
            free(path);
        }
    }
}

study_toleranced *study_find_toleranced(const ff_node *root, memory_arena *arena, size_t *count)
{
    const ff_node *pipeline = ff_node_get(root, "pipeline");
    search s = {.arena = arena};
    for (size_t i = 0; pipeline && pipeline->kind == FF_MAP && i < pipeline->count; i++)
        look_at_stage(&s, pipeline->items[i], pipeline->keys[i]);
    *count = s.count;
    return s.list;
}
