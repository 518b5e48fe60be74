/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command cite: prints the entry of the program with version and commit, and the literature of
 * every model that runs. */
#include "../catalogue/catalogue.h"
#include "command.h"
#include "commit.h"

#include "../accuracy/models.h"

#include <string.h>

/* Adds the models that the cases of a study use in a stage. */
static void add_varied(catalogue *models, cli_session *session)
{
    study_use at = {0};
    const char *id;
    while (session->study && (id = study_next_use(session->study, &at))) {
        const ff_loaded *loaded =
            accuracy_is_open_use(id)
                ? NULL
                : ff_engine_model(session->engine, id, FF_NOWHERE, session->report);
        if (loaded)
            catalogue_add(models, id, loaded, "study", session->report);
    }
}

int cli_cite(const cli_options *options)
{
    cli_session session;
    catalogue models = {.count = 0};
    int code = EXIT_SUCCESS;
    bool good = cli_session_open(&session, options, false);
    for (size_t i = 0; good && i < session.pipeline->count; i++) {
        const ff_stage *stage = &session.pipeline->stages[session.pipeline->order[i]];
        if (stage->needed)
            catalogue_add(&models, stage->use, stage->loaded, stage->name, session.report);
    }
    if (good)
        add_varied(&models, &session);
    if (good && ff_report_errors(session.report) == 0)
        catalogue_print_bibtex(&models, CLI_VERSION, CLI_COMMIT);
    else
        code = cli_refuse(session.report, options, "nothing is cited");
    catalogue_free(&models);
    cli_session_close(&session);
    return code;
}
