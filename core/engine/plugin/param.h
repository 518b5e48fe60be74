/* SPDX-License-Identifier: MIT */
#ifndef FE_PARAM_H
#define FE_PARAM_H

#include <stddef.h>
#include <stdint.h>

/* The member of the instance that a row of that type has, as the table in plugin.h says. */
typedef struct fe_member {
    size_t size, alignment; /* bytes */
} fe_member;

fe_member fe_param_member(int32_t type);

int fe_word_find(const char *words, const char *word); /* rank in "a|b|c"; -1: not there */

#endif
