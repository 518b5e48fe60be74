/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an assignment such as "viscosity.use=viscosity/barus" moved. */
#ifndef CLI_SWAP_H
#define CLI_SWAP_H

#include "session.h"

/* Prints, for each stage whose model the command line has changed, what of the file the new one
   takes and what it cannot take. */
void cli_print_swaps(const cli_session *session, const cli_options *options);

#endif
