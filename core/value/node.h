/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How trees are made. Internal to core/value. */
#ifndef FF_NODE_H
#define FF_NODE_H

#include "memory.h"
#include "tree.h"

enum {
    FF_MOST_LEVELS = 64,
    FF_MOST_TEXT = 1 << 20,
    FF_MOST_NODES = 100000,
    FF_MOST_KEYS = 4096, /* of one map: keys are looked up one after the other */
    FF_MOST_FILES = 64,
    FF_MOST_INCLUDE_LEVELS = 16
};

/* Owns its nodes and the texts that places point into. No node has two parents. */
struct ff_tree {
    ff_arena arena;
    ff_node *root;
    size_t nodes;   /* made so far */
    size_t files;   /* read so far */
    uint32_t ranks; /* layers so far */
};

ff_node *ff_node_new(ff_tree *tree, ff_kind kind, ff_place place);
ff_node *ff_node_copy(ff_tree *tree, const ff_node *node);
/* Adds to a map or, with key NULL, to a list. */
void ff_node_add(ff_tree *tree, ff_node *node, char *key, ff_place key_place, ff_node *item);
void ff_map_remove(ff_node *map, size_t index);
size_t ff_map_find(const ff_node *map, const char *key); /* map->count: absent */
bool ff_node_is_empty(const ff_node *node);              /* a value that nobody wrote */
size_t ff_node_levels(const ff_node *node);              /* 1 for a scalar */
void ff_node_set_rank(ff_node *node, uint32_t rank);

/* Lays `later` over `base` (or NULL) and gives the result, made of both. */
ff_node *ff_node_merge(ff_tree *tree, ff_node *base, ff_node *later);

/* Lays the files that `named` names over the tree. False after an error. */
bool ff_node_include(ff_tree *tree, const ff_node *named, ff_report *report);

/* A source with copies of its texts, owned by the tree: line breaks are LF, a byte order mark is
   left out. */
ff_source *ff_tree_source(ff_tree *tree, const char *name, const char *directory, const char *text,
                          size_t length);

/* Reads `text`, which stands in lines and columns as the source does, as one YAML document. Without
   content an empty scalar; NULL after an error that lost something. */
ff_node *ff_yaml_read(ff_tree *tree, const ff_source *source, const char *text, ff_report *report);

struct yaml_parser_s;
/* Says in words of a user's what the parser stumbled over. */
void ff_yaml_explain(const struct yaml_parser_s *parser, const ff_source *source,
                     ff_report *report);

#endif
