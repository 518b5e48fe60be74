/* SPDX-License-Identifier: MIT */
#ifndef FE_PARAM_H
#define FE_PARAM_H

int fe_word_find(const char *words, const char *word); /* rank in "a|b|c"; -1: not there */

#endif
