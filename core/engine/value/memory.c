/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "report.h"

void *fe_require(void *memory)
{
    if (!memory) {
        fputs("flankfilm: out of memory\n", stderr);
        exit(FE_EXIT_FAILED);
    }
    return memory;
}

void *fe_alloc(size_t size)
{
    return fe_require(calloc(1, size ? size : 1));
}

void *fe_resize(void *memory, size_t size)
{
    return fe_require(realloc(memory, size ? size : 1));
}

char *fe_copy_text(const char *text, size_t length)
{
    char *copy = fe_alloc(length + 1);
    memcpy(copy, text, length);
    return copy;
}

char *fe_print_text(const char *format, ...)
{
    va_list args;
    char *text = NULL;
    va_start(args, format);
    int length = vasprintf(&text, format, args);
    va_end(args);
    return fe_require(length < 0 ? NULL : text);
}

struct fe_block {
    struct fe_block *next;
    max_align_t memory[];
};

void *fe_arena_alloc(fe_arena *arena, size_t size)
{
    struct fe_block *block = fe_alloc(sizeof *block + size);
    block->next = arena->blocks;
    arena->blocks = block;
    return block->memory;
}

char *fe_arena_text(fe_arena *arena, const char *text, size_t length)
{
    char *copy = fe_arena_alloc(arena, length + 1);
    memcpy(copy, text, length);
    return copy;
}

void fe_arena_free(fe_arena *arena)
{
    while (arena->blocks) {
        struct fe_block *next = arena->blocks->next;
        free(arena->blocks);
        arena->blocks = next;
    }
}
