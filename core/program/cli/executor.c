/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens the model that --executor names. */
#include "command.h"

#include "../memory/memory.h"

#include <flankfilm/executor.h>

#include <stdlib.h>
#include <string.h>

/* Sets "parameter=value". */
static bool set(ff_instance *instance, const char *assignment, ff_report *report)
{
    const char *equals = strchr(assignment, '=');
    if (!equals)
        return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                        "--with %s: expected PARAMETER=VALUE", assignment);
    char *param = memory_copy_text(assignment, (size_t)(equals - assignment));
    ff_status status = ff_instance_set(instance, param, equals + 1);
    free(param);
    return status == FF_OK;
}

ff_instance *cli_executor_open(ff_engine *engine, const cli_options *options, ff_report *report)
{
    const char *name = cli_option(options, "executor");
    const cli_words settings = cli_option_words(options, "with");
    ff_instance *instance = NULL;
    const void *table;
    char *id = memory_print_text("%s%s", strchr(name, '/') ? "" : "executor/", name);
    bool good = ff_engine_model(engine, id, FF_NOWHERE, report);
    if (good && ff_instance_new(engine, id, &instance) != FF_OK)
        good = ff_error(report, FF_FAULT_RUN, FF_NOWHERE, NULL, "%s", ff_engine_message(engine));
    free(id);
    for (size_t i = 0; i < settings.count && good; i++)
        good = set(instance, settings.words[i], report);
    ff_status status = good ? ff_instance_service(instance, FF_EXECUTOR_ID, &table) : FF_INVALID;
    if (instance)
        ff_report_append(report, ff_instance_report(instance));
    if (status == FF_OK || status == FF_DOMAIN)
        return instance;
    ff_instance_close(instance);
    return NULL;
}
