/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Finds which of the plugins that take part is to blame for a fault, a call of exit() or of fork(),
 * and ends the process with FF_FAULT_PLUGIN and a sentence. lead.h has what remains: ends that no
 * handler sees.
 */
#ifndef CRASH_CRASH_H
#define CRASH_CRASH_H

/* Installs the handlers; once, at program start, in the process that works. */
void crash_install(void);

/* Ends the process: memory of that size was refused again and again. */
_Noreturn void crash_starve(unsigned long long bytes);

#endif
