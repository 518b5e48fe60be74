/* SPDX-License-Identifier: MIT */
/* Command-line assignments, which override the files. */
#include <stdlib.h>
#include <string.h>

#include "node.h"
#include "text.h"

/* The traversal of one assignment's path through the tree. */
typedef struct walk {
    fe_tree *tree;
    ff_report *report;
    uint32_t rank;
    const ff_place *at; /* place of all words of the path; NULL: each word has its own */
    ff_node **slot;     /* the node that the path has reached */
    size_t level;
} walk;

static bool fail(ff_report *report, ff_place place, const char *hint, const char *text)
{
    return ff_error(report, FF_FAULT_INPUT, place, hint, "%s", text);
}

static bool step_into_map(walk *w, char *word, ff_place place, bool last)
{
    ff_node *map = *w->slot;
    size_t at = fe_map_find(map, word);
    if (at == map->count)
        fe_node_add(w->tree, map, word, place, fe_node_new(w->tree, FF_SCALAR, place));
    if (last) /* only the last key gets a new place; the others keep theirs in the file */
        map->key_places[at] = place;
    w->slot = &map->items[at];
    return true;
}

static bool step_into_list(walk *w, const char *word, ff_place place)
{
    const ff_node *list = *w->slot;
    char *end;
    unsigned long index = strtoul(word, &end, 10);
    if (*end != '\0' || *word < '0' || *word > '9' || index >= list->count)
        return ff_error(w->report, FF_FAULT_INPUT, place, "entries are counted from 0",
                        "\"%.60s\" is not an entry of this list, which has %zu", word, list->count);
    w->slot = &list->items[index];
    return true;
}

/* Follows one word of the path. An empty value on the path becomes a map. */
static bool step(walk *w, char *word, ff_place place, bool last)
{
    ff_node *node = *w->slot;
    w->level++;
    if (fe_node_is_empty(node)) {
        node->kind = FF_MAP;
        node->rank = w->rank;
    }
    if (node->kind == FF_MAP)
        return step_into_map(w, word, place, last);
    if (node->kind == FF_SEQUENCE)
        return step_into_list(w, word, place);
    return fail(w->report, place, NULL, "the path before this part leads to a value, not to a map");
}

/* Returns the length of the next word. A word ends at a dot, unless the map has a longer key that
 * contains dots, such as a path under `sweep`. */
static size_t word_length(const walk *w, const char *at, const char *end)
{
    const ff_node *map = *w->slot;
    const char *dot = memchr(at, '.', (size_t)(end - at));
    size_t whole = (size_t)(end - at), length = dot ? (size_t)(dot - at) : whole;
    for (size_t i = 0; map->kind == FF_MAP && i < map->count; i++) {
        size_t longer = strlen(map->keys[i]);
        if (longer > length && longer <= whole && !memcmp(at, map->keys[i], longer) &&
            (longer == whole || at[longer] == '.'))
            length = longer;
    }
    return length;
}

/* Follows the words between `at` and `end`, which are separated by dots, and merges the value into
   the node that it reaches. */
static bool apply(walk *w, const ff_source *source, const char *at, const char *end, ff_node *value)
{
    for (bool last = false; !last; at++) {
        const char *stop = at + word_length(w, at, end);
        ff_place place = fe_place_of(source, (size_t)(at - source->text), 0);
        place.width = fe_place_of(source, (size_t)(stop - source->text), 0).column - place.column;
        place = w->at ? *w->at : place;
        last = stop == end;
        if (at == stop)
            return fail(w->report, place, "write a path such as duty.torque",
                        "a word is missing here");
        if (w->level + fe_node_levels(value) >= FE_MOST_LEVELS)
            return fail(w->report, place, NULL, "the path is more than 64 levels deep");
        if (!step(w, fe_arena_text(&w->tree->arena, at, (size_t)(stop - at)), place, last))
            return false;
        at = stop;
    }
    *w->slot = fe_node_merge(w->tree, *w->slot, value);
    return true;
}

const char *const *ff_file_keys(void)
{
    static const char *const keys[] = {"format",  "title",  "include",  "pipeline",
                                       "outputs", "study",  "accuracy", "feedback",
                                       "limits",  "accept", NULL};
    return keys;
}

static bool is_file_key(const char *word, size_t length)
{
    for (const char *const *key = ff_file_keys(); *key; key++)
        if (strlen(*key) == length && !memcmp(*key, word, length))
            return true;
    return false;
}

/* Reads the value behind "=". The path before it is overwritten with blanks, so that columns still
   count from the start of the assignment. */
