/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Writes tidy CSV: every row begins with its case and what the study varies, every column has its
 * unit in its head. scalars.csv has a row for each case; <stage>-<dimensions>.csv has all outputs
 * of a stage along the same dimensions, with a row for each point of each case. quality.csv and
 * origin.csv say how far the numbers can be trusted, and where they come from. What a study found
 * keeps the name that it has in the directory: map.csv.
 */
#ifndef RESULTS_EXPORT_CSV_H
#define RESULTS_EXPORT_CSV_H

#include "view.h"

#include "folder.h"

/* Writes the files into the folder, which the caller commits. False with an error in the report. */
bool results_export_csv(const results_view *view, const char *directory, results_folder *folder);

#endif
