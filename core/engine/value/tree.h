/* SPDX-License-Identifier: MIT */
#ifndef FE_TREE_H
#define FE_TREE_H

#include <flankfilm/engine.h>

#define FE_FORMAT "2" /* of the files that the engine reads */

/* False, with an error: the value of `format` is none that the engine reads. */
bool fe_check_format(ff_report *report, const ff_node *format);

const char *fe_kind_name(ff_node_kind kind); /* "a map", "a list", "a value" */

/* Gives a plain value another one in its place, in the layer that it has; its place in the file is
   forgotten. False: the value or what the path leads to is none, and the tree is as before. */
bool fe_tree_change(ff_tree *tree, const char *assignment);

#endif
