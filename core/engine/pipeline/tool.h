/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The service of a model that the command line names, which serves the program itself. */
#ifndef FE_TOOL_H
#define FE_TOOL_H

#include "pipeline.h"

typedef struct fe_tool {
    fe_tree *tree;
    fe_pipeline *pipeline; /* of it alone */
    const void *table;     /* of its service */
} fe_tool;

/* What the command line says of it. */
typedef struct fe_tool_choice {
    const char *option;    /* "--executor" */
    const char *interface; /* "flankfilm.KIND/1": the model is KIND/<name> */
    const char *name;      /* or kind/name */
    const char **settings; /* "parameter=value" */
    size_t setting_count;
} fe_tool_choice;

/* False after an error; the tool must be closed either way. */
bool fe_tool_open(fe_tool *tool, fe_library *library, const fe_tool_choice *choice,
                  fe_report *report);
void fe_tool_close(fe_tool *tool);

/* Calls `work`, which calls the service. Its failure is reported as a fault of the model, unless
   `work` has reported an error itself. */
bool fe_tool_call(const fe_tool *tool, const char *action,
                  ff_status (*work)(const void *table, void *ctx), void *ctx, fe_report *report);

#endif
