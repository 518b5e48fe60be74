/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Failing allocations: the plugin's own calls of malloc, calloc and realloc are redirected in its
 * table of imported addresses. Those of the libraries that it uses stay as they are.
 */
#include "private.h"

#include <dlfcn.h>
#include <link.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { REMEMBERED = 64 };

/* Of the child process; only redirected functions touch them. */
static size_t made, failing;
static struct {
    uintptr_t first;
    size_t size;
} blocks[REMEMBERED]; /* the last ones; one that was freed since may be among them */

static bool fails(void)
{
    return ++made == failing;
}

static void *remember(void *memory, size_t size)
{
    blocks[made % REMEMBERED].first = (uintptr_t)memory;
    blocks[made % REMEMBERED].size = memory ? size : 0;
    return memory;
}

static void *counting_malloc(size_t size)
{
    return fails() ? NULL : remember(malloc(size), size);
}

static void *counting_calloc(size_t count, size_t size)
{
    return fails() ? NULL : remember(calloc(count, size), count * size);
}

static void *counting_realloc(void *memory, size_t size)
{
    return fails() ? NULL : remember(realloc(memory, size), size);
}

size_t verify_allocation_room(const void *memory)
{
    for (size_t back = 0; back < REMEMBERED && back < made; back++) {
        uintptr_t at = (uintptr_t)memory, first = blocks[(made - back) % REMEMBERED].first;
        size_t size = blocks[(made - back) % REMEMBERED].size;
        if (at >= first && at - first < size)
            return size - (at - first);
    }
    return 0;
}

static uintptr_t replacement(const char *name)
{
    if (!strcmp(name, "malloc"))
        return (uintptr_t)counting_malloc;
    if (!strcmp(name, "calloc"))
        return (uintptr_t)counting_calloc;
    return strcmp(name, "realloc") ? 0 : (uintptr_t)counting_realloc;
}

/* Full RELRO leaves the table read-only. */
static void put(uintptr_t *slot, uintptr_t address)
{
    uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE);
    void *start = (void *)((uintptr_t)slot & ~(page - 1));
    if (mprotect(start, page, PROT_READ | PROT_WRITE) == 0)
        *slot = address;
}

static void redirect(const struct link_map *map, const ElfW(Rela) * rows, size_t size,
                     const ElfW(Sym) * symbols, const char *names)
{
    for (size_t i = 0; i < size / sizeof *rows; i++) {
        size_t symbol = sizeof(void *) == 8 ? rows[i].r_info >> 32 : rows[i].r_info >> 8;
        uintptr_t address = replacement(names + symbols[symbol].st_name);
        if (symbol && address && rows[i].r_addend == 0)
            put((uintptr_t *)(map->l_addr + rows[i].r_offset), address);
    }
}

bool verify_allocations_redirect(const ff_model *model)
{
    Dl_info info;
    const struct link_map *map = NULL;
    const ElfW(Sym) *symbols = NULL;
    const ElfW(Rela) *calls = NULL, *others = NULL;
    const char *names = NULL;
    size_t calls_size = 0, others_size = 0;
    void *function;
    memcpy(&function, &model->create, sizeof function);
    if (!dladdr1(function, &info, (void **)(void *)&map, RTLD_DL_LINKMAP) || !map)
        return false;
    for (const ElfW(Dyn) *row = map->l_ld; row->d_tag != DT_NULL; row++) {
        const void *at = (const void *)row->d_un.d_ptr;
        if (row->d_tag == DT_SYMTAB)
            symbols = at;
        else if (row->d_tag == DT_STRTAB)
            names = at;
        else if (row->d_tag == DT_JMPREL)
            calls = at;
        else if (row->d_tag == DT_RELA)
            others = at;
        else if (row->d_tag == DT_PLTRELSZ)
            calls_size = row->d_un.d_val;
        else if (row->d_tag == DT_RELASZ)
            others_size = row->d_un.d_val;
    }
    if (!symbols || !names || (!calls && !others))
        return false;
    if (calls)
        redirect(map, calls, calls_size, symbols, names);
    if (others)
        redirect(map, others, others_size, symbols, names);
    return true;
}

void verify_allocations_fail(size_t nth)
{
    made = 0;
    failing = nth;
}

size_t verify_allocations_made(void)
{
    return made;
}
