/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models that serve the program itself, named on the command line. */
#ifndef CLI_SERVICE_H
#define CLI_SERVICE_H

#include "options.h"

#include <flankfilm/engine.h>

/* Makes an instance of the model KIND/<name>, or kind/name, that `option` names, with the
 * parameters that --with gives, and returns the table of its service in *table. NULL after an
 * error. `interface` is "flankfilm.KIND/1". */
ff_instance *cli_service_open(ff_engine *engine, const cli_options *options, const char *option,
                              const char *interface, const void **table, ff_report *report);

#endif
