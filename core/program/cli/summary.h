/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The answers of a run on the terminal. */
#ifndef CLI_SUMMARY_H
#define CLI_SUMMARY_H

#include "../results/write.h"

/* Prints on stdout, as wide as the terminal, what the file requests and what needs attention;
 * with `all` also the stages and everything else that was computed. */
void cli_print_summary(const results_outcome *outcome, bool all);

#endif
