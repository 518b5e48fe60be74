/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "hunger.h"

#include <dlfcn.h>
#include <errno.h>
#include <stdatomic.h>
#include <sys/mman.h>

typedef void *mapping(void *address, size_t length, int protection, int flags, int file,
                      off_t offset);

enum { MOST_REFUSALS = 1000 };

static void (*starved)(size_t bytes);
static atomic_size_t refused; /* the size */
static atomic_uint refusals;  /* in a row */

void crash_hunger_watch(void (*starve)(size_t bytes))
{
    starved = starve;
}

static void count(size_t length)
{
    if (atomic_exchange(&refused, length) != length)
        atomic_store(&refusals, 0);
    if (atomic_fetch_add(&refusals, 1) + 1 < MOST_REFUSALS)
        return;
    atomic_store(&refusals, 0);
    if (starved)
        starved(length);
    errno = ENOMEM;
}

static void *map(void *address, size_t length, int protection, int flags, int file, off_t offset)
{
    static mapping *next;
    if (!next)
        *(void **)(void *)&next = dlsym(RTLD_NEXT, "mmap");
    void *at = next(address, length, protection, flags, file, offset);
    if (at == MAP_FAILED && errno == ENOMEM)
        count(length);
    else
        atomic_store(&refused, 0);
    return at;
}

#pragma GCC visibility push(default)

/* The header gives one of libc's two names to the other, so that both are spelt out here. */
mapping own_mmap __asm__("mmap"), own_mmap64 __asm__("mmap64");

void *own_mmap(void *address, size_t length, int protection, int flags, int file, off_t offset)
{
    return map(address, length, protection, flags, file, offset);
}

void *own_mmap64(void *address, size_t length, int protection, int flags, int file, off_t offset)
{
    return map(address, length, protection, flags, file, offset);
}

#pragma GCC visibility pop
