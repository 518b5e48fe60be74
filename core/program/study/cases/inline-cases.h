/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Cases that the file itself lists, row by row:
 *     cases:
 *       - {time: 40 %, duty.torque: 220 N m, duty.speed: 1500 rpm}
 *       - {time: 60 %, duty.torque: 150 N m}
 *
 * If a row does not contain a path, the path keeps the value of the file.
 */
#ifndef STUDY_INLINE_CASES_H
#define STUDY_INLINE_CASES_H

#include "study.h"

bool study_listed_is(const ff_node *cases);
/* Reads the rows into an axis of the study. Returns false after an error. */
bool study_listed_read(study_definition *study, const ff_node *cases, ff_report *report);

#endif
