/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one JSON object of --json. The object is stored until the program ends successfully. Anything
   else written to standard output, for instance by a plugin, goes to standard error. */
#ifndef TERMINAL_ANSWER_H
#define TERMINAL_ANSWER_H

#include <stdbool.h>
#include <stdio.h>

void terminal_answer_begin(void);

/* Returns the stream to which the object is printed. Before the first call it is standard
   output. */
FILE *terminal_answer(void);

/* Returns the descriptor of the original standard output. A signal handler may call it. */
int terminal_answer_file(void);

/* Writes the object. Returns false with errno if it could not be written. */
bool terminal_answer_end(void);

#endif
