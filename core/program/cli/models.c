/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands models and schema, which print the tables of the models. */
#include "../terminal/terminal.h"
#include "command.h"

#include "../catalogue/catalogue.h"
#include "../results/json.h"
#include "../results/target.h"

#include <stdlib.h>
#include <string.h>

/* Lists all models, or those of one kind. Errors of models that cannot be loaded go to the report,
 * which may be NULL. */
static void list(catalogue *models, ff_engine *engine, const char *kind, ff_report *report)
{
    size_t count = 0, length = kind ? strlen(kind) : 0;
    const char *const *ids = ff_engine_ids(engine, &count);
    for (size_t i = 0; i < count; i++) {
        ff_report *captured = report ? report : ff_report_new();
        if (!kind || (!strncmp(ids[i], kind, length) && ids[i][length] == '/'))
            catalogue_add(models, ids[i], ff_engine_model(engine, ids[i], FF_NOWHERE, captured), "",
                          captured);
        if (!report)
            ff_report_free(captured);
    }
}

int cli_models(const cli_options *options)
{
    const char *id = options->operand;
    ff_report *report = ff_report_new();
    ff_engine *engine = cli_engine_new(options);
    catalogue models = {.count = 0};
    int code = EXIT_SUCCESS;
    list(&models, engine, id, NULL);
    bool page = id && models.count == 0;
    const ff_loaded *loaded = page ? ff_engine_model(engine, id, FF_NOWHERE, report) : NULL;
    if (loaded)
        catalogue_add(&models, id, loaded, "", report);
    if (!id && models.count == 0 && !options->json)
        puts("no models found; name their directory with --plugin-path");
    else if (page && !loaded)
        code = cli_refuse(report, options, "flankfilm models lists them");
    else if (options->json)
        catalogue_print_json(&models, page, CLI_VERSION);
    else if (cli_option(options, "markdown"))
        catalogue_print_markdown(&models, page);
    else
        catalogue_print_text(&models, page);
    catalogue_free(&models);
    ff_engine_close(engine);
    ff_report_free(report);
    return code;
}

int cli_schema(const cli_options *options)
{
    ff_engine *engine = cli_engine_new(options);
    catalogue models = {.count = 0};
    results_target target = {.report = ff_report_new(), .begins = "{\n \"type\": \"object\""};
    list(&models, engine, NULL, target.report);
    if (options->operand) {
        target.path = memory_print_text("%s", options->operand);
        if (results_target_open(&target, false)) {
            catalogue_print_schema(&models, CLI_VERSION, target.file.out);
            results_target_commit(&target);
        }
    } else {
        catalogue_print_schema(&models, CLI_VERSION, stdout);
        putchar('\n');
    }
    if (ff_report_errors(target.report))
        terminal_print_messages(target.report, stderr, terminal_colour(stderr));
    int code = ff_report_fault(target.report);
    results_target_close(&target);
    catalogue_free(&models);
    ff_engine_close(engine);
    ff_report_free(target.report);
    return code;
}
