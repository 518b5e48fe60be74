/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Service "toy.law/1": gain * x. */
#ifndef TOY_H
#define TOY_H

#include <flankfilm/plugin.h>

#define TOY_LAW_ID "toy.law/1"

typedef struct toy_law {
    size_t size;
    const void *self;
    double (*eval)(const void *self, double x);
} toy_law;

#endif
