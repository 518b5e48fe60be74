/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodes as models see them. */
#include "param.h"

#include "../value/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

ff_written *ff_written_new(const ff_node *node)
{
    ff_written *written = ff_alloc(sizeof *written);
    *written = (ff_written){.size = sizeof *written, .count = node->count};
    written->place = node->place.source ? node : NULL;
    if (node->kind == FF_SCALAR) {
        written->text = ff_copy_text(node->text, strlen(node->text));
        return written;
    }
    const ff_written **items = ff_alloc((node->count + 1) * sizeof *items);
    const char **keys = node->kind == FF_MAP ? ff_alloc((node->count + 1) * sizeof *keys) : NULL;
    for (size_t i = 0; i < node->count; i++) {
        items[i] = ff_written_new(node->items[i]);
        if (keys)
            keys[i] = ff_copy_text(node->keys[i], strlen(node->keys[i]));
    }
    written->items = items;
    written->keys = keys;
    return written;
}

void ff_written_free(const ff_written *written)
{
    for (size_t i = 0; written && i < written->count; i++) {
        ff_written_free(written->items[i]);
        if (written->keys)
            free((void *)(uintptr_t)written->keys[i]);
    }
    if (!written)
        return;
    free((void *)(uintptr_t)written->text);
    free((void *)(uintptr_t)written->keys);
    free((void *)(uintptr_t)written->items);
    free((void *)(uintptr_t)written);
}
