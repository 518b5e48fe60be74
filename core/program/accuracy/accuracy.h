/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs a file that asks for numerical errors, measures them, and refines the settings until they
   meet the file's goals. */
#ifndef ACCURACY_ACCURACY_H
#define ACCURACY_ACCURACY_H

#include "measure.h"

/*
 * Runs a file that asks for numerical errors and measures them. If the file states goals, the
 * settings that it leaves open are chosen to meet them; `report` then receives the messages of the
 * run that gives the answer. `run` and `engine` must outlive the record. Returns false after an
 * error, or if the observer stopped the run.
 */
bool accuracy_run(accuracy_record *record, ff_run *run, ff_engine *engine, const ff_observer *watch,
                  ff_report *report);

#endif
