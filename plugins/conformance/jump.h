/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Searches for jumps of a law. */
#ifndef JUMP_H
#define JUMP_H

#include "slope.h"

#include <stdbool.h>

typedef struct conformance_jump {
    double at, before, after;
} conformance_jump;

/* Searches for a jump of the function along the line, over the range of its axis. The search halves
   an interval down to neighbouring numbers. A jump is a difference that remains; at a kink, or at a
   steep but continuous rise, the difference vanishes. If the law gives a derivative along the axis,
   the search continues in the half whose difference deviates more from the trapezoidal rule, so
   that a small jump on a steep slope is found. */
bool conformance_find_jump(const conformance_line *line, conformance_jump *jump);

#endif
