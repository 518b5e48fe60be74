/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints the file with all its includes and --set as one YAML file that gives the same result. A
 * remark after each value says where it comes from. */
#ifndef CLI_RESOLVED_H
#define CLI_RESOLVED_H

#include "session.h"

void cli_print_resolved(const cli_session *session, const cli_options *options);

#endif
