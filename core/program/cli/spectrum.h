/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums over the rows of a load spectrum, for the terminal and in files. */
#ifndef CLI_SPECTRUM_H
#define CLI_SPECTRUM_H

#include "../study/cases/spectrum.h"

extern const char cli_spectrum_files[]; /* "spectrum.json, spectrum.figure.json, " */

/* Sums over the rows and writes the files; false after an error. `sums` is to be released. */
bool cli_spectrum_sum(const study_run *run, json_t **sums, ff_report *report);
void cli_spectrum_print(const json_t *sums);

#endif
