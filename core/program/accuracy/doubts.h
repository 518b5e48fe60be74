/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What stages doubt of their own numbers. */
#ifndef ACCURACY_DOUBTS_H
#define ACCURACY_DOUBTS_H

#include <flankfilm/engine.h>

/*
 * Whether a stage doubts its numbers, and finer settings may help. Of an error that is measured it
 * does where it estimates more than the file of `goals` asks for: what all twins sample too
 * coarsely none of them shows. goals: NULL, such estimates are no doubts. before: NULL, or a
 * coarser answer, of the same stages.
 */
bool accuracy_has_doubts(const ff_pipeline *answer, const ff_pipeline *before,
                         const ff_tree *goals);

#endif
