/* SPDX-License-Identifier: MIT */
/* A file as a tree of nodes, to which settings are applied. */
#ifndef FE_TREE_H
#define FE_TREE_H

#include <flankfilm/engine.h>

#define FE_FORMAT "2" /* format of the files that this engine reads */

typedef struct fe_tree fe_tree;

/* Reads the files in the `include:` list of `path`, then the file itself, and merges them: maps
   merge recursively, any other value is replaced by the later one. An included path is relative to
   the file that names it or, if not found there, to the examples that came with the library;
   `include` itself is removed. The limits are: 64 levels, 1 MiB of text, 100 000 nodes after alias
   expansion, 4096 keys in a map, 1000 anchors in a file, 16 levels and 64 files of includes.
   Duplicate keys, tags, several documents and a file that includes itself are refused. The merge
   key "<<" takes aliases of maps. A tree is always returned; it has no root if the errors leave no
   content, for example if the file is missing or truncated. Places point into the tree, so it must
   exist when the report is printed. */
fe_tree *fe_tree_load(const char *path, ff_report *report);

/* Like fe_tree_load, for a text in memory. Messages print `name`; relative paths start at
   `directory`. */
fe_tree *fe_tree_parse(const char *name, const char *directory, const char *text,
                       ff_report *report);

/* Returns a copy of the tree that can be changed independently. The original must outlive the copy,
 * which points into it. */
fe_tree *fe_tree_copy(const fe_tree *tree);

/* Applies "a.b.c=value". The value is read as YAML; missing maps on the path are created; ".0" is a
   list index. A path starts at a stage, unless its first word is a top-level key of a file.
   "include=FILE", or a list of files, merges files into the tree. `path` and `value` are the places
   of both if they stand in a file; NULL: they point into the assignment itself. */
bool fe_tree_set(fe_tree *tree, const char *assignment, const ff_place *path, const ff_place *value,
                 ff_report *report);

/* Stores a copy of a node of the tree, including its places, under a key of the root. */
void fe_tree_put(fe_tree *tree, const char *key, const ff_node *node);

const ff_node *fe_tree_root(const fe_tree *tree); /* a map, or NULL */
void fe_tree_free(fe_tree *tree);

/* False, with an error, if the engine does not read this value of `format`. */
bool fe_check_format(ff_report *report, const ff_node *format);

const char *fe_kind_name(ff_node_kind kind); /* "a map", "a list", "a value" */

/* Replaces a plain value. The new value stays in the same layer, but has no place in the file.
   False, with the tree unchanged, if the new value or the target is not a plain value. */
bool fe_tree_change(fe_tree *tree, const char *assignment);

#endif
