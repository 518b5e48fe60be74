/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "memory.h"

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

char *memory_print_text(const char *format, ...)
{
    va_list args;
    char *text = NULL;
    va_start(args, format);
    int length = vasprintf(&text, format, args);
    va_end(args);
    return memory_require(length < 0 ? NULL : text);
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

void memory_arena_free(memory_arena *arena)
{
    while (arena->blocks) {
        struct memory_block *next = arena->blocks->next;
        free(arena->blocks);
        arena->blocks = next;
    }
}
