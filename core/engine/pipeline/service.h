/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The service of a model that the command line names, which serves the program itself. */
#ifndef FE_SERVICE_H
#define FE_SERVICE_H

#include "pipeline.h"

typedef struct fe_service {
    fe_tree *tree;
    fe_pipeline *pipeline; /* of it alone */
    const void *table;     /* of its service */
} fe_service;

/* What the command line says of it. */
typedef struct fe_service_choice {
    const char *option;    /* "--executor" */
    const char *interface; /* "flankfilm.KIND/1": the model is KIND/<name> */
    const char *name;      /* or kind/name */
    const char **settings; /* "parameter=value" */
    size_t setting_count;
} fe_service_choice;

/* False after an error; the service must be closed either way. */
bool fe_service_open(fe_service *service, fe_library *library, const fe_service_choice *choice,
                     fe_report *report);
void fe_service_close(fe_service *service);

/* Calls `work`, which calls the service. Its failure is reported as a fault of the model, unless
   `work` has reported an error itself. */
bool fe_service_call(const fe_service *service, const char *action,
                     ff_status (*work)(const void *table, void *ctx), void *ctx, fe_report *report);

#endif
