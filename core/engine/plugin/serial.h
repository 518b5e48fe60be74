/* SPDX-License-Identifier: MIT */
/*
 * Models that say FF_SERIAL run one call at a time in the process, whichever engine makes it. One
 * lock serves them all: such models often share what cannot be shared, a library or a common block,
 * and calls that nest, one serial model within another, cannot wait for each other in a ring.
 */
#ifndef FE_SERIAL_H
#define FE_SERIAL_H

#include <flankfilm/plugin.h>

/* NULL: a model is being loaded, which may make its tables only then. */
void fe_serial_enter(const ff_model *model);
void fe_serial_leave(const ff_model *model);

#endif
