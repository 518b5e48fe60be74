/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "catalogue.h"
#include "text.h"

#include "../../engine/pipeline/tool.h"
#include "../../engine/plugin/clean.h"
#include "../../engine/plugin/param.h"

#include <stdlib.h>
#include <string.h>

static const char *keep(cli_listing *listing, const char *text)
{
    char *copy = text ? fe_arena_text(&listing->arena, text, strlen(text)) : NULL;
    if (copy)
        fe_clean_text(copy, strlen(text) + 1, text);
    return copy;
}

void cli_listing_add(cli_listing *listing, const char *id, const fe_loaded *loaded,
                     const char *user, const fe_report *report)
{
    ff_catalogue_entry *entry = fe_arena_alloc(&listing->arena, sizeof *entry);
    const fe_message *why = loaded ? NULL : fe_report_first(report);
    *entry = (ff_catalogue_entry){.size = sizeof *entry,
                                  .id = keep(listing, id),
                                  .model = loaded ? loaded->model : NULL,
                                  .why = keep(listing, why ? why->text : NULL),
                                  .file = keep(listing, loaded ? loaded->path : NULL),
                                  .user = keep(listing, user)};
    listing->entries = fe_resize(listing->entries, (listing->count + 1) * sizeof *listing->entries);
    listing->entries[listing->count++] = entry;
}

static void put(void *ctx, const char *text)
{
    fputs(text, ctx);
}

/* Of those who print for a terminal. */
static void wrap(void *ctx, const char *text, int32_t column, int32_t indent)
{
    (void)ctx;
    cli_print_wrapped(text, column, indent);
}

static void expect(void *ctx, const ff_param *row, char *out, size_t size)
{
    (void)ctx;
    fe_param_expectation(row, out, size);
}

static ff_status call_print(const void *table, void *ctx)
{
    const ff_catalogue_printer *printer = table;
    return printer->print(printer->self, ctx);
}

bool cli_listing_print(const cli_listing *listing, fe_library *library, const char *printer,
                       bool page, FILE *out, fe_report *report)
{
    const fe_tool_choice choice = {
        .option = "the catalogue", .interface = FF_CATALOGUE_ID, .name = printer};
    ff_catalogue catalogue = {.size = sizeof catalogue,
                              .ctx = out,
                              .version = CLI_VERSION,
                              .entries = listing->entries,
                              .entry_count = listing->count,
                              .page = page,
                              .top_keys = fe_pipeline_top_keys,
                              .study_keys = study_keys,
                              .put = put,
                              .wrap = wrap,
                              .expect = expect};
    fe_tool tool;
    bool good = fe_tool_open(&tool, library, &choice, report) &&
                fe_tool_call(&tool, "print", call_print, &catalogue, report);
    fe_tool_close(&tool);
    return good;
}

void cli_listing_free(cli_listing *listing)
{
    free(listing->entries);
    fe_arena_free(&listing->arena);
    *listing = (cli_listing){.count = 0};
}
