/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CLI_SUMMARY_H
#define CLI_SUMMARY_H

#include "../results/write.h"

/* What a person wants to read of a run, on stdout, as wide as the terminal. */
void cli_print_summary(const results_outcome *outcome);

#endif
