/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds settings that meet the accuracy goals of a file. */
#ifndef ACCURACY_CONTROL_H
#define ACCURACY_CONTROL_H

#include "measure.h"

/*
 * Runs and measures the file, coarse first, and refines the open settings that cause the errors
 * until all goals are met or refinement helps no more. The record holds the answer and refers to
 * the run that gave it. The messages of that run go to the observer and the report. Returns false
 * after an error, or if the observer stopped it.
 */
bool accuracy_control(accuracy_record *record, const accuracy_scene *scene, ff_report *report);

#endif
