/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the value of a parameter by the type, unit and limits of its row. */
#ifndef FE_PARAM_H
#define FE_PARAM_H

#include <flankfilm/rows.h>

#include "../value/tree.h"
#include "../value/unit.h"

/*
 * Reads `node` by the row's type into *value: SI, inside the physical limits; a warning when
 * outside the calibrated range. `name` ("gears.module") begins each message; unit is the row's.
 * Its text and reals belong to *value. On failure false, with errors in the report.
 */
bool fe_param_read(const ff_param *row, const fe_unit *unit, const char *name, const fe_node *node,
                   ff_value *value, fe_report *report);

/* The same from the row's preset. */
bool fe_param_read_preset(const ff_param *row, const fe_unit *unit, const char *name,
                          ff_value *value, fe_report *report);

void fe_value_clear(ff_value *value);

int fe_word_find(const char *words, const char *word); /* rank in "a|b|c"; -1: not there */

/* What the row expects: 'a number with a unit such as "3 mm"'. */
void fe_param_expectation(const ff_param *row, char *out, size_t size);

#endif
