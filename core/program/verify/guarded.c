/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "private.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ZONE = 32 };

static const double canary = -7.6543210987e-123;

verify_guarded verify_guarded_new(size_t count)
{
    double *memory = memory_alloc((count + 2 * ZONE) * sizeof *memory);
    for (size_t i = 0; i < count + 2 * ZONE; i++)
        memory[i] = i >= ZONE && i < ZONE + count ? (double)NAN : canary;
    return (verify_guarded){.data = memory + ZONE, .count = count};
}

bool verify_is_intact(const double *data, size_t count)
{
    bool intact = true;
    for (size_t i = 0; i < ZONE; i++)
        intact = intact && !memcmp(&data[count + i], &canary, sizeof canary) &&
                 !memcmp(data - 1 - i, &canary, sizeof canary);
    return intact;
}

void verify_guarded_free(verify_guarded *guarded)
{
    if (guarded->data)
        free(guarded->data - ZONE);
    *guarded = (verify_guarded){.data = NULL};
}
