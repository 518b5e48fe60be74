/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads, checks and runs studies of all kinds. */
#ifndef STUDY_KINDS_H
#define STUDY_KINDS_H

#include "answer/kind.h"

/* Reads the map under `study:`. After errors it returns NULL, or a study that must not be run but
 * keeps the texts that the messages need. The tree of the root must outlive the study. */
study_definition *study_open(const ff_node *root, ff_report *report);
void study_free(study_definition *study); /* frees its driver, too; accepts NULL */

/* Checks that the pipeline has the stages and outputs that the study names. */
void study_check(const study_definition *study, const ff_pipeline *pipeline, ff_report *report);
/* Returns the name of the i-th model that a study compares with the model of the file, and the
 * number of its case; NULL after the last one. */
const char *study_compared(const study_definition *study, size_t i, size_t *index);
const char *study_kind_name(const study_definition *study); /* "" if it has no driver */
const char *study_cases(const study_definition *study);     /* word for its cases: "cases" */
const char *study_further(
    const study_definition *study); /* description of cases that may follow; "" if there are none */

/* Builds those cases of a driver that must be free of errors before any case runs. */
bool study_open_cases(const study_run *run, ff_report *report);
/* Runs a study with a driver: the cases that the driver submits, in this process and its workers.
 * Then writes the table of the cases that ran, and the driver's files. */
bool study_drive(const study_run *run, study_counters *counters, ff_report *report);
/* Counts what a run would do. For a study with a driver this includes the cases that the driver
 * would submit based on existing results. */
void study_plan_run(const study_run *run, study_plan *plan);
/* Returns what the driver of a study found: facts, files and verdict. NULL if there is no driver.
 */
const study_context *study_found(const study_definition *study);

#endif
