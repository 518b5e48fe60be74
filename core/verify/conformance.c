/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds what a kind of model asks of its members: a model of its own says so. */
#include "subject.h"

#include "../plugin/param.h"
#include "../value/memory.h"

#include <stdlib.h>
#include <string.h>

static bool is_there(ff_library *library, const char *id)
{
    size_t count;
    const char *const *ids = ff_library_ids(library, &count);
    for (size_t i = 0; i < count; i++)
        if (!strcmp(ids[i], id))
            return true;
    return false;
}

bool ff_kind_open(ff_kindred *kind, ff_library *library, const char *name, ff_report *report)
{
    char *id = ff_print_text("%s/%s", FF_CONFORMANCE_KIND, name);
    const ff_loaded *loaded =
        is_there(library, id) ? ff_library_load(library, id, FF_NOWHERE, report) : NULL;
    *kind = (ff_kindred){.asks = NULL};
    if (loaded && loaded->model->param_count + loaded->model->input_count == 0) {
        const ff_model *model = loaded->model;
        const ff_feed nothing = {.loaded = loaded};
        bool good = ff_trial_open(&kind->author, &nothing) == FF_OK;
        for (size_t i = 0; i < model->output_count && good && !kind->asks; i++) {
            const char *service = ff_model_output(model, i)->service;
            if (service && !strcmp(service, FF_CONFORMANCE_ID))
                kind->asks = model->service(kind->author.self, (uint32_t)i);
        }
    }
    if (loaded && !kind->asks)
        ff_error(report, FF_EXIT_PLUGIN, FF_NOWHERE, NULL, "%s does not offer %s by itself", id,
                 FF_CONFORMANCE_ID);
    free(id);
    return kind->asks;
}

void ff_kind_close(ff_kindred *kind)
{
    ff_trial_close(&kind->author);
}

/* The plain law of the first kind that may feed the row and has one of its interface. */
static const void *plain_law(ff_library *library, const ff_port *row)
{
    ff_report *report = ff_report_new();
    const void *law = NULL;
    char kind[64];
    for (size_t i = 0; !law && ff_word_at(row->from ? row->from : row->name, i, kind, sizeof kind);
         i++) {
        ff_kindred *its = ff_alloc(sizeof *its); /* until the process ends */
        if (ff_kind_open(its, library, kind, report) && its->asks->service &&
            !strcmp(its->asks->service, row->service))
            law = its->asks->plain;
    }
    ff_report_free(report);
    return law;
}

const void **ff_plain_laws(ff_library *library, const ff_loaded *loaded)
{
    const void **laws = ff_alloc((loaded->model->input_count + 1) * sizeof *laws);
    for (size_t i = 0; i < loaded->model->input_count; i++)
        if (ff_model_input(loaded->model, i)->service)
            laws[i] = plain_law(library, ff_model_input(loaded->model, i));
    return laws;
}
