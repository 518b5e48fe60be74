/* SPDX-License-Identifier: MIT */
/* Texts without control characters, which a terminal would act on. */
#ifndef FE_CLEAN_H
#define FE_CLEAN_H

#include <stdbool.h>

bool fe_text_is_clean(const char *text); /* whether its clean copy would equal it */

#endif
