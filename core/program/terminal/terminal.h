/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text for people: lines as wide as the terminal, colour. */
#ifndef TERMINAL_H
#define TERMINAL_H

#include <flankfilm/engine.h>

#include <stdbool.h>
#include <stdio.h>

/* Columns of stdout: those of the terminal, 100 where it is none. */
int terminal_width(void);

/* Whether colour is welcome there: a terminal, and no NO_COLOR. */
bool terminal_colour(FILE *stream);

/* Prints the messages, each with its place and its line. */
void terminal_print_messages(const ff_report *report, FILE *stream, bool colour);

/* Prints text and a line end. The cursor stands at `column`; further lines begin at `indent`. */
void terminal_print_wrapped(const char *text, int column, int indent);
/* The same on one line, "..." for what has no room. */
void terminal_print_cut(const char *text, int column);

#endif
