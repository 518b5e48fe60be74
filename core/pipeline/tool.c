/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tool.h"

#include "build.h"

#include <stdlib.h>
#include <string.h>

static bool find_service(ff_tool *tool, const char *interface, ff_report *report)
{
    ff_stage *stage = &tool->pipeline->stages[0];
    const ff_model *model = stage->loaded->model;
    for (size_t i = 0; i < model->output_count; i++) {
        const char *service = stage->results[i].row->service;
        if (!service || strcmp(service, interface) != 0)
            continue;
        ff_call call = ff_call_begin(stage, "service");
        tool->table = model->service(stage->instance->self, (uint32_t)i);
        return ff_call_end(&call, FF_OK, report) &&
               (tool->table || ff_blame(stage, report, "gave no table for its service"));
    }
    return ff_error(report, FF_EXIT_INPUT, stage->use_place, NULL, "%s offers no service \"%s\"",
                    stage->use, interface);
}

bool ff_tool_open(ff_tool *tool, ff_library *library, const ff_tool_choice *choice,
                  ff_report *report)
{
    static const char legal[] = "abcdefghijklmnopqrstuvwxyz0123456789-/";
    const char *kind = strchr(choice->interface, '.') + 1, *name = choice->name;
    int length = (int)strcspn(kind, "/");
    *tool = (ff_tool){.table = NULL};
    if (!*name || strspn(name, legal) < strlen(name))
        return ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL,
                        "%s wants the name of a model, not \"%.100s\"", choice->option, name);
    bool whole = strchr(name, '/') != NULL;
    char *text = ff_print_text("format: 1\npipeline: {%.*s: {use: %.*s%s%s}}\n", length, kind,
                               whole ? 0 : length, kind, whole ? "" : "/", name);
    tool->tree = ff_tree_parse(choice->option, ".", text, report);
    free(text);
    for (size_t i = 0; i < choice->setting_count; i++) {
        text = ff_print_text("%.*s.%s", length, kind, choice->settings[i]);
        ff_tree_set(tool->tree, text, "pipeline", ff_pipeline_top_keys, report);
        free(text);
    }
    tool->pipeline = ff_pipeline_build(tool->tree, library, true, report);
    return tool->pipeline && ff_report_errors(report) == 0 &&
           find_service(tool, choice->interface, report);
}

void ff_tool_close(ff_tool *tool)
{
    ff_pipeline_free(tool->pipeline);
    ff_tree_free(tool->tree);
    *tool = (ff_tool){.table = NULL};
}

bool ff_tool_call(const ff_tool *tool, const char *action,
                  ff_status (*work)(const void *table, void *ctx), void *ctx, ff_report *report)
{
    ff_call call = ff_call_begin(&tool->pipeline->stages[0], action);
    return ff_call_end(&call, work(tool->table, ctx), report);
}
