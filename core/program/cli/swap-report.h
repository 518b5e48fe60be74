/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What changes when the command line swaps a model: "viscosity.use=viscosity/barus". */
#ifndef CLI_SWAP_REPORT_H
#define CLI_SWAP_REPORT_H

#include "session.h"

/* Prints, for each stage whose model the command line has swapped, which parameters of the file
 * the new model takes and which it cannot take. */
void cli_print_swaps(const cli_session *session, const cli_options *options);

#endif
