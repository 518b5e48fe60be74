/* SPDX-License-Identifier: MIT */
/* Locks for models with the flag FF_SERIAL: a shared object with such a model runs only one call at
   a time in the process, for all engines together. A call takes the locks of its model and of the
   services wired to the model at once. While a call waits it holds no lock, so that calls cannot
   deadlock. Locks are recursive: a thread may take a lock again that it holds. */
#ifndef FE_SERIAL_H
#define FE_SERIAL_H

#include <flankfilm/plugin.h>

/* A set of locks, one bit for each. */
typedef uint64_t fe_serial;

/* The lock for loading: an object may fill its tables only while it is being loaded. */
#define FE_SERIAL_LOADING ((fe_serial)1)

/* Returns the lock of the shared object that has the model; the empty set if the object may run in
   parallel with others. Two objects may share a lock, since serial objects are few. */
fe_serial fe_serial_of(const ff_model *model);

void fe_serial_enter(fe_serial set);
void fe_serial_leave(fe_serial set);

#endif
