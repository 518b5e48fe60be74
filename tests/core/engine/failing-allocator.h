/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The allocator of the C library in a test program, some calls of which are to fail. */
#ifndef TEST_FAILING_ALLOCATOR_H
#define TEST_FAILING_ALLOCATOR_H

#include <stdbool.h>
#include <stddef.h>

/* What the allocator does, and has done. */
extern struct failing_allocator {
    size_t calls, fail_at; /* the first that fails; 0: none */
    bool onwards;          /* and all later ones */
    bool spares;           /* no call fails by libraries that cannot go on without: FFTW, libgomp,
                              OpenBLAS and the dynamic linker with the libraries of shipped models */
    size_t spared;         /* those calls, which are not among the others */
    long live;             /* blocks */
} memory;

#endif
