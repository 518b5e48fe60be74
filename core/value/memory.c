/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "report.h"

void *ff_there(void *memory)
{
    if (!memory) {
        fputs("flankfilm: out of memory\n", stderr);
        exit(FF_EXIT_FAILED);
    }
    return memory;
}

void *ff_alloc(size_t size)
{
    return ff_there(calloc(1, size ? size : 1));
}

void *ff_resize(void *memory, size_t size)
{
    return ff_there(realloc(memory, size ? size : 1));
}

char *ff_copy_text(const char *text, size_t length)
{
    char *copy = ff_alloc(length + 1);
    memcpy(copy, text, length);
    return copy;
}

char *ff_print_text(const char *format, ...)
{
    va_list args;
    char *text = NULL;
    va_start(args, format);
    int length = vasprintf(&text, format, args);
    va_end(args);
    return ff_there(length < 0 ? NULL : text);
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
