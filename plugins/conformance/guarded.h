/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers between guard zones, which tell of a write outside. */
#ifndef GUARDED_H
#define GUARDED_H

#include <stdbool.h>
#include <stddef.h>

typedef struct guarded {
    double *data;
    size_t count;
} guarded;

guarded guarded_new(size_t count); /* holds NaN */
bool guarded_whole(const guarded *g);
void guarded_free(guarded *g);

#endif
