/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the model conformance/KIND provides for tests: checks of the kind, and simple laws. */
#include "private.h"

#include "../memory/memory.h"

#include <stdlib.h>
#include <string.h>

static bool can_be_found(ff_engine *engine, const char *id)
{
    size_t count;
    const char *const *ids = ff_engine_ids(engine, &count);
    for (size_t i = 0; i < count; i++)
        if (!strcmp(ids[i], id))
            return true;
    return false;
}

bool verify_kind_checks_open(verify_kind_checks *checks, ff_engine *engine, const char *kind,
                             ff_report *report)
{
    const void *offer = NULL;
    char *id = memory_print_text("%s/%s", FF_CONFORMANCE_KIND, kind);
    *checks = (verify_kind_checks){.offer = NULL};
    bool known =
        can_be_found(engine, id) && ff_engine_model(engine, id, FF_NOWHERE, report) != NULL;
    if (known && ff_instance_new(engine, id, &checks->instance) == FF_OK)
        ff_instance_service(checks->instance, FF_CONFORMANCE_ID, &offer);
    if (known && !offer)
        ff_error(report, FF_FAULT_PLUGIN, FF_NOWHERE, NULL, "%s does not offer %s by itself", id,
                 FF_CONFORMANCE_ID);
    free(id);
    checks->offer = offer;
    return offer;
}

void verify_kind_checks_close(verify_kind_checks *checks)
{
    ff_instance_close(checks->instance);
    *checks = (verify_kind_checks){.offer = NULL};
}

/* Returns the simple law of the first kind that may feed the row and provides one with its
   interface. */
static const void *plain_law(ff_engine *engine, const ff_port *row)
{
    ff_report *report = ff_report_new();
    const void *law = NULL;
    char kind[64];
    for (size_t i = 0; !law && ff_word_at(row->from ? row->from : row->name, i, kind, sizeof kind);
         i++) {
        /* lives until the process ends */
        verify_kind_checks *checks = memory_alloc(sizeof *checks);
        if (verify_kind_checks_open(checks, engine, kind, report) && checks->offer->service &&
            !strcmp(checks->offer->service, row->service))
            law = checks->offer->plain;
    }
    ff_report_free(report);
    return law;
}

const void **verify_plain_laws(ff_engine *engine, const ff_loaded *loaded)
{
    const ff_model *model = loaded->model;
    const void **laws = memory_alloc(model->input_count * sizeof *laws);
    for (size_t i = 0; i < model->input_count; i++)
        if (ff_model_input(model, i)->service)
            laws[i] = plain_law(engine, ff_model_input(model, i));
    return laws;
}
