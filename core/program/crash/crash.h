/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Keeps a fault inside a plugin from looking like a fault of the program: a signal or a call of
 * exit() while a plugin's code runs ends the program with FF_FAULT_PLUGIN and one sentence that
 * names the plugin, the stage and what it was doing.
 */
#ifndef CRASH_CRASH_H
#define CRASH_CRASH_H

#include <stdbool.h>

/* Installs the handlers; once, at program start. json: also print the failure as the one JSON
   object that a --json run owes its caller. */
void crash_install(bool json);

#endif
