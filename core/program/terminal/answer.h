/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one JSON object of --json. It is held until the program ends well, and whatever else is
   written to standard output, as by a plugin, goes to standard error. */
#ifndef TERMINAL_ANSWER_H
#define TERMINAL_ANSWER_H

#include <stdbool.h>
#include <stdio.h>

void terminal_answer_begin(void);

/* Where the object is printed; standard output before the first call. */
FILE *terminal_answer(void);

/* The file that standard output was. May be called in a handler of signals. */
int terminal_answer_file(void);

/* Writes the object. False, with errno, when it could not be written. */
bool terminal_answer_end(void);

#endif
