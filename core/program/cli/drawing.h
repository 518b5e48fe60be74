/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints the table of a drawing of a gear pair. */
#ifndef CLI_DRAWING_H
#define CLI_DRAWING_H

#include "options.h"
#include "session.h"

/* Prints a table for each stage that is a pair of gears; returns the exit code. */
int cli_print_drawing(cli_session *session, const cli_options *options);

#endif
