/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The phases of the mesh cycle at which k or e jumps or changes its slope. */
#ifndef STIFFNESS_BREAKPOINTS_H
#define STIFFNESS_BREAKPOINTS_H

#include "cycle.h"
#include "equilibrium.h"

enum {
    STIFFNESS_MAX_CORNERS = 64,
    STIFFNESS_MAX_FOUND = 64,
    STIFFNESS_MAX_BREAKPOINTS = 2 * STIFFNESS_MAX_CORNERS + STIFFNESS_MAX_FOUND + 16
};

/* Sorted by phase. */
typedef struct stiffness_breakpoint_list {
    size_t count;
    stiffness_breakpoint list[STIFFNESS_MAX_BREAKPOINTS];
    double phase[STIFFNESS_MAX_BREAKPOINTS]; /* at these phases k or e jumps */
} stiffness_breakpoint_list;

/* Starts the list with the breakpoints known in advance: ends of contact, changes in the slope of
   the compliance, corners of the profiles. */
void stiffness_breakpoints_known(const stiffness_source *s, stiffness_breakpoint_list *b);

/* Adds the phases at which a pair gains or loses load, or at which a different pair is the first to
   touch. Returns false if out of memory. */
bool stiffness_breakpoints_find(const stiffness_source *s, stiffness_breakpoint_list *b);

#endif
