/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a kind of model asks of its members: a model of its own says so. */
#ifndef FF_KIND_H
#define FF_KIND_H

#include "library.h"

#include <flankfilm/conformance.h>

typedef struct ff_kindred {
    const ff_conformance *asks;
    const ff_loaded *author;
    void *self;
} ff_kindred;

/* False when no model says, or with an error. What `asks` points to lives until it is closed. */
bool ff_kind_open(ff_kindred *kind, ff_library *library, const char *name, ff_report *report);
void ff_kind_close(ff_kindred *kind);

#endif
