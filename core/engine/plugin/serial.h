/* SPDX-License-Identifier: MIT */
/* Locks for models with the flag FF_SERIAL: a shared object with such a model runs one call at a
 * time in the process, whichever engine makes it. A call takes all locks it may need at once,
 * those of its model and of the services that the model is wired to, and holds none of them
 * while it waits, so that calls cannot deadlock. A thread may take a lock again that it has. */
#ifndef FE_SERIAL_H
#define FE_SERIAL_H

#include <flankfilm/plugin.h>

/* A set of locks, one bit for each. */
typedef uint64_t fe_serial;

/* The lock for loading objects, which may fill their tables only during loading. */
#define FE_SERIAL_LOADING ((fe_serial)1)

/* Returns the lock of the object that the model is in; the empty set if it may run beside
 * others. Two objects may share a lock, since few are serial. */
fe_serial fe_serial_of(const ff_model *model);

void fe_serial_enter(fe_serial set);
void fe_serial_leave(fe_serial set);

#endif
