/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts that a plugin made, before they reach a message or a file. */
#ifndef FE_CLEAN_H
#define FE_CLEAN_H

#include <stdbool.h>
#include <stddef.h>

/* Copies with control bytes and broken UTF-8 replaced by '?' or, for white space, a blank. */
void fe_clean_text(char *out, size_t size, const char *text);
bool fe_text_is_clean(const char *text); /* such a copy would be equal */

#endif
