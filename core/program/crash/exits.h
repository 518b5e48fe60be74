/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The ends of a process that run no handler: _exit, exec and the like. The program defines these
 * functions itself, and the dynamic linker gives its definitions to plugins and their libraries.
 * They do what libc's do, unless a plugin calls them.
 */
#ifndef CRASH_EXITS_H
#define CRASH_EXITS_H

/* `ask` is called with the name of the function and the address that it will return to, and does
   not return for that of a plugin. */
void crash_exits_watch(void (*ask)(const char *function, const void *caller));

/* Ends the process without a question. For handlers of signals, once crash_exits_watch was called.
 */
_Noreturn void crash_leave(int status);

#endif
