/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "private.h"

double verify_uniform(verify_random *random)
{
    uint64_t z = random->state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

size_t verify_below(verify_random *random, size_t count)
{
    return (size_t)(verify_uniform(random) * (double)count);
}
