/* SPDX-License-Identifier: MIT */
/* Memory of the engine. A block belongs to the heap that was in use when it was made, and is
 * freed with it at the latest. Every public call runs inside fe_protected, where allocations do
 * not fail: without memory the call is left by a long jump, as errors leave a call in Lua, and
 * returns FF_NOMEM. Half-done work stays in the heap until that is closed. No call may be left
 * across a frame of a plugin, so a function that plugins call has a bracket of its own. Outside
 * of brackets blocks belong to no heap, and a failed allocation returns NULL. */
#ifndef FE_MEMORY_H
#define FE_MEMORY_H

#include <flankfilm/plugin.h>

#include <stdarg.h>
#include <stddef.h>

/* Something other than memory that must be closed, such as a parser or the object of a plugin.
 * It lies in memory of the heap. */
typedef struct fe_resource {
    void (*close)(void *object);
    void *object;
    struct fe_resource *next, **link; /* link NULL: no heap closes it */
} fe_resource;

/* Starts zeroed and never moves. Used by one thread at a time. */
typedef struct fe_heap {
    struct fe_block *blocks;
    fe_resource *resources;
} fe_heap;

/* Calls function(ctx) in a bracket. FF_OK, or FF_NOMEM if the function was left. Brackets nest,
 * in each thread by itself. */
ff_status fe_protected(fe_heap *heap, void (*function)(void *ctx), void *ctx);

/* Returns the heap in use; NULL outside of brackets. */
fe_heap *fe_heap_in_use(void);
/* Uses another heap until the bracket ends, and returns the one used before. */
fe_heap *fe_heap_use(fe_heap *heap);

/* Closes the resources, the newest first, and frees all blocks. */
void fe_heap_close(fe_heap *heap);

/* Registers the object with the heap in use, which closes it unless it is removed before. */
void fe_resource_add(fe_resource *resource, void (*close)(void *object), void *object);
void fe_resource_remove(fe_resource *resource);

/* Leaves the call because memory was missing elsewhere. Returns if there is no bracket. */
void fe_out_of_memory(void);
/* Returns the text of errno. If errno says that memory is missing, the call is left. */
const char *fe_errno_text(void);

void *fe_alloc(size_t size);                /* zeroed, for any type */
void *fe_resize(void *memory, size_t size); /* like realloc */
void fe_free(void *memory);                 /* of any heap; NULL is nothing */
char *fe_copy_text(const char *text, size_t length);
char *fe_print_text(const char *format, ...) __attribute__((format(printf, 1, 2)));
char *fe_print_list(const char *format, va_list args) __attribute__((format(printf, 1, 0)));

/* Memory of one owner that is freed all at once. Starts zeroed. */
typedef struct fe_arena {
    struct fe_piece *pieces;
} fe_arena;

void *fe_arena_alloc(fe_arena *arena, size_t size); /* zeroed, for any type */
char *fe_arena_text(fe_arena *arena, const char *text, size_t length);
void fe_arena_free(fe_arena *arena);

#endif
