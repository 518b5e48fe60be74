/* SPDX-License-Identifier: MIT */
/* A file as a tree of nodes, to which settings are applied. */
#ifndef FE_TREE_H
#define FE_TREE_H

#include <flankfilm/engine.h>

#define FE_FORMAT "2" /* of the files that the engine reads */

typedef struct fe_tree fe_tree;

/* Reads the file `path` after the files in its `include:` list, and merges them: maps merge
 * deep, any other value is replaced by the later one. Included paths are relative to the file
 * that names them, or else to the examples that came with the library; `include` itself is left
 * out. Refuses duplicate keys, tags, several documents, more than 64 levels, 1 MiB of text, 100
 * 000 nodes after alias expansion, 4096 keys in a map, 1000 anchors in a file, 16 levels or 64
 * files of includes, and a file that includes itself. The merge key "<<" takes aliases of maps.
 * Always returns a tree; it has no root if the errors leave nothing to read, as when a file is
 * missing or truncated. Places point into the tree, so it must outlive the printing of the
 * report. */
fe_tree *fe_tree_load(const char *path, ff_report *report);

/* Does the same from memory; `name` is used in messages, and relative paths start at
 * `directory`. */
fe_tree *fe_tree_parse(const char *name, const char *directory, const char *text,
                       ff_report *report);

/* Returns a copy of the tree that can be changed by itself. It points into the original, which
 * must outlive it. */
fe_tree *fe_tree_copy(const fe_tree *tree);

/* Applies "a.b.c=value": the value is read as YAML, missing maps on the way are made, ".0" is a
 * list index. A path starts among the stages unless its first word may stand at the top of a
 * file. "include=FILE", or a list of files, merges files into the tree. `path` and `value` are
 * the places of both if a file says them; NULL: they point into the assignment itself. */
bool fe_tree_set(fe_tree *tree, const char *assignment, const ff_place *path, const ff_place *value,
                 ff_report *report);

/* Puts a copy of a node of the tree, including its places, under a key of the root. */
void fe_tree_put(fe_tree *tree, const char *key, const ff_node *node);

const ff_node *fe_tree_root(const fe_tree *tree); /* a map, or NULL */
void fe_tree_free(fe_tree *tree);

/* False, with an error, if the engine does not read this value of `format`. */
bool fe_check_format(ff_report *report, const ff_node *format);

const char *fe_kind_name(ff_node_kind kind); /* "a map", "a list", "a value" */

/* Replaces a plain value. It stays in its layer, but its place in the file is forgotten. False,
 * with the tree unchanged, if the new value or the target is not a plain value. */
bool fe_tree_change(fe_tree *tree, const char *assignment);

#endif
