/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts that a plugin made, before they reach a message or a file. */
#ifndef FE_CLEAN_H
#define FE_CLEAN_H

#include <stdbool.h>
#include <stddef.h>

/* Copies a text; control bytes and broken UTF-8 become '?', white space becomes a blank. */
void fe_clean_text(char *out, size_t size, const char *text);
bool fe_text_is_clean(const char *text); /* a clean copy is equal to it */

#endif
