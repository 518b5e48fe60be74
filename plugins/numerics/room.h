/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks that memory is available before calling libraries that end the process without it. */
#ifndef NUMERICS_ROOM_H
#define NUMERICS_ROOM_H

#include <stdlib.h>

/* Returns whether so many bytes are available: allocates and frees them. A library can then
   allocate them, unless another thread is faster. */
static inline int numerics_has_room(size_t bytes)
{
    void *volatile probe = malloc(bytes); /* volatile, since the compiler would otherwise remove
                                             both calls */
    free(probe);
    return probe != NULL;
}

/* Memory in bytes, with a margin, that FFTW's planner needs for two plans of a real transform with
   this many points. Measured for 48 to 262142 points: 77 to 107 bytes per point if their number has
   large factors. */
static inline size_t numerics_fftw_room(size_t points)
{
    return 256 * 1024 + 128 * points;
}

/* Memory in bytes, with a margin, that libgomp needs for a team of CHOLMOD's threads, without their
   stacks. */
static inline size_t numerics_openmp_room(void)
{
    return 64 * 1024;
}

/* Allocates an array of `count` elements with the alignment of FFTW's vector instructions; free it
   with free(). */
static inline void *numerics_fftw_array(size_t count, size_t element)
{
    enum { LINE = 64 };
    if (count > ((size_t)-1 - LINE) / element)
        return NULL;
    return aligned_alloc(LINE, (count * element + LINE - 1) / LINE * LINE);
}

#endif
