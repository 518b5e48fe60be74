/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text for people: parameters in words, lines of at most CLI_WIDTH columns, colour. */
#ifndef CLI_TERMINAL_TEXT_H
#define CLI_TERMINAL_TEXT_H

#include "../../engine/pipeline/pipeline.h"

enum { CLI_WIDTH = 100 };

/* Whether colour is welcome there: a terminal, and no NO_COLOR. */
bool cli_colour(FILE *stream);

/* Prints text and a line end. The cursor stands at `column`; further lines begin at `indent`. */
void cli_print_wrapped(const char *text, int column, int indent);
/* The same on one line, "..." for what has no room. */
void cli_print_cut(const char *text, int column);

#endif
