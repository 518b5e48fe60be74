/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodes as models see them. */
#include "param.h"

#include "../value/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

ff_written *fe_written_new(const fe_node *node)
{
    ff_written *written = fe_alloc(sizeof *written);
    *written = (ff_written){.size = sizeof *written, .count = node->count};
    written->place = node->place.source ? node : NULL;
    if (node->kind == FE_SCALAR) {
        written->text = fe_copy_text(node->text, strlen(node->text));
        return written;
    }
    const ff_written **items = fe_alloc((node->count + 1) * sizeof *items);
    const char **keys = node->kind == FE_MAP ? fe_alloc((node->count + 1) * sizeof *keys) : NULL;
    for (size_t i = 0; i < node->count; i++) {
        items[i] = fe_written_new(node->items[i]);
        if (keys)
            keys[i] = fe_copy_text(node->keys[i], strlen(node->keys[i]));
    }
    written->items = items;
    written->keys = keys;
    return written;
}

void fe_written_free(const ff_written *written)
{
    for (size_t i = 0; written && i < written->count; i++) {
        fe_written_free(written->items[i]);
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
