/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds settings that meet the accuracy goals of a file. */
#ifndef ACCURACY_CONTROL_H
#define ACCURACY_CONTROL_H

#include "measure.h"

/*
 * Runs and measures the file, coarse first, and refines the open settings that cause the errors
 * until all goals are met or refinement helps no more. The record receives the answer and a
 * reference to its run. The observer and the report receive the messages of that run. Returns false
 * after an error, or if the observer stopped it.
 */
bool accuracy_control(accuracy_record *record, const accuracy_scene *scene, ff_report *report);

#endif
