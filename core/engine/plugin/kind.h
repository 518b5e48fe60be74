/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a kind of model asks of its members: a model of its own says so. */
#ifndef FE_KIND_H
#define FE_KIND_H

#include "library.h"

#include <flankfilm/conformance.h>

typedef struct fe_kindred {
    const ff_conformance *asks;
    const fe_loaded *author;
    void *self;
} fe_kindred;

/* False when no model says, or with an error. What `asks` points to lives until it is closed. */
bool fe_kind_open(fe_kindred *kind, fe_library *library, const char *name, fe_report *report);
void fe_kind_close(fe_kindred *kind);

#endif
