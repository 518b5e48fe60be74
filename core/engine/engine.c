/* SPDX-License-Identifier: MIT */
#include <flankfilm/engine.h>

#include "value/memory.h"

ff_status ff_protected(void (*function)(void *ctx), void *ctx)
{
    fe_heap heap = {.blocks = NULL};
    ff_status status = fe_protected(&heap, function, ctx);
    fe_heap_close(&heap);
    return status;
}

void ff_free(void *memory)
{
    fe_free(memory);
}
