/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Ends processes whose libraries ask for memory until they get it: with a limited address space
 * OpenBLAS never returns. A timer of CPU time looks again and again whether the system has just
 * refused memory.
 */
#ifndef CRASH_HUNGER_H
#define CRASH_HUNGER_H

/* From now on, ends the process with a sentence when it starves. Does nothing if the address space
   is not limited. Child processes need a call of their own. */
void crash_hunger_watch(void);

#endif
