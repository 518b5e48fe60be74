/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "service.h"

#include "build.h"

#include <stdlib.h>
#include <string.h>

/* "kind/name", also of a name alone; the caller frees it. */
static char *id_of(const fe_service_choice *choice, int kind)
{
    return strchr(choice->name, '/')
               ? fe_print_text("%s", choice->name)
               : fe_print_text("%.*s/%s", kind, strchr(choice->interface, '.') + 1, choice->name);
}

/* Whether the model exists and offers the service; checked before its parameters are. */
static bool serves(fe_library *library, const char *id, const fe_service_choice *choice,
                   fe_report *report)
{
    const fe_loaded *loaded = fe_library_load(library, id, FE_NOWHERE, report);
    return loaded && (ff_model_find_service(loaded->model, choice->interface) >= 0 ||
                      fe_error(report, FE_EXIT_INPUT, FE_NOWHERE, NULL,
                               "%s cannot be used for %s: it does not offer the service \"%s\"", id,
                               choice->option, choice->interface));
}

bool fe_service_open(fe_service *service, fe_library *library, const fe_service_choice *choice,
                     fe_report *report)
{
    const char *kind = strchr(choice->interface, '.') + 1;
    int length = (int)strcspn(kind, "/");
    *service = (fe_service){.table = NULL};
    char *id = id_of(choice, length);
    if (!serves(library, id, choice, report)) {
        fe_free(id);
        return false;
    }
    service->tree = fe_tree_parse(choice->option, ".", "format: 1\n", report);
    char *use = fe_print_text("pipeline.%.*s.use=%s", length, kind, id);
    fe_tree_set(service->tree, use, NULL, fe_pipeline_top_keys, report);
    fe_free(use);
    fe_free(id);
    for (size_t i = 0; i < choice->setting_count; i++) {
        char *text = fe_print_text("%.*s.%s", length, kind, choice->settings[i]);
        fe_tree_set(service->tree, text, "pipeline", fe_pipeline_top_keys, report);
        fe_free(text);
    }
    service->pipeline = fe_pipeline_build(service->tree, library, true, report);
    if (!service->pipeline || fe_report_errors(report) > 0)
        return false;
    fe_stage *stage = &service->pipeline->stages[0];
    int output = ff_model_find_service(stage->loaded->model, choice->interface);
    service->table = fe_fetch_service(stage, (uint32_t)output, report);
    return fe_report_errors(report) == 0;
}

void fe_service_close(fe_service *service)
{
    fe_pipeline_free(service->pipeline);
    fe_tree_free(service->tree);
    *service = (fe_service){.table = NULL};
}

bool fe_service_call(const fe_service *service, const char *action,
                     ff_status (*work)(const void *table, void *ctx), void *ctx, fe_report *report)
{
    size_t errors = fe_report_errors(report);
    fe_call call = fe_call_begin(&service->pipeline->stages[0], action);
    ff_status status = work(service->table, ctx);
    bool reported = status != FF_OK && fe_report_errors(report) > errors;
    return fe_call_end(&call, reported ? FF_OK : status, report) && !reported;
}
