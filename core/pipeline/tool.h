/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A model that serves the program instead of a pipeline: one that the command line names. */
#ifndef FF_TOOL_H
#define FF_TOOL_H

#include "pipeline.h"

typedef struct ff_tool {
    ff_tree *tree;
    ff_pipeline *pipeline; /* of it alone */
    const void *table;     /* of its service */
} ff_tool;

/* What the command line says of it. */
typedef struct ff_tool_choice {
    const char *option;    /* "--executor" */
    const char *interface; /* "flankfilm.KIND/1": the model is KIND/<name> */
    const char *name;      /* or kind/name */
    const char **settings; /* "parameter=value" */
    size_t setting_count;
    const ff_node *node; /* or a map of them in a file; the model is called `name` in messages */
} ff_tool_choice;

/* False with errors in the report; the tool is to be closed either way. */
bool ff_tool_open(ff_tool *tool, ff_library *library, const ff_tool_choice *choice,
                  ff_report *report);
void ff_tool_close(ff_tool *tool);

/* Calls `work`, which calls the service: what goes wrong in there is told as the model's fault,
   unless `work` has told of an error itself. */
bool ff_tool_call(const ff_tool *tool, const char *action,
                  ff_status (*work)(const void *table, void *ctx), void *ctx, ff_report *report);

#endif
