/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of studies: reads one, checks it, and runs it. */
#ifndef STUDY_KINDS_H
#define STUDY_KINDS_H

#include "answer/kind.h"

/* Reads what stands under `study:`. After errors it returns NULL, or a study that must not be run
   but keeps the texts that the messages need. The tree of the root must outlive the study. */
study_definition *study_open(const ff_node *root, ff_report *report);
void study_free(study_definition *study); /* frees its driver, too; accepts NULL */

/* Checks that the pipeline has what the driver of the study names. */
void study_check(const study_definition *study, const ff_pipeline *pipeline, ff_report *report);
/* Returns the name of the i-th model that a study compares with the model of the file, and the
 * number of its case; NULL after the last one. */
const char *study_compared(const study_definition *study, size_t i, size_t *index);
const char *study_kind_name(const study_definition *study); /* "" when it has no driver */
const char *study_cases(const study_definition *study);     /* what its cases are called: "cases" */
const char *
study_further(const study_definition *study); /* which cases may follow; "" when none do */

/* Builds those cases of a driver that must be free of errors before any case runs. */
bool study_open_cases(const study_run *run, ff_report *report);
/* Runs a study with a driver: the cases that the driver submits, in this process and its workers.
 * Then writes the table of the cases that ran, and the driver's files. */
bool study_drive(const study_run *run, study_counters *counters, ff_report *report);
/* Tells what a run would do. For a study with a driver these are also the cases that the driver
 * would submit by the results that it has already. */
void study_plan_run(const study_run *run, study_plan *plan);
/* What the driver of a study found: facts, files and verdict. NULL without a driver. */
const study_context *study_found(const study_definition *study);

#endif
