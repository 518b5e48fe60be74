/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints nodes of a file in YAML's flow style. */
#ifndef STUDY_YAML_H
#define STUDY_YAML_H

#include <flankfilm/engine.h>

#include <stdio.h>

/* study_yaml_print writes the node on one line, from which YAML reads the same node;
 * study_yaml_print_text writes a key or a text. */
void study_yaml_print(const ff_node *node, FILE *out);
void study_yaml_print_text(const char *text, bool quoted, FILE *out);
/* Returns "path=node", as in --set, to be freed. */
char *study_yaml_assignment(const char *path, const ff_node *value);

#endif
