/* SPDX-License-Identifier: MIT */
/* Physical limits of a parameter's row. */
#ifndef FE_LIMITS_H
#define FE_LIMITS_H

#include <flankfilm/engine.h>
#include <flankfilm/plugin.h>

/* Compares a value with the physical limits of its row: -1 below, 1 above. `wanted` then says
 * what the value should be: "at least 3 mm". 0 inside; a value within rounding of a closed limit
 * is set to it. */
int fe_limits_check(const ff_param *row, const ff_unit *unit, double *si, char wanted[100]);

#endif
