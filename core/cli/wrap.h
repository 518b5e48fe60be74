/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text in lines of at most FF_WIDTH columns. */
#ifndef FF_WRAP_H
#define FF_WRAP_H

#include <stdio.h>

enum { FF_WIDTH = 100 };

/* Prints text and a line end. The cursor stands at `column`; further lines begin at `indent`. */
void ff_print_wrapped(FILE *stream, const char *text, int column, int indent);

int ff_columns(const char *text); /* characters, not bytes */

#endif
