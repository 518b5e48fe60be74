/* SPDX-License-Identifier: MIT */
#include "build.h"

#include <stdlib.h>
#include <string.h>

/* "kind/name", also of a name alone; the caller frees it. */
static char *id_of(const ff_service_choice *choice, int kind)
{
    return strchr(choice->name, '/')
               ? fe_print_text("%s", choice->name)
               : fe_print_text("%.*s/%s", kind, strchr(choice->interface, '.') + 1, choice->name);
}

/* Whether the model exists and offers the service; checked before its parameters are. */
static bool serves(ff_library *library, const char *id, const ff_service_choice *choice,
                   ff_report *report)
{
    const ff_loaded *loaded = ff_library_load(library, id, FF_NOWHERE, report);
    return loaded && (ff_model_find_service(loaded->model, choice->interface) >= 0 ||
                      ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                               "%s cannot be used for %s: it does not offer the service \"%s\"", id,
                               choice->option, choice->interface));
}

bool ff_service_open(ff_service *service, ff_library *library, const ff_service_choice *choice,
                     ff_report *report)
{
    const char *kind = strchr(choice->interface, '.') + 1;
    int length = (int)strcspn(kind, "/");
    *service = (ff_service){.table = NULL};
    char *id = id_of(choice, length);
    if (!serves(library, id, choice, report)) {
        fe_free(id);
        return false;
    }
    service->tree = ff_tree_parse(choice->option, ".", "format: 1\n", report);
    char *use = fe_print_text("pipeline.%.*s.use=%s", length, kind, id);
    ff_tree_set(service->tree, use, NULL, ff_file_keys(), report);
    fe_free(use);
    fe_free(id);
    for (size_t i = 0; i < choice->setting_count; i++) {
        char *text = fe_print_text("%.*s.%s", length, kind, choice->settings[i]);
        ff_tree_set(service->tree, text, "pipeline", ff_file_keys(), report);
        fe_free(text);
    }
    service->pipeline = ff_pipeline_build(service->tree, library, true, report);
    if (!service->pipeline || ff_report_errors(report) > 0)
        return false;
    ff_stage *stage = &service->pipeline->stages[0];
    int output = ff_model_find_service(stage->loaded->model, choice->interface);
    service->table = fe_fetch_service(stage, (uint32_t)output, report);
    return ff_report_errors(report) == 0;
}

void ff_service_close(ff_service *service)
{
    ff_pipeline_free(service->pipeline);
    ff_tree_free(service->tree);
    *service = (ff_service){.table = NULL};
}

bool ff_service_call(const ff_service *service, const char *action,
                     ff_status (*work)(const void *table, void *ctx), void *ctx, ff_report *report)
{
    size_t errors = ff_report_errors(report);
    fe_call call = fe_call_begin(&service->pipeline->stages[0], action);
    ff_status status = work(service->table, ctx);
    bool reported = status != FF_OK && ff_report_errors(report) > errors;
    return fe_call_end(&call, reported ? FF_OK : status, report) && !reported;
}
