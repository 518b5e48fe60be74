/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Libraries that ask for memory until they get it: under a limit of the address space OpenBLAS
 * never returns. By a timer that counts the time of the processor, the process is seen again and
 * again where the system has just refused memory.
 */
#ifndef CRASH_HUNGER_H
#define CRASH_HUNGER_H

/* Ends the process with a sentence when it starves, from now on. Without a limit of the address
   space nothing is done. Processes that are made from here need it anew. */
void crash_hunger_watch(void);

#endif
