/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Allocation that does not fail: without memory the process ends with a message. */
#ifndef FE_MEMORY_H
#define FE_MEMORY_H

#include <stddef.h>

void *fe_require(void *memory);             /* returns it, unless it is NULL */
void *fe_alloc(size_t size);                /* zeroed */
void *fe_resize(void *memory, size_t size); /* like realloc */
char *fe_copy_text(const char *text, size_t length);
char *fe_print_text(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Memory of one owner that is freed all at once. Starts zeroed. */
typedef struct fe_arena {
    struct fe_block *blocks;
} fe_arena;

void *fe_arena_alloc(fe_arena *arena, size_t size); /* zeroed, for any type */
char *fe_arena_text(fe_arena *arena, const char *text, size_t length);
void fe_arena_free(fe_arena *arena);

#endif
