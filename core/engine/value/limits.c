/* SPDX-License-Identifier: MIT */
#include "limits.h"

#include "unit.h"

#include <stdio.h>

int fe_limits_check(const ff_param *row, const ff_unit *unit, double *si, char wanted[100])
{
    if (!(row->min < row->max))
        return 0;
    int at_min = fe_unit_compare(unit, *si, row->min),
        at_max = fe_unit_compare(unit, *si, row->max);
    bool min_open = row->flags & FF_MIN_OPEN, max_open = row->flags & FF_MAX_OPEN;
    bool small = at_min < 0 || (at_min == 0 && min_open);
    bool large = at_max > 0 || (at_max == 0 && max_open);
    double limit = ff_unit_to_si(unit, small || at_min == 0 ? row->min : row->max);
    if (!small && !large) {
        *si = at_min == 0 || at_max == 0 ? limit : *si;
        return 0;
    }
    const char *open = small ? "above" : "below", *closed = small ? "at least" : "at most";
    char text[80];
    ff_quantity_print(limit, unit, row->unit, text, sizeof text);
    snprintf(wanted, 100, "%s %s", (small ? min_open : max_open) ? open : closed, text);
    return small ? -1 : 1;
}
