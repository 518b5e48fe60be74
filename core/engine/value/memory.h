/* SPDX-License-Identifier: MIT */
/*
 * Memory of the engine. A block belongs to the heap that was in use when it was made, and is freed
 * with it at the latest.
 *
 * Every public call runs inside fe_protected. There an allocation does not fail: without memory the
 * call is left at once, as an error leaves a call of Lua, and its bracket answers FF_NOMEM. What
 * the call had half done stays in the heap until that is closed. So no call may be left across a
 * frame of a plugin: a function that a plugin calls has a bracket of its own.
 *
 * Outside of any bracket blocks belong to no heap, and without memory the answer is NULL.
 */
#ifndef FE_MEMORY_H
#define FE_MEMORY_H

#include <flankfilm/plugin.h>

#include <stdarg.h>
#include <stddef.h>

/* Something that must be closed and is not memory: a parser, the object of a plugin. It lies in
   memory of the heap. */
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

/* FF_OK, or FF_NOMEM when function(ctx) was left. Brackets nest; each is of its thread. */
ff_status fe_protected(fe_heap *heap, void (*function)(void *ctx), void *ctx);

/* The heap in use; NULL outside of any bracket. */
fe_heap *fe_heap_in_use(void);
/* Makes another heap the one in use until the bracket ends, and returns the one before. */
fe_heap *fe_heap_use(fe_heap *heap);

/* Closes the resources, the newest first, and frees all blocks. */
void fe_heap_close(fe_heap *heap);

/* Has the heap in use close the object, unless it is removed before. */
void fe_resource_add(fe_resource *resource, void (*close)(void *object), void *object);
void fe_resource_remove(fe_resource *resource);

/* Leaves the call: memory was missing elsewhere. Returns when there is no bracket. */
void fe_out_of_memory(void);
/* What errno says; for want of memory, the call is left. */
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
