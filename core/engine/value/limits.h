/* SPDX-License-Identifier: MIT */
/* The physical limits of a parameter row. */
#ifndef FE_LIMITS_H
#define FE_LIMITS_H

#include <flankfilm/engine.h>
#include <flankfilm/plugin.h>

/* Compares a value with the physical limits of its row: -1 below, 1 above; `wanted` then describes
   the allowed values: "at least 3 mm". Returns 0 inside the limits; a value within rounding of a
   closed limit is set to the limit. */
int fe_limits_check(const ff_param *row, const ff_unit *unit, double *si, char wanted[100]);

#endif
