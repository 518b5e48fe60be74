/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the files of a study that are derived from its records. */
#ifndef STUDY_TABLE_H
#define STUDY_TABLE_H

#include "study.h"

/* Writes the description of the study next to its journal. `tally` as in study_run.describe. */
bool study_describe(const study_run *run, const study_tally *tally, ff_report *report);

/* Writes table.csv, and the description with the verdicts. `keys` has the keys of all cases.
   `records`: the contents of the journals; NULL: they are read when no other shard is writing the
   table. */
bool study_table_write(const study_run *run, char (*keys)[STUDY_KEY_SIZE], study_records *records,
                       ff_report *report);

#endif
