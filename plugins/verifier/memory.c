/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dimensions of a row, and memory that is guarded. */
#include "subject.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The loader has seen to it that the list can be read. */
ff_dims ff_dims_of(const ff_port *row)
{
    ff_dims dims = {.rank = 0};
    for (const char *at = row->service ? "" : row->dims; *at; at += strspn(at, " ?")) {
        size_t length = strcspn(at, " ?");
        memcpy(dims.name[dims.rank++], at, length);
        at += length;
        dims.first_optional = dims.first_optional || *at == '?';
    }
    return dims;
}

void *ff_alloc(size_t size)
{
    void *memory = calloc(1, size ? size : 1);
    if (!memory)
        abort();
    return memory;
}

enum { ZONE = 32 };

static const double canary = -7.6543210987e-123;

ff_guarded ff_guarded_new(size_t count)
{
    double *memory = ff_alloc((count + 2 * ZONE) * sizeof *memory);
    for (size_t i = 0; i < count + 2 * ZONE; i++)
        memory[i] = i >= ZONE && i < ZONE + count ? (double)NAN : canary;
    return (ff_guarded){.data = memory + ZONE, .count = count};
}

bool ff_guarded_whole(const ff_guarded *guarded)
{
    bool whole = true;
    for (size_t i = 0; i < ZONE; i++)
        whole = whole && !memcmp(&guarded->data[guarded->count + i], &canary, sizeof canary) &&
                !memcmp(guarded->data - 1 - i, &canary, sizeof canary);
    return whole;
}

void ff_guarded_free(ff_guarded *guarded)
{
    if (guarded->data)
        free(guarded->data - ZONE);
    *guarded = (ff_guarded){.data = NULL};
}
