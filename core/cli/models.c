/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the tables of the models say: models and schema. */
#include "catalogue.h"
#include "json.h"
#include "text.h"

#include <errno.h>
#include <string.h>

/* All models, or those of one kind; report: NULL, or what takes errors of those that cannot be
   loaded. */
static void list(ff_listing *listing, ff_library *library, const char *kind, ff_report *report)
{
    size_t count = 0, length = kind ? strlen(kind) : 0;
    const char *const *ids = ff_library_ids(library, &count);
    for (size_t i = 0; i < count; i++) {
        ff_report *said = report ? report : ff_report_new();
        if (!kind || (!strncmp(ids[i], kind, length) && ids[i][length] == '/'))
            ff_listing_add(listing, ids[i], ff_library_load(library, ids[i], FF_NOWHERE, said), "",
                           said);
        if (!report)
            ff_report_free(said);
    }
}

static int tell_none(const ff_options *options)
{
    if (options->json)
        ff_json_print(json_pack("{s:s, s:s, s:i, s:[]}", "flankfilm", FF_VERSION, "status", "ok",
                                "exit", FF_EXIT_OK, "models"));
    else
        printf("no models found; name their directory with --plugin-path\n");
    return FF_EXIT_OK;
}

int ff_models(const ff_options *options)
{
    const char *id = options->operand;
    const char *printer = options->json ? "json" : options->markdown ? "markdown" : "text";
    ff_report *report = ff_report_new();
    ff_library *library = ff_library_new(options->plugin_paths, options->plugin_path_count);
    ff_listing listing = {.count = 0};
    int code = FF_EXIT_OK;
    list(&listing, library, id, NULL);
    bool page = id && listing.count == 0;
    const ff_loaded *loaded = page ? ff_library_load(library, id, FF_NOWHERE, report) : NULL;
    if (loaded)
        ff_listing_add(&listing, id, loaded, "", report);
    if (!id && listing.count == 0)
        code = tell_none(options);
    else if ((page && !loaded) ||
             !ff_listing_print(&listing, library, printer, page, stdout, report))
        code = ff_refuse(report, options,
                         page ? "flankfilm models lists what there is" : "nothing was listed");
    ff_listing_free(&listing);
    ff_library_free(library);
    ff_report_free(report);
    return code;
}

int ff_schema(const ff_options *options)
{
    ff_report *report = ff_report_new();
    ff_library *library = ff_library_new(options->plugin_paths, options->plugin_path_count);
    ff_listing listing = {.count = 0};
    const char *path = options->operand;
    list(&listing, library, NULL, report);
    FILE *out = path ? fopen(path, "w") : stdout;
    if (out && ff_listing_print(&listing, library, "schema", false, out, report) && !path)
        putchar('\n');
    if (!out || (path && (ferror(out) || fclose(out) != 0)))
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL, "%s cannot be written: %s", path,
                 strerror(errno));
    if (ff_report_errors(report))
        ff_report_print(report, stderr, ff_colour(stderr));
    int code = ff_report_exit_code(report);
    ff_listing_free(&listing);
    ff_library_free(library);
    ff_report_free(report);
    return code;
}
