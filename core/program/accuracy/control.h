/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Settings with which an answer is as exact as the file asks. */
#ifndef ACCURACY_CONTROL_H
#define ACCURACY_CONTROL_H

#include "measure.h"

/*
 * Runs and measures the file with the settings that it leaves open, coarse ones first, and refines
 * those that the errors come from, until all errors are below what the file asks for, or refining
 * helps no more. The record has the answer, which may be of another run; what that says goes to
 * the observer and the report. False after an error, and where the observer's progress stopped it.
 */
bool accuracy_control(accuracy_record *record, const ff_run *run, ff_engine *engine,
                      const ff_observer *watch, ff_report *report);

#endif
