/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Keeps a fault inside a plugin from looking like a fault of the program: a signal or a call of
 * exit() while a plugin is at work ends the program with FE_EXIT_PLUGIN and one sentence that names
 * the plugin, the stage and what it was doing.
 */
#ifndef FE_GUARD_H
#define FE_GUARD_H

#include <stdbool.h>

/* Installs the handlers; once, at program start. json: also print the failure as the one JSON
   object that a --json run owes its caller. */
void fe_guard_install(bool json);

/* Which code runs from here on: path of the shared object, stage or NULL, "evaluate". Calls may
   nest: what fe_guard_enter returns is given to fe_guard_leave. */
typedef struct fe_guard_mark {
    const char *path, *stage, *action;
} fe_guard_mark;

fe_guard_mark fe_guard_enter(const char *path, const char *stage, const char *action);
void fe_guard_leave(fe_guard_mark previous);

#endif
