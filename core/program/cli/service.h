/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A model that the command line names, which serves the program itself. */
#ifndef CLI_SERVICE_H
#define CLI_SERVICE_H

#include "options.h"

#include <flankfilm/engine.h>

/* An instance of the model KIND/<name>, or kind/name, that `option` names, with what --with says of
   its parameters, and the table of its service. NULL after an error. `interface` is
   "flankfilm.KIND/1". */
ff_instance *cli_service_open(ff_engine *engine, const cli_options *options, const char *option,
                              const char *interface, const void **table, ff_report *report);

#endif
