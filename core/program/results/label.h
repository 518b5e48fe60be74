/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of outputs in words. */
#ifndef RESULTS_LABEL_H
#define RESULTS_LABEL_H

#include <flankfilm/plugin.h>

enum { RESULTS_LABEL_SIZE = 256 };

/* Returns the label of a row, or its doc if it has none. */
const char *results_called(const ff_port *row);

/* Writes the description of an output: as many clauses of its doc as fit, but at least the first
 * one, without text in brackets or after "; ". */
void results_label(const char *doc, size_t room, char out[RESULTS_LABEL_SIZE]);

#endif
