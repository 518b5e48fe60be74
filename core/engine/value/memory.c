/* SPDX-License-Identifier: MIT */
#include "memory.h"

#include <flankfilm/engine.h>

#include <assert.h>
#include <errno.h>
#include <setjmp.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The blocks of a heap form a doubly linked list. Each block has the address of the pointer to it,
   so that it can be unlinked without access to its heap. */
struct fe_block {
    struct fe_block *next, **link; /* link NULL: it belongs to no heap */
    max_align_t memory[];
};

/* A bracket of fe_protected. */
typedef struct frame {
    fe_heap *heap; /* heap in use */
    struct frame *outer;
    jmp_buf escape;
} frame;

/* The innermost bracket of the thread. The initial-exec model allocates nothing on first access, so
   that a signal handler may read it first. */
static _Thread_local frame *innermost __attribute__((tls_model("initial-exec")));

ff_status fe_protected(fe_heap *heap, void (*function)(void *ctx), void *ctx)
{
    frame own = {.heap = heap, .outer = innermost};
    innermost = &own;
    bool left = setjmp(own.escape) != 0;
    if (!left)
        function(ctx);
    innermost = own.outer;
    return left ? FF_NOMEM : FF_OK;
}

fe_heap *fe_heap_in_use(void)
{
    return innermost ? innermost->heap : NULL;
}

fe_heap *fe_heap_use(fe_heap *heap)
{
    fe_heap *before = fe_heap_in_use();
    if (innermost)
        innermost->heap = heap;
    return before;
}

void fe_out_of_memory(void)
{
    if (innermost)
        longjmp(innermost->escape, 1);
}

const char *fe_errno_text(void)
{
    if (errno == ENOMEM)
        fe_out_of_memory();
    return strerror(errno);
}

static void put_in(struct fe_block *block, struct fe_block **link)
{
    block->link = link;
    block->next = link ? *link : NULL;
    if (block->next)
        block->next->link = &block->next;
    if (link)
        *link = block;
}

static void take_out(struct fe_block *block)
{
    assert(!block->link || *block->link == block);
    if (block->link)
        *block->link = block->next;
    if (block->next)
        block->next->link = block->link;
}

static struct fe_block *block_of(void *memory)
{
    return (struct fe_block *)(void *)((char *)memory - offsetof(struct fe_block, memory));
}

/* Allocates zeroed memory, or resizes a block; NULL if there is no memory. */
static struct fe_block *allocate(struct fe_block *old, size_t size)
{
    size_t whole = sizeof *old + (size ? size : 1);
    if (size > SIZE_MAX / 2)
        return NULL;
    return old ? realloc(old, whole) : calloc(1, whole);
}

void *fe_alloc(size_t size)
{
    struct fe_block *block = allocate(NULL, size);
    if (!block) {
        fe_out_of_memory();
        return NULL;
    }
    fe_heap *heap = fe_heap_in_use();
    put_in(block, heap ? &heap->blocks : NULL);
    return block->memory;
}

void *fe_resize(void *memory, size_t size)
{
    if (!memory)
        return fe_alloc(size);
    struct fe_block *block = block_of(memory), **link = block->link;
    take_out(block);
    struct fe_block *moved = allocate(block, size);
    put_in(moved ? moved : block, link);
    if (!moved)
        fe_out_of_memory();
    return moved ? moved->memory : NULL;
}

void fe_free(void *memory)
{
    if (!memory)
        return;
    take_out(block_of(memory));
    free(block_of(memory));
}

void ff_free(void *memory)
{
    fe_free(memory);
}

void fe_resource_add(fe_resource *resource, void (*close)(void *object), void *object)
{
    assert(close);
    *resource = (fe_resource){.close = close, .object = object};
    if (!fe_heap_in_use())
        return;
    resource->link = &fe_heap_in_use()->resources;
    resource->next = *resource->link;
    if (resource->next)
        resource->next->link = &resource->next;
    *resource->link = resource;
}

void fe_resource_remove(fe_resource *resource)
{
    assert(!resource->link || *resource->link == resource);
    if (resource->link)
        *resource->link = resource->next;
    if (resource->next)
        resource->next->link = resource->link;
    resource->next = NULL;
    resource->link = NULL;
}

void fe_heap_close(fe_heap *heap)
{
    while (heap->resources) {
        fe_resource *newest = heap->resources;
        fe_resource_remove(newest);
        newest->close(newest->object);
    }
    while (heap->blocks)
        fe_free(heap->blocks->memory);
}

char *fe_copy_text(const char *text, size_t length)
{
    char *copy = fe_alloc(length + 1);
    memcpy(copy, text, length);
    return copy;
}

char *fe_print_list(const char *format, va_list args)
{
    va_list again;
    va_copy(again, args);
    int length = vsnprintf(NULL, 0, format, again);
    va_end(again);
    if (length < 0)
        fe_out_of_memory();
    char *text = fe_alloc((size_t)length + 1);
    vsnprintf(text, (size_t)length + 1, format, args);
    return text;
}

char *fe_print_text(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    char *text = fe_print_list(format, args);
    va_end(args);
    return text;
}

struct fe_piece {
    struct fe_piece *next;
    max_align_t memory[];
};

void *fe_arena_alloc(fe_arena *arena, size_t size)
{
    struct fe_piece *piece = fe_alloc(sizeof *piece + size);
    piece->next = arena->pieces;
    arena->pieces = piece;
    return piece->memory;
}

char *fe_arena_text(fe_arena *arena, const char *text, size_t length)
{
    char *copy = fe_arena_alloc(arena, length + 1);
    memcpy(copy, text, length);
    return copy;
}

void fe_arena_free(fe_arena *arena)
{
    while (arena->pieces) {
        struct fe_piece *next = arena->pieces->next;
        fe_free(arena->pieces);
        arena->pieces = next;
    }
}
