/* SPDX-License-Identifier: MIT */
#ifndef FE_TREE_H
#define FE_TREE_H

#include <flankfilm/engine.h>

#define FE_FORMAT "2" /* of the files that the engine reads */

const char *fe_kind_name(ff_node_kind kind); /* "a map", "a list", "a value" */

#endif
