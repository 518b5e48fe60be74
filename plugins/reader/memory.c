/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "results.h"

#include <stdlib.h>
#include <string.h>

void *ff_alloc(size_t size)
{
    void *memory = calloc(1, size ? size : 1);
    if (!memory)
        abort();
    return memory;
}

char *ff_print_text(const char *format, ...)
{
    va_list args;
    char *text = NULL;
    va_start(args, format);
    int length = vasprintf(&text, format, args);
    va_end(args);
    if (length < 0)
        abort();
    return text;
}

struct ff_block {
    struct ff_block *next;
    max_align_t memory[];
};

void *ff_arena_alloc(ff_arena *arena, size_t size)
{
    struct ff_block *block = ff_alloc(sizeof *block + size);
    block->next = arena->blocks;
    arena->blocks = block;
    return block->memory;
}

char *ff_arena_text(ff_arena *arena, const char *text, size_t length)
{
    char *copy = ff_arena_alloc(arena, length + 1);
    memcpy(copy, text, length);
    return copy;
}

void ff_arena_free(ff_arena *arena)
{
    while (arena->blocks) {
        struct ff_block *next = arena->blocks->next;
        free(arena->blocks);
        arena->blocks = next;
    }
}
