/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measured-curves.h"

#include <flankfilm/table.h>

#include <stdlib.h>

const ff_param gear_curve_columns[GEAR_CURVE_COLUMNS] = {
    {.name = "gear",
     .unit = "1",
     .doc = "number of the gear, 1 or 2",
     .type = FF_REALS,
     .flags = FF_REQUIRED | FF_WHOLE,
     .min = 1,
     .max = 2,
     .max_count = 200000},
    {.name = "roll_angle",
     .unit = "deg",
     .doc = "roll angle on the gear itself",
     .type = FF_REALS,
     .flags = FF_REQUIRED},
    {.name = "deviation",
     .unit = "um",
     .doc = "deviation from the involute, positive: more metal",
     .type = FF_REALS,
     .flags = FF_REQUIRED},
};

ff_status gear_curves_read(const ff_host *host, const char *item, const char *path,
                           gear_curve curve[2])
{
    const ff_table *t;
    curve[0] = curve[1] = (gear_curve){0};
    ff_status status = ff_table_read(host, item, path, FF_TABLE(gear_curve_columns), &t);
    for (int g = 0; g < 2 && status == FF_OK; g++) {
        curve[g].roll = malloc(t->row_count * sizeof *curve[g].roll);
        curve[g].deviation = malloc(t->row_count * sizeof *curve[g].deviation);
        status = curve[g].roll && curve[g].deviation ? FF_OK : FF_NOMEM;
    }
    for (size_t i = 0; status == FF_OK && i < t->row_count; i++) {
        gear_curve *c = &curve[t->columns[GEAR_CURVE_GEAR][i] > 1];
        double roll = t->columns[GEAR_CURVE_ROLL][i];
        if (c->count > 0 && !(roll > c->roll[c->count - 1]))
            return ff_table_failf(host, t, i, GEAR_CURVE_ROLL,
                                  "the roll angles of a gear must increase");
        c->roll[c->count] = roll;
        c->deviation[c->count++] = t->columns[GEAR_CURVE_DEVIATION][i];
    }
    return status;
}
