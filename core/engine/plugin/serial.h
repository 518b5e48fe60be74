/* SPDX-License-Identifier: MIT */
/*
 * Shared objects whose models say FF_SERIAL run one call at a time in the process, whichever engine
 * makes it: each has a lock. A call takes at once the locks of all objects whose code it may run,
 * its model's and those of the services that this was wired to, and waits while another thread has
 * one of them; it never holds a part of them while it waits, so that calls cannot wait for each
 * other in a ring. A thread that has a lock may take it again.
 */
#ifndef FE_SERIAL_H
#define FE_SERIAL_H

#include <flankfilm/plugin.h>

/* A set of locks: a bit for each. */
typedef uint64_t fe_serial;

/* The loading of objects, which may make their tables only then. */
#define FE_SERIAL_LOADING ((fe_serial)1)

/* The lock of the object that the model is in; the empty set where it may run beside others. Few
   objects are serial: two of them may share a lock. */
fe_serial fe_serial_of(const ff_model *model);

void fe_serial_enter(fe_serial set);
void fe_serial_leave(fe_serial set);

#endif
