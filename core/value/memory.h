/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory that is there: when the machine has none left, the program ends with a sentence. */
#ifndef FF_MEMORY_H
#define FF_MEMORY_H

#include <stddef.h>

void *ff_there(void *memory);               /* the same, unless it is NULL */
void *ff_alloc(size_t size);                /* zeroed */
void *ff_resize(void *memory, size_t size); /* as realloc */
char *ff_copy_text(const char *text, size_t length);
char *ff_print_text(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Memory of one owner, freed in one go. Starts zeroed. */
typedef struct ff_arena {
    struct ff_block *blocks;
} ff_arena;

void *ff_arena_alloc(ff_arena *arena, size_t size); /* zeroed, for any type */
char *ff_arena_text(ff_arena *arena, const char *text, size_t length);
void ff_arena_free(ff_arena *arena);

#endif
