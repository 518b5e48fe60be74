/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "zoned.h"

#include <stdlib.h>
#include <string.h>

enum { ZONE = 32 };

static const double canary = -7.6543210987e-123;

double *fe_zoned_new(size_t count, double fill)
{
    double *memory = malloc((count + 2 * ZONE) * sizeof *memory);
    for (size_t i = 0; memory && i < count + 2 * ZONE; i++)
        memory[i] = i >= ZONE && i < ZONE + count ? fill : canary;
    return memory ? memory + ZONE : NULL;
}

bool fe_zoned_whole(const double *data, size_t count)
{
    bool whole = true;
    for (size_t i = 0; i < ZONE; i++)
        whole = whole && !memcmp(&data[count + i], &canary, sizeof canary) &&
                !memcmp(data - 1 - i, &canary, sizeof canary);
    return whole;
}

void fe_zoned_free(double *data)
{
    if (data)
        free(data - ZONE);
}
