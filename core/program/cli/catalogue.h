/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models as a printer of the catalogue sees them. */
#ifndef CLI_CATALOGUE_LIST_H
#define CLI_CATALOGUE_LIST_H

#include "command.h"

#include "../../engine/value/memory.h"

#include <flankfilm/catalogue.h>

typedef struct cli_listing {
    fe_arena arena;
    const ff_catalogue_entry **entries;
    size_t count;
} cli_listing; /* starts zeroed */

/* loaded: NULL with what the report says of it. */
void cli_listing_add(cli_listing *listing, const char *id, const fe_loaded *loaded,
                     const char *user, const fe_report *report);
/* page: the only entry in full. False with errors in the report. */
bool cli_listing_print(const cli_listing *listing, fe_library *library, const char *printer,
                       bool page, FILE *out, fe_report *report);
void cli_listing_free(cli_listing *listing);

#endif
