/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the pinion, to which a standard gives index 1, whichever gear drives. */
#ifndef NUMERICS_PINION_H
#define NUMERICS_PINION_H

#include <flankfilm/author.h>

#include <math.h>

/* The input row gear.pinion of a stage that follows a standard; `kind` as in the other gear rows of
   the stage. */
#define NUMERICS_PINION_ROW(kind)                                                                  \
    {                                                                                              \
        .name = "gear.pinion", .unit = "1",                                                        \
        .doc = "number of the gear, 1 or 2, that has index 1 in the standard; left out: the gear " \
               "with fewer "                                                                       \
               "teeth, "                                                                           \
               "gear 1 if both are equal",                                                         \
        .dims = "", .flags = FF_OPTIONAL, .from = kind                                             \
    }

/* Returns FF_OK and the index of the pinion, 0 or 1. */
static inline ff_status numerics_pinion(const ff_host *host, const ff_array *in,
                                        const double teeth[2], int *pinion)
{
    *pinion = in->data ? in->data[0] > 1.5 : teeth[1] < teeth[0];
    if (in->data && !(fabs(in->data[0] - 1 - *pinion) <= 0))
        return ff_failf(host, FF_INVALID, "gear.pinion",
                        "the pinion must be gear 1 or gear 2, but is %g", in->data[0]);
    return FF_OK;
}

#endif
