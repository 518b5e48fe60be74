/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the breakpoints of a mesh cycle. */
#include "breakpoints.h"

#include "contact-point.h"

#include <math.h>
#include <stdlib.h>

static void add(stiffness_breakpoint_list *b, double age, bool jump)
{
    if (b->count < STIFFNESS_MAX_BREAKPOINTS)
        b->list[b->count++] =
            (stiffness_breakpoint){stiffness_phase_of(age, STIFFNESS_ABOVE), jump};
}

static int by_phase(const void *a, const void *b)
{
    double x = ((const stiffness_breakpoint *)a)->phase,
           y = ((const stiffness_breakpoint *)b)->phase;
    return (x > y) - (x < y);
}

/* Sorts by phase and merges equal breakpoints; a merged breakpoint is a jump if any of the equal
   breakpoints is. */
static void sort(stiffness_breakpoint_list *b)
{
    size_t n = 0;
    qsort(b->list, b->count, sizeof b->list[0], by_phase);
    for (size_t i = 0; i < b->count; i++) {
        if (n > 0 && b->list[i].phase - b->list[n - 1].phase <= STIFFNESS_PHASE_TOLERANCE)
            b->list[n - 1].jump |= b->list[i].jump;
        else
            b->list[n++] = b->list[i];
    }
    b->count = n;
    for (size_t i = 0; i < n; i++)
        b->phase[i] = b->list[i].phase;
}

void stiffness_breakpoints_known(const stiffness_source *s, stiffness_breakpoint_list *b)
{
    double tip = s->conditions->path.contact_ratio, roll[STIFFNESS_MAX_CORNERS];
    add(b, 0, s->sharp);
    add(b, -s->before, s->sharp);
    add(b, tip, s->sharp && !(s->after > 0));
    add(b, tip + s->after, s->sharp);
    for (size_t i = 0; i < s->slope_changes; i++)
        add(b, s->slope_change[i], false);
    for (int g = 0; g < 2; g++) {
        size_t corners =
            stiffness_profile_corners(&s->conditions->deviations, g, roll, STIFFNESS_MAX_CORNERS);
        double sap = stiffness_gears_roll(&s->conditions->gears, g, 0),
               end = stiffness_gears_roll(&s->conditions->gears, g, tip);
        for (size_t i = 0; i < corners; i++) {
            double age = tip * (roll[i] - sap) / (end - sap);
            if (age >= 0 && age <= tip)
                add(b, age, false);
        }
    }
    sort(b);
}

static stiffness_loaded solve(const stiffness_source *s, double phase, int side)
{
    return stiffness_source_solve(s, s->cycles.number, phase, side);
}

static bool same_state(const stiffness_loaded *a, const stiffness_loaded *b)
{
    return a->loaded == b->loaded && a->first == b->first;
}

/* Returns the first phase between low and high at which the contact state differs from the state at
   low. */
static double change_of_state(const stiffness_source *s, const stiffness_loaded *at_low, double low,
                              double high)
{
    const double fine = 1e-12; /* mesh cycles, far below STIFFNESS_PHASE_TOLERANCE */
    for (int k = 0; k < 50 && high - low > fine; k++) {
        double middle = (low + high) / 2;
        stiffness_loaded there = solve(s, middle, STIFFNESS_ABOVE);
        *(same_state(at_low, &there) ? &low : &high) = middle;
    }
    return high;
}

bool stiffness_breakpoints_find(const stiffness_source *s, stiffness_breakpoint_list *b)
{
    enum { MOST_IN_A_STEP = 4 };
    stiffness_cycle grid;
    size_t known = b->count, limit = known + STIFFNESS_MAX_FOUND;
    if (!stiffness_cycle_make(&grid, s->points, known, b->list))
        return false;
    for (size_t i = 1; i < grid.count; i++) {
        double low = grid.phase[i - 1], end = grid.phase[i];
        if (!(end > low))
            continue;
        stiffness_loaded from = solve(s, low, STIFFNESS_ABOVE), to = solve(s, end, STIFFNESS_BELOW);
        for (int k = 0; k < MOST_IN_A_STEP && !same_state(&from, &to) && b->count < limit; k++) {
            double phase = change_of_state(s, &from, low, end);
            add(b, phase, false);
            low = fmin(phase + STIFFNESS_PHASE_TOLERANCE, end);
            from = solve(s, low, STIFFNESS_ABOVE);
        }
    }
    stiffness_cycle_free(&grid);
    sort(b);
    return true;
}
