/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dimensions of a row, and memory that is guarded. */
#include "subject.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The loader has seen to it that the list can be read. */
verify_dims verify_dims_of(const ff_port *row)
{
    verify_dims dims = {.rank = 0};
    for (const char *at = row->service ? "" : row->dims; *at; at += strspn(at, " ?")) {
        size_t length = strcspn(at, " ?");
        memcpy(dims.name[dims.rank++], at, length);
        at += length;
        dims.first_optional = dims.first_optional || *at == '?';
    }
    return dims;
}

void *verify_alloc(size_t size)
{
    void *memory = calloc(1, size ? size : 1);
    if (!memory)
        abort();
    return memory;
}

enum { ZONE = 32 };

static const double canary = -7.6543210987e-123;

verify_guarded verify_guarded_new(size_t count)
{
    double *memory = verify_alloc((count + 2 * ZONE) * sizeof *memory);
    for (size_t i = 0; i < count + 2 * ZONE; i++)
        memory[i] = i >= ZONE && i < ZONE + count ? (double)NAN : canary;
    return (verify_guarded){.data = memory + ZONE, .count = count};
}

bool verify_guarded_whole(const verify_guarded *guarded)
{
    bool whole = true;
    for (size_t i = 0; i < ZONE; i++)
        whole = whole && !memcmp(&guarded->data[guarded->count + i], &canary, sizeof canary) &&
                !memcmp(guarded->data - 1 - i, &canary, sizeof canary);
    return whole;
}

void verify_guarded_free(verify_guarded *guarded)
{
    if (guarded->data)
        free(guarded->data - ZONE);
    *guarded = (verify_guarded){.data = NULL};
}
