/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an output is called for people. */
#ifndef RESULTS_LABEL_H
#define RESULTS_LABEL_H

#include <flankfilm/plugin.h>

enum { RESULTS_LABEL_SIZE = 256 };

/* The words that a row has for its output: its label, else its doc. */
const char *results_called(const ff_port *row);

/* What an output is called beside its name: as many clauses of its doc as have room in so many
   bytes, without what stands behind "; " or in brackets; at least the first clause. */
void results_label(const char *doc, size_t room, char out[RESULTS_LABEL_SIZE]);

#endif
