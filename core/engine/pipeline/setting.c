/* SPDX-License-Identifier: MIT */
/* Finds the value of a parameter or a wire in the file. */
#include "build.h"

#include <stdio.h>
#include <string.h>

const ff_node *fe_find_node(const ff_node *map, const char *path)
{
    char word[96];
    while (map) {
        size_t length = strcspn(path, ".");
        snprintf(word, sizeof word, "%.*s", (int)length, path);
        map = ff_node_get(map, word);
        if (!path[length])
            return map;
        path += length + 1;
    }
    return NULL;
}

const ff_node *fe_model_set(const ff_stage *stage, const char *model)
{
    const ff_node *with = ff_node_get(stage->node, "with");
    return with ? ff_node_get(with, model) : NULL;
}

uint32_t fe_latest_rank(const ff_node *node)
{
    uint32_t rank = node->kind == FF_MAP ? 0 : node->rank;
    for (size_t i = 0; node->kind == FF_MAP && i < node->count; i++) {
        uint32_t inner = fe_latest_rank(node->items[i]);
        rank = inner > rank ? inner : rank;
    }
    return rank;
}

static bool is_empty(const ff_node *node)
{
    return node->kind == FF_SCALAR && !*node->text && !node->quoted;
}

bool fe_is_removed(const ff_node *node)
{
    return is_empty(node) && node->replaced;
}

fe_setting fe_find_setting(const ff_stage *stage, const char *model, const char *path)
{
    const ff_node *own = fe_find_node(stage->node, path);
    const ff_node *set = fe_find_node(fe_model_set(stage, model), path);
    if (own && (fe_is_removed(own) || (set && is_empty(own) && own->rank > set->rank)))
        return (fe_setting){.node = NULL};
    fe_setting setting = {.node = own, .priority = own ? 2 * (uint64_t)own->rank + 1 : 0};
    if (set && (!own || 2 * (uint64_t)set->rank > setting.priority))
        setting = (fe_setting){.node = set, .priority = 2 * (uint64_t)set->rank};
    return setting;
}
