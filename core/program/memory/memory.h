/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory allocation of the program. If memory runs out, the program ends with a message. */
#ifndef MEMORY_H
#define MEMORY_H

#include <stddef.h>

void *memory_require(void *memory);             /* returns `memory`; ends the program if it is
                                                   NULL */
void *memory_alloc(size_t size);                /* returns zeroed memory */
void *memory_resize(void *memory, size_t size); /* resizes like realloc */
char *memory_copy_text(const char *text, size_t length);
char *memory_print_text(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* Appends printed text to a text allocated by these functions. The text may move. */
void memory_add_text(char **text, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Sorts items of this size by the double at their start. */
void memory_sort(void *items, size_t count, size_t size);

/* Memory of one owner that is freed all at once. Starts zeroed. */
typedef struct memory_arena {
    struct memory_block *blocks;
} memory_arena;

/* returns zeroed memory, aligned for any type */
void *memory_arena_alloc(memory_arena *arena, size_t size);
/* Makes room for one more item after `count` items. Returns the array, which may have moved. */
void *memory_arena_grow(memory_arena *arena, void *items, size_t count, size_t size);
char *memory_arena_text(memory_arena *arena, const char *text, size_t length);
/* Copies the text into the arena and frees it. */
char *memory_arena_take(memory_arena *arena, char *text);
void memory_arena_free(memory_arena *arena);

#endif
