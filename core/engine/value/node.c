/* SPDX-License-Identifier: MIT */
#include "node.h"

#include "tree.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

ff_node *fe_node_new(fe_tree *tree, ff_node_kind kind, ff_place place)
{
    ff_node *node = fe_arena_alloc(&tree->arena, sizeof *node);
    tree->nodes++;
    node->kind = kind;
    node->place = place;
    if (kind == FF_SCALAR)
        node->text = fe_arena_text(&tree->arena, "", 0);
    return node;
}

static void *grow(fe_tree *tree, const void *old, size_t count, size_t size)
{
    void *grown = fe_arena_alloc(&tree->arena, (count ? 2 * count : 1) * size);
    if (count > 0)
        memcpy(grown, old, count * size);
    return grown;
}

void fe_node_add(fe_tree *tree, ff_node *node, char *key, ff_place key_place, ff_node *item)
{
    size_t n = node->count++;
    if ((n & (n - 1)) == 0) { /* the capacity of the arrays is a power of two */
        node->items = grow(tree, node->items, n, sizeof *node->items);
        if (key) {
            node->keys = grow(tree, node->keys, n, sizeof *node->keys);
            node->key_places = grow(tree, node->key_places, n, sizeof *node->key_places);
        }
    }
    node->items[n] = item;
    if (key) {
        node->keys[n] = key;
        node->key_places[n] = key_place;
    }
}

void fe_map_remove(ff_node *map, size_t index)
{
    assert(index < map->count);
    map->count--;
    for (size_t i = index; i < map->count; i++) {
        map->items[i] = map->items[i + 1];
        map->keys[i] = map->keys[i + 1];
        map->key_places[i] = map->key_places[i + 1];
    }
}

size_t fe_map_find(const ff_node *map, const char *key)
{
    size_t i = 0;
    while (i < map->count && strcmp(map->keys[i], key) != 0)
        i++;
    return i;
}

bool fe_node_is_empty(const ff_node *node)
{
    return node->kind == FF_SCALAR && *node->text == '\0' && !node->quoted;
}

ff_node *fe_node_copy(fe_tree *tree, const ff_node *node)
{
    ff_node *copy = fe_node_new(tree, node->kind, node->place);
    copy->text = node->text;
    copy->quoted = node->quoted;
    for (size_t i = 0; i < node->count; i++) {
        bool map = node->kind == FF_MAP;
        fe_node_add(tree, copy, map ? node->keys[i] : NULL, map ? node->key_places[i] : FF_NOWHERE,
                    fe_node_copy(tree, node->items[i]));
    }
    return copy;
}

size_t fe_node_levels(const ff_node *node)
{
    size_t most = 0;
    for (size_t i = 0; i < node->count; i++) {
        size_t levels = fe_node_levels(node->items[i]);
        most = levels > most ? levels : most;
    }
    return most + 1;
}

void fe_node_set_rank(ff_node *node, uint32_t rank)
{
    node->rank = rank;
    for (size_t i = 0; i < node->count; i++)
        fe_node_set_rank(node->items[i], rank);
}

ff_node *fe_node_merge(fe_tree *tree, ff_node *base, ff_node *later)
{
    if (base && (base->kind != FF_MAP || later->kind != FF_MAP))
        later->replaced = fe_node_is_empty(base) ? base->replaced : base;
    if (!base || base->kind != FF_MAP || later->kind != FF_MAP)
        return later;
    for (size_t i = 0; i < later->count; i++) {
        size_t at = fe_map_find(base, later->keys[i]);
        if (at == base->count) {
            fe_node_add(tree, base, later->keys[i], later->key_places[i], later->items[i]);
            continue;
        }
        base->items[at] = fe_node_merge(tree, base->items[at], later->items[i]);
        base->key_places[at] = later->key_places[i];
    }
    base->place = later->place;
    base->rank = later->rank;
    return base;
}

ff_source *fe_tree_source(fe_tree *tree, const char *name, const char *directory, const char *text,
                          size_t length)
{
    ff_source *source = fe_arena_alloc(&tree->arena, sizeof *source);
    const char *end = text + length;
    source->name = fe_arena_text(&tree->arena, name, strlen(name));
    source->directory = fe_arena_text(&tree->arena, directory, strlen(directory));
    source->text = fe_arena_alloc(&tree->arena, length + 1);
    if (length >= 3 && !memcmp(text, "\xEF\xBB\xBF", 3))
        text += 3;
    for (; text < end; text++)
        if (*text != '\r')
            source->text[source->length++] = *text;
        else if (text + 1 == end || text[1] != '\n')
            source->text[source->length++] = '\n';
    return source;
}

/* Returns a copy in the same layers, including the nodes that the node replaced. */
static ff_node *copy_layers(fe_tree *tree, const ff_node *node)
{
    ff_node *copy = fe_arena_alloc(&tree->arena, sizeof *copy);
    size_t room = 1;
    *copy = *node;
    while (room < node->count) /* the capacity that fe_node_add would have allocated */
        room *= 2;
    if (node->kind == FF_SCALAR || node->count == 0)
        return copy;
    copy->items = fe_arena_alloc(&tree->arena, room * sizeof *copy->items);
    for (size_t i = 0; i < node->count; i++)
        copy->items[i] = copy_layers(tree, node->items[i]);
    if (node->kind != FF_MAP)
        return copy;
    copy->keys = fe_arena_alloc(&tree->arena, room * sizeof *copy->keys);
    copy->key_places = fe_arena_alloc(&tree->arena, room * sizeof *copy->key_places);
    memcpy(copy->keys, node->keys, node->count * sizeof *copy->keys);
    memcpy(copy->key_places, node->key_places, node->count * sizeof *copy->key_places);
    return copy;
}

fe_tree *fe_tree_copy(const fe_tree *tree)
{
    fe_tree *copy = fe_alloc(sizeof *copy);
    copy->nodes = tree->nodes;
    copy->files = tree->files;
    copy->ranks = tree->ranks;
    copy->root = tree->root ? copy_layers(copy, tree->root) : NULL;
    return copy;
}

const ff_node *fe_tree_root(const fe_tree *tree)
{
    return tree->root;
}

void fe_tree_free(fe_tree *tree)
{
    if (!tree)
        return;
    fe_arena_free(&tree->arena);
    fe_free(tree);
}

const ff_node *ff_node_get(const ff_node *map, const char *key)
{
    if (!map || map->kind != FF_MAP)
        return NULL;
    size_t at = fe_map_find(map, key);
    return at < map->count ? map->items[at] : NULL;
}

const char *fe_kind_name(ff_node_kind kind)
{
    static const char *const names[] = {"a value", "a list", "a map"};
    return names[kind];
}
