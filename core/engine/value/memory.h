/* SPDX-License-Identifier: MIT */
/* Memory of the engine. A block belongs to the heap that was in use when it was allocated, and is
   freed with that heap at the latest. Every public call runs inside fe_protected, where allocations
   do not return NULL: if memory is missing, a long jump leaves the call, as for errors in Lua, and
   the call returns FF_NOMEM. Unfinished objects stay in the heap until it is closed. The jump must
   not cross a stack frame of a plugin, so each function that plugins call has its own bracket.
   Outside of brackets, blocks belong to no heap, and a failed allocation returns NULL. */
#ifndef FE_MEMORY_H
#define FE_MEMORY_H

#include <flankfilm/plugin.h>

#include <stdarg.h>
#include <stddef.h>

/* A resource other than memory that must be closed, such as a parser or a plugin's object. This
   struct itself lies in memory that the heap manages. */
typedef struct fe_resource {
    void (*close)(void *object);
    void *object;
    struct fe_resource *next, **link; /* link NULL: no heap closes it */
} fe_resource;

/* Must start zeroed and must not be moved. One thread at a time uses it. */
typedef struct fe_heap {
    struct fe_block *blocks;
    fe_resource *resources;
} fe_heap;

/* Calls function(ctx) in a bracket. Returns FF_OK, or FF_NOMEM if the function was left by the
   jump. Brackets nest; each thread has its own. */
ff_status fe_protected(fe_heap *heap, void (*function)(void *ctx), void *ctx);

/* Returns the heap in use; NULL outside of brackets. */
fe_heap *fe_heap_in_use(void);
/* Switches to another heap until the bracket ends, and returns the previous one. */
fe_heap *fe_heap_use(fe_heap *heap);

/* Closes the resources, newest first, and frees all blocks. */
void fe_heap_close(fe_heap *heap);

/* Registers the object with the heap in use, which closes it unless it is removed earlier. */
void fe_resource_add(fe_resource *resource, void (*close)(void *object), void *object);
void fe_resource_remove(fe_resource *resource);

/* Leaves the call because memory was missing elsewhere. Returns if there is no bracket. */
void fe_out_of_memory(void);
/* Returns the text of errno. If errno means missing memory, the call is left. */
const char *fe_errno_text(void);

void *fe_alloc(size_t size);                /* zeroed, for any type */
void *fe_resize(void *memory, size_t size); /* like realloc */
void fe_free(void *memory);                 /* from any heap; accepts NULL */
char *fe_copy_text(const char *text, size_t length);
char *fe_print_text(const char *format, ...) __attribute__((format(printf, 1, 2)));
char *fe_print_list(const char *format, va_list args) __attribute__((format(printf, 1, 0)));

/* Memory of one owner that is freed as a whole. Must start zeroed. */
typedef struct fe_arena {
    struct fe_piece *pieces;
} fe_arena;

void *fe_arena_alloc(fe_arena *arena, size_t size); /* zeroed, for any type */
char *fe_arena_text(fe_arena *arena, const char *text, size_t length);
void fe_arena_free(fe_arena *arena);

#endif
