/* SPDX-License-Identifier: MIT */
/* Comparison of a value with a limit given in a unit. */
#ifndef FE_UNIT_H
#define FE_UNIT_H

#include <flankfilm/engine.h>

/* Compares `si` with a limit given in `unit`: -1 below, 0 equal within rounding, 1 above. */
int fe_unit_compare(const ff_unit *unit, double si, double limit);

#endif
