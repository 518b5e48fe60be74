/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "drawing-rounding.h"

#include <flankfilm/author.h>

#include <math.h>

/* One unit of the last digit that drawings give: for a length, in m, and for a profile shift
   coefficient. */
static const double length = 1e-6, shift = 1e-4;

/* Rounding error of the arithmetic, m; a smaller overlap is ignored. */
static const double rounding_error = 1e-12;

const double gear_rounding_roll = 0.01 * M_PI / 180;
const double gear_rounding_diameter = 1e-5;

/* Change of the backlash along the line of action with the centre distance and with a profile
 * shift, from j = m cos(a) (z1 + z2) (inv a_w - inv a_tight): dj/da = 2 sin(a_w), dj/dx = -2 m
 * sin(a). */
double gear_rounding_of_backlash(const gear_spur_spec *g, const gear_spur_pair *p)
{
    double open = 2 * 2 * g->module * sin(g->pressure_angle) * shift;
    if (g->centre_distance > 0)
        open += 2 * sin(p->working_angle) * length;
    if (!isnan(g->backlash))
        open += length;
    else if (g->allowance.count > 0 || g->span.count > 0 || g->over_pins.count > 0)
        open += 2 * cos(g->pressure_angle) * length;
    return open;
}

double gear_rounding_of_clearance(const gear_spur_spec *g)
{
    double open = g->centre_distance > 0 ? length : 0;
    open += g->tip_diameter.count > 0 ? gear_rounding_diameter / 2 : 0;
    return open + (g->root_diameter.count > 0 ? gear_rounding_diameter / 2 : 0);
}

void gear_rounding_say(const gear_spur_pair *p, double moved_start, char *text, size_t size)
{
    int used = 0;
    if (size > 0)
        *text = '\0';
    if (p->moved_backlash > rounding_error)
        used = snprintf(text, size,
                        "the teeth overlap by %.3g um along the line of action, less than the "
                        "rounding of the drawing, %.3g um; the backlash is changed to %.6g um",
                        1e6 * p->moved_backlash, 1e6 * p->rounding_of_backlash, 1e6 * p->backlash);
    for (int i = 0; i < 2; i++)
        if (p->moved_root[i] > 0 && (size_t)used < size)
            used += snprintf(text + used, size - (size_t)used,
                             "%sthe root diameter of gear %d is reduced by %.3g um, to the tip of "
                             "the mating gear",
                             used > 0 ? "; " : "", i + 1, 2e6 * p->moved_root[i]);
    if (moved_start > 0 && (size_t)used < size)
        snprintf(text + used, size - (size_t)used,
                 "%sthe start of a relief is moved by %.3g deg of roll angle, to the end of the "
                 "flank",
                 used > 0 ? "; " : "", moved_start * 180 / M_PI);
}
