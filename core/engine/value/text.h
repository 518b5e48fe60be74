/* SPDX-License-Identifier: MIT */
/* UTF-8 and lines, counted as the YAML reader counts them. */
#ifndef FE_TEXT_H
#define FE_TEXT_H

#include <flankfilm/engine.h>

enum { FE_NO_CHAR = 0xFFFFFFFFu >> 1 };

/* Reads the character at `at`, before `end`, and returns its length in bytes. An invalid byte has
   length one and gives FE_NO_CHAR. */
size_t fe_char_read(const char *at, const char *end, uint32_t *code);

/* Returns the first byte of the line; *end is its end without the line break. */
const char *fe_line_begin(const ff_source *source, uint32_t line, const char **end);

/* Returns the place of the character at byte `offset`. */
ff_place fe_place_of(const ff_source *source, size_t offset, uint32_t width);

/* Returns the text of the place's line from the place to *end. */
const char *fe_text_at(const ff_place *place, const char **end);

#endif
