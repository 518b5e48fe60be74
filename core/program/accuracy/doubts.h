/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What stages doubt of their own numbers. */
#ifndef ACCURACY_DOUBTS_H
#define ACCURACY_DOUBTS_H

#include <flankfilm/engine.h>

/* Whether a stage doubts its numbers by anything but the errors that are measured, and that finer
   settings may help. before: NULL, or a coarser answer, of the same stages. */
bool accuracy_has_doubts(const ff_pipeline *answer, const ff_pipeline *before);

#endif
