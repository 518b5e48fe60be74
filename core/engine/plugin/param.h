/* SPDX-License-Identifier: MIT */
/* Reads parameter values from texts or from numbers in SI, and writes them into the memory of a
   model. */
#ifndef FE_PARAM_H
#define FE_PARAM_H

#include <flankfilm/engine.h>

/* Like ff_param_read, for a text as a user writes it in a file: "3 mm", "[1 mm, 2 mm]". */
bool fe_param_read_text(const ff_param *row, const ff_unit *unit, const char *name,
                        const char *text, ff_value *value, ff_report *report);
/* Like ff_param_read, for numbers in SI; a switch is 0 or 1, a choice the rank of its word. */
bool fe_param_take(const ff_param *row, const ff_unit *unit, const char *name, const double *si,
                   size_t count, ff_value *value, ff_report *report);

/* Size and alignment of the instance member for a row of that type, from the table in plugin.h. */
typedef struct fe_member {
    size_t size, alignment; /* bytes */
} fe_member;

fe_member fe_param_member(int32_t type);

int fe_word_find(const char *words, const char *word); /* rank in "a|b|c"; -1: not there */

/* Writes the value into the member given by the row's `place`; NULL: no value was given. Texts and
   lists are not copied; they must be valid until the instance is destroyed. */
void fe_param_place(const ff_param *row, void *self, const ff_value *value);

#endif
