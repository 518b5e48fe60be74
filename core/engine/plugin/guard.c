/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "guard.h"

/* With this model of access nothing is allocated when a signal handler is the first to read it. */
static _Thread_local fe_guard_mark running __attribute__((tls_model("initial-exec")));

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
