/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The literature behind a run: that of every model that runs. */
#include "catalogue.h"

#include <string.h>

/* Models that a study puts into a stage. */
static void add_varied(ff_listing *listing, ff_session *session)
{
    const ff_study *study = session->study;
    for (size_t k = 0; study && k < study->varied_count; k++) {
        const ff_varied *varied = &study->varied[k];
        size_t length = strlen(varied->path), points = study->points[varied->axis];
        bool use = length > 4 && !strcmp(varied->path + length - 4, ".use");
        for (size_t i = 0; use && i < points; i++) {
            const char *id = ff_varied_value(varied, i);
            const ff_loaded *loaded =
                ff_names_kind_only(id)
                    ? NULL
                    : ff_library_load(session->library, id, FF_NOWHERE, session->report);
            if (loaded)
                ff_listing_add(listing, id, loaded, "study", session->report);
        }
    }
}

int ff_cite(const ff_options *options)
{
    ff_session session;
    ff_listing listing = {.count = 0};
    int code = FF_EXIT_OK;
    bool good = ff_session_open(&session, options, false) &&
                ff_choose_models(&session); /* what is not known before is not cited */
    for (size_t i = 0; good && i < session.pipeline->count; i++) {
        const ff_stage *stage = &session.pipeline->stages[session.pipeline->order[i]];
        if (stage->needed)
            ff_listing_add(&listing, stage->use, stage->loaded, stage->name, session.report);
    }
    if (good)
        add_varied(&listing, &session);
    good = good && ff_report_errors(session.report) == 0 &&
           ff_listing_print(&listing, session.library, "bibtex", false, stdout, session.report);
    if (!good)
        code = ff_refuse(session.report, options, "nothing is cited");
    ff_listing_free(&listing);
    ff_session_close(&session);
    return code;
}
