/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <flankfilm/engine.h>

#include "service.h"

#include "../memory/memory.h"

#include <stdlib.h>
#include <string.h>

/* Returns "kind/name", also for a name without a kind; the caller frees it. */
static char *id_of(const char *name, const char *interface)
{
    const char *kind = strchr(interface, '.') + 1;
    return strchr(name, '/') ? memory_print_text("%s", name)
                             : memory_print_text("%.*s/%s", (int)strcspn(kind, "/"), kind, name);
}

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

static bool serves(ff_engine *engine, const char *id, const char *option, const char *interface,
                   ff_report *report)
{
    const ff_loaded *loaded = ff_engine_model(engine, id, FF_NOWHERE, report);
    return loaded && (ff_model_find_service(loaded->model, interface) >= 0 ||
                      ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                               "%s cannot be used for --%s: it does not offer the service \"%s\"",
                               id, option, interface));
}

ff_instance *cli_service_open(ff_engine *engine, const cli_options *options, const char *option,
                              const char *interface, const void **table, ff_report *report)
{
    const cli_words settings = cli_option_words(options, "with");
    ff_instance *instance = NULL;
    char *id = id_of(cli_option(options, option), interface);
    bool known = serves(engine, id, option, interface, report), good = known;
    if (known && ff_instance_new(engine, id, &instance) != FF_OK)
        good = ff_error(report, FF_FAULT_RUN, FF_NOWHERE, NULL, "%s", ff_engine_message(engine));
    free(id);
    for (size_t i = 0; i < settings.count && good; i++)
        good = set(instance, settings.words[i], report);
    ff_status status = good ? ff_instance_service(instance, interface, table) : FF_INVALID;
    good = status == FF_OK || status == FF_DOMAIN;
    if (instance)
        ff_report_append(report, ff_instance_report(instance));
    if (good)
        return instance;
    ff_instance_close(instance);
    return NULL;
}
