/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "node.h"

#include <stdlib.h>
#include <string.h>

ff_node *ff_node_new(ff_tree *tree, ff_kind kind, ff_place place)
{
    if (tree->nodes >= FF_MOST_NODES)
        return NULL;
    tree->nodes++;
    ff_node *node = ff_arena_alloc(&tree->arena, sizeof *node);
    node->kind = kind;
    node->place = place;
    if (kind == FF_SCALAR)
        node->text = ff_arena_text(&tree->arena, "", 0);
    return node;
}

/* Arrays have room for the next power of two. */
static bool is_full(size_t count)
{
    return (count & (count - 1)) == 0;
}

static void *grow(ff_tree *tree, const void *old, size_t count, size_t size)
{
    void *grown = ff_arena_alloc(&tree->arena, (count ? 2 * count : 1) * size);
    if (count > 0)
        memcpy(grown, old, count * size);
    return grown;
}

void ff_list_add(ff_tree *tree, ff_node *list, ff_node *item)
{
    if (is_full(list->count))
        list->items = grow(tree, list->items, list->count, sizeof *list->items);
    list->items[list->count++] = item;
}

void ff_map_add(ff_tree *tree, ff_node *map, char *key, ff_place key_place, ff_node *item)
{
    if (is_full(map->count)) {
        map->keys = grow(tree, map->keys, map->count, sizeof *map->keys);
        map->key_places = grow(tree, map->key_places, map->count, sizeof *map->key_places);
    }
    map->keys[map->count] = key;
    map->key_places[map->count] = key_place;
    ff_list_add(tree, map, item);
}

void ff_map_remove(ff_node *map, size_t index)
{
    size_t after = map->count - index - 1;
    memmove(map->items + index, map->items + index + 1, after * sizeof *map->items);
    memmove(map->keys + index, map->keys + index + 1, after * sizeof *map->keys);
    memmove(map->key_places + index, map->key_places + index + 1, after * sizeof *map->key_places);
    map->count--;
}

size_t ff_map_find(const ff_node *map, const char *key)
{
    size_t i = 0;
    while (i < map->count && strcmp(map->keys[i], key) != 0)
        i++;
    return i;
}

ff_node *ff_node_copy(ff_tree *tree, const ff_node *node)
{
    ff_node *copy = ff_node_new(tree, node->kind, node->place);
    if (!copy)
        return NULL;
    copy->text = node->text;
    copy->quoted = node->quoted;
    copy->rank = node->rank;
    for (size_t i = 0; i < node->count; i++) {
        ff_node *item = ff_node_copy(tree, node->items[i]);
        if (!item)
            return NULL;
        if (node->kind == FF_MAP)
            ff_map_add(tree, copy, node->keys[i], node->key_places[i], item);
        else
            ff_list_add(tree, copy, item);
    }
    return copy;
}

size_t ff_node_levels(const ff_node *node)
{
    size_t most = 0;
    for (size_t i = 0; i < node->count; i++) {
        size_t levels = ff_node_levels(node->items[i]);
        most = levels > most ? levels : most;
    }
    return most + 1;
}

void ff_node_set_rank(ff_node *node, uint32_t rank)
{
    node->rank = rank;
    for (size_t i = 0; i < node->count; i++)
        ff_node_set_rank(node->items[i], rank);
}

ff_node *ff_node_merge(ff_tree *tree, ff_node *base, ff_node *later)
{
    if (!base || base->kind != FF_MAP || later->kind != FF_MAP)
        return later;
    for (size_t i = 0; i < later->count; i++) {
        size_t at = ff_map_find(base, later->keys[i]);
        if (at == base->count) {
            ff_map_add(tree, base, later->keys[i], later->key_places[i], later->items[i]);
            continue;
        }
        base->items[at] = ff_node_merge(tree, base->items[at], later->items[i]);
        base->key_places[at] = later->key_places[i];
    }
    base->place = later->place;
    base->rank = later->rank;
    return base;
}

const ff_node *ff_tree_root(const ff_tree *tree)
{
    return tree->root;
}

void ff_tree_free(ff_tree *tree)
{
    if (!tree)
        return;
    ff_arena_free(&tree->arena);
    free(tree);
}

ff_source *ff_tree_source(ff_tree *tree, const char *name, const char *directory, const char *text,
                          size_t length)
{
    ff_source *source = ff_arena_alloc(&tree->arena, sizeof *source);
    source->name = ff_arena_text(&tree->arena, name, strlen(name));
    source->directory = ff_arena_text(&tree->arena, directory, strlen(directory));
    source->text = ff_arena_text(&tree->arena, text, length);
    source->length = length;
    return source;
}

const ff_node *ff_node_get(const ff_node *map, const char *key)
{
    if (!map || map->kind != FF_MAP)
        return NULL;
    size_t at = ff_map_find(map, key);
    return at < map->count ? map->items[at] : NULL;
}

ff_place ff_node_key_place(const ff_node *map, const char *key)
{
    if (!map || map->kind != FF_MAP)
        return FF_NOWHERE;
    size_t at = ff_map_find(map, key);
    return at < map->count ? map->key_places[at] : map->place;
}

const char *ff_kind_name(ff_kind kind)
{
    switch (kind) {
    case FF_SEQUENCE:
        return "a list";
    case FF_MAP:
        return "a map";
    default:
        return "a value";
    }
}
