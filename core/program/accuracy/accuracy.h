/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Answers with their numerical errors, measured, and as small as the file asks. */
#ifndef ACCURACY_ACCURACY_H
#define ACCURACY_ACCURACY_H

#include "measure.h"

/*
 * Runs the pipeline that was built from the tree. Where the file asks for errors they are measured;
 * where it says how large they may be, the settings that it leaves open are chosen for that, and
 * the answer comes from another pipeline. The record has both, and refers to tree, engine and
 * pipeline. False after an error, and, without one, where the observer's progress stopped it.
 */
bool accuracy_run(accuracy_record *record, const ff_tree *tree, ff_engine *engine,
                  ff_pipeline *pipeline, const ff_observer *watch, ff_report *report);

#endif
