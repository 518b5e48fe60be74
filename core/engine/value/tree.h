/* SPDX-License-Identifier: MIT */
/* A file as a tree of nodes, to which settings are laid. */
#ifndef FE_TREE_H
#define FE_TREE_H

#include <flankfilm/engine.h>

#define FE_FORMAT "2" /* of the files that the engine reads */

typedef struct fe_tree fe_tree;

/*
 * Reads `path`, reads the files of its `include:` list first (relative to the file that names
 * them, or else to the examples that came with the library) and merges: maps deep, all else is
 * replaced by the later; `include` itself is left out.
 * Refuses duplicate keys, tags, several documents, more than 64 levels, 1 MiB of text, 100 000
 * nodes after alias expansion, 4096 keys in a map, 1000 anchors in a file, 16 levels or 64 files of
 * includes, and a file that includes itself. Merge key "<<" takes aliases of maps. Always returns a
 * tree; it has no root when the report got errors that leave nothing to read: a file is lost or
 * broken off. Places point into the tree, so it outlives the report's printing.
 */
fe_tree *fe_tree_load(const char *path, ff_report *report);

/* The same from memory: name serves messages, directory the relative files. */
fe_tree *fe_tree_parse(const char *name, const char *directory, const char *text,
                       ff_report *report);

/* The tree as it is now, to be changed by itself; it points into the first, which outlives it. */
fe_tree *fe_tree_copy(const fe_tree *tree);

/*
 * Applies "a.b.c=value": the value is read as YAML, maps on the way are made, a list index is
 * ".0". A path starts among the stages unless its first word may stand at the top of a file.
 * "include=FILE", or a list of files, merges files into the tree. `path` and `value` are the places
 * of both where a file says them; NULL: they point into the assignment itself.
 */
bool fe_tree_set(fe_tree *tree, const char *assignment, const ff_place *path, const ff_place *value,
                 ff_report *report);

/* Puts a copy of a node of the tree, places and all, under a key of its root. */
void fe_tree_put(fe_tree *tree, const char *key, const ff_node *node);

const ff_node *fe_tree_root(const fe_tree *tree); /* a map, or NULL */
void fe_tree_free(fe_tree *tree);

/* False, with an error: the value of `format` is none that the engine reads. */
bool fe_check_format(ff_report *report, const ff_node *format);

const char *fe_kind_name(ff_node_kind kind); /* "a map", "a list", "a value" */

/* Gives a plain value another one in its place, in the layer that it has; its place in the file is
   forgotten. False: the value or what the path leads to is none, and the tree is as before. */
bool fe_tree_change(fe_tree *tree, const char *assignment);

#endif
