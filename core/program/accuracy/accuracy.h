/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Answers with their numerical errors, measured, and as small as the file asks. */
#ifndef ACCURACY_ACCURACY_H
#define ACCURACY_ACCURACY_H

#include "measure.h"

/*
 * Runs a file that asks for errors, which are measured. Where it says how large they may be, the
 * settings that it leaves open are chosen for that, and the answer comes from another run; what
 * that says goes to `report`. The record refers to run and engine. False after an error, and,
 * without one, where the observer's progress stopped it.
 */
bool accuracy_run(accuracy_record *record, ff_run *run, ff_engine *engine, const ff_observer *watch,
                  ff_report *report);

#endif
