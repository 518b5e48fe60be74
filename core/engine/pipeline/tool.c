/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tool.h"

#include "build.h"

#include <stdlib.h>
#include <string.h>

/* "kind/name", also of a name alone; the caller frees it. */
static char *id_of(const fe_tool_choice *choice, int kind)
{
    return strchr(choice->name, '/')
               ? fe_print_text("%s", choice->name)
               : fe_print_text("%.*s/%s", kind, strchr(choice->interface, '.') + 1, choice->name);
}

/* Whether the model exists and offers the service; checked before its parameters are. */
static bool serves(fe_library *library, const char *id, const fe_tool_choice *choice,
                   fe_report *report)
{
    const fe_loaded *loaded = fe_library_load(library, id, FE_NOWHERE, report);
    return loaded && (ff_model_find_service(loaded->model, choice->interface) >= 0 ||
                      fe_error(report, FE_EXIT_INPUT, FE_NOWHERE, NULL,
                               "%s cannot stand behind %s: it offers no service \"%s\"", id,
                               choice->option, choice->interface));
}

bool fe_tool_open(fe_tool *tool, fe_library *library, const fe_tool_choice *choice,
                  fe_report *report)
{
    const char *kind = strchr(choice->interface, '.') + 1;
    int length = (int)strcspn(kind, "/");
    *tool = (fe_tool){.table = NULL};
    char *id = id_of(choice, length);
    if (!serves(library, id, choice, report)) {
        free(id);
        return false;
    }
    tool->tree = fe_tree_parse(choice->option, ".", "format: 1\n", report);
    char *use = fe_print_text("pipeline.%.*s.use=%s", length, kind, id);
    fe_tree_set(tool->tree, use, NULL, fe_pipeline_top_keys, report);
    free(use);
    free(id);
    for (size_t i = 0; i < choice->setting_count; i++) {
        char *text = fe_print_text("%.*s.%s", length, kind, choice->settings[i]);
        fe_tree_set(tool->tree, text, "pipeline", fe_pipeline_top_keys, report);
        free(text);
    }
    tool->pipeline = fe_pipeline_build(tool->tree, library, true, report);
    if (!tool->pipeline || fe_report_errors(report) > 0)
        return false;
    fe_stage *stage = &tool->pipeline->stages[0];
    int output = ff_model_find_service(stage->loaded->model, choice->interface);
    tool->table = fe_fetch_service(stage, (uint32_t)output, report);
    return fe_report_errors(report) == 0;
}

void fe_tool_close(fe_tool *tool)
{
    fe_pipeline_free(tool->pipeline);
    fe_tree_free(tool->tree);
    *tool = (fe_tool){.table = NULL};
}

bool fe_tool_call(const fe_tool *tool, const char *action,
                  ff_status (*work)(const void *table, void *ctx), void *ctx, fe_report *report)
{
    size_t errors = fe_report_errors(report);
    fe_call call = fe_call_begin(&tool->pipeline->stages[0], action);
    ff_status status = work(tool->table, ctx);
    bool told = status != FF_OK && fe_report_errors(report) > errors;
    return fe_call_end(&call, told ? FF_OK : status, report) && !told;
}
