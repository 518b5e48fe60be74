/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Doubts that stages raise about their own numbers. */
#ifndef ACCURACY_DOUBTS_H
#define ACCURACY_DOUBTS_H

#include <flankfilm/engine.h>

/* True if a stage doubts its numbers for a reason that finer settings may remove, measured errors
   aside. `before` is a coarser answer of the same stages, or NULL. */
bool accuracy_has_doubts(const ff_pipeline *answer, const ff_pipeline *before);

#endif
