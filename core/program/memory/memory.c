/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "memory.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void *memory_require(void *memory)
{
    if (!memory) {
        fputs("flankfilm: out of memory\n", stderr);
        exit(EXIT_FAILURE);
    }
    return memory;
}

void *memory_alloc(size_t size)
{
    return memory_require(calloc(1, size ? size : 1));
}

void *memory_resize(void *memory, size_t size)
{
    return memory_require(realloc(memory, size ? size : 1));
}

char *memory_copy_text(const char *text, size_t length)
{
    char *copy = memory_alloc(length + 1);
    memcpy(copy, text, length);
    return copy;
}

static char *print(const char *format, va_list args)
{
    char *text = NULL;
    return memory_require(vasprintf(&text, format, args) < 0 ? NULL : text);
}

char *memory_print_text(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    char *text = print(format, args);
    va_end(args);
    return text;
}

void memory_add_text(char **text, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    char *more = print(format, args);
    va_end(args);
    size_t length = strlen(*text), size = strlen(more) + 1;
    *text = memory_resize(*text, length + size);
    memcpy(*text + length, more, size);
    free(more);
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void memory_sort(void *items, size_t count, size_t size)
{
    assert(size >= sizeof(double));
    qsort(items, count, size, compare);
}

struct memory_block {
    struct memory_block *next;
    max_align_t memory[];
};

void *memory_arena_alloc(memory_arena *arena, size_t size)
{
    struct memory_block *block = memory_alloc(sizeof *block + size);
    block->next = arena->blocks;
    arena->blocks = block;
    return block->memory;
}

char *memory_arena_text(memory_arena *arena, const char *text, size_t length)
{
    char *copy = memory_arena_alloc(arena, length + 1);
    memcpy(copy, text, length);
    return copy;
}

char *memory_arena_take(memory_arena *arena, char *text)
{
    char *copy = memory_arena_text(arena, text, strlen(text));
    free(text);
    return copy;
}

void *memory_arena_grow(memory_arena *arena, void *items, size_t count, size_t size)
{
    if ((count & (count - 1)) != 0)
        return items;
    void *more = memory_arena_alloc(arena, (count ? 2 * count : 1) * size);
    return count ? memcpy(more, items, count * size) : more;
}

void memory_arena_free(memory_arena *arena)
{
    while (arena->blocks) {
        struct memory_block *next = arena->blocks->next;
        free(arena->blocks);
        arena->blocks = next;
    }
}
