/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Jumps of a law. */
#ifndef JUMP_H
#define JUMP_H

#include "slope.h"

#include <stdbool.h>

typedef struct conformance_jump {
    double at, before, after;
} conformance_jump;

/* Looks for a jump of the function along the line, over the range of its axis. A jump is what stays
   of a difference when its interval is halved down to neighbouring numbers: a kink or a steep but
   continuous rise leaves nothing. Where the law has a derivative along the axis, each half is
   chosen by what its trapezoidal rule leaves unexplained, so that a small jump on a steep slope is
   found. */
bool conformance_find_jump(const conformance_line *line, conformance_jump *jump);

#endif