static ff_node *read_value(fe_tree *tree, const ff_source *source, const char *equals,
                           ff_report *report)
{
    const char *end = source->text + source->length;
    char *text = fe_copy_text(source->text, source->length), *blank = text;
    uint32_t code;
    for (const char *at = source->text; at <= equals; at += fe_char_read(at, end, &code))
        *blank++ = *at == '\n' ? '\n' : ' ';
    memmove(blank, equals + 1, strlen(equals));
    ff_node *value = fe_yaml_read(tree, source, text, report);
    fe_free(text);
    return value;
}

static void relocate(ff_node *node, const ff_place *place)
{
    node->place = *place;
    for (size_t i = 0; i < node->count; i++) {
        if (node->kind == FF_MAP)
            node->key_places[i] = *place;
        relocate(node->items[i], place);
    }
}

bool fe_tree_set(fe_tree *tree, const char *assignment, const ff_place *path, const ff_place *place,
                 ff_report *report)
{
    size_t length = strlen(assignment), errors = ff_report_errors(report);
    bool fits = length <= FE_MOST_TEXT;
    ff_source *source = fe_tree_source(tree, "--set", ".", assignment, fits ? length : 0);
    const char *at = source->text, *equals = strchr(at, '='), *end = equals;
    ff_place whole = {.source = source, .line = 1, .column = 1};
    if (!fits)
        return fail(report, whole, NULL, "the assignment is larger than 1 MiB");
    if (!equals)
        return fail(report, whole, "write it like duty.torque=\"250 N m\"",
                    "an assignment needs a \"=\" between path and value");
    at += strspn(at, " ");
    while (end > at && end[-1] == ' ')
        end--;
    size_t first = strcspn(at, ".= ");
    ff_node *value = read_value(tree, source, equals, report);
    if (!value || !tree->root || ff_report_errors(report) > errors)
        return false;
    if (at + first == end && !strncmp(at, "include=", first + 1))
        return fe_node_include(tree, value, report);
    if (place)
        relocate(value, place);
    walk w = {
        .tree = tree, .report = report, .rank = tree->ranks++, .at = path, .slot = &tree->root};
    fe_node_set_rank(value, w.rank);
    if (!is_file_key(at, first) &&
        !step(&w, fe_arena_text(&tree->arena, "pipeline", strlen("pipeline")), whole, false))
        return false;
    return apply(&w, source, at, end, value);
}

/* Returns the node whose path ends at `end`; NULL: there is none. */
static ff_node *find(fe_tree *tree, const char *at, const char *end)
{
    walk w = {.tree = tree, .slot = &tree->root};
    for (bool last = false; !last; at++) {
        const char *stop = at + word_length(&w, at, end);
        char *word = fe_copy_text(at, (size_t)(stop - at));
        size_t index = (*w.slot)->kind == FF_MAP ? fe_map_find(*w.slot, word) : 0;
        fe_free(word);
        if ((*w.slot)->kind != FF_MAP || index == (*w.slot)->count)
            return NULL;
        w.slot = &(*w.slot)->items[index];
        last = stop == end;
        at = stop;
    }
    return *w.slot;
}

static bool is_plain(const ff_node *node)
{
    return node && node->kind == FF_SCALAR && !fe_node_is_empty(node);
}

bool fe_tree_change(fe_tree *tree, const char *assignment)
{
    size_t length = strlen(assignment);
    if (length > FE_MOST_TEXT || !strchr(assignment, '='))
        return false;
    const ff_source *source = fe_tree_source(tree, "--set", ".", assignment, length);
    const char *equals = strchr(source->text, '=');
    ff_report *unused = ff_report_new();
    char *whole =
        fe_print_text("%s%s", strncmp(assignment, "pipeline.", 9) ? "pipeline." : "", source->text);
    ff_node *node = find(tree, whole, strchr(whole, '='));
    const ff_node *value = is_plain(node) ? read_value(tree, source, equals, unused) : NULL;
    bool good = is_plain(value) && ff_report_count(unused) == 0;
    if (good) {
        node->text = value->text;
        node->quoted = value->quoted;
        node->place = value->place;
    }
    fe_free(whole);
    ff_report_free(unused);
    return good;
}

void fe_tree_put(fe_tree *tree, const char *key, const ff_node *node)
{
    ff_node *root = tree->root, *copy = fe_node_copy(tree, node);
    fe_node_set_rank(copy, tree->ranks++);
    size_t at = fe_map_find(root, key);
    if (at < root->count)
        root->items[at] = copy;
    else
        fe_node_add(tree, root, fe_arena_text(&tree->arena, key, strlen(key)), node->place, copy);
}
