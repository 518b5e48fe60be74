/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A YAML file as a tree of maps, sequences and scalars. Scalars stay text: the reader of a value
 * declares its type. Every node and key knows its place.
 */
#ifndef FE_TREE_H
#define FE_TREE_H

#include "report.h"

typedef enum fe_kind { FE_SCALAR, FE_SEQUENCE, FE_MAP } fe_kind;

typedef struct fe_node fe_node;

struct fe_node {
    fe_kind kind;
    fe_place place;
    char *text;    /* scalar; "" when empty */
    bool quoted;   /* scalar written in quotes */
    uint32_t rank; /* layer: included files first, the file itself, then each --set; higher wins */
    size_t count;  /* children of a sequence or map */
    fe_node **items;
    char **keys;          /* map */
    fe_place *key_places; /* map */
};

typedef struct fe_tree fe_tree;

/*
 * Reads `path`, reads the files of its `include:` list first (relative to the file that names
 * them, or else to the examples that came with the program) and merges: maps deep, all else is
 * replaced by the later; `include` itself is left out.
 * Refuses duplicate keys, tags, several documents, more than 64 levels, 1 MiB of text, 100 000
 * nodes after alias expansion, 4096 keys in a map, 1000 anchors in a file, 16 levels or 64 files of
 * includes, and a file that includes itself. Merge key "<<" takes aliases of maps. Always returns a
 * tree; it has no root when the report got errors that leave nothing to read: a file is lost or
 * broken off. Places point into the tree, so it outlives the report's printing.
 */
fe_tree *fe_tree_load(const char *path, fe_report *report);

/* The same from memory: name serves messages, directory the relative files. */
fe_tree *fe_tree_parse(const char *name, const char *directory, const char *text,
                       fe_report *report);

/*
 * Applies "a.b.c=value": the value is read as YAML, maps on the way are made, a list index is
 * ".0". `prefix` (or NULL) names the map that a path starts in unless its first word is one of
 * `top` (a NULL-terminated list). Places of such values point into the assignment itself.
 * "include=FILE", or a list of files, merges files into the tree.
 */
bool fe_tree_set(fe_tree *tree, const char *assignment, const char *prefix, const char *const *top,
                 fe_report *report);

/* The same for an assignment that stands in a file: places of its path and of its value there, or
   NULL. */
bool fe_tree_set_at(fe_tree *tree, const char *assignment, const fe_place *path,
                    const fe_place *place, const char *prefix, const char *const *top,
                    fe_report *report);

/* Puts a copy of a node of the tree, places and all, under a key of its root. */
void fe_tree_put(fe_tree *tree, const char *key, const fe_node *node);

/* The path of a file that a text in that directory names; the caller frees it. */
char *fe_path_beside(const char *directory, const char *path);

const fe_node *fe_tree_root(const fe_tree *tree); /* a map, or NULL */
void fe_tree_free(fe_tree *tree);

const fe_node *fe_node_get(const fe_node *map, const char *key); /* NULL: absent or no map */
const char *fe_kind_name(fe_kind kind);                          /* "a map", "a list", "a value" */

/* Writes the node on one line that reads as the same node; the second writes a key or a text. */
void fe_yaml_print(const fe_node *node, FILE *out);
void fe_yaml_print_text(const char *text, bool quoted, FILE *out);

#endif
