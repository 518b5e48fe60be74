/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Which plugin's code is running, for handlers of crashes. Each thread knows its own: a thread that
 * a plugin started knows nothing, and the one that waits for it has the answer.
 */
#ifndef FE_GUARD_H
#define FE_GUARD_H

/* Path of the shared object, or NULL when no plugin runs; stage or NULL; "evaluate" and the like.
 */
typedef struct fe_guard_mark {
    const char *path, *stage, *action;
} fe_guard_mark;

/* Which code runs from here on. Calls may nest: what fe_guard_enter returns is given to
   fe_guard_leave. */
fe_guard_mark fe_guard_enter(const char *path, const char *stage, const char *action);
void fe_guard_leave(fe_guard_mark previous);

fe_guard_mark fe_guard_current(void); /* may be called in a handler of signals */

#endif
