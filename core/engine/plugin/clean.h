/* SPDX-License-Identifier: MIT */
/* Removes control characters, which would affect a terminal, from texts. */
#ifndef FE_CLEAN_H
#define FE_CLEAN_H

#include <stdbool.h>

bool fe_text_is_clean(const char *text); /* whether the text has no control characters */

#endif
