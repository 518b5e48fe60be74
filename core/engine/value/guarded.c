/* SPDX-License-Identifier: MIT */
/* Arrays between guard zones, which reveal writes outside of the arrays. */
#include "memory.h"

#include <flankfilm/engine.h>

#include <string.h>

enum { LEAST = 128, MOST = 512, MULTIPLE = 8 };

/* The content of the zones, a value that no model would write. */
static const double canary = -7.6543210987e-123;

/* Returns the length of a zone, which grows with the array, so that a write one row beyond the
 * array is still inside the zone. */
static size_t zone_of(size_t count)
{
    size_t zone = count < LEAST ? LEAST : count > MOST ? MOST : count;
    return (zone + MULTIPLE - 1) / MULTIPLE * MULTIPLE;
}

static void fill(double *zone, size_t count)
{
    for (size_t i = 0; i < count; i++)
        zone[i] = canary;
}

/* Whether a zone is unchanged: its first number is the canary, and each number equals the next. */
static bool is_filled(const double *zone, size_t count)
{
    return !memcmp(zone, &canary, sizeof canary) &&
           !memcmp(zone, zone + 1, (count - 1) * sizeof *zone);
}

double *ff_guarded_new(size_t count)
{
    size_t zone = zone_of(count);
    double *memory = fe_alloc((count + 2 * zone) * sizeof *memory);
    if (!memory)
        return NULL;
    fill(memory, zone);
    fill(memory + zone + count, zone);
    return memory + zone;
}

const char *ff_guarded_breach(const double *numbers, size_t count)
{
    size_t zone = zone_of(count);
    if (!is_filled(numbers - zone, zone))
        return "before";
    return is_filled(numbers + count, zone) ? NULL : "behind";
}

void ff_guarded_free(const double *numbers, size_t count)
{
    if (numbers)
        fe_free((double *)(uintptr_t)numbers - zone_of(count));
}
