/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums over the rows of a load spectrum, as an answer. */
#ifndef CLI_SPECTRUM_H
#define CLI_SPECTRUM_H

#include "../study/run/context.h"

/* Sums over the rows, and stores sentences, files and facts in the context. False after an error in
 * its report. */
bool cli_spectrum_sum(const study_run *run, study_context *context);

#endif
