/* SPDX-License-Identifier: MIT */
#ifndef FE_CLEAN_H
#define FE_CLEAN_H

#include <stdbool.h>

bool fe_text_is_clean(const char *text); /* its clean copy is equal to it */

#endif
