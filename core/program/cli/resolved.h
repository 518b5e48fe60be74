/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The file as one, with all that includes and --set have made of it, as YAML that runs to the same
   result. Behind each value stands where it comes from. */
#ifndef CLI_RESOLVED_H
#define CLI_RESOLVED_H

#include "session.h"

void cli_print_resolved(const cli_session *session, const cli_options *options);

#endif
