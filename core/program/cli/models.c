/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the tables of the models say: models and schema. */
#include "catalogue.h"
#include "json.h"
#include "text.h"

#include <errno.h>
#include <string.h>

/* All models, or those of one kind; report: NULL, or what takes errors of those that cannot be
   loaded. */
static void list(cli_listing *listing, fe_library *library, const char *kind, fe_report *report)
{
    size_t count = 0, length = kind ? strlen(kind) : 0;
    const char *const *ids = fe_library_ids(library, &count);
    for (size_t i = 0; i < count; i++) {
        fe_report *said = report ? report : fe_report_new();
        if (!kind || (!strncmp(ids[i], kind, length) && ids[i][length] == '/'))
            cli_listing_add(listing, ids[i], fe_library_load(library, ids[i], FE_NOWHERE, said), "",
                            said);
        if (!report)
            fe_report_free(said);
    }
}

static int tell_none(const cli_options *options)
{
    if (options->json)
        cli_json_print(json_pack("{s:s, s:s, s:i, s:[]}", "flankfilm", CLI_VERSION, "status", "ok",
                                 "exit", FE_EXIT_OK, "models"));
    else
        printf("no models found; name their directory with --plugin-path\n");
    return FE_EXIT_OK;
}

int cli_models(const cli_options *options)
{
    const char *id = options->operand;
    const char *printer = options->json ? "json" : options->markdown ? "markdown" : "text";
    fe_report *report = fe_report_new();
    fe_library *library = fe_library_new(options->plugin_paths, options->plugin_path_count);
    cli_listing listing = {.count = 0};
    int code = FE_EXIT_OK;
    list(&listing, library, id, NULL);
    bool page = id && listing.count == 0;
    const fe_loaded *loaded = page ? fe_library_load(library, id, FE_NOWHERE, report) : NULL;
    if (loaded)
        cli_listing_add(&listing, id, loaded, "", report);
    if (!id && listing.count == 0)
        code = tell_none(options);
    else if ((page && !loaded) ||
             !cli_listing_print(&listing, library, printer, page, stdout, report))
        code = cli_refuse(report, options,
                          page ? "flankfilm models lists what there is" : "nothing was listed");
    cli_listing_free(&listing);
    fe_library_free(library);
    fe_report_free(report);
    return code;
}

int cli_schema(const cli_options *options)
{
    fe_report *report = fe_report_new();
    fe_library *library = fe_library_new(options->plugin_paths, options->plugin_path_count);
    cli_listing listing = {.count = 0};
    const char *path = options->operand;
    list(&listing, library, NULL, report);
    FILE *out = path ? fopen(path, "w") : stdout;
    if (out && cli_listing_print(&listing, library, "schema", false, out, report) && !path)
        putchar('\n');
    if (!out || (path && (ferror(out) || fclose(out) != 0)))
        fe_error(report, FE_EXIT_INPUT, FE_NOWHERE, NULL, "%s cannot be written: %s", path,
                 strerror(errno));
    if (fe_report_errors(report))
        fe_report_print(report, stderr, cli_colour(stderr));
    int code = fe_report_exit_code(report);
    cli_listing_free(&listing);
    fe_library_free(library);
    fe_report_free(report);
    return code;
}
