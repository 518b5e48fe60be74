/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "results.h"

#include <stdlib.h>
#include <string.h>

void *results_alloc(size_t size)
{
    void *memory = calloc(1, size ? size : 1);
    if (!memory)
        abort();
    return memory;
}

char *results_print_text(const char *format, ...)
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

struct results_block {
    struct results_block *next;
    max_align_t memory[];
};

void *results_arena_alloc(results_arena *arena, size_t size)
{
    struct results_block *block = results_alloc(sizeof *block + size);
    block->next = arena->blocks;
    arena->blocks = block;
    return block->memory;
}

char *results_arena_text(results_arena *arena, const char *text, size_t length)
{
    char *copy = results_arena_alloc(arena, length + 1);
    memcpy(copy, text, length);
    return copy;
}

void results_arena_free(results_arena *arena)
{
    while (arena->blocks) {
        struct results_block *next = arena->blocks->next;
        free(arena->blocks);
        arena->blocks = next;
    }
}
