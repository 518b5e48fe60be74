/* SPDX-License-Identifier: MIT */
/* Creates and merges trees of nodes. Internal to core/engine/value. */
#ifndef FE_NODE_H
#define FE_NODE_H

#include "memory.h"
#include "tree.h"

enum {
    FE_MOST_LEVELS = 64,
    FE_MOST_TEXT = 1 << 20,
    FE_MOST_NODES = 100000,
    FE_MOST_KEYS = 4096, /* keys in one map, which are searched linearly */
    FE_MOST_FILES = 64,
    FE_MOST_INCLUDE_LEVELS = 16
};

/* A tree owns its nodes and the texts to which their places point. No node has two parents. */
struct fe_tree {
    fe_arena arena;
    ff_node *root;
    size_t nodes;   /* number of nodes so far */
    size_t files;   /* number of files read so far */
    uint32_t ranks; /* number of layers so far */
};

ff_node *fe_node_new(fe_tree *tree, ff_node_kind kind, ff_place place);
ff_node *fe_node_copy(fe_tree *tree, const ff_node *node);
/* Adds an item to a map or, if key is NULL, to a list. */
void fe_node_add(fe_tree *tree, ff_node *node, char *key, ff_place key_place, ff_node *item);
void fe_map_remove(ff_node *map, size_t index);
size_t fe_map_find(const ff_node *map, const char *key); /* returns map->count if absent */
bool fe_node_is_empty(const ff_node *node);              /* true for a key without a value */
size_t fe_node_levels(const ff_node *node);              /* depth; 1 for a scalar */
void fe_node_set_rank(ff_node *node, uint32_t rank);

/* Merges `later` into `base`, which may be NULL. Both become part of the result. */
ff_node *fe_node_merge(fe_tree *tree, ff_node *base, ff_node *later);

/* Reads the files listed in `named` and merges them into the tree. False after an error. */
bool fe_node_include(fe_tree *tree, const ff_node *named, ff_report *report);

/* Returns a source with its own copies of the texts, owned by the tree. Line breaks become LF; a
   byte order mark is removed. */
ff_source *fe_tree_source(fe_tree *tree, const char *name, const char *directory, const char *text,
                          size_t length);

/* Reads `text` as one YAML document; its lines and columns are those of the source. A document
   without content gives an empty scalar. NULL after an error that lost content. */
ff_node *fe_yaml_read(fe_tree *tree, const ff_source *source, const char *text, ff_report *report);

struct yaml_parser_s;
/* Explains the parser's error to a user. */
void fe_yaml_explain(const struct yaml_parser_s *parser, const ff_source *source,
                     ff_report *report);

#endif
