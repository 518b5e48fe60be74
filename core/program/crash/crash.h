/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Finds the plugin to blame for a fault or for a call of exit() or fork(), and ends the process
 * with FF_FAULT_PLUGIN and a sentence. lead.h covers the ends that no handler sees.
 */
#ifndef CRASH_CRASH_H
#define CRASH_CRASH_H

/* Installs the handlers; once, at program start, in the working process. */
void crash_install(void);

/* Ends the process after memory of that size was refused again and again. */
_Noreturn void crash_starve(unsigned long long bytes);

#endif
