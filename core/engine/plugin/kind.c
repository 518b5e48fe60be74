/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "kind.h"

#include "../value/memory.h"
#include "guard.h"

#include <stdlib.h>
#include <string.h>

static bool is_there(fe_library *library, const char *id)
{
    size_t count;
    const char *const *ids = fe_library_ids(library, &count);
    for (size_t i = 0; i < count; i++)
        if (!strcmp(ids[i], id))
            return true;
    return false;
}

/* A model that has nothing to compute needs little of its host. */
static ff_status fail(void *ctx, ff_status status, const char *item, const char *text)
{
    (void)ctx, (void)item, (void)text;
    return status;
}

static const void *find_offer(fe_kindred *kind)
{
    static const ff_host host = {
        .size = sizeof host, .abi_minor = FF_ABI_MINOR, .ctx = NULL, .fail = fail};
    const ff_model *model = kind->author->model;
    const void *offer = NULL;
    fe_guard_mark mark = fe_guard_enter(kind->author->path, NULL, "create and service");
    bool good =
        model->param_count + model->input_count == 0 && model->create(&host, &kind->self) == FF_OK;
    for (size_t i = 0; i < model->output_count && good && !offer; i++) {
        const char *service = ff_model_output(model, i)->service;
        if (service && !strcmp(service, FF_CONFORMANCE_ID))
            offer = model->service(kind->self, (uint32_t)i);
    }
    fe_guard_leave(mark);
    return offer;
}

bool fe_kind_open(fe_kindred *kind, fe_library *library, const char *name, fe_report *report)
{
    char *id = fe_print_text("%s/%s", FF_CONFORMANCE_KIND, name);
    *kind = (fe_kindred){.asks = NULL};
    if (is_there(library, id))
        kind->author = fe_library_load(library, id, FE_NOWHERE, report);
    if (kind->author && !(kind->asks = find_offer(kind)))
        fe_error(report, FE_EXIT_PLUGIN, FE_NOWHERE, NULL, "%s does not offer %s by itself", id,
                 FF_CONFORMANCE_ID);
    free(id);
    return kind->asks;
}

void fe_kind_close(fe_kindred *kind)
{
    if (kind->asks && kind->author->model->destroy)
        kind->author->model->destroy(kind->self);
    kind->asks = NULL;
}
