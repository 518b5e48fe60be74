/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "guarded.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GUARD = 32 };

static const double canary = -7.6543210987e-123;

guarded guarded_new(size_t count)
{
    double *memory = malloc((count + 2 * GUARD) * sizeof *memory);
    if (!memory)
        abort();
    for (size_t i = 0; i < count + 2 * GUARD; i++)
        memory[i] = i >= GUARD && i < GUARD + count ? (double)NAN : canary;
    return (guarded){.data = memory + GUARD, .count = count};
}

bool guarded_whole(const guarded *g)
{
    bool whole = true;
    for (size_t i = 0; i < GUARD; i++)
        whole = whole && !memcmp(g->data - 1 - i, &canary, sizeof canary) &&
                !memcmp(g->data + g->count + i, &canary, sizeof canary);
    return whole;
}

void guarded_free(guarded *g)
{
    if (g->data)
        free(g->data - GUARD);
    g->data = NULL;
}
