/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tool.h"

#include "build.h"

#include <stdlib.h>
#include <string.h>

/* "kind/name" for the name alone, too; to be freed. */
static char *id_of(const ff_tool_choice *choice, int kind)
{
    return strchr(choice->name, '/')
               ? ff_print_text("%s", choice->name)
               : ff_print_text("%.*s/%s", kind, strchr(choice->interface, '.') + 1, choice->name);
}

/* Whether it is there and offers the service, before any parameter is looked at. */
static bool serves(ff_library *library, const char *id, const ff_tool_choice *choice,
                   ff_report *report)
{
    const ff_loaded *loaded = ff_library_load(library, id, FF_NOWHERE, report);
    return loaded && (ff_model_find_service(loaded->model, choice->interface) >= 0 ||
                      ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL,
                               "%s cannot stand behind %s: it offers no service \"%s\"", id,
                               choice->option, choice->interface));
}

static bool open_service(ff_tool *tool, const char *interface, ff_report *report)
{
    ff_stage *stage = &tool->pipeline->stages[0];
    uint32_t output = (uint32_t)ff_model_find_service(stage->loaded->model, interface);
    ff_call call = ff_call_begin(stage, "service");
    tool->table = stage->loaded->model->service(stage->instance->self, output);
    return ff_call_end(&call, FF_OK, report) &&
           (tool->table || ff_blame(stage, report, "gave no table for its service"));
}

/* A pipeline of the model alone, with the parameters that a file gives it (or NULL). */
static ff_tree *tree_of(const ff_tool_choice *choice, const char *name, const char *id,
                        ff_report *report)
{
    char *text = ff_print_text("pipeline.%s.use=%s", name, id);
    char *keys[] = {(char *)(size_t)choice->name}; /* which outlives the tree */
    ff_tree *tree = ff_tree_parse(choice->option, ".", "format: 1\n", report);
    if (choice->node) {
        ff_node stage = *choice->node, *items[] = {&stage};
        ff_place places[] = {stage.place};
        const ff_node pipeline = {.kind = FF_MAP,
                                  .place = stage.place,
                                  .count = 1,
                                  .items = items,
                                  .keys = keys,
                                  .key_places = places};
        ff_tree_put(tree, "pipeline", &pipeline);
    }
    ff_tree_set(tree, text, NULL, ff_pipeline_top_keys, report);
    free(text);
    return tree;
}

bool ff_tool_open(ff_tool *tool, ff_library *library, const ff_tool_choice *choice,
                  ff_report *report)
{
    const char *kind = strchr(choice->interface, '.') + 1;
    int length = (int)strcspn(kind, "/");
    *tool = (ff_tool){.table = NULL};
    char *id = id_of(choice, length);
    if (!serves(library, id, choice, report)) {
        free(id);
        return false;
    }
    char *name = choice->node ? ff_copy_text(choice->name, strlen(choice->name))
                              : ff_copy_text(kind, (size_t)length);
    tool->tree = tree_of(choice, name, id, report);
    free(id);
    for (size_t i = 0; i < choice->setting_count; i++) {
        char *text = ff_print_text("%s.%s", name, choice->settings[i]);
        ff_tree_set(tool->tree, text, "pipeline", ff_pipeline_top_keys, report);
        free(text);
    }
    free(name);
    tool->pipeline = ff_pipeline_build(tool->tree, library, true, report);
    return tool->pipeline && ff_report_errors(report) == 0 &&
           open_service(tool, choice->interface, report);
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
    size_t errors = ff_report_errors(report);
    ff_call call = ff_call_begin(&tool->pipeline->stages[0], action);
    ff_status status = work(tool->table, ctx);
    bool told = status != FF_OK && ff_report_errors(report) > errors;
    return ff_call_end(&call, told ? FF_OK : status, report) && !told;
}
