/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Searches for jumps of a law. */
#ifndef JUMP_H
#define JUMP_H

#include "slope.h"

#include <stdbool.h>

typedef struct conformance_jump {
    double at, before, after;
} conformance_jump;

/* Searches for a jump of the function along the line, over the range of its axis. A jump is a
 * difference that remains when its interval is halved down to neighbouring numbers; a kink, or a
 * steep but continuous rise, leaves nothing. If the law gives a derivative along the axis, each
 * time the half is taken whose difference the trapezoidal rule explains less, so that a small
 * jump on a steep slope is found. */
bool conformance_find_jump(const conformance_line *line, conformance_jump *jump);

#endif
