/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes allocations of the plugin fail, and finds writes past their ends. The plugin's own calls of
   malloc, calloc and realloc are redirected in its table of imported addresses. Calls of the
   libraries that it uses are not. */
#include "private.h"

#include "../memory/memory.h"

#include <dlfcn.h>
#include <link.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum {
    ZONE = 256,    /* number of guard bytes after each block */
    FILLING = 0xA5 /* their value */
};

typedef struct block {
    unsigned char *first;
    size_t size; /* without the guard bytes */
} block;

/* State of the child process. Several threads of a model may allocate at once, so it is protected
   by `lock`. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static size_t made, failing;
static block *blocks; /* blocks in use, in the order of allocation, except that freed entries are
                         reused */
static size_t block_count, block_room;
static size_t breached; /* size of a block after whose end the model wrote; 0: none */

static bool fails(void)
{
    pthread_mutex_lock(&lock);
    bool now = ++made == failing;
    pthread_mutex_unlock(&lock);
    return now;
}

static size_t with_zone(size_t size)
{
    return size <= SIZE_MAX - ZONE ? size + ZONE : SIZE_MAX;
}

/* Removes the blocks that a library has freed: those that overlap a new block. The caller holds the
   lock. */
static void drop_blocks_in(const unsigned char *first, size_t size)
{
    for (size_t i = block_count; i-- > 0;)
        if (blocks[i].first < first + size && first < blocks[i].first + blocks[i].size + ZONE)
            blocks[i] = blocks[--block_count];
}

static void *remember(void *memory, size_t size)
{
    if (!memory)
        return NULL;
    memset((unsigned char *)memory + size, FILLING, ZONE);
    pthread_mutex_lock(&lock);
    drop_blocks_in(memory, size + ZONE);
    if (block_count == block_room) {
        block_room = block_room ? 2 * block_room : 64;
        blocks = memory_resize(blocks, block_room * sizeof *blocks);
    }
    blocks[block_count++] = (block){memory, size};
    pthread_mutex_unlock(&lock);
    return memory;
}

/* Checks the guard bytes of a block. The caller holds the lock. */
static void check_guard(const block *b)
{
    unsigned char *zone = b->first + b->size;
    for (size_t i = 0; i < ZONE; i++)
        if (zone[i] != FILLING) {
            breached = b->size ? b->size : 1;
            memset(zone, FILLING, ZONE);
        }
}

/* Removes a block. A block allocated by a library of the plugin is not in the list. */
static void forget(const void *memory)
{
    pthread_mutex_lock(&lock);
    for (size_t i = block_count; i-- > 0;)
        if (blocks[i].first == memory) {
            check_guard(&blocks[i]);
            blocks[i] = blocks[--block_count];
            break;
        }
    pthread_mutex_unlock(&lock);
}

static void *zoned_malloc(size_t size)
{
    return fails() ? NULL : remember(malloc(with_zone(size)), size);
}

static void *zoned_calloc(size_t count, size_t size)
{
    if (fails() || (size && count > SIZE_MAX / size))
        return NULL;
    return remember(calloc(1, with_zone(count * size)), count * size);
}

static void zoned_free(void *memory)
{
    forget(memory);
    free(memory);
}

/* If there is no memory for the new block, the old one is kept. */
static void *zoned_realloc(void *memory, size_t size)
{
    if (memory && size == 0) {
        zoned_free(memory);
        return NULL;
    }
    if (fails())
        return NULL;
    forget(memory);
    return remember(realloc(memory, with_zone(size)), size);
}

size_t verify_allocation_room(const void *memory)
{
    size_t room = 0;
    pthread_mutex_lock(&lock);
    for (size_t i = 0; i < block_count && !room; i++) {
        size_t offset = (uintptr_t)memory - (uintptr_t)blocks[i].first;
        room = offset < blocks[i].size ? blocks[i].size - offset : 0;
    }
    pthread_mutex_unlock(&lock);
    return room;
}

size_t verify_allocation_breached(void)
{
    pthread_mutex_lock(&lock);
    for (size_t i = 0; i < block_count; i++)
        check_guard(&blocks[i]);
    size_t size = breached;
    breached = 0;
    pthread_mutex_unlock(&lock);
    return size;
}

static uintptr_t replacement(const char *name)
{
    static const struct {
        const char *name;
        void (*function)(void);
    } rows[] = {{"malloc", (void (*)(void))zoned_malloc},
                {"calloc", (void (*)(void))zoned_calloc},
                {"realloc", (void (*)(void))zoned_realloc},
                {"free", (void (*)(void))zoned_free}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (!strcmp(name, rows[i].name))
            return (uintptr_t)rows[i].function;
    return 0;
}

/* Writes an address into the table, which full RELRO makes read-only. */
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
    if (model->destroy == free) /* the address was entered into the plugin's table while the
                                   object was loaded */
        put((uintptr_t *)(uintptr_t)&model->destroy, (uintptr_t)zoned_free);
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
