/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes tidy CSV: every row begins with the number of its case and the varied values, and every
 * column head contains the unit. scalars.csv has a row for each case. <stage>-<dimensions>.csv has
 * all outputs of a stage with the same dimensions, and a row for each point of each case.
 * quality.csv shows how far the numbers can be trusted, origin.csv where they come from. Tables of
 * the study itself, such as map.csv, keep their names. */
#ifndef RESULTS_EXPORT_CSV_H
#define RESULTS_EXPORT_CSV_H

#include "view.h"

#include "folder.h"

/* Writes the files to the folder, which the caller commits. Returns false with an error in the
 * report. */
bool results_export_csv(const results_view *view, const char *directory, results_folder *folder);

#endif
