/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A YAML file as a tree of maps, sequences and scalars. Scalars stay text: the reader of a value
 * declares its type. Every node and key knows its place.
 */
#ifndef FF_TREE_H
#define FF_TREE_H

#include "report.h"

typedef enum ff_kind { FF_SCALAR, FF_SEQUENCE, FF_MAP } ff_kind;

typedef struct ff_node ff_node;

struct ff_node {
    ff_kind kind;
    ff_place place;
    char *text;    /* scalar; "" when empty */
    bool quoted;   /* scalar written in quotes */
    uint32_t rank; /* layer: included files first, the file itself, then each --set; higher wins */
    size_t count;  /* children of a sequence or map */
    ff_node **items;
    char **keys;          /* map */
    ff_place *key_places; /* map */
};

typedef struct ff_tree ff_tree;

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
ff_tree *ff_tree_load(const char *path, ff_report *report);

/* The same from memory: name serves messages, directory the relative files. */
ff_tree *ff_tree_parse(const char *name, const char *directory, const char *text,
                       ff_report *report);

/*
 * Applies "a.b.c=value": the value is read as YAML, maps on the way are made, a list index is
 * ".0". `prefix` (or NULL) names the map that a path starts in unless its first word is one of
 * `top` (a NULL-terminated list). Places of such values point into the assignment itself.
 * "include=FILE", or a list of files, lays files over the tree.
 */
bool ff_tree_set(ff_tree *tree, const char *assignment, const char *prefix, const char *const *top,
                 ff_report *report);

/* The same for an assignment that stands in a file: places of its path and of its value there, or
   NULL. */
bool ff_tree_set_at(ff_tree *tree, const char *assignment, const ff_place *path,
                    const ff_place *place, const char *prefix, const char *const *top,
                    ff_report *report);

/* Puts a copy of a node of the tree, places and all, under a key of its root. */
void ff_tree_put(ff_tree *tree, const char *key, const ff_node *node);

/* The path as it stands in a file of that directory, to be freed. */
char *ff_path_beside(const char *directory, const char *path);

const ff_node *ff_tree_root(const ff_tree *tree); /* a map, or NULL */
void ff_tree_free(ff_tree *tree);

const ff_node *ff_node_get(const ff_node *map, const char *key); /* NULL: absent or no map */
/* The map's own place when the key is absent. */
ff_place ff_node_key_place(const ff_node *map, const char *key);
const char *ff_kind_name(ff_kind kind); /* "a map", "a list", "a value" */

/* Writes the node on one line, such that it reads as the same; a key or another text likewise. */
void ff_yaml_print(const ff_node *node, FILE *out);
void ff_yaml_print_text(const char *text, bool quoted, FILE *out);

#endif
