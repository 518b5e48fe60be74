/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "failing-allocator.h"

#include <dlfcn.h>
#include <errno.h>
#include <link.h>
#include <stdlib.h>
#include <string.h>

struct failing_allocator memory;

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *old);

#define PUBLIC __attribute__((visibility("default")))

static bool is_spared(void *caller)
{
    static const char *const names[] = {"/libfftw3.so", "/libgomp.so", "/libopenblas", "/ld-linux"};
    struct dl_find_object found;
    if (_dl_find_object(caller, &found) != 0)
        return false;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strstr(found.dlfo_link_map->l_name, names[i]))
            return true;
    return false;
}

static bool refuses(void *caller)
{
    if (memory.spares && is_spared(caller)) {
        memory.spared++;
        return false;
    }
    memory.calls++;
    bool refused = memory.fail_at > 0 && (memory.onwards ? memory.calls >= memory.fail_at
                                                         : memory.calls == memory.fail_at);
    if (refused)
        errno = ENOMEM;
    return refused;
}

static void *count(void *made)
{
    memory.live += made != NULL;
    return made;
}

PUBLIC void *malloc(size_t size)
{
    return refuses(__builtin_return_address(0)) ? NULL : count(__libc_malloc(size));
}

PUBLIC void *calloc(size_t number, size_t size)
{
    return refuses(__builtin_return_address(0)) ? NULL : count(__libc_calloc(number, size));
}

PUBLIC void *realloc(void *old, size_t size)
{
    if (refuses(__builtin_return_address(0)))
        return NULL;
    void *made = __libc_realloc(old, size);
    memory.live += (made != NULL) - (old != NULL && (made || size == 0));
    return made;
}

PUBLIC void *memalign(size_t alignment, size_t size)
{
    return refuses(__builtin_return_address(0)) ? NULL : count(__libc_memalign(alignment, size));
}

PUBLIC void *aligned_alloc(size_t alignment, size_t size)
{
    return refuses(__builtin_return_address(0)) ? NULL : count(__libc_memalign(alignment, size));
}

PUBLIC int posix_memalign(void **made, size_t alignment, size_t size)
{
    *made = refuses(__builtin_return_address(0)) ? NULL : count(__libc_memalign(alignment, size));
    return *made ? 0 : ENOMEM;
}

PUBLIC void free(void *old)
{
    memory.live -= old != NULL;
    __libc_free(old);
}
