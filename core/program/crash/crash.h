/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Finds the plugin that caused a fault, or called exit() or fork(), and ends the process with
 * FF_FAULT_PLUGIN and a sentence. lead.h handles ends of the process that no handler can catch.
 */
#ifndef CRASH_CRASH_H
#define CRASH_CRASH_H

/* Installs the handlers, once, at the start of the working process. */
void crash_install(void);

/* Ends the process, since the system has repeatedly refused it `bytes` of memory. */
_Noreturn void crash_starve(unsigned long long bytes);

#endif
