/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Ends processes whose libraries request memory in an endless loop, as OpenBLAS does if the address
 * space is limited. A timer of CPU time checks repeatedly whether the system has just refused
 * memory.
 */
#ifndef CRASH_ALLOC_WATCH_H
#define CRASH_ALLOC_WATCH_H

/* From now on, ends the process with a sentence when memory is refused repeatedly. Does nothing if
   the address space is not limited. Child processes must call it themselves. */
void crash_hunger_watch(void);

#endif
