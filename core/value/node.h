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

/* Empty; NULL when the tree has all the nodes that it may have. */
ff_node *ff_node_new(ff_tree *tree, ff_kind kind, ff_place place);
ff_node *ff_node_copy(ff_tree *tree, const ff_node *node); /* NULL as above */
void ff_list_add(ff_tree *tree, ff_node *list, ff_node *item);
void ff_map_add(ff_tree *tree, ff_node *map, char *key, ff_place key_place, ff_node *item);
void ff_map_remove(ff_node *map, size_t index);
size_t ff_map_find(const ff_node *map, const char *key); /* map->count: absent */
size_t ff_node_levels(const ff_node *node);              /* 1 for a scalar */
void ff_node_set_rank(ff_node *node, uint32_t rank);

/* Lays `later` over `base` (or NULL) and gives the result, made of both. */
ff_node *ff_node_merge(ff_tree *tree, ff_node *base, ff_node *later);

/* A source with copies of its texts, owned by the tree. */
ff_source *ff_tree_source(ff_tree *tree, const char *name, const char *directory, const char *text,
                          size_t length);

/* Reads source->text from byte `start` on as one YAML document. NULL after an error that lost
   something, or with *empty set when there is no content. */
ff_node *ff_yaml_read(ff_tree *tree, const ff_source *source, size_t start, bool *empty,
                      ff_report *report);

struct yaml_parser_s;
/* Says in words of a user's what the parser stumbled over. `shift`: columns before the text in its
   first line. */
void ff_yaml_explain(const struct yaml_parser_s *parser, const ff_source *source, uint32_t shift,
                     ff_report *report);

#endif
