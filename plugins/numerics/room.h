/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks for memory before calling libraries that end the process without it. */
#ifndef NUMERICS_ROOM_H
#define NUMERICS_ROOM_H

#include <stdlib.h>

/* Whether that much memory is available: allocates and frees it, so that the library finds it
 * unless another thread takes it in between. */
static inline int numerics_has_room(size_t bytes)
{
    void *volatile probe = malloc(bytes); /* volatile, since the compiler would remove both calls */
    free(probe);
    return probe != NULL;
}

/* Bytes, with a margin, that FFTW's planner and two plans of a real transform of that many
 * points take: measured for 48 to 262142 points, 77 to 107 bytes each if their number has large
 * factors. */
static inline size_t numerics_fftw_room(size_t points)
{
    return 256 * 1024 + 128 * points;
}

/* Bytes, with a margin, that libgomp takes for a team of CHOLMOD's threads, without their
 * stacks. */
static inline size_t numerics_openmp_room(void)
{
    return 64 * 1024;
}

/* An array of `count` elements that FFTW's vector instructions can work on; free() takes it. */
static inline void *numerics_fftw_array(size_t count, size_t element)
{
    enum { LINE = 64 };
    if (count > ((size_t)-1 - LINE) / element)
        return NULL;
    return aligned_alloc(LINE, (count * element + LINE - 1) / LINE * LINE);
}

#endif
