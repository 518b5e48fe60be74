/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text for people: parameters in words, lines of at most FF_WIDTH columns, colour. */
#ifndef FF_TERMINAL_TEXT_H
#define FF_TERMINAL_TEXT_H

#include "../pipeline/pipeline.h"

enum { FF_WIDTH = 100 };

/* Whether colour is welcome there: a terminal, and no NO_COLOR. */
bool ff_colour(FILE *stream);

/* Prints text and a line end. The cursor stands at `column`; further lines begin at `indent`. */
void ff_print_wrapped(const char *text, int column, int indent);
/* The same on one line, "..." for what has no room. */
void ff_print_cut(const char *text, int column);

/* Where a value comes from: "pair.yaml:12", "--set", "preset"; "proposed" by the model for the
   accuracy asked for. */
void ff_origin(const ff_bound *bound, char *out, size_t size);

#endif
