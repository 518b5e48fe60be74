/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Calls that change what the whole process has, start another one or send a signal. As with the
 * ends of exits.h, the program defines these functions itself, and the dynamic linker gives its
 * definitions to plugins and their libraries. They do what libc's do, unless a plugin calls them.
 */
#ifndef CRASH_MEDDLING_H
#define CRASH_MEDDLING_H

#include <stdbool.h>

/* `ask` is called with the name of the function, the address that it will return to, and whether it
   may end the program; it does not return for that of a plugin. */
void crash_meddling_watch(void (*ask)(const char *function, const void *caller, bool ends));

#endif
