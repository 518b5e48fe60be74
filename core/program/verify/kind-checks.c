/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "private.h"

#include "../memory/memory.h"

#include <stdlib.h>
#include <string.h>

static bool can_be_found(ff_library *library, const char *id)
{
    size_t count;
    const char *const *ids = ff_library_ids(library, &count);
    for (size_t i = 0; i < count; i++)
        if (!strcmp(ids[i], id))
            return true;
    return false;
}

/* A model that has nothing to compute needs little of its host. */
static ff_status host_fail(void *ctx, ff_status status, const char *item, const char *text)
{
    (void)ctx, (void)item, (void)text;
    return status;
}

static const void *find_offer(verify_kind_checks *checks)
{
    static const ff_host host = {
        .size = sizeof host, .abi_minor = FF_ABI_MINOR, .ctx = NULL, .fail = host_fail};
    const ff_model *model = checks->loaded->model;
    const void *offer = NULL;
    ff_guard_mark mark = ff_guard_enter(
        (ff_guard_mark){.path = checks->loaded->path, .action = "create and service"});
    checks->created = model->param_count + model->input_count == 0 &&
                      model->create(&host, &checks->self) == FF_OK;
    for (size_t i = 0; i < model->output_count && checks->created && !offer; i++) {
        const char *service = ff_model_output(model, i)->service;
        if (service && !strcmp(service, FF_CONFORMANCE_ID))
            offer = model->service(checks->self, (uint32_t)i);
    }
    ff_guard_leave(mark);
    return offer;
}

bool verify_kind_checks_open(verify_kind_checks *checks, ff_library *library, const char *kind,
                             ff_report *report)
{
    char *id = memory_print_text("%s/%s", FF_CONFORMANCE_KIND, kind);
    *checks = (verify_kind_checks){.offer = NULL};
    if (can_be_found(library, id))
        checks->loaded = ff_library_load(library, id, FF_NOWHERE, report);
    if (checks->loaded && !(checks->offer = find_offer(checks)))
        ff_error(report, FF_FAULT_PLUGIN, FF_NOWHERE, NULL, "%s does not offer %s by itself", id,
                 FF_CONFORMANCE_ID);
    free(id);
    return checks->offer;
}

void verify_kind_checks_close(verify_kind_checks *checks)
{
    if (checks->created && checks->loaded->model->destroy)
        checks->loaded->model->destroy(checks->self);
    *checks = (verify_kind_checks){.offer = NULL};
}

/* The plain law of the first kind that may feed the row and has one of its interface. */
static const void *plain_law(ff_library *library, const ff_port *row)
{
    ff_report *report = ff_report_new();
    const void *law = NULL;
    char kind[64];
    for (size_t i = 0; !law && ff_word_at(row->from ? row->from : row->name, i, kind, sizeof kind);
         i++) {
        verify_kind_checks *checks = memory_alloc(sizeof *checks); /* until the process ends */
        if (verify_kind_checks_open(checks, library, kind, report) && checks->offer->service &&
            !strcmp(checks->offer->service, row->service))
            law = checks->offer->plain;
    }
    ff_report_free(report);
    return law;
}

const void **verify_plain_laws(ff_library *library, const ff_loaded *loaded)
{
    const ff_model *model = loaded->model;
    const void **laws = memory_alloc(model->input_count * sizeof *laws);
    for (size_t i = 0; i < model->input_count; i++)
        if (ff_model_input(model, i)->service)
            laws[i] = plain_law(library, ff_model_input(model, i));
    return laws;
}
