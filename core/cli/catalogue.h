/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models as a printer of the catalogue sees them. */
#ifndef FF_CATALOGUE_LIST_H
#define FF_CATALOGUE_LIST_H

#include "command.h"

#include "../value/memory.h"

#include <flankfilm/catalogue.h>

typedef struct ff_listing {
    ff_arena arena;
    const ff_catalogue_entry **entries;
    size_t count;
} ff_listing; /* starts zeroed */

/* loaded: NULL with what the report says of it. */
void ff_listing_add(ff_listing *listing, const char *id, const ff_loaded *loaded, const char *user,
                    const ff_report *report);
/* page: the only entry in full. False with errors in the report. */
bool ff_listing_print(const ff_listing *listing, ff_library *library, const char *printer,
                      bool page, FILE *out, ff_report *report);
void ff_listing_free(ff_listing *listing);

#endif
