/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text output: lines as wide as the terminal, and colour. */
#ifndef TERMINAL_H
#define TERMINAL_H

#include <flankfilm/engine.h>

#include <stdbool.h>
#include <stdio.h>

/* Returns the number of columns of stdout, or 100 if it is not a terminal. */
int terminal_width(void);

/* Returns whether colour may be used: the stream is a terminal, and NO_COLOR is not set. */
bool terminal_colour(FILE *stream);

/* Prints the messages, each with its place and its line of the file. */
void terminal_print_messages(const ff_report *report, FILE *stream, bool colour);

/* Prints text and a line break. The text starts at `column`; continuation lines are indented by
   `indent`. */
void terminal_print_wrapped(const char *text, int column, int indent);
/* Prints the same on one line. Text that does not fit is replaced by "...". */
void terminal_print_cut(const char *text, int column);

#endif
