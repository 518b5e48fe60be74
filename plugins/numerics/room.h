/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory for libraries that end the process when they get none. */
#ifndef NUMERICS_ROOM_H
#define NUMERICS_ROOM_H

#include <stdlib.h>

/* Whether there is so much memory: asks for it and gives it back, so that the library finds it
   unless another thread takes it in between. */
static inline int numerics_has_room(size_t bytes)
{
    void *volatile probe = malloc(bytes); /* volatile: or else the compiler leaves both calls out */
    free(probe);
    return probe != NULL;
}

/* Bytes that FFTW's planner and two plans of a real transform of so many points take, and some
   more: measured for 48 to 262142 points, 77 to 107 bytes each where their number has large
   factors. */
static inline size_t numerics_fftw_room(size_t points)
{
    return 256 * 1024 + 128 * points;
}

/* Bytes that libgomp takes for a team of CHOLMOD's threads, and some more; not their stacks. */
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
