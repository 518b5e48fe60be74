/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Assignments from the command line: one more layer over the files. */
#include <stdlib.h>
#include <string.h>

#include "node.h"
#include "text.h"

typedef struct walk {
    ff_tree *tree;
    const ff_source *source;
    ff_report *report;
    const char *at, *end; /* the path that is left */
    size_t level;
} walk;

/* One word of the path. */
typedef struct word {
    char *text;
    ff_place place;
} word;

static bool fail(const walk *w, ff_place place, const char *hint, const char *text)
{
    return ff_error(w->report, FF_EXIT_INPUT, place, hint, "%s", text);
}

static word take_word(walk *w)
{
    const char *start = w->at;
    const char *dot = memchr(start, '.', (size_t)(w->end - start));
    const char *stop = dot ? dot : w->end;
    ff_place place = ff_place_of(w->source, (size_t)(start - w->source->text), 0);
    place.width = ff_place_of(w->source, (size_t)(stop - w->source->text), 0).column - place.column;
    w->at = dot ? dot + 1 : NULL;
    return (word){ff_arena_text(&w->tree->arena, start, (size_t)(stop - start)), place};
}

static bool add_empty(walk *w, ff_node *map, const word *step)
{
    ff_node *empty = ff_node_new(w->tree, FF_SCALAR, step->place);
    if (!empty)
        return fail(w, step->place, NULL, "the input has more than 100000 values");
    ff_map_add(w->tree, map, step->text, step->place, empty);
    return true;
}

/* Where the value of the word's key or index stands; makes the key. NULL after an error. */
static ff_node **slot_of(walk *w, ff_node *node, const word *step)
{
    if (node->kind == FF_MAP) {
        size_t at = ff_map_find(node, step->text);
        if (at == node->count && !add_empty(w, node, step))
            return NULL;
        if (!w->at) /* the keys on the way stay where the file has them */
            node->key_places[at] = step->place;
        return &node->items[at];
    }
    if (node->kind == FF_SCALAR) {
        fail(w, step->place, NULL,
             "what stands before this part of the path is a value, not a map");
        return NULL;
    }
    char *end;
    unsigned long index = strtoul(step->text, &end, 10);
    bool digits = *end == '\0' && *step->text >= '0' && *step->text <= '9';
    if (digits && index < node->count)
        return &node->items[index];
    ff_error(w->report, FF_EXIT_INPUT, step->place, "entries are counted from 0",
             "\"%.60s\" is no entry of a list of %zu", step->text, node->count);
    return NULL;
}

static bool is_nothing(const ff_node *node)
{
    return node->kind == FF_SCALAR && *node->text == '\0' && !node->quoted;
}

/* Follows the path from `node`, making maps on the way, and lays the value over what is there. */
static bool apply(walk *w, ff_node *node, ff_node *value, uint32_t rank)
{
    for (;;) {
        word step = take_word(w);
        if (*step.text == '\0')
            return fail(w, step.place, "write a path such as duty.torque",
                        "a word is missing here");
        if (++w->level + ff_node_levels(value) > FF_MOST_LEVELS)
            return fail(w, step.place, NULL, "the path is more than 64 levels deep");
        ff_node **slot = slot_of(w, node, &step);
        if (!slot)
            return false;
        if (!w->at) {
            *slot = ff_node_merge(w->tree, *slot, value);
            return true;
        }
        if (is_nothing(*slot)) {
            ff_node *map = ff_node_new(w->tree, FF_MAP, step.place);
            if (!map)
                return fail(w, step.place, NULL, "the input has more than 100000 values");
            map->rank = rank;
            *slot = map;
        }
        node = *slot;
    }
}

static bool starts_at_top(const char *path, size_t length, const char *const *top)
{
    for (; top && *top; top++)
        if (strlen(*top) == length && !memcmp(*top, path, length))
            return true;
    return false;
}

/* The map named by the prefix, made when the tree has none. */
static ff_node *prefix_map(walk *w, const char *prefix, uint32_t rank)
{
    ff_node *root = w->tree->root;
    size_t at = ff_map_find(root, prefix);
    ff_place place = {.source = w->source, .line = 1, .column = 1};
    if (at < root->count && !is_nothing(root->items[at]))
        return root->items[at];
    ff_node *map = ff_node_new(w->tree, FF_MAP, place);
    if (!map) {
        fail(w, place, NULL, "the input has more than 100000 values");
        return NULL;
    }
    map->rank = rank;
    if (at < root->count)
        root->items[at] = map;
    else
        ff_map_add(w->tree, root, ff_arena_text(&w->tree->arena, prefix, strlen(prefix)), place,
                   map);
    return map;
}

/* The value behind "="; an empty text is an empty value. */
static ff_node *read_value(walk *w, size_t start)
{
    bool empty;
    ff_node *value = ff_yaml_read(w->tree, w->source, start, &empty, w->report);
    if (empty)
        value = ff_node_new(w->tree, FF_SCALAR, ff_place_of(w->source, start, 0));
    return value;
}

bool ff_tree_set(ff_tree *tree, const char *assignment, const char *prefix, const char *const *top,
                 ff_report *report)
{
    size_t length = strlen(assignment);
    bool fits = length <= FF_MOST_TEXT;
    ff_source *source = ff_tree_source(tree, "--set", ".", assignment, fits ? length : 0);
    const char *equals = strchr(source->text, '=');
    walk w = {.tree = tree, .source = source, .report = report, .at = source->text, .end = equals};
    ff_place whole = {.source = source, .line = 1, .column = 1};
    if (!fits)
        return fail(&w, whole, NULL, "the assignment is larger than 1 MiB");
    if (!equals)
        return fail(&w, whole, "write it like duty.torque=\"250 N m\"",
                    "an assignment needs a \"=\" between path and value");
    while (w.at < w.end && *w.at == ' ')
        w.at++;
    while (w.end > w.at && w.end[-1] == ' ')
        w.end--;
    size_t first = strcspn(w.at, ".= ");
    if (first == 7 && !memcmp(w.at, "include", 7))
        return fail(&w, whole, "write it in the file", "\"include\" cannot be set");
    size_t errors = ff_report_errors(report);
    ff_node *value = read_value(&w, (size_t)(equals + 1 - source->text));
    if (!value || !tree->root || ff_report_errors(report) > errors)
        return false;
    uint32_t rank = tree->ranks++;
    ff_node_set_rank(value, rank);
    ff_node *node = tree->root;
    if (prefix && !starts_at_top(w.at, first, top))
        node = prefix_map(&w, prefix, rank);
    return node && apply(&w, node, value, rank);
}
