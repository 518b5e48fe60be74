/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CLI_SUMMARY_H
#define CLI_SUMMARY_H

#include "../results/write.h"

/* Prints what the file asks for, and what is to be looked at, on stdout, as wide as the terminal;
   with `all` also the stages and whatever was computed besides. */
void cli_print_summary(const results_outcome *outcome, bool all);

#endif
