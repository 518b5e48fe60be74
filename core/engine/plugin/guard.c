/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "guard.h"

/*
 * A process runs one stage at a time, but threads of the plugin may fault: so this is kept for the
 * process and not for the thread.
 */
static fe_guard_mark running;

fe_guard_mark fe_guard_enter(const char *path, const char *stage, const char *action)
{
    fe_guard_mark previous = running;
    running = (fe_guard_mark){.path = path, .stage = stage, .action = action};
    return previous;
}

void fe_guard_leave(fe_guard_mark previous)
{
    running = previous;
}

fe_guard_mark fe_guard_current(void)
{
    return running;
}
